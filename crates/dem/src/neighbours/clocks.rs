//! Clocks that run as fast as bodies can come closer, and the reading at which lists expire.

use crate::neighbours::drift::Drift;

/// Steps by which one looks ahead where ropes and the grains at them move within a step: the step to come takes about as much of the way as the
/// last, and may take more.
pub const STEPS_AHEAD: f64 = 1.5;

/// A clock, and how far it went in the last step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Clock {
    /// m
    pub now: f64,
    /// m
    pub tick: f64,
}

impl Clock {
    fn go_on(&mut self, way: f64) {
        self.now += way;
        self.tick = way;
    }
}

/// The clocks of one block of grains.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BlockClocks {
    /// For two members of the block.
    pub inner: Clock,
    /// For a member of the block and one of another.
    pub border: Clock,
    /// For a member of the block and a surface or rope.
    pub fixed: Clock,
}

/// How far any bodies can have come closer since the lists were made, from the fastest pace in every step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Clocks {
    /// Two members (m).
    pairs: f64,
    /// A member and a surface or rope (m).
    fixed: f64,
    /// What the last step has added to that (m).
    fixed_tick: f64,
    elapsed: f64,
    /// Closing speed that the drift alone may give a pair (m/s).
    drawing_out: f64,
    /// Largest drift (m/s).
    drift: f64,
    pairs_limit: f64,
    fixed_limit: f64,
}

impl Clocks {
    /// Clocks at zero. `span` is the largest distance between grains whose members are in each other's reach, `pairs_left` what two members
    /// that are in none may come closer at least, `fixed_skin` the reach of the lists of surfaces and ropes (m).
    pub fn start(drift: &Drift, span: f64, pairs_left: f64, fixed_skin: f64) -> Self {
        Self {
            drawing_out: drift.steepness * span,
            drift: drift.fastest,
            pairs_limit: pairs_left,
            fixed_limit: fixed_skin,
            ..Self::default()
        }
    }

    /// Takes a step of length `step` (s) in which no member of any block escaped faster than `stray` from its drift and no
    /// barrier node moves faster than `nodes` (m/s).
    pub fn tick(&mut self, step: f64, stray: f64, nodes: f64) {
        self.elapsed += step;
        self.pairs += step * (2.0 * stray + self.drawing_out);
        self.fixed_tick = step * (stray + self.drift + nodes);
        self.fixed += self.fixed_tick;
    }

    /// Moves the clocks of one block on through the same step; `own` is the fastest stray in the block (m/s).
    pub fn tick_block(&self, clocks: &mut BlockClocks, step: f64, own: f64, stray: f64, nodes: f64) {
        clocks.inner.go_on(step * (2.0 * own + self.drawing_out));
        clocks.border.go_on(step * (own + stray + self.drawing_out));
        clocks.fixed.go_on(step * (own + self.drift + nodes));
    }

    /// Whether nothing outside the lists can touch yet, surfaces and ropes in so many steps more like the last.
    pub fn hold(&self, steps_ahead: f64) -> bool {
        self.pairs < self.pairs_limit && self.fixed + steps_ahead * self.fixed_tick < self.fixed_limit
    }

    /// What so many steps like the last would add for surfaces and ropes (m).
    pub fn fixed_ahead(&self, steps: f64) -> f64 {
        steps * self.fixed_tick
    }

    /// Sets the limits anew: pairs may still come closer by `pairs_left`, others by `fixed_left` (m).
    pub fn extend(&mut self, pairs_left: f64, fixed_left: f64) {
        self.pairs_limit = self.pairs + pairs_left;
        self.fixed_limit = self.fixed + fixed_left;
    }

    /// Time since the start (s).
    pub fn elapsed(&self) -> f64 {
        self.elapsed
    }
}
