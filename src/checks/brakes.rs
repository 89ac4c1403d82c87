//! Dissipators: stroke against what is available, force against the plateau.

use crate::checks::outcome::{CheckName, Outcome};
use crate::demand::{Demand, Demands};
use crate::design::{BarrierDesign, Design, DissipatorDesign};
use crate::sources::{BRAKE_DATA, PLATEAU_DATA};

/// Share by which a sampled anchor load may exceed the plateau before the dissipator counts as exhausted.
const PLATEAU_TOLERANCE: f64 = 1.01;

fn dissipators(design: &Design) -> Option<DissipatorDesign> {
    match &design.barrier {
        BarrierDesign::FlexibleNet(net) => net.dissipators,
        BarrierDesign::RigidWall(_) => None,
    }
}

pub fn check_stroke(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let Some(dissipator) = dissipators(design) else {
        return Vec::new();
    };
    let strokes = demands.brake_stroke.iter().enumerate();
    strokes
        .map(|(index, demand)| {
            let rope = index + 1;
            let title = format!("Stroke of the dissipators of main rope {rope}");
            let name = CheckName::new(format!("brake_{rope}_stroke"), title, "m", BRAKE_DATA);
            Outcome::at_most(name, *demand, dissipator.stroke, design.limits.brake_utilisation)
        })
        .collect()
}

/// With stroke left, no anchor behind a dissipator sees more than the plateau. More means that the stroke is
/// used up or that load goes past the dissipator.
pub fn check_plateau(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let Some(dissipator) = dissipators(design) else {
        return Vec::new();
    };
    let largest = |values: Vec<f64>| values.into_iter().reduce(f64::max);
    let demand = Demand {
        guideline: largest(demands.anchor_force.iter().filter_map(|demand| demand.guideline).collect()),
        simulation: largest(demands.anchor_force.iter().filter_map(|demand| demand.simulation).collect()),
    };
    let name =
        CheckName::new("brake_plateau", "Largest anchor load against the dissipators' plateau", "N", PLATEAU_DATA);
    // At the plateau the dissipator works as it should: utilisation 1 is a pass, not a warning.
    let mut outcome = Outcome::at_most(name, demand, dissipator.plateau, PLATEAU_TOLERANCE);
    if outcome.verdict == crate::checks::outcome::CheckVerdict::Warn {
        outcome.verdict = crate::checks::outcome::CheckVerdict::Pass;
    }
    vec![outcome]
}
