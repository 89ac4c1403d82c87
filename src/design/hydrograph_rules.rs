//! Contradictions between the values of a hydrograph.

use crate::design::channel_entries::{height_of_sides, section, survey};
use crate::design::entries::Entries;
use crate::design::flow_entries::size_curve;
use crate::design::hydrograph_entries::{HYDROGRAPH, hydrograph, key};
use crate::design::show::length;
use crate::problem::Problem;
use crate::units::Dimension;

/// What of the table may be how large, and its dimension.
const BOUNDS: [(&str, Dimension, f64); 3] = [
    ("depths", Dimension::Length, 50.0),
    ("discharges", Dimension::Discharge, 1e5),
    ("velocities", Dimension::Velocity, 40.0),
];

fn is_there(e: &Entries) -> bool {
    e.has_section(HYDROGRAPH)
}

/// Whether a file was named that could not be read: of that is told already.
fn unread(e: &Entries) -> bool {
    e.mentions(&key("file")) && !e.mentions(&key("times"))
}

/// Rows come from a file or stand in the design.
pub fn table_is_there(e: &Entries) -> Option<Problem> {
    let missing = is_there(e) && !e.mentions(&key("file")) && !e.mentions(&key("times"));
    missing.then(|| {
        Problem::new(HYDROGRAPH, "neither a file nor times", "a file, or times with depths or discharges")
            .hint("a file is a table like `time (s),depth (m),velocity (m/s)`")
    })
}

/// Depth and velocity follow from what is given, one way.
pub fn rows_are_told_one_way(e: &Entries) -> Option<Problem> {
    if !is_there(e) || unread(e) || !e.mentions(&key("times")) {
        return None;
    }
    let [depths, discharges, velocities, velocity] =
        ["depths", "discharges", "velocities", "velocity"].map(|name| e.mentions(&key(name)));
    let allowed = "two of depth, discharge and velocity: depths or discharges with velocities (or one velocity for all), or depths and discharges";
    let found = match (depths, discharges, velocities || velocity) {
        (true, true, true) => "depths, discharges and velocities",
        (false, false, _) => "neither depths nor discharges",
        (true, false, false) => "depths without a velocity",
        (false, true, false) => "discharges without a velocity",
        _ if velocities && velocity => "velocities and one velocity for all",
        _ => return None,
    };
    let hint = if velocities || velocity {
        "leave one of them out"
    } else {
        "where the table has no velocity, `velocity` gives one for all its rows"
    };
    Some(Problem::new(HYDROGRAPH, found, allowed).hint(hint))
}

/// All columns have as many rows, and at least two.
pub fn columns_are_equally_long(e: &Entries) -> Option<Problem> {
    let times = e.numbers(&key("times"))?.len();
    if times < 2 {
        return Some(Problem::new(key("times"), format!("{times} row(s)"), "two or more"));
    }
    BOUNDS.iter().find_map(|(name, _, _)| {
        let count = e.numbers(&key(name))?.len();
        (count != times)
            .then(|| Problem::new(key(name), format!("{count} value(s) at {times} times"), "one for each time"))
    })
}

pub fn times_rise(e: &Entries) -> Option<Problem> {
    let pair = e.numbers(&key("times"))?.windows(2).find(|pair| pair[1] <= pair[0])?;
    let show = |time: f64| Dimension::Time.show(time);
    Some(Problem::new(key("times"), format!("{} after {}", show(pair[1]), show(pair[0])), "times that rise"))
}

