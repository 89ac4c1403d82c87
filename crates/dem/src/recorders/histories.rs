//! Time series of one run, all with the same times.

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::ledger::Ledger;
use crate::recorders::film::Film;
use crate::recorders::snapshots::Snapshot;

/// What happened, sample by sample. Forces are means over the sampling interval, so that no impulse is lost.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Histories {
    /// End of each sampling interval (s).
    pub time: Vec<f64>,
    /// Force of the grains on the barrier, wall or net (N).
    pub force: Vec<Vec3>,
    /// Largest force of a single step in the interval, along the channel (N).
    pub force_instant: Vec<f64>,
    /// Standard deviation of that force over the steps of the interval (N).
    pub force_scatter: Vec<f64>,
    /// Moment of the normal force on a rigid wall about its toe (N m).
    pub moment: Vec<f64>,
    /// Normal force on each segment of a rigid wall (N), a row for each segment.
    pub segments: Vec<Vec<f64>>,
    /// Mean tension along each main rope (N), a row for each rope.
    pub rope_mean: Vec<Vec<f64>>,
    /// Largest tension along each main rope, its dissipators included (N).
    pub rope_largest: Vec<Vec<f64>>,
    /// Load of the higher loaded anchor of each main rope (N).
    pub anchors: Vec<Vec<f64>>,
    /// How far downstream the furthest point of each main rope is from where the rope hung at first (m).
    pub extension: Vec<Vec<f64>>,
    /// Stroke used by each rope's dissipators, the larger of the two (m).
    pub strokes: Vec<Vec<f64>>,
    /// Stroke used by each rope's dissipators, the mean of the two (m).
    pub strokes_mean: Vec<Vec<f64>>,
    /// Larger tension of each main rope's two dissipators (N); zeros where there are none.
    pub brakes: Vec<Vec<f64>>,
    /// Largest tension in the lateral ropes (N).
    pub lateral_largest: Vec<f64>,
    /// Force on what holds the lowest main rope to the bed (N).
    pub bed_force: Vec<f64>,
    /// Largest force on one of the bolts that hold the lowest main rope to the bed, and the largest lift of one (N); empty where
    /// their distance is not known.
    pub bolt_largest: Vec<f64>,
    pub bolt_lift: Vec<f64>,
    /// Largest tension in the net (N).
    pub net_largest: Vec<f64>,
    /// Pieces of rope that have broken so far.
    pub broken_pieces: Vec<f64>,
    /// Largest permanent elongation of a piece of rope so far, over its first length.
    pub drawn_out: Vec<f64>,
    /// Lowest height of the top main rope above the bed (m).
    pub top_rope_height: Vec<f64>,
    /// Mean velocity of the grains along the channel and normal to the bed (m/s).
    pub velocity: Vec<[f64; 2]>,
    /// Push of the grains at rest on a rigid wall (N), by their static equilibrium; empty for a net.
    pub push_at_rest: Vec<f64>,
    /// Forces along the channel with which grains at rest and moving grains touch the barrier, at single instants (N).
    pub pushes_by_state: Vec<[f64; 2]>,
    /// Depth of the grains at rest where that of all grains at the barrier is largest, at bulk density (m).
    pub dead_depth: Vec<f64>,
    /// Share of the mass that is at rest, wherever it lies, once the barrier has been hit.
    pub dead: Vec<f64>,
    /// Share of the mass still moving upstream of the barrier.
    pub moving: Vec<f64>,
    /// Shares of the mass that went through, under, beside and over the barrier.
    pub lost: Vec<[f64; 4]>,
    /// The incoming flow just upstream of the barrier.
    pub incoming: Vec<Gauge>,
    /// The flow about a barrier's height upstream, where laboratories measure it.
    pub approaching: Vec<Gauge>,
    /// Between which places the front is timed, the far one and the near one (m upstream of the barrier's foot).
    pub gauges: [f64; 2],
    /// Where the front of the flow is: 2 % of its mass is further down the channel (m from the barrier's foot, downstream positive).
    pub front: Vec<f64>,
    /// Largest depth of the grains at the barrier, at bulk density (m).
    pub barrier_depth: Vec<f64>,
    /// Energies and losses: at the release, and sample by sample.
    pub at_release: Ledger,
    pub ledger: Vec<Ledger>,
    /// Share of the mass that has come to rest upstream at the end, and does not lean on the barrier.
    pub stopped_upstream: f64,
    /// The scene at a few moments, in their order.
    pub snapshots: Vec<Snapshot>,
    pub film: Film,
}

