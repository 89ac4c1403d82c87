//! Contradictions between values of a channel; listed in [`super::rules`].

use crate::design::channel_entries::{height_of_barrier, reaches, section, survey};
use crate::design::entries::Entries;
use crate::design::flow::RUN_IN;
use crate::design::flow_entries::flow_volume;
use crate::design::hydrograph_entries::HYDROGRAPH;
use crate::design::net_rules::{TypedLattice, rope_heights};
use crate::design::show::{NET, at, length};
use crate::design::surge_entries::{of_the_first, volume_of_all};
use crate::problem::Problem;
use crate::section::Section;

const POINTS: &str = "channel.section.points";

pub fn width_section_or_terrain(e: &Entries) -> Option<Problem> {
    let given: Vec<&str> = WAYS.into_iter().filter(|key| e.mentions(&format!("channel.{key}"))).collect();
    let found = match given[..] {
        [] if e.has_section("channel") => "none of width, section and terrain".to_string(),
        [] | [_] => return None,
        _ => given.join(" and "),
    };
    Some(Problem::new("channel", found, "one of width, section and terrain").hint(
        "`width` is that of a channel of rectangular section; `section` is a surveyed one, as a trapezoid or as points; `terrain` is a raster",
    ))
}

/// Ways to say what lies across the channel.
const WAYS: [&str; 3] = ["width", "section", "terrain"];

/// Whether the section is not a rectangle.
fn is_surveyed(e: &Entries) -> bool {
    e.mentions("channel.section") || e.mentions("channel.terrain")
}

pub fn slope_is_given(e: &Entries) -> Option<Problem> {
    (e.has_section("channel") && !e.mentions("channel.slope") && !e.mentions("channel.terrain")).then(|| {
        Problem::new("channel", "no key `slope`", "an angle with unit (deg, rad, gon), 0 deg to 80 deg")
            .hint("`slope` is the slope of the bed against the horizontal, at the barrier")
    })
}

pub fn terrain_tells_the_reaches(e: &Entries) -> Option<Problem> {
    (e.mentions("channel.terrain") && e.has_section("channel.profile")).then(|| {
        Problem::new("channel.profile", "a profile beside a terrain", "this group beside a width or a section")
            .hint("the raster tells the bed along the channel: leave it out")
    })
}

pub fn terrain_takes_a_plumb_barrier(e: &Entries) -> Option<Problem> {
    if !e.mentions("channel.terrain") {
        return None;
    }
    let leans = |path: &str| e.number(path).is_some_and(|angle| angle != 0.0);
    let lean = [at("tilt"), "barrier.rigid_wall.tilt".to_string()].into_iter().find(|path| leans(path));
    let base = "barrier.rigid_wall.stability.base_slope";
    let (path, found) = match lean {
        Some(path) => (path, "a barrier that leans, in a terrain"),
        None if leans(base) => (base.to_string(), "a base that is not level, in a terrain"),
        None => return None,
    };
    Some(Problem::new(path, found, "0 deg: the section is taken vertically between the two ends"))
}

pub fn terrain_takes_a_surge(e: &Entries) -> Option<Problem> {
    let others = [("flow.arrival.dam_break", "a dam break"), (HYDROGRAPH, "a hydrograph")];
    let (_, other) = others.into_iter().find(|(path, _)| e.mentions("channel.terrain") && e.has_section(path))?;
    Some(
        Problem::new("flow.arrival", format!("{other} in a terrain"), "a surge, or surges")
            .hint("give the flow as a surge with its depth and velocity at the barrier"),
    )
}

/// How far downstream grains are followed, over the height of the barrier.
const FOLLOWED: f64 = 3.0;

pub fn terrain_goes_far_enough_downstream(e: &Entries) -> Option<Problem> {
    let path = "channel.terrain.downstream";
    let height = e.number(&at("height")).or_else(|| e.number("barrier.rigid_wall.height"))?;
    let least = FOLLOWED * height + 1.0;
    (e.number(path)? < least).then(|| {
        Problem::new(
            path,
            length(e.number(path).unwrap_or(0.0)),
            format!("at least {}, three heights of the barrier and a metre", length(least)),
        )
    })
}

