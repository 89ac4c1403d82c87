//! Dissipators: stroke against what is available, force against the plateau.

use crate::checks::outcome::{
    CheckName, CheckVerdict, Kind, LoadScaling, OpenReason, Outcome, Resistance, YieldingRope,
};
use crate::checks::ropes::OVER_POSTS;
use crate::demand::{CAP_TOLERANCE, Demand, Demands, USED_UP};
use crate::design::{BarrierDesign, Design, DissipatorDesign, FlexibleNet};
use crate::guideline::lean;
use crate::quantities::quantity::Unit;
use crate::quantities::{dissipator, rope_tension};
use crate::sources::{PLATEAU_DATA, STROKE_DATA};
use crate::text::Text;

pub(crate) const STROKE_TEXTS: &[Text] = &[Text {
    id: "brake_N_stroke",
    meaning: "The stroke of the dissipators of a main rope against what is available.",
    formula: "s ≤ dissipator_utilisation · s_max",
    source: STROKE_DATA,
}];

pub(crate) const PLATEAU_TEXTS: &[Text] = &[Text {
    id: "brake_plateau",
    meaning: "The tension of the dissipators against their plateau or the largest force of their curve. A dissipator that yields works as it should; more than its plateau means that a stroke is used up.",
    formula: "T ≤ F_plateau",
    source: PLATEAU_DATA,
}];

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
            let ropes = net.main_ropes.levels.get(index).map_or(1, |level| level.ropes);
            let name = CheckName::of(&dissipator::STROKE, index, id, STROKE_DATA).each_of(ropes);
            let stroke = Resistance { characteristic: given.stroke, factor: 1.0 };
            let outcome = Outcome::at_most(name, *demand, stroke, design.limits.dissipator_utilisation);
            let tension = demands.each(&rope_tension::PEAK).get(index).copied().unwrap_or_default();
            let to_the_stop = growth_of(given, demand, &tension).filter(|_| net.runs_over_posts(index));
            let hangs = || growth_of_hanging(design, net, given, index, &tension);
            let growth = to_the_stop.or_else(hangs).unwrap_or(outcome.growth);
            let outcome = Outcome { kind: Kind::Stroke, growth, ..outcome.of_rope(index) };
            let outcome = if net.runs_over_posts(index) { outcome.only_by_simulation(OVER_POSTS) } else { outcome };
            open_without_least_force(given, outcome, "barrier.flexible_net.dissipators.lower_bound")
        })
        .collect()
}

/// Leaves the stroke of dissipators open where nobody says how small their force may be: the smaller it is the further they pay out.
pub fn open_without_least_force(given: &DissipatorDesign, mut outcome: Outcome, key: &str) -> Outcome {
    if given.lower_bound.is_none() && outcome.holds() {
        outcome.leave_open(OpenReason::NotGiven(format!(
            "how far below its plateau or curve a dissipator may pull is not given (give {key} from its tests; 1 if what is given is the lower bound)"
        )));
    }
    outcome
}

/// How the stroke of the dissipators of a main rope that hangs from bank to bank grows with the load.
fn growth_of_hanging(
    design: &Design,
    net: &FlexibleNet,
    given: &DissipatorDesign,
    index: usize,
    tension: &Demand,
) -> Option<LoadScaling> {
    let level = net.main_ropes.levels.get(index)?;
    let yields_at = given.yields_at();
    let span = design.channel.section().width(level.height * libm::cos(lean(design)));
    let elastic = yields_at * (span / level.rope.axial_stiffness() + 2.0 / given.stiffness);
    Some(LoadScaling::OfYieldingRope(YieldingRope {
        tension: tension.simulation?,
        yields_at,
        elastic,
        stroke: given.stroke,
    }))
}

