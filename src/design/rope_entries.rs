//! What the entries of a design say of its ropes, and where.

use crate::design::entries::{Entries, Entry, Origin, Value};
use crate::design::rope::{Level, Rope};
use crate::design::rope_table::{Listed, plain};
use crate::design::show::at;
use crate::problem::Problem;
use crate::units::Dimension;

/// Part of a net that describes the ropes of posts.
pub const RETAINING: &str = "posts.retaining_ropes";

/// Levels of main ropes, from the bottom.
pub const LEVELS: &str = "main_ropes.levels";

/// Where a level stands within the net.
pub fn level(number: usize) -> String {
    format!("{LEVELS}.{number}")
}

/// Where the levels stand that the design lists.
pub fn levels(e: &Entries) -> Vec<String> {
    (0..).map(level).take_while(|part| e.has_section(&at(part))).collect()
}

/// What every rope must be told to have.
pub const OF_A_ROPE: [&str; 3] = ["diameter", "modulus", "breaking_load"];

/// Parts of a net that describe a rope, as far as the design has them.
pub fn parts(e: &Entries) -> Vec<String> {
    let all = ["net_rope", "main_ropes", "lateral_ropes", RETAINING].map(String::from);
    all.into_iter().chain(levels(e)).filter(|part| e.has_section(&at(part))).collect()
}

/// Where a key of a rope is told: in the first of the parts that tells it.
pub fn told_in<'a>(e: &Entries, parts: &[&'a str], key: &str) -> Option<&'a str> {
    parts.iter().copied().find(|part| e.number(&at(&format!("{part}.{key}"))).is_some())
}

/// Whether what carries breaks at its breaking load, or holds beyond it and is checked.
pub fn breaks(e: &Entries, path: &str) -> Option<bool> {
    e.chosen(path, &[("holds", false), ("breaks", true)])
}

/// The rope that is told by the first of these parts, and as far as it is silent by the next.
pub fn rope(e: &Entries, parts: &[&str]) -> Option<Rope> {
    let value = |key: &str| e.number(&at(&format!("{}.{key}", told_in(e, parts, key)?)));
    Some(Rope {
        diameter: value("diameter")?,
        modulus: value("modulus")?,
        breaking_load: value("breaking_load")?,
        elastic_limit: value("elastic_limit"),
        breaks: parts.iter().find_map(|part| breaks(e, &at(&format!("{part}.at_breaking_load"))))?,
    })
}

/// Levels of main ropes at these heights; nothing where a rope of one is not told.
pub fn levels_at(e: &Entries, heights: &[f64]) -> Option<Vec<Level>> {
    let listed = levels(e);
    let one = |(number, height): (usize, &f64)| {
        let own = listed.get(number).map(String::as_str);
        let parts: Vec<&str> = own.into_iter().chain(["main_ropes"]).collect();
        let ropes = own.and_then(|part| e.number(&at(&format!("{part}.ropes"))));
        Some(Level { height: *height, ropes: ropes.unwrap_or(1.0) as u16, rope: rope(e, &parts)? })
    };
    heights.iter().enumerate().map(one).collect()
}

/// Puts the numbers of ropes that are named where they are not typed.
pub fn put_named(e: &mut Entries, table: &[Listed], problems: &mut Vec<Problem>) {
    for part in parts(e) {
        let key = at(&format!("{part}.rope"));
        let Some(name) = e.text(&key).map(String::from) else { continue };
        let Some(rope) = table.iter().find(|rope| plain(&rope.name) == plain(&name)) else {
            problems.push(unknown(key, &name, table));
            continue;
        };
        let diameter = at(&format!("{part}.diameter"));
        if e.mentions(&diameter) {
            problems.push(
                Problem::new(diameter, format!("a diameter beside the rope `{name}`"), "the name or the diameter").hint(
                    "breaking_load and modulus may be typed beside a name, as a certificate has them; another diameter is another rope",
                ),
            );
            continue;
        }
        let load = at(&format!("{part}.breaking_load"));
        if let Some(typed) = e.number(&load).filter(|typed| *typed > MOST_OF_A_TABLE * rope.breaking_load) {
            let [typed, listed] = [typed, rope.breaking_load].map(|force| Dimension::Force.show(force));
            problems.push(
                Problem::new(
                    load,
                    format!("{typed} beside the rope `{name}`, which has {listed}"),
                    "at most a tenth more than the table",
                )
                .hint("a stronger rope is another one: leave out its name, or give another"),
            );
            continue;
        }
        let values = [
            ("diameter", "nominal diameter", rope.diameter, format!("{} mm", shown(rope.diameter * 1e3))),
            (
                "modulus",
                "modulus with the full circle of the diameter",
                rope.modulus,
                format!("{} GPa", shown(rope.modulus * 1e-9)),
            ),
            (
                "breaking_load",
                "minimum breaking load",
                rope.breaking_load,
                format!("{} kN", shown(rope.breaking_load * 1e-3)),
            ),
        ];
        for (quantity, meaning, number, typed) in values {
            let path = at(&format!("{part}.{quantity}"));
            if !e.mentions(&path) {
                let table = rope.table.as_deref().unwrap_or("the program's table of ropes");
                let source = if rope.remark.is_empty() { String::new() } else { format!("; {}", rope.remark) };
                let remark = format!("{} of {table}{source}", rope.name);
                let entry = Entry { meaning, value: Value::Number(number), typed, origin: Origin::File, remark };
                e.put(&path, entry);
            }
        }
    }
}

/// Breaking load that a certificate may have, over that of the table.
const MOST_OF_A_TABLE: f64 = 1.1;

/// A number of a table as it is read there.
fn shown(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

fn unknown(key: String, name: &str, table: &[Listed]) -> Problem {
    let wanted = plain(name);
    // Of ropes that are written much like it, those of the nearest diameters.
    let number = |text: &str| text.split(' ').find_map(|word| word.trim_end_matches("mm").parse::<f64>().ok());
    let apart = |rope: &Listed| {
        number(&wanted).zip(number(&plain(&rope.name))).map_or(f64::INFINITY, |(one, other)| (one - other).abs())
    };
    let mut near: Vec<(usize, &Listed)> = table
        .iter()
        .map(|rope| (strsim::damerau_levenshtein(&wanted, &plain(&rope.name)), rope))
        .filter(|(distance, _)| *distance <= MUCH_ALIKE)
        .collect();
    near.sort_by(|a, b| apart(a.1).total_cmp(&apart(b.1)).then(a.0.cmp(&b.0)));
    let names: Vec<String> = near.iter().take(2).map(|(_, rope)| format!("`{}`", rope.name)).collect();
    let hint = match names[..] {
        [] => "the user guide says what the program's table has; a table of your own is named by barrier.flexible_net.rope_table"
            .to_string(),
        _ => format!("the nearest are {}", names.join(" and ")),
    };
    Problem::new(key, format!("`{name}`, which no table has"), "the name of a rope, as `6x36-IWRC 22 mm 1770`")
        .hint(hint)
}

/// Slips up to which two names are much alike.
const MUCH_ALIKE: usize = 4;