/// The surge starts on the raster.
pub fn terrain_goes_far_enough_upstream(e: &Entries) -> Option<Problem> {
    let path = "channel.terrain.upstream";
    let (upstream, section) = (e.number(path)?, section(e)?);
    let (_, depth) = of_the_first(e, "depth")?;
    let run_in = of_the_first(e, "run_in").map_or(RUN_IN * depth, |(_, run_in)| run_in);
    // Later surges start behind what the earlier ones have left.
    let long = volume_of_all(e).or_else(|| flow_volume(e))? / section.area(depth);
    // With its nose, and room for the packing.
    let least = run_in + 1.4 * long + 2.0 * depth + 2.0;
    (upstream < least).then(|| {
        let found = format!("{}, while the surge starts up to about {} upstream", length(upstream), length(least));
        Problem::new(path, found, format!("at least {}", length(least)))
            .hint("give more of the raster, or a smaller flow")
    })
}

pub fn walls_belong_to_a_width(e: &Entries) -> Option<Problem> {
    let path = "channel.wall_height";
    match (e.mentions("channel.width"), is_surveyed(e), e.mentions(path)) {
        (true, false, false) => {
            let allowed = "the height of the side walls beside their distance";
            Some(
                Problem::new("channel", "no key `wall_height`", allowed)
                    .hint("`wall_height` is the height of the side walls, normal to the bed"),
            )
        }
        (false, true, true) => Some(
            Problem::new(path, "the height of side walls beside a section", "this key beside `width` only")
                .hint("the section itself says how high its banks are: leave wall_height out"),
        ),
        _ => None,
    }
}

pub fn bed_is_told_of_points(e: &Entries) -> Option<Problem> {
    let path = "channel.bed_up_to";
    (e.mentions(path) && (!e.mentions(POINTS) || e.mentions("channel.terrain"))).then(|| {
        Problem::new(path, "what is bed, of a section that says so itself", "this key beside `section.points` only")
            .hint("leave it out")
    })
}

pub fn points_are_three(e: &Entries) -> Option<Problem> {
    let points = e.points(POINTS)?;
    (points.len() < 3).then(|| {
        Problem::new(
            POINTS,
            format!("{} point(s)", points.len()),
            "three points or more: two banks and the bed between them",
        )
    })
}

pub fn points_go_to_the_right(e: &Entries) -> Option<Problem> {
    let points = e.points(POINTS)?;
    let index = points.windows(2).position(|pair| pair[1][0] < pair[0][0])?;
    let (before, after) = (points[index][0], points[index + 1][0]);
    let hint = if points.windows(2).all(|pair| pair[1][0] <= pair[0][0]) {
        "these go from the right to the left: list them the other way round"
    } else {
        "the ground must not overhang or cross itself: list each point once, in order"
    };
    let found = format!("{} after {}", length(after), length(before));
    let allowed = "points from the left to the right, looking downstream; a vertical bank has two at one distance";
    Some(Problem::new(format!("{POINTS}.{}", index + 1), found, allowed).hint(hint))
}

pub fn points_are_apart(e: &Entries) -> Option<Problem> {
    let points = e.points(POINTS)?;
    let index = points.windows(2).position(|pair| pair[0] == pair[1])?;
    let found = format!("the point {}, {} a second time", length(points[index][0]), length(points[index][1]));
    Some(Problem::new(format!("{POINTS}.{}", index + 1), found, "each point once"))
}

pub fn both_banks_are_there(e: &Entries) -> Option<Problem> {
    let points = e.points(POINTS).filter(|points| points.len() >= 3)?;
    let lowest = points.iter().map(|point| point[1]).fold(f64::INFINITY, f64::min);
    let missing = |end: &[f64; 2]| end[1] <= lowest;
    let (left, right) = (missing(&points[0]), missing(&points[points.len() - 1]));
    let which = match (left, right) {
        (true, true) => "either bank",
        (true, false) => "the left bank",
        (false, true) => "the right bank",
        (false, false) => return None,
    };
    let found = format!("a section without {which}: it ends at its lowest point");
    Some(Problem::new(POINTS, found, "points up to the height of the barrier's top on either side"))
}

pub fn section_has_a_width(e: &Entries) -> Option<Problem> {
    let points = e.points(POINTS).filter(|points| points.len() >= 3)?;
    (points[points.len() - 1][0] == points[0][0])
        .then(|| Problem::new(POINTS, "points at one distance only", "points on either side of the bed"))
}

