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
use crate::text::Text;

type Check = fn(&Design, &Demands) -> Vec<Outcome>;

/// All checks with what is told of them, in the order of the report.
const CHECKS: &[(Check, &[Text])] = &[
    (total_force::check, total_force::TEXTS),
    (wall_local::check, wall_local::TEXTS),
    (wall_moment::check, wall_moment::TEXTS),
    (wall::check, wall::TEXTS),
    (ropes::check_main, ropes::MAIN_TEXTS),
    (ropes::check_net, ropes::NET_TEXTS),
    (ropes::check_lateral, ropes::LATERAL_TEXTS),
    (rope_damage::check_broken, rope_damage::BROKEN_TEXTS),
    (rope_damage::tell_drawn_out, rope_damage::DRAWN_OUT_TEXTS),
    (dissipators::check_stroke, dissipators::STROKE_TEXTS),
    (dissipators::check_plateau, dissipators::PLATEAU_TEXTS),
    (ropes::check_plateau, ropes::PLATEAU_TEXTS),
    (anchors::check, anchors::TEXTS),
    (bolts::check, bolts::TEXTS),
    (posts::check, posts::TEXTS),
    (retained::check, retained::TEXTS),
    (height::check, height::TEXTS),
    (freeboard::check, freeboard::TEXTS),
];

/// Holds the demands against all limits.
pub fn check_all(design: &Design, demands: &Demands) -> Vec<Outcome> {
    CHECKS.iter().flat_map(|(check, _)| check(design, demands)).collect()
}

/// What is told of each check, in the order of the report.
pub fn texts() -> impl Iterator<Item = &'static Text> {
    CHECKS.iter().flat_map(|(_, texts)| *texts)
}