/// How the stroke of dissipators grows with the load where the equations see none: nothing where they do.
pub fn growth_of(given: &DissipatorDesign, stroke: &Demand, tension: &Demand) -> Option<LoadScaling> {
    if stroke.guideline.is_some_and(|stroke| stroke > 0.0) {
        return None;
    }
    let yields_at = given.yields_at();
    Some(LoadScaling::ToItsStop { tension: tension.simulation?, yields_at, stroke: given.stroke })
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
    outcome.kind = if given.curve.is_plateau() { Kind::DissipatorTension } else { Kind::DissipatorCurve };
    if outcome.utilisation.is_some_and(|utilisation| utilisation <= CAP_TOLERANCE) {
        // The end of a curve may have less than its largest force: there the stroke tells.
        let used_up = !given.curve.is_plateau() && stroke_is_used_up(given, demands);
        outcome.utilisation = None;
        outcome.verdict = if used_up { CheckVerdict::Fail } else { CheckVerdict::Pass };
    }
    vec![outcome]
}

/// Whether any stroke is at its end, by any route; one that is not known may be.
fn stroke_is_used_up(given: &DissipatorDesign, demands: &Demands) -> bool {
    let strokes = demands.each(&dissipator::STROKE).iter().flat_map(|demand| [demand.guideline, demand.simulation]);
    let left = |stroke: f64| stroke < USED_UP * given.stroke;
    strokes.flatten().any(|stroke| !left(stroke))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demand::Demand;
    use crate::design::read::read_design;
    use crate::quantities::dissipator;
    use crate::yield_curve::YieldCurve;

    /// Along a curve that ends with less than its largest force a stroke that is used up fails, whatever the tension.
    #[test]
    fn a_curve_is_used_up_by_its_stroke() {
        let mut design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        let given = net.dissipators.as_mut().expect("dissipators");
        let (curve, [plateau, stroke]) = YieldCurve::of(&[[0.0, 150e3], [0.9, 60e3]]);
        (given.curve, given.plateau, given.stroke) = (curve, plateau, stroke);
        let told = |tension: f64, stroke: f64| {
            let demand = |value: f64| [Demand { simulation: Some(value), ..Demand::default() }];
            let demands = Demands::default()
                .with(&dissipator::TENSION, &demand(tension))
                .with(&dissipator::STROKE, &demand(stroke));
            check_plateau(&design, &demands)[0].verdict
        };
        assert_eq!(told(100e3, 0.5), CheckVerdict::Pass);
        assert_eq!(told(100e3, 0.9), CheckVerdict::Fail);
        assert_eq!(told(100e3, f64::NAN), CheckVerdict::Fail);
        assert_eq!(told(160e3, 0.5), CheckVerdict::Fail);
    }

    /// A rope that is pulled with 120 of the 150 kN with which its dissipators yield, 2 cm longer then: 1.2 times the load leaves it elastic, twice the
    /// load is 1.6 times what makes it yield, 0.02 (1.6² − 1) = 31 mm. One that yields already, by 10 mm, goes to 4 · 10 + 20 · 3 = 100 mm.
    #[test]
    fn a_dissipator_that_was_idle_yields_under_more_load() {
        let stroke = |tension: f64, stroke: f64, more: f64| {
            let rope = YieldingRope { tension, yields_at: 150e3, elastic: 0.02, stroke: 0.9 };
            let name = CheckName::new("x", "x", Unit::Metre, "x");
            let demand = Demand { simulation: Some(stroke), ..Demand::default() };
            let resistance = Resistance { characteristic: 0.9, factor: 1.0 };
            let outcome = Outcome::at_most(name, demand, resistance, 1.0);
            let outcome = Outcome { growth: LoadScaling::OfYieldingRope(rope), ..outcome };
            outcome.demand_under(crate::checks::outcome::Route::Simulation, more).expect("a stroke")
        };
        let close = |found: f64, wanted: f64| assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
        close(stroke(120e3, 0.0, 1.2), 0.0);
        close(stroke(120e3, 0.0, 2.0), 0.0312);
        close(stroke(151e3, 0.01, 2.0), 0.1);
        close(stroke(151e3, 0.01, 1.0), 0.01);
        // One that has yielded under a peak, with a mean below its force, has yielded all the same.
        close(stroke(120e3, 0.01, 1.2), 0.0144);
        close(stroke(120e3, 0.0, 100.0), 0.9);
        assert!(stroke(f64::NAN, 0.0, 2.0).is_nan());
    }

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
