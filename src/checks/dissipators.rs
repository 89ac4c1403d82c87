//! Dissipators: stroke against what is available, force against the plateau.

use crate::checks::outcome::{CheckName, CheckVerdict, Kind, Outcome, Resistance};
use crate::demand::{CAP_TOLERANCE, Demands};
use crate::design::{BarrierDesign, Design, DissipatorDesign, FlexibleNet};
use crate::quantities::dissipator;
use crate::quantities::quantity::Unit;
use crate::sources::{PLATEAU_DATA, STROKE_DATA};

fn dissipators(design: &Design) -> Option<(&FlexibleNet, &DissipatorDesign)> {
    match &design.barrier {
        BarrierDesign::FlexibleNet(net) => net.dissipators.as_ref().map(|dissipators| (&**net, dissipators)),
        BarrierDesign::RigidWall(_) => None,
    }
}

pub fn check_stroke(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let Some((net, given)) = dissipators(design) else { return Vec::new() };
    let strokes = demands.each(&dissipator::STROKE).iter().enumerate().skip(net.ropes_held_by_bed());
    strokes
        .map(|(index, demand)| {
            let id = format!("brake_{}_stroke", index + 1);
            let name = CheckName::of(&dissipator::STROKE, index, id, STROKE_DATA);
            let stroke = Resistance { characteristic: given.stroke, factor: 1.0 };
            let outcome = Outcome::at_most(name, *demand, stroke, design.limits.dissipator_utilisation);
            Outcome { kind: Kind::Stroke, ..outcome.of_rope(index) }
        })
        .collect()
}

/// With stroke left, a dissipator pulls with its plateau force at the most. At the plateau it works as it should, so there
/// is no utilisation to tell; more means that the stroke is used up.
pub fn check_plateau(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let Some((_, given)) = dissipators(design) else { return Vec::new() };
    let against = match given.curve.is_plateau() {
        true => "Dissipator tension against its plateau",
        false => "Dissipator tension against the largest of its curve",
    };
    let name = CheckName::new("brake_plateau", against, Unit::Newton, PLATEAU_DATA);
    let mut outcome = Outcome::at_most(
        name,
        demands.one(&dissipator::TENSION),
        Resistance { characteristic: given.plateau, factor: 1.0 },
        1.0,
    );
    outcome.kind = Kind::DissipatorTension;
    if let Some(utilisation) = outcome.utilisation.filter(|utilisation| *utilisation <= CAP_TOLERANCE) {
        // On a curve it yields below the largest force too.
        outcome.utilisation = (!given.curve.is_plateau() && utilisation < 1.0).then_some(utilisation);
        outcome.verdict = CheckVerdict::Pass;
    }
    vec![outcome]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demand::Demand;
    use crate::design::read::read_design;
    use crate::quantities::dissipator;

    /// A plateau of 150 kN: at it and 1 % above, which is rounding, a dissipator works; above that its stroke is used up.
    #[test]
    fn a_dissipator_works_at_its_plateau_and_is_used_up_beyond() {
        let design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        let told = |tension: f64| {
            let brake_force = Demand { simulation: Some(tension), ..Demand::default() };
            let outcomes = check_plateau(&design, &Demands::default().with(&dissipator::TENSION, &[brake_force]));
            let outcome = outcomes.first().expect("a check");
            (outcome.verdict, outcome.utilisation.is_some())
        };
        assert_eq!(told(20e3), (CheckVerdict::Pass, false));
        assert_eq!(told(151e3), (CheckVerdict::Pass, false));
        assert_eq!(told(152e3), (CheckVerdict::Fail, true));
        assert_eq!(told(f64::NAN), (CheckVerdict::Fail, true));
    }
}
