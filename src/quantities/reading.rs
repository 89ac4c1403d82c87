//! What quantities are read off: the time series of a run, and what several of them need of these.

use crate::design::Design;
use crate::guideline::Guideline;
use crate::quantities::coefficients::{Across, Coefficients, STANDING, coefficients};
use dem::recorders::channels::Channel;
use dem::recorders::gauge::Gauge;
use dem::recorders::histories::{Histories, peak, smoothed, tail_mean};

/// How the histories were sampled and are to be read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Samples {
    /// Samples in the smoothing window.
    pub window: usize,
    /// Samples at the end over which residuals are averaged.
    pub tail: usize,
}

/// A run that is being read.
pub struct Reading<'a> {
    pub histories: &'a Histories,
    pub design: &'a Design,
    pub guideline: &'a Guideline,
    pub samples: Samples,
    /// Total force, sample by sample, and smoothed (N).
    pub force: Vec<f64>,
    pub smooth: Vec<f64>,
    /// Sample in which the smoothed force is largest.
    pub at_peak: usize,
    /// Largest smoothed force along the bed (N), and its sample.
    pub push: f64,
    pub at_push: usize,
    /// The flow just upstream of the barrier when its momentum flux was largest, before grains came to rest there, and that flux (m³/s²).
    pub incoming: Gauge,
    pub largest_flux: f64,
    /// The flow a barrier's height upstream when the total force peaked.
    pub incoming_at_peak: Gauge,
    pub coefficients: Coefficients,
}

impl<'a> Reading<'a> {
    pub fn of(histories: &'a Histories, design: &'a Design, guideline: &'a Guideline, samples: Samples) -> Self {
        let force: Vec<f64> = histories.force.iter().map(|force| force.norm()).collect();
        let smooth = smoothed(&force, samples.window);
        let at_peak = peak(&smooth).0;
        let along: Vec<f64> = histories.force.iter().map(|force| force.x).collect();
        let (at_push, push) = peak(&smoothed(&along, samples.window));
        // Grains at rest in the window are deposit, no flow that comes.
        let flux = |gauge: &Gauge| if gauge.at_rest > STANDING { 0.0 } else { gauge.flux };
        let flux: Vec<f64> = histories.incoming.iter().map(flux).collect();
        let until_push = &flux[..flux.len().min(at_push + 1)];
        let (at_largest, largest_flux) = peak(&smoothed(until_push, samples.window));
        let grain = design.flow.sizes.quantile(0.5);
        let across = Across { section: &guideline.section, width: guideline.width };
        Self {
            histories,
            design,
            guideline,
            samples,
            force,
            smooth,
            at_peak,
            push,
            at_push,
            incoming: histories.incoming.get(at_largest).copied().unwrap_or_default(),
            largest_flux,
            incoming_at_peak: histories.approaching.get(at_peak).copied().unwrap_or_default(),
            coefficients: coefficients(histories, &guideline.input, &across, samples.window, grain),
        }
    }

    /// Width of the channel (m).
    pub fn width(&self) -> f64 {
        self.design.channel.width
    }

    /// When a sample ended (s).
    pub fn time(&self, sample: usize) -> f64 {
        self.histories.time.get(sample).copied().unwrap_or(0.0)
    }

    /// Largest value of each row of a channel.
    pub fn peaks(&self, channel: &Channel) -> Vec<f64> {
        self.histories.barrier.rows(channel).iter().map(|row| peak(row).1).collect()
    }

    /// The vectors of three channels in the channel frame, of each row when it is largest; by the level: along the valley, to the left, and up.
    pub fn vectors_at_largest(&self, channels: &[Channel; 3]) -> Vec<[f64; 3]> {
        let rows = [0, 1, 2].map(|axis| self.histories.barrier.rows(&channels[axis]));
        let (sine, cosine) = libm::sincos(self.design.channel.slope);
        let of = |row: usize| {
            let at = |sample: usize| [0, 1, 2].map(|axis| rows[axis].get(row).map_or(f64::NAN, |row| row[sample]));
            let sizes: Vec<f64> = (0..self.histories.time.len())
                .map(|sample| at(sample).iter().map(|part| part * part).sum::<f64>().sqrt())
                .collect();
            let (sample, size) = peak(&sizes);
            let [x, y, z] = if size > 0.0 || size.is_nan() { at(sample) } else { [0.0; 3] };
            [x * cosine + z * sine, y, z * cosine - x * sine]
        };
        (0..rows[0].len()).map(of).collect()
    }

    /// Mean of each row of a channel over the end of the run.
    pub fn at_rest(&self, channel: &Channel) -> Vec<f64> {
        self.histories.barrier.rows(channel).iter().map(|row| tail_mean(row, self.samples.tail)).collect()
    }

    /// Largest value of a channel of the barrier as a whole; 0 where it has none.
    pub fn peak(&self, channel: &Channel) -> Vec<f64> {
        vec![peak(self.histories.barrier.series(channel)).1]
    }

    /// A series, smoothed.
    pub fn smoothed(&self, series: &[f64]) -> Vec<f64> {
        smoothed(series, self.samples.window)
    }

    /// Depth below which a flow or deposit has none that could be told: two grains (m).
    pub fn thin(&self) -> f64 {
        2.0 * self.design.flow.sizes.quantile(0.5)
    }
}
