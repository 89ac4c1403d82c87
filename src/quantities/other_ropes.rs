//! Tension of lateral ropes and net.

use crate::quantities::quantity::Unit::Newton;
use crate::quantities::quantity::{Demanded, Of, Quantity, Told};
use dem::recorders::histories::tail_mean;
use dem::recorders::of_ropes;

/// Largest tension of the lateral ropes.
pub const LATERAL: Quantity =
    Quantity::new("lateral_tension", "Tension of the lateral ropes", Newton, Of::Run, |run| {
        run.peak(&of_ropes::LATERAL)
    })
    .json("lateral_tension_peak_n")
    .demanded(Demanded::Load(|_, _| None));

/// Largest tension of the net's ropes; of a ring net, the force of a leg as that of a chain that is as near to breaking.
pub const NET: Quantity =
    Quantity::new("net_tension", "Tension of the net's ropes", Newton, Of::Run, |run| run.peak(&of_ropes::NET))
        .json("net_tension_peak_n")
        .told(Told::WhereLoaded)
        .demanded(Demanded::Load(|guideline, _| guideline.rings.map(|rings| rings.leg)));

/// Both at any instant.
pub const LATERAL_AT_ONCE: Quantity =
    Quantity::new("lateral_tension_at_once", "Tension of the lateral ropes at any instant", Newton, Of::Run, |run| {
        run.peak(&of_ropes::LATERAL_AT_ONCE)
    })
    .json("lateral_tension_at_once_n");
pub const NET_AT_ONCE: Quantity =
    Quantity::new("net_tension_at_once", "Tension of the net's ropes at any instant", Newton, Of::Run, |run| {
        run.peak(&of_ropes::NET_AT_ONCE)
    })
    .json("net_tension_at_once_n");

/// Largest tension of the net at the end.
pub const NET_RESIDUAL: Quantity =
    Quantity::new("net_tension_residual", "Tension of the net's ropes at rest", Newton, Of::Run, |run| {
        vec![tail_mean(run.histories.barrier.series(&of_ropes::NET), run.samples.tail)]
    });
