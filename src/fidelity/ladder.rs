//! The rungs from cheap to fine, and whether a rung's answer can still change on a finer one.
//!
//! After each rung every check is asked: with the demand as far off as this rung is known to be, can its verdict flip? A check that
//! certainly fails decides the design, and so do all checks when each certainly holds; else the next rung runs. What a check needs
//! and a rung cannot tell leaves it open.

use serde::{Deserialize, Serialize};

use crate::checks::not_covered::rigid_wall::SIMULATIONS_REACH;
use crate::checks::outcome::{CheckVerdict, Kind, OpenReason, Outcome, Route};
use crate::demand::USED_UP;
use crate::design::{BarrierDesign, BarrierModel, Design, FidelityWish};
use crate::fidelity::{needed_pieces, net_pieces};

/// How far off a rung may be: what a finer one may say over what this one says, less one, upwards and downwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// Of forces and moments.
    pub force: f64,
    /// Of strokes.
    pub stroke: f64,
    /// Of shares, of the whole: mass held, height left.
    pub share: f64,
}

/// Which rung it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RungKind {
    Equations,
    CoarseGrains,
    Grains,
    Starts,
    Fine,
}

/// A rung of the ladder.
#[derive(Clone, Copy, Debug)]
pub struct Rung {
    pub kind: RungKind,
    pub name: &'static str,
    pub what: &'static str,
    /// Packings; 0 where nothing is simulated.
    pub starts: u32,
    pub band: Band,
    /// The same of forces on a rigid wall, which no net softens.
    pub on_a_wall: f64,
    /// The same of the tension of the net, which a single grain may decide.
    pub of_the_net: f64,
    /// How far its demands may lie above what a finer one says: below that, what it fails is not failed for certain.
    pub above: Band,
    /// Whether the ladder does without it where it would take too long.
    pub may_be_left_out: bool,
    apply: fn(&mut Design),
}

/// Factor on the size of the grains of the coarse rung.
pub const COARSE: f64 = 1.5;

/// From cheap to fine. The bands hold what was seen of the examples:
/// * equations: simulations come to 0.1 to 1.8 times the guideline's loads and strokes, 3.3 times for the bolts in the bed;
/// * one start: packings of one design scatter by 2 to 16 % in forces and by 1 to 28 % in strokes, five starts put 2.3 standard
///   deviations of it on their mean, and a single one may be the mildest of them (1.6 below): factors of 2.2 and 3; on a rigid wall a single
///   one showed half of what five ask for: a factor of 2.5; of eight runs of one net its tension came to 1 to 2.9 times the least: 3, and the
///   mass held to 89 to 95 %: 6 points;
/// * coarse grains: besides, what `designs/studies/speed_accuracy.yaml` measures of their size, up to 36 % in forces, and a stroke
///   twice as long in `small_net`;
/// * five starts: what cylinders change against sliding ropes, 3 to 14 % in forces, and what divided sides of the mesh let through besides,
///   1.1 % of the mass in `small_net`; on forces and strokes they change less than the packings scatter.
///
/// A failure need not be as certain as a pass: a demand is beyond its limit for certain if it is so by more than the largest standard
/// deviation of one packing, or than what the model leaves open.
pub const RUNGS: [Rung; 5] = [
    Rung {
        kind: RungKind::Equations,
        name: "equations",
        what: "the guideline alone",
        starts: 0,
        band: Band { force: SIMULATIONS_REACH - 1.0, stroke: 4.0, share: 1.0 },
        on_a_wall: SIMULATIONS_REACH - 1.0,
        of_the_net: SIMULATIONS_REACH - 1.0,
        above: Band { force: 0.0, stroke: 0.0, share: 0.0 },
        may_be_left_out: false,
        apply: |_| {},
    },
    Rung {
        kind: RungKind::CoarseGrains,
        name: "coarse",
        what: "grains half as large again, ropes that slide, one run",
        starts: 1,
        band: Band { force: 1.6, stroke: 3.0, share: 0.08 },
        on_a_wall: 2.0,
        of_the_net: 3.0,
        above: Band { force: 0.4, stroke: 1.0, share: 0.05 },
        may_be_left_out: true,
        apply: coarsen,
    },
    Rung {
        kind: RungKind::Grains,
        name: "grains",
        what: "grains as they are, ropes that slide, one run",
        starts: 1,
        band: Band { force: 1.2, stroke: 2.0, share: 0.06 },
        on_a_wall: 1.5,
        of_the_net: 2.0,
        above: Band { force: 0.16, stroke: 0.28, share: 0.02 },
        may_be_left_out: false,
        apply: |design| set(design, FidelityWish::Standard, BarrierModel::SlidingRopes),
    },
    Rung {
        kind: RungKind::Starts,
        name: "starts",
        what: "the same with five runs, their scatter in the demand",
        starts: 5,
        band: Band { force: 0.15, stroke: 0.2, share: 0.02 },
        on_a_wall: 0.15,
        of_the_net: 0.5,
        above: Band { force: 0.15, stroke: 0.2, share: 0.01 },
        may_be_left_out: true,
        apply: |design| set(design, FidelityWish::Standard, BarrierModel::SlidingRopes),
    },
    Rung {
        kind: RungKind::Fine,
        name: "fine",
        what: "half the step, ropes and rings of cylinders that bend, sides of the mesh divided as the grains need, five runs",
        starts: 5,
        band: Band { force: 0.0, stroke: 0.0, share: 0.0 },
        on_a_wall: 0.0,
        of_the_net: 0.0,
        above: Band { force: 0.0, stroke: 0.0, share: 0.0 },
        may_be_left_out: true,
        apply: |design| set(design, FidelityWish::Fine, BarrierModel::Cylinders),
    },
];

