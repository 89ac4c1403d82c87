//! The bolts that hold the lowest main rope to the bed: the load of the worst one against the resistance of one.
//!
//! The load is not even along the rope: of the simulated examples the worst bolt takes two to three times the mean, and part of it
//! lifts. So the equations, which spread the load evenly, can fail the bolts but never pass them.

use crate::checks::outcome::{CheckName, CheckVerdict, Kind, Opening, Outcome, Resistance};
use crate::demand::Demands;
use crate::design::{BarrierDesign, Bottom, Design};
use crate::sources::{ANCHOR_FACTOR, NO_LIMIT};

/// Ring spacings between two bolts up to which the lowest rope counts as held along its length.
const MOST_RINGS: f64 = 4.0;

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return Vec::new() };
    if net.bottom != Bottom::Fixed {
        return Vec::new();
    }
    let name = CheckName::new("bed_bolts", "Load of the worst bolt of the lowest rope", "N", ANCHOR_FACTOR);
    vec![match net.bed_bolts.and_then(|bolts| bolts.resistance) {
        Some(characteristic) => {
            let resistance = Resistance { characteristic, factor: design.factors.anchor };
            let mut outcome = Outcome::at_most(name, demands.bolt_force, resistance, design.limits.anchor_utilisation)
                .only_by_simulation("the load is not even along the rope, and the equations spread it evenly");
            outcome.kind = Kind::Bolts;
            let spacing = net.bed_bolts.map_or(0.0, |bolts| bolts.spacing);
            let holds = matches!(outcome.verdict, CheckVerdict::Pass | CheckVerdict::Warn);
            if holds && spacing > MOST_RINGS * net.main_ropes.ring_spacing {
                outcome.leave_open(Opening::OutOfRange(format!(
                    "the lowest rope is modelled as held at every ring, and between bolts {spacing:.2} m apart it would hang free with a tension that is not checked (at most {MOST_RINGS} ring spacings)"
                )));
            }
            outcome
        }
        None => {
            let title = "Load on what holds the lowest rope to the bed, in all";
            let name = CheckName { title: title.into(), source: NO_LIMIT, ..name };
            Outcome::without_resistance(
                name,
                demands.bed_force,
                "anchors.bed_bolt_spacing and anchors.bed_bolt_resistance",
            )
        }
    }]
}
