//! Leapfrog integration of grains and barrier nodes.
//!
//! v(t+½) = v(t−½) + Δt (F/m + g), x(t+Δt) = x(t) + Δt v(t+½), L(t+½) = L(t−½) + Δt T. The axis of a free
//! axisymmetric body turns about its angular momentum at the rate |L|/I_t exactly, so free rotation keeps
//! both momentum and energy to rounding.

use nalgebra::{Quaternion, UnitQuaternion};

use crate::simd::eight::{Eight, LANES, Row, each_lane, joined, parted};
use crate::simd::quad::Quad;
use crate::simd::real::{Real, Triple, add_scaled, cross, dot, plus, scaled};
use crate::simd::widest::{Work, with_widest};
use crate::tables::grain_rows::Prefetcher;
use crate::tables::grain_table::GrainLoad;
use crate::tables::moving_rows::MovingRows;
use crate::tables::nodes::{Frame, Node};
use crate::tables::prefetch::prefetch_to_write;
use crate::{Vec3, larger_or_nan};

/// The stretch of time a step covers, with what acts on all grains alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepInterval {
    /// s
    pub step: f64,
    /// Viscous slowing (1/s); zero but in preparation.
    pub drag: f64,
    /// m/s²
    pub gravity: Vec3,
}

/// Upper bounds on how fast the grains of a block go (m/s).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pace {
    /// Of any member's motion relative to its drift; infinite if anything is not finite.
    pub stray: f64,
}

impl MovingRows<'_> {
    /// Moves all grains through one step. Meanwhile goes on with `prefetcher`.
    pub fn advance(self, time: &StepInterval, prefetcher: &mut Prefetcher) -> Pace {
        with_widest(Advance { rows: self, time, prefetcher })
    }

    /// Parts the first `count` grains from the rest.
    #[inline(always)]
    fn split(self, count: usize) -> (Self, Self) {
        let clumps = count.min(self.axis.len());
        let (place, motion, spin) =
            (self.place.split_at_mut(count), self.motion.split_at_mut(count), self.spin.split_at_mut(count));
        let (axis, momentum) = (self.axis.split_at_mut(clumps), self.momentum.split_at_mut(clumps));
        let (loads, drift) = (self.loads.split_at_mut(count), self.drift.split_at(count));
        let half = |place, motion, spin, axis, momentum, loads, drift| MovingRows {
            place,
            motion,
            spin,
            axis,
            momentum,
            loads,
            drift,
        };
        (
            half(place.0, motion.0, spin.0, axis.0, momentum.0, loads.0, drift.0),
            half(place.1, motion.1, spin.1, axis.1, momentum.1, loads.1, drift.1),
        )
    }
}

/// The rows of a block, to be moved with any vectors.
struct Advance<'a, 'b, 'c> {
    rows: MovingRows<'a>,
    time: &'b StepInterval,
    prefetcher: &'b mut Prefetcher<'c>,
}

impl Work for Advance<'_, '_, '_> {
    type Output = Pace;

    #[inline(always)]
    fn run<E: Eight>(self) -> Pace {
        let steps = Steps::of(self.time);
        let mut fastest = Fastest::<E>::default();
        let mut rest = self.rows;
        while !rest.place.is_empty() {
            let count = LANES.min(rest.place.len());
            let (eight, others) = rest.split(count);
            rest = others;
            self.prefetcher.go_on();
            let mut eight = UpToEight(eight);
            fastest.see_strays(eight.translate(&steps));
            if eight.0.axis.is_empty() {
                eight.turn_spheres::<E::Row>(&steps);
            } else {
                fastest.see_turning(eight.turn_clumps(&steps));
            }
            eight.0.loads.fill(GrainLoad::default());
        }
        fastest.pace()
    }
}

/// Eight grains, or fewer.
struct UpToEight<'a>(MovingRows<'a>);