fn set(design: &mut Design, fidelity: FidelityWish, model: BarrierModel) {
    design.simulation.fidelity = fidelity;
    design.simulation.barrier_model = model;
}

fn coarsen(design: &mut Design) {
    // Longer steps, spheres or pinned ropes save little and err much.
    set(design, FidelityWish::Standard, BarrierModel::SlidingRopes);
    design.flow.coarsen(COARSE);
}

/// Packings from which their scatter is told by themselves: the table that k_n is from begins with three.
const LEAST_STARTS: usize = 3;

/// Share of the flow that may be coarsened before a run counts as one of coarse grains.
const SMALL_CUT: f64 = 0.25;

/// The rung that a run of this many packings is like, whose fineness the design pins.
pub fn rung_of(design: &Design, starts: usize) -> &'static Rung {
    let fine = design.simulation.fidelity == FidelityWish::Fine
        && match &design.barrier {
            BarrierDesign::RigidWall(_) => true,
            BarrierDesign::FlexibleNet(net) => {
                design.simulation.barrier_model == BarrierModel::Cylinders
                    && net_pieces(design, net) >= needed_pieces(design, net)
            }
        };
    // Pinned rings load ropes unevenly, long steps are coarse too: neither is better known than coarse grains.
    let pinned = design.simulation.barrier_model == BarrierModel::PinnedRopes
        && matches!(design.barrier, BarrierDesign::FlexibleNet(_));
    // So are grains that were made coarser than given, for more than a small part of the flow.
    let coarsened = design.flow.cut.as_ref().is_some_and(|cut| cut.share > SMALL_CUT);
    if pinned || coarsened || design.simulation.fidelity == FidelityWish::Fast {
        return RUNGS.iter().find(|rung| rung.kind == RungKind::CoarseGrains).unwrap_or(&RUNGS[0]);
    }
    let like = |rung: &&Rung| rung.starts > 1 && starts >= LEAST_STARTS && (fine || rung.kind != RungKind::Fine);
    RUNGS.iter().rfind(like).or_else(|| RUNGS.iter().find(|rung| rung.kind == RungKind::Grains)).unwrap_or(&RUNGS[0])
}

impl Rung {
    /// The design as this rung models it.
    pub fn of(&self, design: &Design) -> Design {
        let mut design = design.clone();
        (self.apply)(&mut design);
        design
    }

