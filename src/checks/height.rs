//! Height the barrier keeps against the least share the design asks for.

use crate::checks::outcome::{CheckName, Kind, Outcome};
use crate::demand::Demands;
use crate::design::{BarrierDesign, Design};
use crate::quantities::height;
use crate::quantities::quantity::Unit;
use crate::sources::DESIGN_LIMIT;

/// A net sags and is pulled out; a rigid wall keeps its height.
pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    if matches!(design.barrier, BarrierDesign::RigidWall(_)) {
        return Vec::new();
    }
    let name = CheckName::new("residual_height", "Residual height / initial height", Unit::Share, DESIGN_LIMIT);
    let outcome = Outcome::at_least(name, demands.one(&height::RESIDUAL), design.limits.residual_height);
    vec![Outcome { kind: Kind::HeightLeft, ..outcome }]
}