/// The barrier hangs from bank to bank: what rises above the survey has no bank to hang on.
pub fn barrier_within_the_section(e: &Entries) -> Option<Problem> {
    let (survey, top) = (survey(e)?, height_of_barrier(e)?);
    let end = survey.lower_end();
    let plumb = libm::cos(e.number("channel.slope")?);
    (top > end * (1.0 + 1e-9)).then(|| {
        let found = format!("a section whose lower end is {} above the bed", length(end / plumb));
        let allowed = format!("both banks up to the barrier's top, {} above the bed (vertically)", length(top / plumb));
        if e.mentions("channel.terrain") {
            let found = format!("ends of which the lower one is {} above the bed", length(end / plumb));
            return Problem::new("channel.terrain.left_end", found, allowed)
                .hint("put the lower end further up its bank, or give a lower barrier");
        }
        Problem::new(path_of_section(e, "depth"), found, allowed)
            .hint("survey the banks further up, or give a lower barrier")
    })
}

fn path_of_section(e: &Entries, of_trapezoid: &str) -> String {
    if e.mentions(POINTS) { POINTS.to_string() } else { format!("channel.section.trapezoid.{of_trapezoid}") }
}

pub fn strips_lie_on_vertical_walls(e: &Entries) -> Option<Problem> {
    let path = at("side_extension");
    (e.has_section(&path) && is_surveyed(e)).then(|| {
        Problem::new(path, "strips along the banks of a surveyed section", "this group beside a `width` only")
            .hint("strips are modelled on vertical side walls only: leave them out")
    })
}

pub fn ropes_of_cylinders_are_straight(e: &Entries) -> Option<Problem> {
    let path = "simulation.barrier_model";
    (e.text(path) == Some("cylinders") && is_surveyed(e)).then(|| {
        Problem::new(path, "cylinders in a surveyed section", "sliding_ropes or pinned_ropes")
            .hint("a net that is cut to its banks is modelled of ropes only")
    })
}

/// Length of the lowest rope below which it is none, in widths of a mesh or ring.
const SHORTEST_ROPE: f64 = 2.0;

pub fn lowest_rope_has_a_length(e: &Entries) -> Option<Problem> {
    let (survey, lattice) = (survey(e)?, TypedLattice::of(e)?);
    let least = SHORTEST_ROPE * lattice.across();
    let opening = e.number(&at("bottom.opening"));
    let bed = survey.bed();
    let width = match opening {
        Some(opening) => survey.banks(opening)[1] - survey.banks(opening)[0],
        None => bed[bed.len() - 1][0] - bed[0][0],
    };
    (width < least).then(|| {
        let (path, what, hint) = match opening {
            Some(_) => (at("bottom.opening"), "between the banks", "a higher opening has more width below its rope"),
            None if e.mentions(POINTS) => (
                POINTS.to_string(),
                "of bed between the banks",
                "the lowest rope is bolted to the bed; where the banks meet in a groove, give barrier.flexible_net.bottom.opening",
            ),
            None => (
                path_of_section(e, "bed_width"),
                "of bed between the banks",
                "the lowest rope is bolted to the bed: is the unit right? Over a narrow bed give barrier.flexible_net.bottom.opening",
            ),
        };
        let found = format!("{} {what} for the lowest rope", length(width));
        Problem::new(path, found, format!("at least two {}s, {}", lattice.wide(), length(least))).hint(hint)
    })
}

/// Least height of the second rope over a bed to which the lowest is bolted, in heights of a mesh or ring.
const ABOVE_THE_BED: f64 = 0.5;

/// Height over the bed, normal to it, of a place along the barrier (m).
fn over_the_bed(e: &Entries, along: f64) -> Option<f64> {
    let lean = e.number("channel.slope")? + e.number(&at("tilt"))?;
    Some(along * libm::cos(lean) + e.number(&at("bottom.opening")).unwrap_or(0.0))
}

/// The second rope hangs above a bed that is not level.
pub fn second_rope_above_the_bed(e: &Entries) -> Option<Problem> {
    let (survey, heights, lattice) = (survey(e)?, rope_heights(e)?, TypedLattice::of(e)?);
    let bed = survey.bed().iter().map(|point| point[1]).fold(0.0, f64::max);
    let second = over_the_bed(e, *heights.get(1)?)?;
    let least = bed + ABOVE_THE_BED * lattice.along();
    (e.number(&at("bottom.opening")).is_none() && bed > 0.0 && second < least).then(|| {
        let found = format!("main rope 2, {} above the lowest point, over a bed that rises by {}", length(second), length(bed));
        let allowed = format!("at least {} (normal to the bed)", length(least));
        Problem::new(at("main_ropes"), found, allowed).hint(
            "give heights with a higher second rope, or a smaller channel.bed_up_to: the ground that is steeper is bank, and the lowest rope ends there",
        )
    })
}

