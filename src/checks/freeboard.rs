//! The level that the event reaches in front of the barrier against the barrier's height, less the freeboard that the design asks for.

use crate::checks::height::left_by_sag;
use crate::checks::outcome::{CheckName, Kind, OpenReason, Outcome, Resistance};
use crate::demand::Demands;
use crate::design::{Design, RunUp};
use crate::guideline::{Guideline, flows, guideline, height_over_bed};
use crate::larger::larger_or_nan;
use crate::loads::input::GuidelineInput;
use crate::loads::run_up::{by_energy, by_jump};
use crate::quantities::quantity::Unit;
use crate::quantities::{height, run_up};
use crate::sources::{DESIGN_LIMIT, NO_LIMIT};
use crate::text::Text;

pub(crate) const TEXTS: &[Text] = &[Text {
    id: "freeboard",
    meaning: "The level that deposit and run-up reach at the barrier against its height, less the freeboard that the design asks for. Without limits.freeboard it is told for information.",
    formula: "max(H_deposit, H_before the last surge + run-up) ≤ H − freeboard",
    source: DESIGN_LIMIT,
}];

/// Judged where a freeboard is asked for; many barriers are meant to be overtopped.
pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let name = |source| CheckName::new("freeboard", "Level of run-up and deposit at the barrier", Unit::Metre, source);
    let demand = demands.one(&run_up::LEVEL);
    let mut outcome = match design.limits.freeboard {
        None => Outcome::informative(name(NO_LIMIT), demand),
        Some(freeboard) => {
            // More freeboard than there is barrier leaves no room; asked so that what is not a number stays so.
            let room = height_kept(design, demands) - freeboard;
            let room = if room < 0.0 { 0.0 } else { room };
            Outcome::at_most(name(DESIGN_LIMIT), demand, Resistance { characteristic: room, factor: 1.0 }, 1.0)
        }
    };
    if outcome.holds() && !guideline(design).level_is_known {
        outcome.leave_open(OpenReason::NotGiven(
            "the deposit of the event reaches beyond what is known of the channel, so that its level at the barrier is not known (a terrain: raise channel.terrain.upstream, or put the ends further apart; a level reach: give the slope that follows it)".to_string(),
        ));
    }
    let by_energy_alone = design.limits.run_up == RunUp::Energy;
    if outcome.holds() && by_energy_alone && !energy_is_enough(design) {
        outcome.leave_open(OpenReason::OutOfRange(
            "the run-up by energy is lower than that by a momentum jump here, so that it is no upper bound (limits.run_up: larger)"
                .to_string(),
        ));
    }
    vec![Outcome { kind: Kind::Level, ..outcome.whatever_the_pressures() }]
}

/// Whether the barrier is high enough for the level by other equations, with the height that was found to be kept and with the sag of a net
/// by these.
pub fn has_room(design: &Design, asked: &Guideline, found: &Outcome) -> bool {
    let Some((room, freeboard)) = found.capacity.zip(design.limits.freeboard) else { return true };
    let sagged = height_over_bed(design) * left_by_sag(design, asked).unwrap_or(1.0) - freeboard;
    asked.level_is_known && asked.level <= room && asked.level <= sagged
}

/// Whether the energy balance gives no less than the jump does, of any surge.
fn energy_is_enough(design: &Design) -> bool {
    let guideline = guideline(design);
    let enough = |flow: &GuidelineInput| by_energy(flow) >= by_jump(flow, &guideline.section);
    flows(design, guideline.input).iter().all(enough)
}

