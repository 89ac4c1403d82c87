//! How the grains move, and where their mass goes.

use crate::quantities::quantity::Unit::{MetrePerSecond, Second, Share};
use crate::quantities::quantity::{Demanded, Of, Quantity, Told};
use crate::quantities::reading::Reading;
use dem::recorders::histories::peak;

/// Highest mean velocity of all grains along the channel.
pub const VELOCITY: Quantity =
    Quantity::new("velocity_mean_peak", "Highest mean velocity", MetrePerSecond, Of::Run, |run| {
        vec![peak(&velocity(run)).1]
    })
    .json("velocity_mean_peak_m_s")
    .told(Told::Always);

pub const VELOCITY_TIME: Quantity =
    Quantity::new("velocity_mean_peak_time", "Time of the highest mean velocity", Second, Of::Run, |run| {
        vec![run.time(peak(&velocity(run)).0)]
    })
    .json("velocity_mean_peak_time_s");

fn velocity(run: &Reading) -> Vec<f64> {
    run.histories.velocity.iter().map(|velocity| velocity[0]).collect()
}

/// Of the mass that has come to the barrier, the share that it holds.
pub const RETAINED: Quantity = Quantity::new("retained", "Mass retained", Share, Of::Run, |run| {
    let all_lost = lost(run).iter().sum::<f64>();
    let held = 1.0 - all_lost - run.histories.stopped_upstream;
    vec![held / (held + all_lost)]
})
.json("retained_fraction")
.meaning("Of the mass that has come to the barrier.")
.told(Told::Always)
.demanded(Demanded::Kept);

/// Share of the mass that came to rest upstream, without leaning on the barrier.
pub const STOPPED_UPSTREAM: Quantity =
    Quantity::new("stopped_upstream", "Mass that stopped upstream", Share, Of::Run, |run| {
        vec![run.histories.stopped_upstream]
    })
    .json("stopped_upstream_fraction")
    .meaning("Of the mass, what came to rest upstream without leaning on the barrier.");

fn lost(run: &Reading) -> [f64; 4] {
    run.histories.lost.last().copied().unwrap_or_default()
}

pub const LOST_THROUGH: Quantity =
    Quantity::new("lost_through", "Mass lost through the barrier", Share, Of::Run, |run| vec![lost(run)[0]])
        .json_in("lost", "through");
pub const LOST_UNDER: Quantity =
    Quantity::new("lost_under", "Mass lost under the barrier", Share, Of::Run, |run| vec![lost(run)[1]])
        .json_in("lost", "under");
pub const LOST_BESIDE: Quantity =
    Quantity::new("lost_beside", "Mass lost beside the barrier", Share, Of::Run, |run| vec![lost(run)[2]])
        .json_in("lost", "beside");
pub const LOST_OVER: Quantity =
    Quantity::new("lost_over", "Mass lost over the barrier", Share, Of::Run, |run| vec![lost(run)[3]])
        .json_in("lost", "over");

/// The ways that mass is lost, with the word for each.
pub const WAYS: [(&str, &Quantity); 4] =
    [("through", &LOST_THROUGH), ("under", &LOST_UNDER), ("beside", &LOST_BESIDE), ("over", &LOST_OVER)];
