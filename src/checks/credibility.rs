//! Whether a run may be believed at all. A run that breaks one of these limits ends undecided, never as a pass.

use serde::{Deserialize, Serialize};

/// Energy imbalance over the energy put in.
pub const ENERGY_LIMIT: f64 = 0.01;
/// Overlap over the smaller grain's radius.
pub const OVERLAP_LIMIT: f64 = 0.20;
/// Time step over critical step. An audit cuts the step as soon as it finds it beyond 1, so a value much
/// above means that contacts stiffened between two audits.
pub const STEP_LIMIT: f64 = 1.5;

/// Share of the mass that may go through the bed or a side wall; it counts as lost.
pub const ESCAPED_LIMIT: f64 = 0.001;
/// Density that the packing of the flow may fall short of, as a share of the one asked for.
pub const PACKING_LIMIT: f64 = 0.03;
/// Energy stored in the contacts of a moving flow at its release, over its energy of motion.
pub const STORED_LIMIT: f64 = 0.01;
/// Share of the mass that may stop upstream and never lean on the barrier.
pub const STOPPED_LIMIT: f64 = 0.5;

/// Work with which what stands behind an inlet pushes on, over that of the static pressure of the flow as it passes: a flow that runs on
/// needs about that, K times, and a deposit that stands in its way many times.
pub const PUSHED_LIMIT: f64 = 4.0;

/// What a run shows of its own numerics.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Numerics {
    pub energy_error: f64,
    pub overlap: f64,
    pub step_ratio: f64,
    /// Grains whose centre has gone through a rope.
    pub crossings: u32,
    /// Grains that have gone through the bed or a side wall, and their share of the mass.
    pub escaped: u32,
    pub escaped_share: f64,
    /// By how much the packing of the flow falls short of the density asked for, as a share of it.
    pub packing_shortfall: f64,
    /// Energy stored in contacts at the release of a moving flow, over its energy of motion.
    pub stored_at_release: f64,
    /// Share of the mass that stopped upstream.
    pub stopped_upstream: f64,
    /// Work with which the flow that is carried to an inlet pushes on what stands before it, over that of its static pressure.
    pub pushed_in: f64,
    /// Why the run ended early, if it did.
    pub broke_down: Option<String>,
    /// Whether no grain ever touched the barrier.
    pub missed: bool,
    /// Whether the answer still changed when the longest time was reached.
    pub unfinished: bool,
}

impl Numerics {
    /// The worse of two runs in every respect.
    pub fn worst(&self, other: &Self) -> Self {
        let worse = |a: f64, b: f64| if b.is_nan() || b.abs() > a.abs() { b } else { a };
        Self {
            energy_error: worse(self.energy_error, other.energy_error),
            overlap: worse(self.overlap, other.overlap),
            step_ratio: worse(self.step_ratio, other.step_ratio),
            crossings: self.crossings + other.crossings,
            escaped: self.escaped + other.escaped,
            escaped_share: worse(self.escaped_share, other.escaped_share),
            packing_shortfall: worse(self.packing_shortfall, other.packing_shortfall),
            stored_at_release: worse(self.stored_at_release, other.stored_at_release),
            stopped_upstream: worse(self.stopped_upstream, other.stopped_upstream),
            pushed_in: worse(self.pushed_in, other.pushed_in),
            broke_down: self.broke_down.clone().or_else(|| other.broke_down.clone()),
            missed: self.missed || other.missed,
            unfinished: self.unfinished || other.unfinished,
        }
    }
}

