//! Mass held by the barrier against the least share the design asks for.

use crate::checks::outcome::{CheckName, CheckVerdict, Opening, Outcome};
use crate::demand::Demands;
use crate::demand::from_loads::held;
use crate::design::{BarrierDesign, Design};
use crate::sources::DESIGN_LIMIT;

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let name = CheckName::new("retained_mass", "Mass held by the barrier", "-", DESIGN_LIMIT);
    let mut outcome = Outcome::at_least(name, demands.retained, design.limits.retained_mass);
    if matches!(outcome.verdict, CheckVerdict::Pass | CheckVerdict::Warn)
        && let Some(why) = unseen(design)
    {
        outcome.leave_open(why);
    }
    vec![outcome]
}

/// What the simulation cannot have seen get lost: surges that were not simulated, and grains that were made too coarse for the mesh.
fn unseen(design: &Design) -> Option<Opening> {
    let flow = &design.flow;
    if let (Some(cut), BarrierDesign::FlexibleNet(net)) = (&flow.cut, &design.barrier) {
        let finer = cut.whole.finer_than(net.mesh_opening);
        if finer > 1.0 - design.limits.retained_mass {
            return Some(Opening::NotGiven(format!(
                "{:.0} % of the real flow is finer than the mesh and was not simulated as it is (simulation.coarsen): what of it gets through is not known",
                100.0 * finer
            )));
        }
    }
    let held = held(design)?;
    (flow.event_volume > 1.001 * flow.volume() && held.volume < design.limits.retained_mass * flow.event_volume).then(|| {
        Opening::NotGiven(format!(
            "one surge of {:.0} m³ was simulated, and by the equations the barrier holds about {:.0} of the event's {:.0} m³: what of the later surges is held is not known",
            flow.volume(),
            held.volume,
            flow.event_volume
        ))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demand::Demand;
    use crate::design::read::read_design;

    #[test]
    fn an_event_that_more_than_fills_the_barrier_is_not_held_because_one_surge_is() {
        let mut design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        let retained = Demand { simulation: Some(1.0), ..Demand::default() };
        let demands = Demands { retained, ..Demands::default() };
        assert_eq!(check(&design, &demands)[0].verdict, CheckVerdict::Pass);
        design.flow.event_volume = 40.0 * design.flow.volume();
        assert_eq!(check(&design, &demands)[0].verdict, CheckVerdict::Open);
    }
}