/// What a file gives is within the bounds of what may be typed.
pub fn values_are_within_bounds(e: &Entries) -> Option<Problem> {
    let of_column = |&(name, dimension, most): &(&'static str, Dimension, f64)| {
        let values = e.numbers(&key(name)).unwrap_or_default().iter().enumerate();
        let outside = values.filter(move |(_, value)| !(0.0..=most).contains(*value));
        outside.map(move |(row, value)| (name, row + 1, dimension.show(*value), dimension.show(most)))
    };
    let outside: Vec<_> = BOUNDS.iter().flat_map(of_column).collect();
    let (first, _, _, _) = outside.first()?;
    let in_a_row =
        |(name, row, value, _): &(&str, usize, String, String)| format!("{value} in row {row} of the {name}");
    let mut found: Vec<String> = outside.iter().take(NAMED).map(in_a_row).collect();
    if outside.len() > NAMED {
        found.push(format!("and {} more", outside.len() - NAMED));
    }
    let mut allowed: Vec<String> = outside.iter().map(|(name, _, _, most)| format!("{name} of 0 to {most}")).collect();
    allowed.dedup();
    let place = if e.mentions(&key("file")) { "file" } else { first };
    Some(Problem::new(key(place), found.join(", "), allowed.join(", ")))
}

/// Values outside their bounds that an error names.
const NAMED: usize = 5;

/// A row with a discharge has what carries it.
pub fn discharges_are_carried(e: &Entries) -> Option<Problem> {
    let (times, discharges) = (e.numbers(&key("times"))?, e.numbers(&key("discharges"))?);
    let section = section(e)?;
    ["velocities", "depths"].into_iter().find_map(|other| {
        let others = e.numbers(&key(other))?;
        let name = if other == "depths" { "depth" } else { "velocity" };
        times.iter().zip(discharges).zip(others).find_map(|((time, discharge), other)| {
            let at = Dimension::Time.show(*time);
            let show = Dimension::Discharge.show(*discharge);
            if *other <= 0.0 && *discharge > 0.0 {
                let found = format!("{show} with no {name} at {at}");
                return Some(Problem::new(
                    key("discharges"),
                    found,
                    format!("a {name} above 0 where there is a discharge"),
                ));
            }
            let fast = discharge / section.area(*other);
            let (_, _, most) = BOUNDS[2];
            (name == "depth" && *other > 0.0 && fast > most).then(|| {
                let found =
                    format!("{show} in a flow {} deep at {at}: {}", length(*other), Dimension::Velocity.show(fast));
                Problem::new(key("discharges"), found, format!("no more than {}", Dimension::Velocity.show(most)))
            })
        })
    })
}

/// Something comes: the lists are sound and hold a volume.
pub fn something_comes(e: &Entries) -> Option<Problem> {
    let rules = [
        table_is_there,
        rows_are_told_one_way,
        columns_are_equally_long,
        times_rise,
        values_are_within_bounds,
        discharges_are_carried,
    ];
    let silent =
        e.numbers(&key("times")).is_some() && section(e).is_some() && rules.iter().all(|rule| rule(e).is_none());
    let given = ["depths", "discharges"].iter().any(|name| e.numbers(&key(name)).is_some());
    (silent && given && hydrograph(e).is_none()).then(|| {
        Problem::new(HYDROGRAPH, "a flow of no volume", "a depth and a velocity above 0 between two of the times")
    })
}

/// The deepest row stays between banks and walls.
pub fn deepest_row_within_the_channel(e: &Entries) -> Option<Problem> {
    let sides = height_of_sides(e)?;
    let deepest = hydrograph(e)?.rows.iter().map(|row| row.depth).fold(0.0, f64::max);
    (deepest > sides).then(|| {
        let (found, allowed) = match survey(e) {
            Some(_) => (
                format!("a flow {} deep in a section whose lower bank ends at {}", length(deepest), length(sides)),
                "at most the height of the lower bank, normal to the bed",
            ),
            None => (
                format!("a flow {} deep between walls of {}", length(deepest), length(sides)),
                "at most channel.wall_height",
            ),
        };
        Problem::new(HYDROGRAPH, found, allowed)
    })
}

/// The train of a hydrograph is longer than its grains.
pub fn flow_longer_than_its_grains(e: &Entries) -> Option<Problem> {
    let hydrograph = hydrograph(e)?;
    let (way, largest) = (hydrograph.way(hydrograph.duration()), size_curve(e)?.quantile(1.0));
    (way < 3.0 * largest).then(|| {
        let found = format!("a flow {} long, velocity times time, of grains up to {}", length(way), length(largest));
        Problem::new(HYDROGRAPH, found, "a flow at least three times as long as its largest grains")
    })
}
