//! Runs a scene from release until the answer no longer changes.

use std::sync::atomic::{AtomicBool, Ordering};

use serde::{Deserialize, Serialize};

use crate::checkpoint::CheckpointStore;
use crate::design::Design;
use crate::scene::build::Scene;
use crate::scene::flow::packing::PackingError;
use crate::scene::inlet::Feed;
use crate::scene::interrupt_grace::Patience;
use crate::scene::surges::{Next, Ready};
use dem::recorders::film::Film;
use dem::recorders::histories::{Histories, tail_mean};
use dem::recorders::recorder::Recorder;
use dem::simulation::{Simulation, Unstable};

/// Force may change by this share of itself from one stretch to the next and still count as steady.
const STEADY_FORCE: f64 = 0.01;
/// Shares of the mass that may still move, come to rest or get lost.
const STEADY_MOVING: f64 = 0.02;
const STEADY_DEAD: f64 = 0.005;
const STEADY_LOST: f64 = 0.002;

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// Force, mass at rest and mass held no longer changed.
    Steady,
    /// The longest time allowed was reached first.
    OutOfTime,
    BrokeDown(Unstable),
    /// A later surge, counted from 0, could not be let go.
    NotLetGo(usize, PackingError),
    Interrupted,
}

/// What is told while a simulation goes on.
#[derive(Clone, Copy, Debug)]
pub struct ProgressReport<'a> {
    /// Which simulation it is, counted from 0, of how many that run side by side or one after the other.
    pub number: usize,
    pub of: usize,
    /// s
    pub time: f64,
    /// Rough share of it that is done, 0 to 1.
    pub share: f64,
    /// Force on the barrier now (N).
    pub force: f64,
    /// What it has looked like so far.
    pub film: &'a Film,
}

/// How a run is watched and stopped from outside, and where it is kept, if it is.
pub struct RunControl<'a> {
    pub progress: &'a (dyn Fn(ProgressReport) + Sync),
    pub stop: &'a AtomicBool,
    pub store: Option<&'a CheckpointStore>,
}

/// A run under way.
#[derive(Serialize, Deserialize)]
pub struct Ongoing {
    simulation: Simulation,
    recorder: Recorder,
    /// Largest energy imbalance met, over the energy put in.
    energy_error: f64,
    /// Samples in the stretch over which steadiness is judged.
    stretch: usize,
    /// Rough time the event takes (s).
    expected_time: f64,
    /// How far upstream of its foot the barrier reaches, with room for the largest grain (m).
    reach: f64,
    /// Number of the next grain that is let go, and when the surge under way was (s).
    next_grain: u32,
    let_go: f64,
    /// Density of the loosest packing of all surges over the one asked for.
    packed_share: f64,
    /// What is still to come in through an inlet, if there is one.
    feed: Option<Feed>,
}

/// A finished run.
pub struct Event {
    pub histories: Histories,
    pub ending: Ending,
    pub simulation: Simulation,
    /// Largest energy imbalance met, over the energy put in.
    pub energy_error: f64,
    /// Grains that have left the channel through its bed or a side wall, and their share of the mass.
    pub escaped: u32,
    pub escaped_share: f64,
    /// Density of the loosest packing of all surges over the one asked for.
    pub packed_share: f64,
    /// Grains of all surges.
    pub grains: u32,
}

impl Ongoing {
    pub fn begin(scene: Scene) -> Self {
        let stretch = scene.samples_of_rest();
        let Scene { simulation, recorder, expected_time, reach, packed_share, feed, .. } = scene;
        let next_grain = simulation.grains.ids.iter().max().map_or(0, |highest| highest + 1);
        let recorder = Recorder::new(recorder);
        Self {
            simulation,
            recorder,
            energy_error: 0.0,
            stretch,
            expected_time,
            reach,
            next_grain,
            let_go: 0.0,
            packed_share,
            feed,
        }
    }

