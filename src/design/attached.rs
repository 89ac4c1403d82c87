//! Files that a design names beside itself: a surveyed section, a terrain raster, a hydrograph, the curve of a dissipator, a table of ropes.

use std::collections::BTreeMap;

use crate::design::curve_file::{self, Way};
use crate::design::dissipator_entries::{CURVES, OF_MAIN_ROPES, OF_RETAINING_ROPES, curve_key};
use crate::design::entries::{Entries, Entry, Origin, Value};
use crate::design::hydrograph_entries::{LISTS, key};
use crate::design::hydrograph_file::{self, Column};
use crate::design::rope_entries::put_named;
use crate::design::rope_table::{self, Listed, plain};
use crate::design::section_file;
use crate::design::show::at;
use crate::design::terrain_file::{Asked, terrain};
use crate::problem::Problem;

/// Files by the name under which the design has them.
pub type Attached = BTreeMap<String, Vec<u8>>;

/// Opens a file that a design names: its bytes, or why there are none.
pub type Open<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, String>;

/// Opens files that were kept with a design.
pub fn within(attached: &Attached) -> impl Fn(&str) -> Result<Vec<u8>, String> {
    |name| attached.get(name).cloned().ok_or_else(|| "it was not kept with the design".to_string())
}

/// Key of the file of a section, and that of the points which it stands for.
const SECTION: [&str; 2] = ["channel.section.file", "channel.section.points"];

/// Reads the files that the entries name, and puts what they hold in their place.
pub fn read_attached(entries: &mut Entries, open: Open, problems: &mut Vec<Problem>) -> Attached {
    let mut attached = Attached::new();
    // Where the design's own table cannot be read, what it names is not known.
    if let Some(ropes) = read_ropes(entries, open, problems, &mut attached) {
        put_named(entries, &ropes, problems);
    }
    for read in [read_section, read_terrain, read_hydrograph, read_curve, read_curve_of_retaining_ropes] {
        if let Some(read) = read(entries, open) {
            match read {
                Ok((name, bytes)) => drop(attached.insert(name, bytes)),
                Err(problem) => problems.push(problem),
            }
        }
    }
    attached
}

type Read = Option<Result<(String, Vec<u8>), Problem>>;

/// The file of a key, if the design names one.
fn opened(entries: &Entries, key: &str, open: Open, wanted: &str) -> Option<Result<(String, Vec<u8>), Problem>> {
    let name = entries.text(key)?.to_string();
    Some(open(&name).map(|bytes| (name.clone(), bytes)).map_err(|why| {
        Problem::new(key, format!("`{name}`, which cannot be read: {why}"), wanted)
            .hint("the name is taken from the folder of the design file")
    }))
}

fn read_section(entries: &mut Entries, open: Open) -> Read {
    let [key, points] = SECTION;
    let wanted = "a text file of points beside the design file";
    let read = opened(entries, key, open, wanted)?;
    Some(read.and_then(|(name, bytes)| {
        let listed = section_file::parse(&bytes)
            .map_err(|(found, hint)| Problem::new(key, format!("`{name}`, {found}"), wanted).hint(hint))?;
        let typed = format!("{} points of {name}", listed.len());
        put(entries, key, points, Value::Points(listed), typed);
        Ok((name, bytes))
    }))
}

/// By how much a slope that is given may differ from that of the raster (rad): 3 degrees.
const MOST_OFF: f64 = 0.0524;

fn read_terrain(entries: &mut Entries, open: Open) -> Read {
    let key = |name: &str| format!("channel.terrain.{name}");
    let wanted = "a raster of the ground beside the design file";
    let read = opened(entries, &key("file"), open, wanted)?;
    let place = |name: &str| entries.points(&key(name)).map(|points| points[0]);
    let length = |name: &str| entries.number(&key(name));
    let asked = Asked {
        left: place("left_end")?,
        right: place("right_end")?,
        upstream: length("upstream")?,
        downstream: length("downstream")?,
    };
    Some(read.and_then(|(name, bytes)| {
        let terrain = terrain(&bytes, &asked).map_err(|(of, found, hint)| {
            let found = if of == "file" { format!("`{name}`, {found}") } else { found };
            let allowed = if of == "file" {
                wanted
            } else {
                "a place in a bank, in the coordinates of the raster, east and north"
            };
            Problem::new(key(of), found, allowed).hint(hint)
        })?;
        let file = key("file");
        let typed = format!("{} points across {name}", terrain.section.len());
        if let Some(given) = entries.number("channel.slope")
            && (given - terrain.slope).abs() > MOST_OFF
        {
            let [given, found] = [given, terrain.slope].map(f64::to_degrees);
            return Err(Problem::new(
                "channel.slope",
                format!("{given:.1} deg, where the lowest line in {name} falls by {found:.1} deg at the barrier"),
                format!("a slope within {:.0} deg of that of the raster", MOST_OFF.to_degrees()),
            )
            .hint("leave `slope` out: the terrain tells it"));
        }
        put(entries, &file, SECTION[1], Value::Points(terrain.section), typed);
        if !entries.mentions("channel.slope") {
            let typed = format!("{:.2} deg, the mean of the lowest line in {name}", terrain.slope.to_degrees());
            put(entries, &file, "channel.slope", Value::Number(terrain.slope), typed);
        }
        entries.relief = Some(terrain.relief);
        Ok((name, bytes))
    }))
}

