//! Leapfrog integration of grains and barrier nodes.
//!
//! v(t+½) = v(t−½) + Δt (F/m + g), x(t+Δt) = x(t) + Δt v(t+½), L(t+½) = L(t−½) + Δt T. The axis of a free
//! axisymmetric body turns about its angular momentum at the rate |L|/I_t exactly, so free rotation keeps
//! both momentum and energy to rounding.

use crate::dem::simd::eight::{Eight, LANES, Row, each_lane, joined, parted};
use crate::dem::simd::real::{Real, Triple, add_scaled, cross, dot, plus, scaled};
use crate::dem::simd::widest::{Work, with_widest};
use crate::dem::tables::barrier::Node;
use crate::dem::tables::grain_table::{GrainLoad, Quad};
use crate::dem::{Vec3, larger_or_nan};

/// The stretch of time a step covers, with what acts on all grains alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// s
    pub step: f64,
    /// Viscous slowing (1/s); zero but in preparation.
    pub drag: f64,
    /// m/s²
    pub gravity: Vec3,
}

/// The rows of one block of grains, to be moved; `axis` and `momentum` are empty for spheres.
pub struct MovingRows<'a> {
    pub place: &'a mut [Quad],
    pub motion: &'a mut [Quad],
    pub spin: &'a mut [Quad],
    pub axis: &'a mut [Quad],
    pub momentum: &'a mut [Quad],
    /// Set to zero when used.
    pub loads: &'a mut [GrainLoad],
    /// Drift of the flow at each grain (m/s).
    pub drift: &'a [Drifting],
}

/// A drift velocity (m/s); the last entry is unused.
pub type Drifting = [f32; 4];

/// Upper bounds on how fast the grains of a block go (m/s).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pace {
    /// Of any member's motion relative to its drift; infinite if anything is not finite.
    pub stray: f64,
}

impl MovingRows<'_> {
    /// Moves all grains through one step.
    pub fn advance(self, time: &Stretch) -> Pace {
        with_widest(Advance { rows: self, time })
    }

    #[inline(always)]
    fn advance_spheres(self, time: &Stretch) -> Pace {
        let step = Steps::of(time);
        let mut fastest = Fastest::default();
        let rows = self.place.iter_mut().zip(self.motion).zip(self.spin).zip(self.loads).zip(self.drift);
        for ((((place, motion), spin), load), drift) in rows {
            step.translate(place, motion, &load.force);
            let inverse_inertia = spin.fourth();
            for entry in 0..4 {
                spin.0[entry] += load.torque.0[entry] * inverse_inertia * step.time[entry];
                spin.0[entry] *= step.keep[entry];
            }
            *load = GrainLoad::default();
            fastest.see(motion, drift);
        }
        fastest.pace()
    }

    #[inline(always)]
    fn advance_clumps<E: Eight>(self, time: &Stretch) -> Pace {
        let step = Steps::of(time);
        let mut fastest = Fastest::default();
        let rows = self.place.iter_mut().zip(self.motion).zip(self.loads.iter().zip(self.drift));
        for ((place, motion), (load, drift)) in rows {
            step.translate(place, motion, &load.force);
            fastest.see(motion, drift);
        }
        let mut rates = E::all(0.0);
        let mut eights = Turning { spin: self.spin, axis: self.axis, momentum: self.momentum, loads: self.loads };
        while !eights.spin.is_empty() {
            rates = eights.turn_eight::<E>(time.step, step.keep[0]).or_larger(rates);
        }
        fastest.turning = rates.lanes().into_iter().fold(0.0, larger_or_nan);
        fastest.total += fastest.turning;
        fastest.pace()
    }
}

/// The rows of a block, to be moved with any vectors.
struct Advance<'a, 'b> {
    rows: MovingRows<'a>,
    time: &'b Stretch,
}

impl Work for Advance<'_, '_> {
    type Output = Pace;

    #[inline(always)]
    fn run<E: Eight>(self) -> Pace {
        if self.rows.axis.is_empty() {
            self.rows.advance_spheres(self.time)
        } else {
            self.rows.advance_clumps::<E>(self.time)
        }
    }
}

/// Clumps that are still to be turned in this step.
struct Turning<'a> {
    spin: &'a mut [Quad],
    axis: &'a mut [Quad],
    momentum: &'a mut [Quad],
    loads: &'a mut [GrainLoad],
}

