//! What the entries of a design say of the section of its channel.

use crate::design::entries::Entries;
use crate::design::show::at;
use crate::profile::Profile;
use crate::section::{Section, Survey};

const SECTION: &str = "channel.section";
/// Slope across the gully up to which ground beside the lowest point is bed, where the design says none (rad): 25 degrees.
pub const STEEPEST_BED: f64 = 25.0 * std::f64::consts::PI / 180.0;

/// Points of the section as they are listed: distance to the right, and plumb height (m).
pub fn listed_points(e: &Entries) -> Option<Vec<[f64; 2]>> {
    if let Some(points) = e.points(&format!("{SECTION}.points")) {
        return Some(points.to_vec());
    }
    let value = |key: &str| e.number(&format!("{SECTION}.trapezoid.{key}"));
    let (bed, depth) = (value("bed_width")?, value("depth")?);
    let run = |bank: f64| depth / libm::tan(bank);
    let half = 0.5 * bed;
    let [left, right] = [half + run(value("left_bank")?), half + run(value("right_bank")?)];
    Some(vec![[-left, depth], [-half, 0.0], [half, 0.0], [right, depth]])
}

/// Whether points make a section: from the left to the right, with a bank on either side of the lowest, no two on top of each other.
pub fn make_a_section(points: &[[f64; 2]]) -> bool {
    let lowest = points.iter().map(|point| point[1]).fold(f64::INFINITY, f64::min);
    points.len() >= 3
        && points.windows(2).all(|pair| pair[1][0] >= pair[0][0] && pair[0] != pair[1])
        && [points[0], points[points.len() - 1]].iter().all(|end| end[1] > lowest)
        && points[points.len() - 1][0] > points[0][0]
}

/// The surveyed section, normal to the bed, if there is one that is sound.
pub fn survey(e: &Entries) -> Option<Survey> {
    let points = listed_points(e).filter(|points| make_a_section(points))?;
    let upright = libm::cos(e.number("channel.slope")?);
    let normal: Vec<[f64; 2]> = points.iter().map(|[right, up]| [*right, up * upright]).collect();
    let steepest = match e.has_section(&format!("{SECTION}.trapezoid")) {
        true => 0.0,
        // Heights are less by cos α, and so is what is steep.
        false => libm::atan(libm::tan(e.number("channel.bed_up_to").unwrap_or(STEEPEST_BED)) * upright),
    };
    Some(Survey::new(&normal, steepest))
}

/// The section of the channel, whichever way it is given.
pub fn section(e: &Entries) -> Option<Section> {
    match e.number("channel.width") {
        Some(width) => Some(Section::Rectangle { width }),
        None => survey(e).map(Section::Surveyed),
    }
}

/// Up to where the sides of the channel reach, normal to the bed (m).
pub fn height_of_sides(e: &Entries) -> Option<f64> {
    e.number("channel.wall_height").or_else(|| Some(survey(e)?.lower_end()))
}

/// Height of the barrier's top above the bed, normal to it (m).
pub fn height_of_barrier(e: &Entries) -> Option<f64> {
    let slope = e.number("channel.slope")?;
    let lean = |path: &str| e.number(path).map_or(0.0, |tilt| slope + tilt);
    if let Some(height) = e.number("barrier.rigid_wall.height") {
        let plumb = e.mentions("channel.terrain") && !e.mentions("barrier.rigid_wall.tilt");
        return Some(height * libm::cos(if plumb { slope } else { lean("barrier.rigid_wall.tilt") }));
    }
    let height = e.number(&at("height"))?;
    Some(height * libm::cos(lean(&at("tilt"))) + e.number(&at("bottom.opening")).unwrap_or(0.0))
}

/// Level distances from the barrier with the slopes that begin there (rad), upstream or downstream.
pub fn reaches(e: &Entries, side: &str) -> Vec<[f64; 2]> {
    e.points(&format!("channel.profile.{side}")).map_or(Vec::new(), <[[f64; 2]]>::to_vec)
}

/// The bed where it has several reaches.
pub fn profile(e: &Entries) -> Option<Profile> {
    if let Some(relief) = &e.relief {
        return Some(Profile::through(&relief.lowest_line()));
    }
    let (upstream, downstream) = (reaches(e, "upstream"), reaches(e, "downstream"));
    let several = !(upstream.is_empty() && downstream.is_empty());
    let rounding = e.number("channel.profile.rounded_over").unwrap_or(0.0);
    several.then(|| Some(Profile::new(e.number("channel.slope")?, &upstream, &downstream, rounding)))?
}