impl Histories {
    /// Whether every series has a value for each moment, or none: what was read from a file may have been forged.
    pub fn is_whole(&self) -> bool {
        let moments = self.time.len();
        let fits = |count: usize| count == 0 || count == moments;
        let single = [
            self.force.len(),
            self.force_instant.len(),
            self.force_scatter.len(),
            self.moment.len(),
            self.lateral_largest.len(),
            self.bed_force.len(),
            self.bolt_largest.len(),
            self.bolt_lift.len(),
            self.net_largest.len(),
            self.broken_pieces.len(),
            self.drawn_out.len(),
            self.top_rope_height.len(),
            self.velocity.len(),
            self.push_at_rest.len(),
            self.pushes_by_state.len(),
            self.dead_depth.len(),
            self.dead.len(),
            self.moving.len(),
            self.lost.len(),
            self.incoming.len(),
            self.approaching.len(),
            self.front.len(),
            self.barrier_depth.len(),
            self.ledger.len(),
        ];
        let by_rope = [
            &self.rope_mean,
            &self.rope_largest,
            &self.anchors,
            &self.extension,
            &self.strokes,
            &self.strokes_mean,
            &self.brakes,
        ];
        let rows = by_rope.into_iter().chain([&self.segments]).flatten().map(Vec::len);
        let ropes = self.rope_mean.len();
        single.into_iter().chain(rows).all(fits)
            && by_rope.iter().all(|rows| rows.len() == ropes)
            && self.film.is_whole()
    }
}

/// The flow in a window across the channel; zeros where there are no grains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Gauge {
    /// Height below which 90 % of the grain centres lie, plus half a grain (m).
    pub thickness: f64,
    /// Mean velocity along the channel (m/s).
    pub velocity: f64,
    /// Depth that the mass in the window has at the flow's bulk density (m).
    pub depth: f64,
    /// Share of the mass in the window that is at rest.
    pub at_rest: f64,
    /// Σ m v² over the window's area and the bulk density: h v² of an even flow (m³/s²).
    pub flux: f64,
}

/// Centred moving average of a series with even spacing; `window` is in samples and is cut at the ends.
pub fn smoothed(series: &[f64], window: usize) -> Vec<f64> {
    let half = window / 2;
    let mut sums = Vec::with_capacity(series.len() + 1);
    let mut sum = 0.0;
    sums.push(sum);
    for value in series {
        sum += value;
        sums.push(sum);
    }
    (0..series.len())
        .map(|index| {
            let (from, to) = (index.saturating_sub(half), (index + half + 1).min(series.len()));
            (sums[to] - sums[from]) / (to - from) as f64
        })
        .collect()
}

/// Largest value and its index; (0, 0.0) for an empty series, NaN if any value is NaN.
pub fn peak(series: &[f64]) -> (usize, f64) {
    if let Some(index) = series.iter().position(|value| value.is_nan()) {
        return (index, f64::NAN);
    }
    series.iter().copied().enumerate().fold(
        (0, 0.0),
        |best, (index, value)| {
            if value > best.1 { (index, value) } else { best }
        },
    )
}

/// Mean of the last `count` values; 0 for an empty series.
pub fn tail_mean(series: &[f64], count: usize) -> f64 {
    let tail = &series[series.len().saturating_sub(count)..];
    if tail.is_empty() { 0.0 } else { tail.iter().sum::<f64>() / tail.len() as f64 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smoothing_keeps_the_mean_of_a_plateau_and_finds_its_peak() {
        let series = [0.0, 0.0, 3.0, 3.0, 3.0, 0.0, 0.0];
        let smooth = smoothed(&series, 3);
        assert_eq!(peak(&smooth), (3, 3.0));
        assert_eq!(smooth[1], 1.0);
        assert_eq!(tail_mean(&series, 2), 0.0);
        assert_eq!(tail_mean(&series, 3), 1.0);
    }
}