impl Turning<'_> {
    /// Turns the next eight clumps, or as many as there are, and sets their loads to zero. Returns the squares of the speeds
    /// of their members about the centres (m²/s²).
    #[inline(always)]
    fn turn_eight<E: Eight>(&mut self, step: f64, keep: f64) -> E {
        let last = self.spin.len().min(LANES) - 1;
        let axes = each_lane!(|lane| E::Row::load(&self.axis[lane.min(last)]));
        let momenta = each_lane!(|lane| E::Row::load(&self.momentum[lane.min(last)]));
        let torques = each_lane!(|lane| E::Row::load(&self.loads[lane.min(last)].torque));
        let spins = each_lane!(|lane| E::Row::load(&self.spin[lane.min(last)]));
        let (axis, inverse_transverse) = parted(E::columns(axes));
        let (momentum, difference) = parted(E::columns(momenta));
        let (torque, _) = parted(E::columns(torques));
        let [_, _, _, arm] = E::columns(spins);
        let momentum = scaled(add_scaled(momentum, E::all(step), torque), E::all(keep));
        let (axis, rate) = turned(axis, momentum, step, inverse_transverse);
        let spin = add_scaled(scaled(momentum, inverse_transverse), dot(axis, momentum) * difference, axis);
        let axes = E::rows(joined(axis, inverse_transverse));
        let momenta = E::rows(joined(momentum, difference));
        let spins = E::rows(joined(spin, arm));
        each_lane!(|lane| {
            if lane <= last {
                axes[lane].store(&mut self.axis[lane]);
                momenta[lane].store(&mut self.momentum[lane]);
                spins[lane].store(&mut self.spin[lane]);
                self.loads[lane] = GrainLoad::default();
            }
        });
        for rows in [&mut self.spin, &mut self.axis, &mut self.momentum] {
            let all = std::mem::take(rows);
            *rows = &mut all[last + 1..];
        }
        self.loads = &mut std::mem::take(&mut self.loads)[last + 1..];
        rate * arm * arm
    }
}

/// Factors for rows of four that leave the fourth entry alone.
struct Steps {
    time: [f64; 4],
    keep: [f64; 4],
    gravity: [f64; 4],
}

impl Steps {
    fn of(time: &Stretch) -> Self {
        let keep = (1.0 - time.drag * time.step).max(0.0);
        let (t, g) = (time.step, time.gravity);
        Self { time: [t, t, t, 0.0], keep: [keep, keep, keep, 1.0], gravity: [g.x, g.y, g.z, 0.0] }
    }

    #[inline(always)]
    fn translate(&self, place: &mut Quad, motion: &mut Quad, force: &Quad) {
        let inverse_mass = motion.fourth();
        for entry in 0..4 {
            let gained = (force.0[entry] * inverse_mass + self.gravity[entry]) * self.time[entry];
            motion.0[entry] = (motion.0[entry] + gained) * self.keep[entry];
            place.0[entry] += motion.0[entry] * self.time[entry];
        }
    }
}

/// Largest squares met so far.
#[derive(Default)]
struct Fastest {
    stray: f64,
    turning: f64,
    total: f64,
}

impl Fastest {
    #[inline(always)]
    fn see(&mut self, motion: &Quad, drift: &Drifting) {
        let mut square = 0.0;
        for (velocity, drift) in motion.0.iter().zip(drift).take(3) {
            let off = velocity - f64::from(*drift);
            square += off * off;
        }
        self.stray = if square > self.stray { square } else { self.stray };
        self.total += square;
    }

    fn pace(&self) -> Pace {
        let stray = self.stray.sqrt() + self.turning.sqrt();
        Pace { stray: if self.total < f64::INFINITY { stray } else { f64::INFINITY } }
    }
}

/// The axis turned about the angular momentum L by the angle |L| Δt/I_t, and the square of the rate (1/s²).
///
/// With h = L tan(x)/|L|, x half the angle, the turned axis is a + 2 h × (a + h × a)/(1 + h²). The tangent comes from its
/// series up to x⁷: the angle of one step is small, the result keeps the length for any argument, and it is the same on
/// every machine, which the system's library does not promise.
#[inline(always)]
fn turned<R: Real>(axis: Triple<R>, momentum: Triple<R>, step: f64, inverse_transverse: R) -> (Triple<R>, R) {
    let half = scaled(momentum, inverse_transverse * (0.5 * step));
    let square = dot(half, half);
    let series = square * (square * (square * (17.0 / 315.0) + 2.0 / 15.0) + 1.0 / 3.0) + 1.0;
    let line = scaled(half, series);
    let across = cross(line, plus(axis, cross(line, axis)));
    let turned = add_scaled(axis, R::all(2.0) / (dot(line, line) + 1.0), across);
    (scaled(turned, dot(turned, turned) * -0.5 + 1.5), square * (4.0 / (step * step)))
}

/// Moves the nodes of a barrier through one step; returns the square of the largest speed (m²/s²).
pub fn move_nodes(nodes: &mut [Node], forces: &[Vec3], gravity: &Vec3, step: f64) -> f64 {
    let mut fastest = 0.0;
    for (node, force) in nodes.iter_mut().zip(forces) {
        if node.fixed {
            continue;
        }
        node.velocity += (force / node.mass + gravity) * step;
        node.position += node.velocity * step;
        fastest = larger_or_nan(fastest, node.velocity.norm_squared());
    }
    fastest
}