    /// Whether this rung makes sense for a design: grains that are coarser than the mesh lets through tell nothing of what it holds.
    pub fn suits(&self, design: &Design) -> bool {
        match &design.barrier {
            // If only the finest tenth could pass, coarse grains hide little.
            BarrierDesign::FlexibleNet(net) if self.kind == RungKind::CoarseGrains => {
                design.flow.sizes.quantile(0.1) > net.opening()
            }
            // Slack is a matter of ropes that only pull.
            BarrierDesign::FlexibleNet(net) if self.kind == RungKind::Fine => net.net_slack == 0.0,
            _ => true,
        }
    }

    /// What of `outcomes` is open still on this rung; nothing where one check fails for certain.
    pub fn open(&self, outcomes: &[Outcome]) -> Vec<String> {
        if outcomes.iter().any(|outcome| self.answer(outcome) == Answer::Fails) {
            return Vec::new();
        }
        self.could_flip(outcomes)
    }

    /// Checks that a finer model may decide otherwise, whatever the others say.
    pub fn could_flip(&self, outcomes: &[Outcome]) -> Vec<String> {
        let open = outcomes.iter().filter(|outcome| self.answer(outcome) == Answer::Open);
        open.map(|outcome| outcome.title.clone()).collect()
    }

    /// Leaves those checks open of which this rung cannot tell on which side of the limit they lie.
    pub fn leave_open_what_is_too_close(&self, packings: usize, outcomes: &mut [Outcome]) {
        for outcome in outcomes.iter_mut() {
            let close = match outcome.verdict {
                CheckVerdict::Pass | CheckVerdict::Warn => self.answer(outcome) == Answer::Open,
                CheckVerdict::Fail => !self.fails_clearly(outcome),
                CheckVerdict::Open | CheckVerdict::Info => false,
            };
            if close {
                let finer = match packings {
                    1 => "one simulation is not enough: the scatter between runs could reverse the result (run with --seeds 5 or simulation.fidelity: auto)".to_string(),
                    2 => format!("{packings} simulations are not enough: the scatter between runs could reverse the result (run with --seeds 5 or simulation.fidelity: auto)"),
                    _ => "it is closer to its limit than this model is accurate".to_string(),
                };
                outcome.leave_open(OpenReason::TooClose(finer));
            }
        }
    }

    /// Whether a failed check stays failed with its demand as much smaller as the rung may be off.
    fn fails_clearly(&self, outcome: &Outcome) -> bool {
        let (Some(capacity), Some(used)) = (outcome.capacity, outcome.utilisation) else { return true };
        if outcome.fails_by_equations() || capacity <= 0.0 || used.is_nan() {
            return true;
        }
        match outcome.resistance {
            None => used - self.above.share / (1.0 - capacity).max(1e-9) > 1.0,
            // A stroke that is used up would be longer if there were more of it.
            Some((resistance, _))
                if outcome.kind == Kind::Stroke
                    && outcome.demand.simulation >= Some(USED_UP * resistance.characteristic) =>
            {
                true
            }
            Some(_) => {
                let above = if outcome.kind == Kind::Stroke { self.above.stroke } else { self.above.force };
                used / (1.0 + above) > 1.0
            }
        }
    }

    fn answer(&self, outcome: &Outcome) -> Answer {
        match &outcome.open {
            // No finer model closes these.
            Some(OpenReason::NotGiven(_) | OpenReason::OutOfRange(_)) if self.starts > 0 => return Answer::Holds,
            Some(OpenReason::NotGiven(_)) => return Answer::Holds,
            Some(OpenReason::TooClose(_) | OpenReason::Contradicted(_)) => return Answer::Open,
            _ => {}
        }
        let (Some(capacity), Some(used)) = (outcome.capacity, outcome.utilisation) else {
            // Nothing is judged, or it is by a rule of its own, whose failure on a coarse model is not certain.
            let open = matches!(outcome.verdict, CheckVerdict::Fail | CheckVerdict::Open);
            return if open { Answer::Open } else { Answer::Holds };
        };
        if outcome.resistance.is_none() {
            return self.answer_at_least(capacity, used);
        }
        if self.starts == 0 && outcome.verdict == CheckVerdict::Open {
            return Answer::Open;
        }
        let band = match outcome.kind {
            _ if outcome.is_of_a_wall() => self.on_a_wall,
            Kind::NetRopes => self.of_the_net,
            Kind::Stroke => self.band.stroke,
            _ => self.band.force,
        };
        let used_by = |demand: Option<f64>| demand.map(|demand| demand / capacity);
        let (guideline, simulation) = (used_by(outcome.demand.guideline), used_by(outcome.demand.simulation));
        let under = |route: Route, more: f64| used_by(outcome.demand_under(route, more)).unwrap_or(f64::NAN);
        if guideline.is_some_and(|used| used > 1.0) || capacity <= 0.0 {
            return Answer::Fails;
        }
        // Above its cap a load goes only when a stroke is used up, and strokes are checked too.
        let cap = outcome.demand.cap.map_or(f64::INFINITY, |cap| cap / capacity);
        match (simulation, self.starts) {
            (Some(_), _) if under(Route::Simulation, 1.0 / (1.0 + band)) > 1.0 => Answer::Fails,
            (Some(used), _) if under(Route::Simulation, 1.0 + band) <= 1.0 || cap.max(used) <= 1.0 => Answer::Holds,
            // Without a simulation the guideline stands for what one would say.
            (None, 0) if under(Route::Guideline, 1.0 + band) <= 1.0 => Answer::Holds,
            // What only the guideline tells is told once and for all.
            (None, 1..) if guideline.is_some() => Answer::Holds,
            _ => Answer::Open,
        }
    }