fn read_hydrograph(entries: &mut Entries, open: Open) -> Read {
    let file = key("file");
    let wanted = "a table of time, depth or discharge, and velocity beside the design file";
    let read = opened(entries, &file, open, wanted)?;
    if let Some(typed) = LISTS.iter().find(|list| entries.mentions(&key(list))) {
        return Some(Err(Problem::new(
            key(typed),
            format!("`{typed}` beside a file"),
            "a file, or the lists of its columns",
        )
        .hint("leave one of them out")));
    }
    Some(read.and_then(|(name, bytes)| {
        let columns = hydrograph_file::parse(&bytes)
            .map_err(|(found, hint)| Problem::new(&file, format!("`{name}`, {found}"), wanted).hint(hint))?;
        for (column, values) in columns {
            let list = match column {
                Column::Time => "times",
                Column::Depth => "depths",
                Column::Discharge => "discharges",
                Column::Velocity => "velocities",
            };
            let typed = format!("{} rows of {name}", values.len());
            put(entries, &file, &key(list), Value::Numbers(values), typed);
        }
        Ok((name, bytes))
    }))
}

fn read_curve(entries: &mut Entries, open: Open) -> Read {
    read_curve_at(entries, open, OF_MAIN_ROPES)
}

fn read_curve_of_retaining_ropes(entries: &mut Entries, open: Open) -> Read {
    read_curve_at(entries, open, OF_RETAINING_ROPES)
}

fn read_curve_at(entries: &mut Entries, open: Open, place: &str) -> Read {
    let file = curve_key(place, "file");
    let wanted = "a table of stroke or travel, and force, beside the design file";
    let read = opened(entries, &file, open, wanted)?;
    Some(read.and_then(|(name, bytes)| {
        let (way, points) = curve_file::parse(&bytes)
            .map_err(|(found, hint)| Problem::new(&file, format!("`{name}`, {found}"), wanted).hint(hint))?;
        let list = match way {
            Way::Stroke => CURVES[0],
            Way::Travel => CURVES[1],
        };
        let typed = format!("{} points of {name}", points.len());
        put(entries, &file, &curve_key(place, list), Value::Points(points), typed);
        Ok((name, bytes))
    }))
}

/// The ropes that may be named: those of the design's own table before those of the program.
fn read_ropes(
    entries: &Entries,
    open: Open,
    problems: &mut Vec<Problem>,
    attached: &mut Attached,
) -> Option<Vec<Listed>> {
    let key = at("rope_table");
    let wanted = "a table of ropes beside the design file";
    let mut ropes = Vec::new();
    match opened(entries, &key, open, wanted) {
        None => {}
        Some(Err(problem)) => {
            problems.push(problem);
            return None;
        }
        Some(Ok((name, bytes))) => {
            match rope_table::parse(&bytes) {
                Ok(listed) => {
                    let known = rope_table::built_in();
                    let shared = |rope: &&Listed| known.iter().any(|other| plain(&other.name) == plain(&rope.name));
                    if let Some(rope) = listed.iter().find(shared) {
                        let found = format!("`{name}`, which has the name `{}` of the program's table", rope.name);
                        problems.push(Problem::new(&key, found, wanted).hint("give your rope a name of its own"));
                        return None;
                    }
                    ropes = listed.into_iter().map(|rope| Listed { table: Some(name.clone()), ..rope }).collect();
                }
                Err((found, hint)) => {
                    problems.push(Problem::new(&key, format!("`{name}`, {found}"), wanted).hint(hint));
                    return None;
                }
            }
            attached.insert(name, bytes);
        }
    }
    ropes.extend_from_slice(rope_table::built_in());
    Some(ropes)
}

/// Puts a value in that comes from the file of a key.
fn put(entries: &mut Entries, file: &str, path: &str, value: Value, typed: String) {
    let entry = Entry { value, typed, origin: Origin::File, remark: String::new(), ..entries.values[file].clone() };
    entries.put(path, entry);
}
