//! The one contact law: linear spring with a dashpot that never pulls, and Coulomb friction.
//!
//! Normal force   F_n = max(0, k u + γ u̇),  γ = 2 ζ √(k m_r), ζ from the restitution and the step
//! Tangential     F_t ← rotate(F_t) + k_t Δs, |F_t| ≤ μ F_n,  k_t = (2/7) k
//!
//! with u the overlap (m), u̇ its rate, m_r the reduced mass of the two bodies, Δs the slip of this step.
//! Source: Albaba 2015, section 3.3.1, with the signs, the reduced mass and the frame rotation corrected.
//! Written without branches so that a loop over contacts becomes vector instructions.

use crate::dem::contact::restitution::{StepCorrection, damping_ratio_for};
use crate::dem::tables::grain_table::Quad;

/// Where and how two bodies touch: what geometry hands to the law. The second body is "the other one".
#[derive(Clone, Copy, Debug)]
pub struct ContactPoint {
    /// Unit normal from the first body to the other.
    pub normal: [f64; 3],
    /// Overlap u (m); without contact it is negative or zero, and the law answers with nothing.
    pub overlap: f64,
    /// Velocity of the other body's surface relative to the first's, at the contact (m/s).
    pub velocity: [f64; 3],
    /// Mean spin of the two bodies about the normal (rad/s); it turns the stored friction force.
    pub twist: f64,
    pub spring: Spring,
    /// Friction coefficient μ, the smaller of the pair.
    pub friction: f64,
}

/// The normal spring of a contact, with what would otherwise cost divisions again and again.
#[derive(Clone, Copy, Debug)]
pub struct Spring {
    /// k (N/m).
    pub stiffness: f64,
    /// 1/k (m/N).
    pub compliance: f64,
    /// ω0 = √(k/m_r) (1/s).
    pub frequency: f64,
    /// √(k m_r) (N s/m).
    pub impedance: f64,
}

impl Spring {
    /// A spring of stiffness k (N/m) between bodies with 1/m_1 + 1/m_2 = `inverse_mass` (1/kg).
    pub fn new(stiffness: f64, inverse_mass: f64) -> Self {
        let frequency = (stiffness * inverse_mass).sqrt();
        Self { stiffness, compliance: 1.0 / stiffness, frequency, impedance: frequency / inverse_mass }
    }
}

/// What a contact remembers from step to step; all zero without contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(32))]
pub struct Memory {
    /// Tangential force on the first body (N).
    pub tangential: [f64; 3],
    /// Dashpot part of the last normal force (N), for the energy account.
    pub dashpot: f64,
}

impl Memory {
    #[inline(always)]
    pub fn quad(&self) -> Quad {
        let [x, y, z] = self.tangential;
        Quad([x, y, z, self.dashpot])
    }

    #[inline(always)]
    pub fn from_quad(quad: Quad) -> Self {
        let [x, y, z, dashpot] = quad.0;
        Self { tangential: [x, y, z], dashpot }
    }
}

/// Constants shared by all contacts of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LawConstants {
    /// Damping ratio ζ for short steps.
    pub damping_ratio: f64,
    /// What it needs in steps of finite length.
    pub correction: StepCorrection,
    /// k_t / k_n.
    pub tangential_ratio: f64,
    /// ½ k_n / k_t.
    pub half_tangential_compliance: f64,
    /// Time step (s).
    pub time_step: f64,
}

impl LawConstants {
    pub fn new(restitution: f64, tangential_ratio: f64, time_step: f64) -> Self {
        Self {
            damping_ratio: damping_ratio_for(restitution),
            correction: StepCorrection::of(restitution),
            tangential_ratio,
            half_tangential_compliance: 0.5 / tangential_ratio,
            time_step,
        }
    }