    /// Goes on until the last surge is steady, at the longest time that the design allows each, on breakdown or when asked to. At every stop of the simulation `keep` is
    /// handed the run, and told whether it ends there because it was asked to; a run that nobody keeps, or whose next stop is far, ends
    /// before.
    pub fn go_on(mut self, design: &Design, seed: u64, watch: &RunControl, mut keep: impl FnMut(&Self, bool)) -> Event {
        let mut interrupt_grace = Patience::default();
        let ending = loop {
            let sampled = match self.recorder.step(&mut self.simulation) {
                Err(unstable) => break Ending::BrokeDown(unstable),
                Ok(sampled) => sampled,
            };
            // Before the run is kept, or what this sample says would be lost with it.
            if let Some(ending) = sampled.then(|| self.judge(design, watch)).flatten() {
                let next = if ending == Ending::Steady { self.next_surge(design, seed, watch) } else { None };
                match next {
                    None => break ending,
                    Some(Ok(())) => {}
                    Some(Err(ending)) => break ending,
                }
            }
            // After the account of the step, which knows nothing of what comes now.
            if let Some(ending) = sampled.then(|| self.feed_on(design)).flatten() {
                break ending;
            }
            let asked = watch.stop.load(Ordering::Relaxed);
            if self.simulation.at_stop() {
                keep(&self, asked);
            }
            if asked && (self.simulation.at_stop() || interrupt_grace.is_over()) {
                break Ending::Interrupted;
            }
        };
        self.recorder.finish(&self.simulation);
        let grains = self.feed.as_ref().map_or(self.next_grain, Feed::grains);
        let Self { simulation, recorder, energy_error, packed_share, .. } = self;
        let (escaped, escaped_share) = (recorder.escaped.len() as u32, recorder.escaped_share);
        Event {
            histories: recorder.histories,
            ending,
            simulation,
            energy_error,
            escaped,
            escaped_share,
            packed_share,
            grains,
        }
    }

    /// Lets in what is to stand behind an inlet now; tells whether the run ends because it cannot.
    fn feed_on(&mut self, design: &Design) -> Option<Ending> {
        let feed = self.feed.as_mut()?;
        match feed.go_on(design, &mut self.simulation) {
            Ok(mass) => {
                self.recorder.let_in(mass);
                None
            }
            Err(error) => Some(Ending::NotLetGo(0, error)),
        }
    }

    /// Time (s) up to which the flow comes in.
    fn comes_until(&self, design: &Design) -> f64 {
        match (&self.feed, &design.flow.hydrograph) {
            (Some(feed), Some(_)) if !feed.is_over() => f64::INFINITY,
            (Some(_), Some(hydrograph)) => hydrograph.duration(),
            _ => self.let_go,
        }
    }

    /// Lets the next surge go, if there is one.
    fn next_surge(&mut self, design: &Design, seed: u64, watch: &RunControl) -> Option<Result<(), Ending>> {
        let number = self.recorder.histories.surges.len() + 1;
        design.flow.later.get(number - 1)?;
        let next = Next { design, number, seed, first: self.next_grain, reach: self.reach };
        Some(match next.ready(&self.simulation, watch.stop) {
            Ok(Ready { grains, last, packed_share }) => {
                let mass = grains.iter().map(|grain| grain.body.mass).sum();
                self.recorder.next_surge(self.next_grain, mass, last);
                self.packed_share = self.packed_share.min(packed_share);
                self.next_grain += grains.len() as u32;
                self.let_go = self.simulation.time;
                self.simulation.let_in(&grains);
                Ok(())
            }
            Err(PackingError::Interrupted) => Err(Ending::Interrupted),
            Err(error) => Err(Ending::NotLetGo(number, error)),
        })
    }

    /// Takes in the sample just made; tells whether the surge under way ends with it.
    fn judge(&mut self, design: &Design, watch: &RunControl) -> Option<Ending> {
        let histories = &self.recorder.histories;
        let error = self.simulation.ledger.relative_error(&histories.at_release);
        self.energy_error = worse(self.energy_error, error);
        let force = histories.force.last().map_or(0.0, |force| force.norm());
        let time = self.simulation.time;
        let share = (time / self.expected_time).min(0.99);
        (watch.progress)(ProgressReport { number: 0, of: 1, time, share, force, film: &histories.film });
        if watch.store.is_none() && watch.stop.load(Ordering::Relaxed) {
            return Some(Ending::Interrupted);
        }
        let under_way = time - self.comes_until(design);
        if under_way < 0.0 {
            return None;
        }
        // One that follows at a given time does not wait until the surge before it has come to rest.
        let follows = design.flow.later.get(histories.surges.len()).and_then(|later| later.after);
        let over = match follows {
            Some(after) => under_way >= after,
            None => {
                let whole = self.recorder.samples_under_way() >= 2 * self.stretch;
                whole && steady(histories, self.stretch, self.recorder.share_under_way)
            }
        };
        if over {
            return Some(Ending::Steady);
        }
        (under_way >= design.simulation.longest).then_some(Ending::OutOfTime)
    }
}

/// The imbalance further from zero; one that is not a number stays.
fn worse(before: f64, now: f64) -> f64 {
    if now.abs() > before.abs() || now.is_nan() { now } else { before }
}