    /// A least share: `used` is what is missing of what may be missing.
    fn answer_at_least(&self, least: f64, used: f64) -> Answer {
        let shift = self.band.share / (1.0 - least).max(1e-9);
        match used {
            used if used + shift <= 1.0 => Answer::Holds,
            used if used - shift > 1.0 => Answer::Fails,
            _ => Answer::Open,
        }
    }
}

/// What a rung says of a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Answer {
    Holds,
    Fails,
    /// A finer model may say otherwise.
    Open,
}

/// A rung that ran, for the report.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Step {
    /// Place in [`RUNGS`].
    pub rung: usize,
    /// s
    pub wall_clock: f64,
    /// The verdict as this rung has it.
    pub said: String,
    /// Largest utilisation, and of what.
    pub governing: String,
    /// Checks that a finer model may decide otherwise.
    pub open: Vec<String>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::outcome::{CheckName, Resistance};
    use crate::demand::Demand;
    use crate::quantities::quantity::Unit;

    fn force(guideline: Option<f64>, simulation: Option<f64>) -> Outcome {
        let resistance = Resistance { characteristic: 100.0, factor: 1.0 };
        Outcome::at_most(
            CheckName::new("x", "x", Unit::Newton, "x"),
            Demand { guideline, simulation, ..Demand::default() },
            resistance,
            1.0,
        )
    }

    fn rung(name: &str) -> &'static Rung {
        RUNGS.iter().find(|rung| rung.name == name).unwrap()
    }

    #[test]
    fn clear_cases_are_decided_low_and_marginal_ones_climb() {
        let equations = rung("equations");
        assert_eq!(equations.answer(&force(Some(19.0), None)), Answer::Holds);
        assert_eq!(equations.answer(&force(Some(21.0), None)), Answer::Open);
        assert_eq!(equations.answer(&force(Some(90.0), None)), Answer::Open);
        assert_eq!(equations.answer(&force(Some(101.0), None)), Answer::Fails);
        assert_eq!(equations.answer(&force(None, None)), Answer::Open);
        let grains = rung("grains");
        assert_eq!(grains.answer(&force(Some(90.0), Some(45.0))), Answer::Holds);
        // What a dissipator caps cannot climb beyond.
        let capped =
            Outcome { demand: Demand { cap: Some(90.0), ..force(None, Some(90.0)).demand }, ..force(None, Some(90.0)) };
        assert_eq!(grains.answer(&capped), Answer::Holds);
        assert_eq!(grains.answer(&force(Some(10.0), Some(95.0))), Answer::Open);
        assert_eq!(grains.answer(&force(Some(10.0), Some(105.0))), Answer::Open);
        assert_eq!(grains.answer(&force(Some(10.0), Some(230.0))), Answer::Fails);
        assert_eq!(grains.answer(&force(None, Some(f64::NAN))), Answer::Open);
        let fine = rung("fine");
        assert_eq!(fine.answer(&force(None, Some(99.9))), Answer::Holds);
        assert_eq!(fine.answer(&force(None, Some(100.1))), Answer::Fails);
    }

    #[test]
    fn one_certain_failure_decides() {
        let grains = rung("grains");
        assert!(grains.open(&[force(None, Some(95.0)), force(None, Some(300.0))]).is_empty());
        assert_eq!(grains.open(&[force(None, Some(95.0)), force(None, Some(30.0))]).len(), 1);
    }

    #[test]
    fn shares_have_a_band_of_their_own() {
        let held = |share| {
            let demand = Demand { simulation: Some(share), ..Demand::default() };
            Outcome::at_least(CheckName::new("x", "x", Unit::Share, "x"), demand, 0.9)
        };
        let grains = rung("grains");
        assert_eq!(grains.answer(&held(0.99)), Answer::Holds);
        assert_eq!(grains.answer(&held(0.91)), Answer::Open);
        assert_eq!(grains.answer(&held(0.80)), Answer::Fails);
        let demand = Demand::default();
        let untold = Outcome::at_least(CheckName::new("x", "x", Unit::Share, "x"), demand, 0.9);
        assert_eq!(rung("equations").answer(&untold), Answer::Open);
    }

    #[test]
    fn what_is_too_close_to_its_limit_is_neither_passed_nor_failed() {
        let after = |rung: &Rung, outcome: Outcome| {
            let mut outcomes = [outcome];
            rung.leave_open_what_is_too_close(1, &mut outcomes);
            outcomes[0].verdict
        };
        for (name, used, expected) in [
            ("grains", 45.0, CheckVerdict::Pass),
            ("grains", 47.0, CheckVerdict::Open),
            ("grains", 104.3, CheckVerdict::Open),
            ("grains", 128.0, CheckVerdict::Fail),
            ("starts", 80.0, CheckVerdict::Pass),
            ("starts", 104.3, CheckVerdict::Open),
            ("starts", 120.0, CheckVerdict::Fail),
            ("fine", 99.0, CheckVerdict::Warn),
            ("fine", 101.0, CheckVerdict::Fail),
        ] {
            assert_eq!(after(rung(name), force(Some(10.0), Some(used))), expected, "{name} {used}");
        }
        // What the guideline fails is failed, and what only it tells is told.
        assert_eq!(after(rung("grains"), force(Some(101.0), Some(10.0))), CheckVerdict::Fail);
        assert_eq!(after(rung("grains"), force(Some(95.0), Some(10.0))), CheckVerdict::Warn);
        assert_eq!(after(rung("grains"), force(None, Some(f64::NAN))), CheckVerdict::Fail);
        // Of one run a wall and the net may show less than half and a third of what others do.
        let of = |kind: Kind, used: f64| Outcome { kind, ..force(Some(10.0), Some(used)) };
        assert_eq!(after(rung("grains"), of(Kind::WallStrength, 39.0)), CheckVerdict::Pass);
        assert_eq!(after(rung("grains"), of(Kind::WallStrength, 41.0)), CheckVerdict::Open);
        assert_eq!(after(rung("grains"), of(Kind::NetRopes, 33.0)), CheckVerdict::Pass);
        assert_eq!(after(rung("grains"), of(Kind::NetRopes, 34.0)), CheckVerdict::Open);
        // A used-up stroke is used up.
        let demand = Demand { simulation: Some(2.5), ..Demand::default() };
        let stroke = Resistance { characteristic: 2.5, factor: 1.0 };
        let used_up = Outcome::at_most(CheckName::new("x", "x", Unit::Metre, "x"), demand, stroke, 0.9);
        let used_up = Outcome { kind: Kind::Stroke, ..used_up };
        assert_eq!(after(rung("grains"), used_up), CheckVerdict::Fail);
    }

    #[test]
    fn every_band_is_narrower_than_the_one_before() {
        for pair in RUNGS.windows(2) {
            let [before, after] = [pair[0].band, pair[1].band];
            assert!(after.force < before.force && after.stroke < before.stroke && after.share < before.share);
            let [before, after] = [pair[0], pair[1]].map(|rung| [rung.on_a_wall, rung.of_the_net]);
            assert!(after[0] < before[0] && after[1] < before[1]);
        }
    }
}