/// A rope that is free to move hangs from bank to bank, with no ground between.
pub fn ropes_hang_clear_of_the_ground(e: &Entries) -> Option<Problem> {
    let (survey, heights) = (survey(e)?, rope_heights(e).filter(|_| e.has_section(NET))?);
    if second_rope_above_the_bed(e).is_some() {
        return None;
    }
    let opening = e.number(&at("bottom.opening"));
    let section = Section::Surveyed(survey.clone());
    let mut free = heights.iter().enumerate().skip(usize::from(opening.is_none()));
    let caught = |height: f64| {
        let z = over_the_bed(e, height)?;
        let [right, left] = survey.banks(z);
        (section.width(z) > (left - right) * (1.0 + 1e-9)).then_some(z)
    };
    let (index, z) = free.find_map(|(index, height)| Some((index, caught(*height)?)))?;
    let [right, left] = survey.banks(z);
    // The ground that rises through the rope: beside the part of the section in which the lowest point is.
    let beyond =
        survey.points().iter().filter(|point| point[1] > z && (point[0] > left - 1e-9 || point[0] < right + 1e-9));
    let highest = beyond.filter(|point| {
        survey
            .points()
            .iter()
            .any(|other| other[1] < z && (other[0] - point[0]).signum() == (point[0] - 0.5 * (right + left)).signum())
    });
    let bar = highest.map(|point| point[1]).fold(z, f64::max);
    let found = format!("main rope {}, {} above the lowest point, with ground between its ends", index + 1, length(z));
    let hint = if index == 0 {
        format!(
            "the ground rises to {} there: a higher barrier.flexible_net.bottom.opening lifts the lowest rope over it; or is a point of the survey wrong?",
            length(bar)
        )
    } else {
        format!(
            "the ground rises to {} there: give main_ropes.heights with this rope above it; or is a point of the survey wrong?",
            length(bar)
        )
    };
    Some(Problem::new(at("main_ropes"), found, "ropes that hang clear of the ground from bank to bank").hint(hint))
}

pub fn profile_has_a_reach(e: &Entries) -> Option<Problem> {
    let path = "channel.profile";
    let mentioned = ["upstream", "downstream"].iter().any(|side| e.mentions(&format!("{path}.{side}")));
    (e.has_section(path) && !mentioned).then(|| {
        Problem::new(path, "neither upstream nor downstream", "reaches on one side at least, or no profile")
            .hint("`upstream: [[25 m, 14 deg]]`: from 25 m upstream on the bed slopes at 14 deg")
    })
}

pub fn reaches_upstream_follow(e: &Entries) -> Option<Problem> {
    reaches_follow(e, "upstream")
}

pub fn reaches_downstream_follow(e: &Entries) -> Option<Problem> {
    reaches_follow(e, "downstream")
}

/// Breaks lie in order, far enough apart for their rounding.
fn reaches_follow(e: &Entries, side: &str) -> Option<Problem> {
    let reaches = reaches(e, side);
    let rounding = e.number("channel.profile.rounded_over").unwrap_or(0.0);
    let path = |index: usize| format!("channel.profile.{side}.{index}");
    if let Some(index) = reaches.windows(2).position(|pair| pair[1][0] <= pair[0][0]) {
        let found = format!("{} after {}", length(reaches[index + 1][0]), length(reaches[index][0]));
        return Some(Problem::new(path(index + 1), found, "distances that increase away from the barrier"));
    }
    let first = reaches.first().filter(|reach| reach[0] < 0.5 * rounding);
    let near = reaches.windows(2).position(|pair| pair[1][0] - pair[0][0] < rounding).map(|index| index + 1);
    let index = first.map(|_| 0).or(near)?;
    let found = format!("a break at {} that is rounded over {}", length(reaches[index][0]), length(rounding));
    let allowed = "breaks at least that far from each other, and half of it from the barrier";
    Some(Problem::new(path(index), found, allowed).hint("give a shorter rounded_over"))
}
