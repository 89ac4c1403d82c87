//! Contradictions between the values of dissipators.

use crate::design::dissipator_entries::{CURVES, PLACES, SAME, curve_key, dissipators, key, points};
use crate::design::entries::Entries;
use crate::design::show::length;
use crate::problem::Problem;
use crate::units::Dimension;

/// Rules of dissipators, wherever they stand.
const RULES: &[fn(&Entries, &str) -> Option<Problem>] = &[
    they_yield_one_way,
    curve_goes_forwards,
    curve_is_within_bounds,
    curve_is_no_stiffer_than_elastic,
    only_what_does_not_fall_stands_in_series,
    curve_falls_gently,
    dissipators_are_stiff,
];

/// All that is wrong with the dissipators.
pub fn are_sound(e: &Entries) -> Vec<Problem> {
    PLACES.iter().flat_map(|place| RULES.iter().filter_map(|rule| rule(e, place))).collect()
}

/// Largest travel (m) and force (N) of a point.
const BOUNDS: [f64; 2] = [20.0, 1e8];

/// They yield at one force or by a curve.
fn they_yield_one_way(e: &Entries, place: &str) -> Option<Problem> {
    if !e.has_section(place) {
        return None;
    }
    let [plateau, stroke, curve] = ["plateau_force", "stroke", "curve"].map(|name| e.mentions(&key(place, name)));
    let found = match (plateau, stroke, curve) {
        (true, true, false) | (false, false, true) => return None,
        (true, _, true) => "a plateau_force and a curve",
        (false, true, true) => "a stroke and a curve",
        (true, false, false) => "a plateau_force without a stroke",
        (false, true, false) => "a stroke without a plateau_force",
        (false, false, false) => "neither a plateau_force nor a curve",
    };
    Some(Problem::new(place, found, "either plateau_force and stroke, or a curve").hint(
        "a curve tells force against stroke as tests show it: `curve: {after_unloading: [[0 m, 60 kN], [0.9 m, 140 kN]]}`",
    ))
}

/// The key of the curve as given, a file included, with its points.
fn typed<'e>(e: &'e Entries, place: &str) -> Option<(String, &'e [[f64; 2]])> {
    let file = curve_key(place, "file");
    CURVES.iter().find_map(|name| {
        let points = e.points(&curve_key(place, name))?;
        Some((if e.mentions(&file) { file.clone() } else { curve_key(place, name) }, points))
    })
}

/// From the beginning on, to and fro in no place.
fn curve_goes_forwards(e: &Entries, place: &str) -> Option<Problem> {
    let (path, points) = typed(e, place)?;
    let wanted = "two points or more, the first at 0 m, with a travel that rises";
    if points.len() < 2 {
        return Some(Problem::new(path, format!("{} point(s)", points.len()), wanted));
    }
    if points[0][0] != 0.0 {
        return Some(Problem::new(path, format!("a first point at {}", length(points[0][0])), wanted));
    }
    let least = SAME * points.last()?[0];
    let pair = points.windows(2).find(|pair| pair[1][0] - pair[0][0] <= least)?;
    let found = format!("{} after {}", length(pair[1][0]), length(pair[0][0]));
    Some(
        Problem::new(path, found, wanted)
            .hint("keep one point for each travel, and leave out what a test records after its largest travel"),
    )
}

/// What a file gives is within the bounds of what may be typed, and some force is there.
fn curve_is_within_bounds(e: &Entries, place: &str) -> Option<Problem> {
    let (path, points) = typed(e, place)?;
    let dimensions = [Dimension::Length, Dimension::Force];
    let outside = points.iter().find_map(|point| {
        (0..2).find(|&side| !(0.0..=BOUNDS[side]).contains(&point[side])).map(|side| (side, point[side]))
    });
    if let Some((side, value)) = outside {
        let show = |value: f64| dimensions[side].show(value);
        return Some(Problem::new(path, show(value), format!("0 to {}", show(BOUNDS[side]))));
    }
    points
        .iter()
        .all(|[_, force]| *force < 1.0)
        .then(|| Problem::new(path, "a curve without force", "a force of 1 N or more at one of its points"))
}