/// Reasons why the run cannot be relied on; none if it can.
pub fn doubts(numerics: &Numerics) -> Vec<String> {
    let mut doubts = Vec::new();
    doubts.extend(numerics.broke_down.iter().map(|reason| format!("the simulation broke down: {reason}")));
    let mut hold = |what: &str, value: f64, limit: f64, remedy: &str| {
        // Asked as "within", so that a NaN raises a doubt.
        let within = value.abs() <= limit;
        if !within {
            doubts.push(format!("{what} is {value:.3}, beyond the limit of {limit}; {remedy}"));
        }
    };
    let finer = "try simulation.fidelity: fine";
    hold("the energy imbalance over the energy put in", numerics.energy_error, ENERGY_LIMIT, finer);
    let stiffer = "a larger flow.contact_modulus makes grains stiffer";
    hold("the largest overlap over the grain's radius", numerics.overlap, OVERLAP_LIMIT, stiffer);
    hold("the time step over the critical step", numerics.step_ratio, STEP_LIMIT, finer);
    hold(
        "the share of the mass that has gone through the bed or a side wall",
        numerics.escaped_share,
        ESCAPED_LIMIT,
        "a larger flow.contact_modulus makes grains stiffer",
    );
    hold(
        "the share by which the packed flow falls short of the bulk density asked for",
        numerics.packing_shortfall,
        PACKING_LIMIT,
        "grains are too large for the block or the density too high: smaller grains, a deeper block or a lower flow.bulk_density",
    );
    hold(
        "the energy stored in contacts at the release, over the energy of motion,",
        numerics.stored_at_release,
        STORED_LIMIT,
        "the flow would start with speed that nobody asked for: a lower flow.bulk_density leaves grains more room",
    );
    hold(
        "the share of the mass that stopped upstream and never leant on the barrier",
        numerics.stopped_upstream,
        STOPPED_LIMIT,
        "this is no test of the barrier: a flow that arrives needs less friction on the bed, more slope or more velocity",
    );
    hold(
        "the work with which the flow at the inlet pushes on what stands before it, over that of its static pressure,",
        if numerics.pushed_in < 0.0 { 0.0 } else { numerics.pushed_in },
        PUSHED_LIMIT,
        "the flow backs up to the inlet, or comes in faster than what came in before it: a longer run_in gives it room",
    );
    if numerics.crossings > 0 {
        let count = numerics.crossings;
        doubts.push(format!("{count} times a grain has slipped through a rope; {stiffer}"));
    }
    if numerics.missed {
        doubts.push("the flow came to rest without ever touching the barrier".to_string());
    }
    if numerics.unfinished {
        doubts.push("the flow had not come to rest when the longest simulated time was reached".to_string());
    }
    doubts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_of_several_starts_is_kept() {
        let one = Numerics { energy_error: -0.02, overlap: 0.1, crossings: 1, ..Numerics::default() };
        let other = Numerics { energy_error: 0.01, overlap: f64::NAN, missed: true, ..Numerics::default() };
        for worst in [one.worst(&other), other.worst(&one)] {
            assert_eq!((worst.energy_error, worst.crossings, worst.missed), (-0.02, 1, true));
            assert!(worst.overlap.is_nan());
        }
    }

    #[test]
    fn every_limit_and_nan_raise_a_doubt() {
        assert!(doubts(&Numerics::default()).is_empty());
        for broken in [
            Numerics { energy_error: -0.02, ..Numerics::default() },
            Numerics { energy_error: f64::NAN, ..Numerics::default() },
            Numerics { overlap: 0.21, ..Numerics::default() },
            Numerics { step_ratio: 2.0, ..Numerics::default() },
            Numerics { crossings: 1, ..Numerics::default() },
            Numerics { escaped_share: 0.002, ..Numerics::default() },
            Numerics { packing_shortfall: 0.04, ..Numerics::default() },
            Numerics { stored_at_release: 0.02, ..Numerics::default() },
            Numerics { stopped_upstream: 0.6, ..Numerics::default() },
            Numerics { stopped_upstream: f64::NAN, ..Numerics::default() },
            Numerics { missed: true, ..Numerics::default() },
            Numerics { unfinished: true, ..Numerics::default() },
            Numerics { broke_down: Some("x".into()), ..Numerics::default() },
        ] {
            assert_eq!(doubts(&broken).len(), 1, "{broken:?}");
        }
    }

    #[test]
    fn of_several_starts_counts_add_up_and_every_fault_stays() {
        let one = Numerics { escaped: 2, crossings: 1, unfinished: true, escaped_share: 0.1, ..Numerics::default() };
        let other = Numerics { escaped: 3, crossings: 4, stored_at_release: -0.3, ..Numerics::default() };
        for worst in [one.worst(&other), other.worst(&one)] {
            assert_eq!((worst.escaped, worst.crossings, worst.unfinished, worst.missed), (5, 5, true, false));
            assert_eq!((worst.escaped_share, worst.stored_at_release), (0.1, -0.3));
        }
        let missed = Numerics { missed: true, packing_shortfall: 0.5, step_ratio: 2.0, ..Numerics::default() };
        let worst = Numerics::default().worst(&missed);
        assert_eq!(
            (worst.missed, worst.unfinished, worst.packing_shortfall, worst.step_ratio),
            (true, false, 0.5, 2.0)
        );
    }
}
