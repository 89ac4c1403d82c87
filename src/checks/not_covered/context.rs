//! What the rules of this folder go by.

use crate::checks::outcome::Kind;
use crate::design::Design;
use crate::guideline::Guideline;

/// What a simulation shows of the first surge, without partial factors.
#[derive(Clone, Copy, Debug, Default)]
pub struct FirstSurge {
    /// Its largest force along the bed (N).
    pub push: f64,
    /// The largest of all surges that were simulated (N).
    pub largest_push: f64,
    /// The same as the next packing may exceed it with a probability of 5 % (N).
    pub hardest_push: f64,
    /// The largest force of one boulder on the barrier, as the next packing may exceed it with a probability of 5 % (N); 0 where the flow has none.
    pub boulder: f64,
    /// The least that one boulder presses on the barrier with at its largest in any packing (N): 0 where none comes to it. Nothing where the flow has none.
    pub gentlest_boulder: Option<f64>,
    /// The largest moment of the first surge about the foot of a wall, per width (N m/m).
    pub moment: f64,
    /// Largest force, and moment, of one sample over the largest of the smoothed signal, which is judged (ratio, at least 1).
    pub sampled_over_smoothed: f64,
    pub moment_sampled_over_smoothed: f64,
    /// Largest load at any instant over the largest mean over a sample, which is judged (ratios, at least 1).
    pub at_once: AtOnce,
    /// The velocity with which it arrives (m/s).
    pub velocity: f64,
    /// Its depth then, at bulk density (m).
    pub depth: f64,
    /// Its momentum flux h v² over the one that the design gives (ratio); 1 where the design gives none.
    pub flux_share: f64,
    /// K that the deposit shows at rest, where there is one.
    pub earth_pressure: Option<f64>,
    /// By how much the next run may push harder than a single one (over it, less one); 0 of several, whose scatter is in the demands.
    pub one_run: f64,
    /// By how much a finer model, or other packings, may show larger forces and strokes (over these, less one) and smaller shares.
    pub force_band: f64,
    /// The same of the net, which a single grain may load.
    pub net_band: f64,
    pub stroke_band: f64,
    pub share_band: f64,
}

/// By how much what bears a net is loaded more at an instant than in the mean over a sample (ratios).
#[derive(Clone, Copy, Debug)]
pub struct AtOnce {
    pub main_ropes: f64,
    pub net: f64,
    pub lateral_ropes: f64,
    pub anchors: f64,
    pub bolts: f64,
    pub posts: f64,
}

impl Default for AtOnce {
    fn default() -> Self {
        Self { main_ropes: 1.0, net: 1.0, lateral_ropes: 1.0, anchors: 1.0, bolts: 1.0, posts: 1.0 }
    }
}

impl AtOnce {
    /// That of what a check is about, if that is such a part.
    pub fn of(&self, kind: Kind) -> Option<f64> {
        match kind {
            Kind::MainRope => Some(self.main_ropes),
            Kind::NetRopes => Some(self.net),
            Kind::LateralRopes => Some(self.lateral_ropes),
            Kind::Anchors => Some(self.anchors),
            Kind::Bolts | Kind::BetweenBolts => Some(self.bolts),
            Kind::Posts => Some(self.posts),
            _ => None,
        }
    }
}

impl FirstSurge {
    /// How its scatter is known better, as a hint says it.
    pub fn known_better(&self) -> &'static str {
        if self.one_run > 0.0 {
            "run with --seeds 5 or simulation.fidelity: auto"
        } else {
            "run with more packings, --seeds, or a finer simulation.fidelity"
        }
    }
}

/// What a rule goes by.
#[derive(Clone, Copy)]
pub struct CheckContext<'a> {
    pub design: &'a Design,
    pub guideline: &'a Guideline,
    /// Nothing where nothing was simulated.
    pub seen: Option<FirstSurge>,
}