/// What is elastic comes back: a curve under load is nowhere stiffer than the elastic stiffness.
fn curve_is_no_stiffer_than_elastic(e: &Entries, place: &str) -> Option<Problem> {
    if curve_goes_forwards(e, place).is_some() || curve_is_within_bounds(e, place).is_some() {
        return None;
    }
    let travels = e.points(&curve_key(place, CURVES[1]))?;
    let (path, _) = typed(e, place)?;
    if travels[0][1] > 0.0 {
        let found = format!("{} at 0 m", Dimension::Force.show(travels[0][1]));
        return Some(Problem::new(path, found, "no force without travel").hint(
            "under load a dissipator stretches elastically before it yields; strokes without that go under `after_unloading`",
        ));
    }
    let points = points(e, place)?;
    if points.len() < 2 {
        let found = format!("a curve that is elastic up to its end at {}", length(travels.last()?[0]));
        return Some(Problem::new(path, found, "a part with less than the elastic stiffness, where it yields").hint(
            "with `under_load` the elastic travel, force over stiffness, is taken off; what is left is the stroke",
        ));
    }
    let back = points.windows(2).find(|pair| pair[1][0] <= pair[0][0])?;
    let steepest =
        travels.windows(2).map(|pair| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0])).fold(0.0, f64::max);
    let found = format!("a rise to {} that is stiffer than the elastic stiffness", Dimension::Force.show(back[1][1]));
    let least = Dimension::Stiffness.show((1.01 * steepest * 1e-4).ceil() * 1e4);
    let hint = format!("give a stiffness of {least} or more, which is that of the steepest part of this curve");
    Some(Problem::new(path, found, format!("no more than `{}` anywhere", e.typed(&key(place, "stiffness")))).hint(hint))
}

/// Two that fall do not share a stroke: the weaker runs down its curve alone.
fn only_what_does_not_fall_stands_in_series(e: &Entries, place: &str) -> Option<Problem> {
    let (points, in_series) = (points(e, place)?, e.number(&key(place, "in_series"))?);
    let falls = points.windows(2).any(|pair| pair[1][1] < pair[0][1]);
    (in_series > 1.0 && falls).then(|| {
        let found = format!("{in_series} in series, with a curve whose force falls");
        Problem::new(key(place, "in_series"), found, "one, or a curve that nowhere falls").hint(
            "where the force falls the weaker of them pays out alone: give the curve of all together, one stroke after the other",
        )
    })
}

/// Share of the elastic stiffness by which a force may fall with the stroke.
const STEEPEST_FALL: f64 = 0.5;

/// A force that falls faster than the dissipator relaxes makes it jump.
fn curve_falls_gently(e: &Entries, place: &str) -> Option<Problem> {
    if curve_goes_forwards(e, place).is_some() || curve_is_no_stiffer_than_elastic(e, place).is_some() {
        return None;
    }
    let ((path, _), points, stiffness) = (typed(e, place)?, points(e, place)?, e.number(&key(place, "stiffness"))?);
    let limit = STEEPEST_FALL * stiffness;
    let steep = points.windows(2).find(|pair| pair[0][1] - pair[1][1] > limit * (pair[1][0] - pair[0][0]))?;
    let show = |force: f64| Dimension::Force.show(force);
    let found = format!(
        "a fall from {} to {} within {}",
        show(steep[0][1]),
        show(steep[1][1]),
        length(steep[1][0] - steep[0][0])
    );
    let allowed = format!("a fall by no more than {}, half the elastic stiffness", Dimension::Stiffness.show(limit));
    Some(Problem::new(path, found, allowed).hint("draw the mean line through the peaks of a test"))
}

/// Elastic travel of a dissipator before it yields, over its stroke, up to which it can be left out of the stroke.
const ELASTIC_TRAVEL: f64 = 0.25;

fn dissipators_are_stiff(e: &Entries, place: &str) -> Option<Problem> {
    let given = dissipators(e, place)?;
    let travel = given.plateau / given.stiffness;
    (travel > ELASTIC_TRAVEL * given.stroke).then(|| {
        if let Some((path, _)) = typed(e, place) {
            let (travel, stroke) = (length(travel), length(given.stroke));
            let found = format!("an elastic travel of {travel} up to the largest force, with a stroke of {stroke}");
            return Problem::new(
                path,
                found,
                "a largest force that is reached elastically within a quarter of the stroke",
            )
            .hint("a higher stiffness, or more stroke");
        }
        let found = format!(
            "an elastic travel of {} up to the plateau, with a stroke of {}",
            length(travel),
            length(given.stroke)
        );
        Problem::new(key(place, "stiffness"), found, "a plateau that is reached within a quarter of the stroke")
            .hint("the stroke is the travel at the plateau; elastic travel does not count to it")
    })
}