impl UpToEight<'_> {
    /// Moves the centres. Returns the squares of the velocities relative to the drift (m²/s²).
    #[inline(always)]
    fn translate<E: Eight>(&mut self, steps: &Steps) -> E {
        let Self(rows) = self;
        let [time, keep, gravity] = [&steps.time, &steps.keep, &steps.gravity].map(E::Row::load);
        let count = rows.place.len();
        let escaped = each_lane!(|lane| {
            if lane < count {
                let (place, motion) = (&mut rows.place[lane], &mut rows.motion[lane]);
                let inverse_mass = E::Row::all(motion.fourth());
                let gained = (E::Row::load(&rows.loads[lane].force) * inverse_mass + gravity) * time;
                let velocity = (E::Row::load(motion) + gained) * keep;
                velocity.store(motion);
                (E::Row::load(place) + velocity * time).store(place);
                velocity - E::Row::widened(&rows.drift[lane])
            } else {
                E::Row::all(0.0)
            }
        });
        let (stray, _) = parted(E::columns(escaped));
        dot(stray, stray)
    }

    #[inline(always)]
    fn turn_spheres<R: Row>(&mut self, steps: &Steps) {
        let Self(rows) = self;
        let [time, keep] = [&steps.time, &steps.keep].map(R::load);
        for (spin, load) in rows.spin.iter_mut().zip(&*rows.loads) {
            let inverse_inertia = R::all(spin.fourth());
            ((R::load(spin) + R::load(&load.torque) * inverse_inertia * time) * keep).store(spin);
        }
    }

    /// Returns the squares of the speeds of the members about the centres (m²/s²).
    #[inline(always)]
    fn turn_clumps<E: Eight>(&mut self, steps: &Steps) -> E {
        let Self(rows) = self;
        let last = rows.place.len() - 1;
        let axes = each_lane!(|lane| E::Row::load(&rows.axis[lane.min(last)]));
        let momenta = each_lane!(|lane| E::Row::load(&rows.momentum[lane.min(last)]));
        let torques = each_lane!(|lane| E::Row::load(&rows.loads[lane.min(last)].torque));
        let spins = each_lane!(|lane| E::Row::load(&rows.spin[lane.min(last)]));
        let (axis, inverse_transverse) = parted(E::columns(axes));
        let (momentum, difference) = parted(E::columns(momenta));
        let (torque, _) = parted(E::columns(torques));
        let [_, _, _, arm] = E::columns(spins);
        let (step, keep) = (steps.time.0[0], steps.keep.0[0]);
        let momentum = scaled(add_scaled(momentum, E::all(step), torque), E::all(keep));
        let before = axis;
        let (axis, rate) = turned(before, momentum, step, inverse_transverse);
        // Of the middle of the step, as the momentum is: about the axis half-way.
        let about = dot(axis, momentum) * difference * 0.5;
        let spin = add_scaled(scaled(momentum, inverse_transverse), about, plus(before, axis));
        let axes = E::rows(joined(axis, inverse_transverse));
        let momenta = E::rows(joined(momentum, difference));
        let spins = E::rows(joined(spin, arm));
        each_lane!(|lane| {
            if lane <= last {
                axes[lane].store(&mut rows.axis[lane]);
                momenta[lane].store(&mut rows.momentum[lane]);
                spins[lane].store(&mut rows.spin[lane]);
            }
        });
        rate * arm * arm
    }
}

/// Factors for rows of four that leave the fourth entry alone.
struct Steps {
    time: Quad,
    keep: Quad,
    gravity: Quad,
}

impl Steps {
    fn of(time: &StepInterval) -> Self {
        let keep = (1.0 - time.drag * time.step).max(0.0);
        Self {
            time: Quad(joined([time.step; 3], 0.0)),
            keep: Quad(joined([keep; 3], 1.0)),
            gravity: Quad::new(&time.gravity, 0.0),
        }
    }
}

/// Largest squares met so far, and the sum of all, which keeps what is not a number.
#[derive(Default)]
struct Fastest<E> {
    stray: E,
    turning: E,
    total: E,
}

impl<E: Eight> Fastest<E> {
    #[inline(always)]
    fn see_strays(&mut self, squares: E) {
        self.stray = squares.or_larger(self.stray);
        self.total = self.total + squares;
    }

    #[inline(always)]
    fn see_turning(&mut self, squares: E) {
        self.turning = squares.or_larger(self.turning);
        self.total = self.total + squares;
    }

    #[inline(always)]
    fn pace(&self) -> Pace {
        let most = |squares: E| squares.lanes().into_iter().fold(0.0, larger_or_nan).sqrt();
        let finite = self.total.lanes().iter().sum::<f64>() < f64::INFINITY;
        Pace { stray: if finite { most(self.stray) + most(self.turning) } else { f64::INFINITY } }
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

/// Turns axes, unit vectors, for a while (s) at the given spins.
pub fn turn_axes(axes: &mut [Quad], spins: &[Quad], time: f64) {
    for (axis, spin) in axes.iter_mut().zip(spins) {
        let turned = small_turn(&(spin.vector() * time)) * axis.vector();
        axis.set_vector(&(turned * (1.5 - 0.5 * turned.norm_squared())));
    }
}

/// How many nodes ahead their rows are asked for: other threads have read them since they were moved last.
const NODES_AHEAD: usize = 16;

/// Moves the nodes of a barrier through one step.
pub fn move_nodes(nodes: &mut [Node], forces: &[Vec3], gravity: &Vec3, step: f64) {
    for number in 0..nodes.len() {
        if let Some(next) = nodes.get(number + NODES_AHEAD) {
            prefetch_to_write(&next.velocity);
        }
        let (node, force) = (&mut nodes[number], &forces[number]);
        if !node.fixed {
            node.velocity += (force / node.mass + gravity) * step;
            node.position += node.velocity * step;
        }
    }
}

/// Turns the nodes of a barrier through one step.
pub fn turn_frames(frames: &mut [Frame], torques: &[Vec3], step: f64) {
    for (frame, torque) in frames.iter_mut().zip(torques).filter(|(frame, _)| !frame.held) {
        frame.spin += torque * (step / frame.inertia);
        frame.orientation = small_turn(&(frame.spin * step)) * frame.orientation;
        frame.orientation.renormalize_fast();
    }
}

/// The turn about and by a small vector φ (rad): (φ sin(φ/2)/φ, cos(φ/2)) by their series up to φ⁴, which are the same on every
/// machine.
pub fn small_turn(by: &Vec3) -> UnitQuaternion<f64> {
    let square = by.norm_squared();
    let sine = 0.5 - square * (1.0 / 48.0 - square / 3840.0);
    let cosine = 1.0 - square * (0.125 - square / 384.0);
    UnitQuaternion::new_unchecked(Quaternion::from_parts(cosine, by * sine))
}