/// Height of the barrier over the bed, normal to it, that a net keeps when it sags: by the equations or in the simulation, whichever is
/// less (m).
pub fn height_kept(design: &Design, demands: &Demands) -> f64 {
    let simulated = demands.one(&height::RESIDUAL).simulation.unwrap_or(1.0);
    let by_equations = left_by_sag(design, &guideline(design)).unwrap_or(1.0);
    let lost = larger_or_nan(1.0 - simulated, 1.0 - by_equations);
    height_over_bed(design) * (1.0 - larger_or_nan(lost, 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::Demand;
    use crate::design::read::read_design;
    use approx::assert_relative_eq;

    fn wall() -> Design {
        read_design("x", include_bytes!("../../designs/gravity_wall.yaml")).unwrap().design
    }

    fn outcome(design: &Design, simulation: Option<f64>) -> Outcome {
        let by_equations = Demands::by_equations(&guideline(design), &design.factors).one(&run_up::LEVEL);
        check(design, &Demands::default().with(&run_up::LEVEL, &[Demand { simulation, ..by_equations }])).remove(0)
    }

    /// The level of the equations plus the freeboard is the height that is needed.
    #[test]
    fn the_barrier_is_as_high_as_the_level_and_the_freeboard() {
        let mut design = wall();
        design.limits.freeboard = None;
        assert_eq!(outcome(&design, None).verdict, CheckVerdict::Info);
        let level = guideline(&design).level;
        let room = height_over_bed(&design) - level;
        assert!(room > 0.5, "{room}");
        let verdict = |design: &mut Design, freeboard: f64, seen: Option<f64>| {
            design.limits.freeboard = Some(freeboard);
            outcome(design, seen).verdict
        };
        let held = |verdict: CheckVerdict| matches!(verdict, CheckVerdict::Pass | CheckVerdict::Warn);
        assert!(held(verdict(&mut design, 0.99 * room, None)));
        assert_eq!(verdict(&mut design, 1.01 * room, None), CheckVerdict::Fail);
        assert_eq!(verdict(&mut design, 0.99 * room, Some(1.02 * level)), CheckVerdict::Fail);
        assert_eq!(verdict(&mut design, 0.0, Some(f64::NAN)), CheckVerdict::Fail);
        // More freeboard than there is barrier.
        assert_eq!(verdict(&mut design, 50.0, None), CheckVerdict::Fail);
    }

    /// With 5 m/s and 0.4 m on a bed of 20°: h + v²/(2 g cos α) = 0.4 + 25/18.44 = 1.756 m.
    #[test]
    fn the_design_says_by_which_balance() {
        let mut design = wall();
        (design.channel.slope, design.flow.event_volume) = (20_f64.to_radians(), design.flow.volume());
        let mut input = guideline(&design).input;
        (input.velocity, input.depth, input.gravity_normal) = (5.0, 0.4, 9.81 * libm::cos(20_f64.to_radians()));
        let by = |design: &mut Design, run_up: RunUp| {
            design.limits.run_up = run_up;
            // Of a flow whose deposit is no higher.
            (design.flow.mass, design.flow.event_volume) = (1.0, 1.0 / design.flow.bulk_density);
            crate::guideline::level_reached(design, &crate::guideline::event_fill(design, &input), &input)
                .expect("a level")
        };
        assert_relative_eq!(by(&mut design, RunUp::Energy), 0.4 + 25.0 / 18.4368, max_relative = 1e-4);
        let jump = by(&mut design, RunUp::MomentumJump);
        // r³ − r² − (2 Fr² + 1) r + 1 = 0 with Fr² = 25/(9.2184 · 0.4).
        let (r, froude) = (jump / 0.4, 25.0 / (9.2184 * 0.4));
        assert!((r.powi(3) - r * r - (2.0 * froude + 1.0) * r + 1.0).abs() < 1e-3, "{r}");
        assert_eq!(by(&mut design, RunUp::Larger), by(&mut design, RunUp::Energy).max(jump));
    }

    /// A flow of 0.6 m with 3.6 m/s runs up higher by the jump than by energy, which then passes nothing.
    #[test]
    fn the_energy_balance_alone_passes_no_slow_flow() {
        let mut design = wall();
        (design.limits.freeboard, design.limits.run_up) = (Some(0.0), RunUp::Energy);
        assert_eq!(outcome(&design, None).verdict, CheckVerdict::Open);
        design.limits.run_up = RunUp::MomentumJump;
        assert!(outcome(&design, None).holds());
    }

    /// A net that keeps 60 % of its height holds back no more than that.
    #[test]
    fn what_a_net_sags_is_no_height() {
        let mut design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        design.limits.freeboard = Some(0.0);
        let residual = Demand { simulation: Some(0.6), ..Demand::default() };
        let demands = Demands::default().with(&height::RESIDUAL, &[residual]);
        assert_relative_eq!(height_kept(&design, &demands), 0.6 * height_over_bed(&design), max_relative = 1e-12);
        let unknown = Demand { simulation: Some(f64::NAN), ..Demand::default() };
        assert!(height_kept(&design, &Demands::default().with(&height::RESIDUAL, &[unknown])).is_nan());
    }
}
