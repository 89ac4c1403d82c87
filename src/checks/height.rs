//! Height the barrier keeps against the least share the design asks for.

use crate::checks::outcome::{CheckName, Outcome};
use crate::demand::Demands;
use crate::design::Design;
use crate::sources::DESIGN_LIMIT;

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let name = CheckName::new("residual_height", "Residual height over initial height", "-", DESIGN_LIMIT);
    vec![Outcome::at_least(name, demands.residual_height, design.limits.residual_height)]
}
