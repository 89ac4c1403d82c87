//! Mass held by the barrier against the least share the design asks for.

use crate::checks::outcome::{CheckName, Outcome};
use crate::demand::Demands;
use crate::design::Design;
use crate::sources::DESIGN_LIMIT;

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let name = CheckName::new("retained_mass", "Mass held by the barrier", "-", DESIGN_LIMIT);
    vec![Outcome::at_least(name, demands.retained, design.limits.retained_mass)]
}
