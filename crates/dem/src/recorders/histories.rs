//! Time series of one run, all with the same times.

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::ledger::Ledger;
use crate::recorders::CHANNELS;
use crate::recorders::channels::{Channel, Channels, Rows};
use crate::recorders::film::Film;
use crate::recorders::gauge::Gauge;
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
    /// What the parts of the barrier bear and do.
    pub barrier: Channels,
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
    /// Mass (kg), momentum (kg m/s) and energy (J) that have come in through an inlet; empty without one.
    pub entered: Vec<[f64; 3]>,
    /// Share of the mass that has come to rest upstream at the end, and does not lean on the barrier.
    pub stopped_upstream: f64,
    /// Samples at which each surge after the first was let go: their number when it was.
    pub surges: Vec<usize>,
    /// Share of each surge in the mass, and of its own mass that came to rest upstream at the end without leaning on the barrier.
    pub shares: Vec<f64>,
    pub stopped_of: Vec<f64>,
    /// The surge under way just upstream of what lay there when it was let go; zeros for the first.
    pub on_deposit: Vec<Gauge>,
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
            self.velocity.len(),
            self.push_at_rest.len(),
            self.pushes_by_state.len(),
            self.dead_depth.len(),
            self.dead.len(),
            self.moving.len(),
            self.lost.len(),
            self.incoming.len(),
            self.approaching.len(),
            self.on_deposit.len(),
            self.front.len(),
            self.barrier_depth.len(),
            self.ledger.len(),
            self.entered.len(),
        ];
        let of =
            |rows: Rows| CHANNELS.iter().copied().filter(|channel| channel.rows == rows).collect::<Vec<&Channel>>();
        let alike = [Rows::EachRope, Rows::EachPost, Rows::EachAnchor].map(of);
        let in_order = self.surges.windows(2).all(|pair| pair[0] <= pair[1]);
        let told = |series: &[f64], count: usize| series.is_empty() || series.len() == count;
        let several = self.surges.len() + 1;
        let told = told(&self.shares, several) && told(&self.stopped_of, several);
        let surges = in_order && told && self.surges.iter().all(|sample| *sample <= moments);
        surges && single.into_iter().all(fits) && self.barrier.is_whole(moments, &alike) && self.film.is_whole()
    }
}

impl Histories {
    /// The samples of one surge, counted from 0: from its release to that of the next.
    pub fn samples_of(&self, surge: usize) -> std::ops::Range<usize> {
        let start =
            surge.checked_sub(1).map_or(0, |before| self.surges.get(before).copied().unwrap_or(self.time.len()));
        start..self.surges.get(surge).copied().unwrap_or(self.time.len())
    }

    /// The series of one surge alone, without pictures. Shares of what is lost and what stopped are of its own mass; what had passed before it
    /// has not passed in it.
    pub fn of_surge(&self, surge: usize) -> Self {
        let samples = self.samples_of(surge);
        fn cut<T: Clone>(series: &[T], samples: &std::ops::Range<usize>) -> Vec<T> {
            series.get(samples.clone()).map_or(Vec::new(), <[T]>::to_vec)
        }
        let before = samples.start.checked_sub(1).and_then(|sample| self.lost.get(sample)).copied().unwrap_or_default();
        let lost = cut(&self.lost, &samples);
        let share = self.shares.get(surge).copied().unwrap_or(1.0);
        Self {
            time: cut(&self.time, &samples),
            force: cut(&self.force, &samples),
            force_instant: cut(&self.force_instant, &samples),
            force_scatter: cut(&self.force_scatter, &samples),
            barrier: self.barrier.part(&samples),
            velocity: cut(&self.velocity, &samples),
            push_at_rest: cut(&self.push_at_rest, &samples),
            pushes_by_state: cut(&self.pushes_by_state, &samples),
            dead_depth: cut(&self.dead_depth, &samples),
            dead: cut(&self.dead, &samples),
            moving: cut(&self.moving, &samples),
            lost: lost.into_iter().map(|lost| [0, 1, 2, 3].map(|way| (lost[way] - before[way]) / share)).collect(),
            incoming: cut(&self.incoming, &samples),
            approaching: cut(&self.approaching, &samples),
            on_deposit: cut(&self.on_deposit, &samples),
            gauges: self.gauges,
            front: cut(&self.front, &samples),
            barrier_depth: cut(&self.barrier_depth, &samples),
            at_release: self.at_release,
            ledger: cut(&self.ledger, &samples),
            entered: cut(&self.entered, &samples),
            stopped_upstream: self.stopped_of.get(surge).copied().unwrap_or(0.0),
            surges: Vec::new(),
            shares: Vec::new(),
            stopped_of: Vec::new(),
            snapshots: Vec::new(),
            film: Film::default(),
        }
    }
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
    fn every_channel_has_a_name_of_its_own() {
        let names: std::collections::BTreeSet<&str> = CHANNELS.iter().map(|channel| channel.name).collect();
        assert_eq!(names.len(), CHANNELS.len());
    }

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
