//! Leapfrog integration of grains and barrier nodes.
//!
//! v(t+½) = v(t−½) + Δt (F/m + g), x(t+Δt) = x(t) + Δt v(t+½), L(t+½) = L(t−½) + Δt T. The axis of a free
//! axisymmetric body turns about its angular momentum at the rate |L|/I_t exactly, so free rotation keeps
//! both momentum and energy to rounding.

use crate::dem::contact::lanes::{LANES, Lane, Quads};
use crate::dem::contact::law::{add_scaled, cross, dot, scaled};
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
    /// Moves all grains through one step, with the widest vectors this processor has.
    pub fn advance(self, time: &Stretch) -> Pace {
        #[cfg(target_arch = "x86_64")]
        {
            if std::arch::is_x86_feature_detected!("avx512f") && std::arch::is_x86_feature_detected!("avx512vl") {
                // SAFETY: the processor was just asked for these features.
                return unsafe { self.advance_avx512(time) };
            }
            if std::arch::is_x86_feature_detected!("avx2") {
                // SAFETY: as above.
                return unsafe { self.advance_avx2(time) };
            }
        }
        self.advance_rows(time)
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512vl")]
    fn advance_avx512(self, time: &Stretch) -> Pace {
        self.advance_rows(time)
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn advance_avx2(self, time: &Stretch) -> Pace {
        self.advance_rows(time)
    }

    #[inline(always)]
    fn advance_rows(self, time: &Stretch) -> Pace {
        if self.axis.is_empty() { self.advance_spheres(time) } else { self.advance_clumps(time) }
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
    fn advance_clumps(self, time: &Stretch) -> Pace {
        let step = Steps::of(time);
        let mut fastest = Fastest::default();
        let rows = self.place.iter_mut().zip(self.motion).zip(self.loads.iter().zip(self.drift));
        for ((place, motion), (load, drift)) in rows {
            step.translate(place, motion, &load.force);
            fastest.see(motion, drift);
        }
        let mut turning = Turning::default();
        let rows = self.spin.chunks_mut(LANES).zip(self.axis.chunks_mut(LANES)).zip(self.momentum.chunks_mut(LANES));
        for (((spin, axis), momentum), loads) in rows.zip(self.loads.chunks_mut(LANES)) {
            turning.gather(axis, momentum, loads);
            turning.advance(time.step, step.keep[0]);
            turning.scatter(spin, axis, momentum);
            fastest.turning = spin
                .iter()
                .zip(&turning.rate)
                .fold(fastest.turning, |most, (spin, rate)| larger_or_nan(most, rate * spin.fourth() * spin.fourth()));
        }
        fastest.total += fastest.turning;
        fastest.pace()
    }
}

/// Clumps that turn, side by side.
#[derive(Default)]
struct Turning {
    axis: Quads,
    momentum: Quads,
    torque: Quads,
    spin: Quads,
    /// Square of the rate at which each axis turns (1/s²).
    rate: Lane,
}

impl Turning {
    /// Takes the rows in and sets the loads to zero. Lanes left over keep what they had: it goes nowhere.
    #[inline(always)]
    fn gather(&mut self, axis: &[Quad], momentum: &[Quad], loads: &mut [GrainLoad]) {
        self.axis.rows[..axis.len()].copy_from_slice(axis);
        self.momentum.rows[..momentum.len()].copy_from_slice(momentum);
        for (torque, load) in self.torque.rows.iter_mut().zip(loads) {
            *torque = load.torque;
            *load = GrainLoad::default();
        }
        [&mut self.axis, &mut self.momentum, &mut self.torque].into_iter().for_each(Quads::turn_to_columns);
    }

    #[inline(always)]
    fn advance(&mut self, step: f64, keep: f64) {
        for lane in 0..LANES {
            let momentum = scaled(add_scaled(self.momentum.vector(lane), step, self.torque.vector(lane)), keep);
            let inverse_transverse = self.axis.fourth(lane);
            let (axis, rate) = turned(self.axis.vector(lane), momentum, step, inverse_transverse);
            let difference = self.momentum.fourth(lane);
            let spin = add_scaled(scaled(momentum, inverse_transverse), dot(axis, momentum) * difference, axis);
            self.axis.put(lane, axis, inverse_transverse);
            self.momentum.put(lane, momentum, difference);
            self.spin.put(lane, spin, 0.0);
            self.rate[lane] = rate;
        }
        [&mut self.axis, &mut self.momentum, &mut self.spin].into_iter().for_each(Quads::turn_to_rows);
    }

    #[inline(always)]
    fn scatter(&self, spin: &mut [Quad], axis: &mut [Quad], momentum: &mut [Quad]) {
        axis.copy_from_slice(&self.axis.rows[..axis.len()]);
        momentum.copy_from_slice(&self.momentum.rows[..momentum.len()]);
        for (spin, new) in spin.iter_mut().zip(&self.spin.rows) {
            let [x, y, z, _] = new.0;
            *spin = Quad([x, y, z, spin.fourth()]);
        }
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
fn turned(axis: [f64; 3], momentum: [f64; 3], step: f64, inverse_transverse: f64) -> ([f64; 3], f64) {
    let half = scaled(momentum, 0.5 * step * inverse_transverse);
    let square = dot(half, half);
    let series = 1.0 + square * (1.0 / 3.0 + square * (2.0 / 15.0 + square * (17.0 / 315.0)));
    let line = scaled(half, series);
    let across = cross(line, add_scaled(axis, 1.0, cross(line, axis)));
    let turned = add_scaled(axis, 2.0 / (1.0 + dot(line, line)), across);
    (scaled(turned, 1.5 - 0.5 * dot(turned, turned)), 4.0 * square / (step * step))
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
