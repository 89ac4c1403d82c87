//! Limit states, one file each. Nothing here sees the simulation: demands come ready.

pub mod anchors;
pub mod bolts;
pub mod brakes;
pub mod credibility;
pub mod detailing;
pub mod height;
pub mod implausible;
pub mod not_covered;
pub mod outcome;
pub mod range;
pub mod retained;
pub mod ropes;
pub mod total_force;
pub mod wall;
pub mod wall_local;
pub mod wall_moment;
pub mod wear;

use crate::checks::outcome::Outcome;
use crate::demand::Demands;
use crate::design::Design;

type Check = fn(&Design, &Demands) -> Vec<Outcome>;

/// All checks, in the order of the report.
const CHECKS: &[Check] = &[
    total_force::check,
    wall_local::check,
    wall_moment::check,
    wall::check,
    ropes::check_main,
    ropes::check_net,
    ropes::check_lateral,
    wear::check_broken,
    wear::tell_drawn_out,
    brakes::check_stroke,
    brakes::check_plateau,
    anchors::check,
    bolts::check,
    retained::check,
    height::check,
];

/// Holds the demands against all limits.
pub fn check_all(design: &Design, demands: &Demands) -> Vec<Outcome> {
    CHECKS.iter().flat_map(|check| check(design, demands)).collect()
}