    /// γ of a contact (N s/m).
    #[inline(always)]
    pub fn damping(&self, spring: &Spring) -> f64 {
        let x = spring.frequency * self.time_step;
        let corrected = self.damping_ratio * (1.0 + x * (self.correction.linear + x * self.correction.quadratic));
        2.0 * corrected * spring.impedance
    }
}

/// The law's answer.
#[derive(Clone, Copy, Debug)]
pub struct Response {
    /// Force on the first body (N); the other gets the opposite.
    pub force: [f64; 3],
    /// Magnitude of the normal force (N).
    pub normal_force: f64,
    pub memory: Memory,
    /// Elastic energy stored now (J).
    pub stored: f64,
    /// Energy lost in the dashpot in this step (J).
    pub lost_damping: f64,
    /// Energy lost by slip in this step (J).
    pub lost_friction: f64,
}

#[inline(always)]
pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
pub fn add_scaled(a: [f64; 3], factor: f64, b: [f64; 3]) -> [f64; 3] {
    [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]]
}

#[inline(always)]
pub fn scaled(a: [f64; 3], factor: f64) -> [f64; 3] {
    [a[0] * factor, a[1] * factor, a[2] * factor]
}

#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Force of one contact for one step.
///
/// Energy is accounted by the trapezoidal rule over the step just made, which equals the discrete work of
/// the leapfrog integrator: dashpot ½(D_old + D_new) u̇ Δt, slip = work done minus change of stored energy. What a
/// friction spring still holds when its contact parts counts as lost by slip.
#[inline(always)]
pub fn respond(point: &ContactPoint, memory: &Memory, constants: &LawConstants) -> Response {
    let n = point.normal;
    let step = constants.time_step;
    let on = if point.overlap > 0.0 { 1.0 } else { 0.0 };
    let stiffness = on * point.spring.stiffness;
    let separation_rate = dot(point.velocity, n);
    let spring = stiffness * point.overlap;
    let damping = on * constants.damping(&point.spring);
    let normal_force = larger(0.0, spring - damping * separation_rate);
    let dashpot = normal_force - spring;
    let lost_damping = -0.5 * (memory.dashpot + dashpot) * separation_rate * step;

    let old = carried(memory.tangential, n, point.twist * step);
    let slip = add_scaled(point.velocity, -separation_rate, n);
    let trial = add_scaled(old, constants.tangential_ratio * stiffness * step, slip);
    let trial_squared = dot(trial, trial);
    let limit = point.friction * normal_force;
    let scale = if trial_squared > limit * limit { limit / trial_squared.sqrt() } else { 1.0 };
    let tangential = [trial[0] * scale, trial[1] * scale, trial[2] * scale];

    let now_squared = trial_squared * scale * scale;
    let work = 0.5 * step * (dot(old, slip) + dot(tangential, slip));
    let half_compliance = constants.half_tangential_compliance * point.spring.compliance;
    let change = (now_squared - dot(old, old)) * half_compliance;
    Response {
        force: add_scaled(tangential, -normal_force, n),
        normal_force,
        memory: Memory { tangential, dashpot },
        stored: 0.5 * spring * point.overlap + now_squared * half_compliance,
        lost_damping,
        lost_friction: work - change,
    }
}

/// The stored tangential force carried into the present contact frame: turned about the normal by `angle`,
/// laid into the tangent plane, its magnitude kept. The frame turns little in a step, so two terms of the series of
/// 1/√(1 − x) restore the magnitude, x being the share of the square that the new plane has cut off.
#[inline(always)]
fn carried(force: [f64; 3], n: [f64; 3], angle: f64) -> [f64; 3] {
    let turned = add_scaled(force, angle, cross(n, force));
    let flat = add_scaled(turned, -dot(turned, n), n);
    let before = dot(force, force);
    let cut = (before - dot(flat, flat)) / larger(before, f64::MIN_POSITIVE);
    let scale = 1.0 + cut * (0.5 + 0.375 * cut);
    [flat[0] * scale, flat[1] * scale, flat[2] * scale]
}
