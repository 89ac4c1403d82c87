//! The flow that arrives, and the depth of what it leaves.

use crate::quantities::quantity::Unit::{Metre, MetrePerSecond, Number};
use crate::quantities::quantity::{Of, Quantity};
use crate::quantities::reading::Reading;
use dem::recorders::gauge::Gauge;
use dem::recorders::histories::{Histories, peak};

/// Of the flow just upstream of the barrier when its momentum flux was largest, before grains came to rest there.
pub const DEPTH: Quantity =
    Quantity::new("incoming_depth", "Depth of the incoming flow", Metre, Of::Run, |run| vec![run.incoming.depth])
        .json("incoming_depth_m")
        .meaning(
            "Of the flow just upstream of the barrier when its momentum flux was largest, before grains came to rest there; depth at bulk density.",
        );
pub const VELOCITY: Quantity =
    Quantity::new("incoming_velocity", "Velocity of the incoming flow", MetrePerSecond, Of::Run, |run| {
        vec![run.incoming.velocity]
    })
    .json("incoming_velocity_m_s");

/// Speed of the front on the last stretch before the gauge just upstream of the barrier; not known where it was not seen there.
pub const FRONT: Quantity =
    Quantity::new("front_velocity", "Velocity of the front", MetrePerSecond, Of::RunIfKnown, |run| {
        front_velocity(run.histories).into_iter().collect()
    })
    .json("front_velocity_m_s")
    .meaning("Of the front, on the last 0.4 barrier heights before the gauge just upstream of the barrier.");

/// Of a later surge just upstream of what those before it have left, when its momentum flux was largest there; of one that does not come there,
/// and of the first, not known. The flux over the bulk density and the mean width of the section, h v² (m³/s²).
pub const ON_DEPOSIT: Quantity = Quantity::new(
    "velocity_on_deposit",
    "Velocity of the surge where it comes to the deposit",
    MetrePerSecond,
    Of::RunIfKnown,
    |run| on_deposit(run).map(|gauge| gauge.velocity).into_iter().collect(),
);
pub const FLUX_ON_DEPOSIT: Quantity = Quantity::new(
    "flux_on_deposit",
    "Momentum flux of the surge where it comes to the deposit",
    Number,
    Of::RunIfKnown,
    |run| on_deposit(run).map(|gauge| gauge.flux).into_iter().collect(),
);

/// Of the flow a barrier's height upstream when the total force peaked, as laboratories measure it.
pub const THICKNESS_AT_PEAK: Quantity =
    Quantity::new("incoming_thickness_at_peak", "Thickness of the flow at the peak", Metre, Of::Run, |run| {
        vec![run.incoming_at_peak.thickness]
    })
    .json("incoming_thickness_at_peak_m")
    .meaning(
        "Of the flow a barrier's height upstream when the total force peaked; 90 % of the centres and half a grain.",
    );
pub const VELOCITY_AT_PEAK: Quantity =
    Quantity::new("incoming_velocity_at_peak", "Velocity of the flow at the peak", MetrePerSecond, Of::Run, |run| {
        vec![run.incoming_at_peak.velocity]
    })
    .json("incoming_velocity_at_peak_m_s");

/// Depth of the deposit at the barrier at the end, at bulk density.
pub const DEPOSIT: Quantity = Quantity::new("deposit_depth", "Depth of the deposit", Metre, Of::Run, |run| {
    vec![run.histories.barrier_depth.last().copied().unwrap_or(0.0)]
})
.json("deposit_depth_m");

fn on_deposit(run: &Reading) -> Option<Gauge> {
    if !run.histories.surges.is_empty() {
        return None;
    }
    let flux: Vec<f64> = run.histories.on_deposit.iter().map(|gauge| gauge.flux).collect();
    let (at_largest, largest) = peak(&run.smoothed(&flux));
    // Asked as "none", so that what is not a number is told.
    let none = largest <= 0.0;
    let gauge = run.histories.on_deposit.get(at_largest).copied().filter(|_| !none)?;
    Some(Gauge { flux: largest, ..gauge })
}

/// Way of the front between the two places over its time; from where it started, if that is nearer than the far one.
fn front_velocity(histories: &Histories) -> Option<f64> {
    let [far, near] = histories.gauges;
    let reached = |place: f64| {
        let sample = histories.front.iter().position(|front| *front >= -place)?;
        Some((*histories.time.get(sample)?, histories.front[sample]))
    };
    let ((from, start), (to, end)) = (reached(far)?, reached(near)?);
    (to > from).then(|| (end - start) / (to - from))
}
