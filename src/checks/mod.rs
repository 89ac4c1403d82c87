//! Limit states, one file each. Nothing here sees the simulation: demands come ready.

pub(crate) mod anchors;
pub(crate) mod between_bolts;
pub(crate) mod bolts;
pub mod credibility;
pub mod detailing;
pub(crate) mod dissipators;
pub(crate) mod freeboard;
pub(crate) mod height;
pub(crate) mod implausible;
pub(crate) mod not_covered;
pub mod outcome;
pub(crate) mod posts;
pub(crate) mod range;
pub(crate) mod retained;
pub(crate) mod rope_damage;
pub(crate) mod ropes;
pub(crate) mod total_force;
pub(crate) mod wall;
pub(crate) mod wall_local;
pub(crate) mod wall_moment;

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
    rope_damage::check_broken,
    rope_damage::tell_drawn_out,
    dissipators::check_stroke,
    dissipators::check_plateau,
    ropes::check_plateau,
    anchors::check,
    bolts::check,
    posts::check,
    retained::check,
    height::check,
    freeboard::check,
];

/// Holds the demands against all limits.
pub fn check_all(design: &Design, demands: &Demands) -> Vec<Outcome> {
    CHECKS.iter().flat_map(|check| check(design, demands)).collect()
}