/// Whether the last two stretches tell the same; `share` is that of the surge under way in the mass.
fn steady(histories: &Histories, stretch: usize, share: f64) -> bool {
    let count = histories.time.len();
    if count < 2 * stretch || !histories.moving.last().is_some_and(|moving| *moving < STEADY_MOVING * share) {
        return false;
    }
    let force: Vec<f64> = histories.force[count - 2 * stretch..].iter().map(|force| force.norm()).collect();
    let (before, after) = (tail_mean(&force[..stretch], stretch), tail_mean(&force, stretch));
    let dead = (histories.dead[count - 1] - histories.dead[count - stretch]).abs();
    let lost = |index: usize| histories.lost[index].iter().sum::<f64>();
    (after - before).abs() <= STEADY_FORCE * after.max(before)
        && dead < STEADY_DEAD * share
        && lost(count - 1) - lost(count - stretch) < STEADY_LOST * share
}

#[cfg(test)]
mod tests {
    use super::*;
    /// Two stretches of ten samples in which nothing changes, but for what `change` does to the last.
    fn after(change: impl Fn(&mut Histories, usize)) -> bool {
        let count = 20;
        let mut histories = Histories {
            time: (0..count).map(f64::from).collect(),
            force: vec![dem::Vec3::new(100.0, 0.0, 0.0); count as usize],
            moving: vec![0.01; count as usize],
            dead: vec![0.9; count as usize],
            lost: vec![[0.01, 0.0, 0.0, 0.0]; count as usize],
            ..Histories::default()
        };
        (10..20).for_each(|sample| change(&mut histories, sample));
        steady(&histories, 10, 1.0)
    }

    #[test]
    fn an_event_is_over_when_force_mass_at_rest_and_mass_held_no_longer_change() {
        let ramp = |sample: usize| (sample - 10) as f64 / 9.0;
        assert!(after(|_, _| ()));
        assert!(!after(|histories, sample| histories.force[sample].x = 103.0));
        assert!(!after(|histories, sample| histories.force[sample].x = 97.0));
        assert!(!after(|histories, sample| histories.moving[sample] = 0.03));
        assert!(!after(|histories, sample| histories.dead[sample] += 0.01 * ramp(sample)));
        assert!(!after(|histories, sample| histories.dead[sample] -= 0.01 * ramp(sample)));
        assert!(!after(|histories, sample| histories.lost[sample][3] += 0.004 * ramp(sample)));
        // Within what may still change.
        assert!(after(|histories, sample| histories.dead[sample] += 0.004 * ramp(sample)));
        assert!(after(|histories, sample| histories.lost[sample][3] += 0.001 * ramp(sample)));
        // Nothing is steady before there are two stretches, or where what moves is unknown.
        assert!(!steady(&Histories::default(), 10, 1.0));
        assert!(!after(|histories, sample| histories.moving[sample] = f64::NAN));
        assert!(!after(|histories, sample| histories.force[sample].x = f64::NAN));
    }

    #[test]
    fn the_largest_imbalance_of_energy_is_kept_and_one_that_is_no_number_stays() {
        assert_eq!(worse(0.01, -0.02), -0.02);
        assert_eq!(worse(-0.02, 0.01), -0.02);
        assert!(worse(0.01, f64::NAN).is_nan() && worse(f64::NAN, 0.01).is_nan());
    }

    /// Twenty samples are two stretches of ten, not of eleven; what went on before them is past, and what came to rest or was lost in the
    /// first of them no longer counts.
    #[test]
    fn the_last_two_stretches_tell_and_nothing_before_them() {
        let count = 40;
        let long = |change: &dyn Fn(&mut Histories)| {
            let mut histories = Histories {
                time: (0..count).map(f64::from).collect(),
                force: vec![dem::Vec3::new(100.0, 0.0, 0.0); count as usize],
                moving: vec![0.01; count as usize],
                dead: vec![0.9; count as usize],
                lost: vec![[0.01, 0.0, 0.0, 0.0]; count as usize],
                ..Histories::default()
            };
            change(&mut histories);
            histories
        };
        let quiet = long(&|_| ());
        assert!(steady(&quiet, 10, 1.0) && steady(&quiet, 20, 1.0) && !steady(&quiet, 21, 1.0));
        assert!(steady(&long(&|histories| histories.force[..20].fill(dem::Vec3::zeros())), 10, 1.0));
        assert!(!steady(&long(&|histories| histories.force[..21].fill(dem::Vec3::zeros())), 10, 1.0));
        assert!(steady(&long(&|histories| histories.dead[..30].fill(0.1)), 10, 1.0));
        assert!(steady(&long(&|histories| histories.lost[..30].fill([0.0; 4])), 10, 1.0));
        // The mean force of a stretch by a hundredth.
        assert!(steady(&long(&|histories| histories.force[30..].fill(dem::Vec3::new(101.0, 0.0, 0.0))), 10, 1.0));
    }
}
