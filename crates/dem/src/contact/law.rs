//! The one contact law: linear spring with a non-adhesive dashpot, and Coulomb friction.
//!
//! Normal force   F_n = max(0, k u + γ u̇),  γ = 2 ζ √(k m_r), ζ from the restitution and the step
//! Tangential     F_t ← rotate(F_t) + k_t Δs, |F_t| ≤ μ F_n,  k_t = k × the tangential ratio (2/7), corrected for the step
//!
//! with u the overlap (m), u̇ its rate, m_r the reduced mass of the two bodies, Δs the slip of this step while in contact.
//!
//! Places are those at the end of a step, velocities those of its middle. Rate and slip are therefore told with the normal of the middle:
//! with the one at the end a grain that rolls round another would slip a little more in every step, always the same way, until its
//! friction spring held it fast where it should fall off (Vyas, Ottino, Lueptow & Umbanhowar 2025).
//! Source: Albaba 2015, section 3.3.1, with the signs, the reduced mass and the frame rotation corrected.
//! Written for any [`Real`]: for one contact, or for eight side by side in vector registers.

use serde::{Deserialize, Serialize};

use crate::contact::material::Material;
use crate::contact::restitution::{StepCorrection, begins_beyond, damping_ratio_for, first_weight};
use crate::simd::eight::{joined, parted};
use crate::simd::quad::Quad;
use crate::simd::real::{Real, Triple, add_scaled, cross, dot, scaled};

/// Where and how two bodies touch: what geometry hands to the law. The second body is "the other one".
#[derive(Clone, Copy, Debug)]
pub struct ContactPoint<R = f64> {
    /// Unit normal from the first body to the other.
    pub normal: Triple<R>,
    /// The same half a step before, when the bodies moved with `velocity`.
    pub middle: Triple<R>,
    /// Overlap u (m); without contact it is negative or zero, and the law answers with nothing.
    pub overlap: R,
    /// Velocity of the other body's surface relative to the first's, at the contact, half a step before (m/s).
    pub velocity: Triple<R>,
    /// Mean spin of the two bodies about the normal (rad/s); it turns the stored friction force.
    pub twist: R,
    pub spring: Spring<R>,
    /// Friction coefficient μ of the pair; less than tan φ where pore pressure carries part of the load.
    pub friction: R,
}

/// Stiffness (N/m) of the contact of two bodies with E₁ r₁ and E₂ r₂ (N/m): k = 2 E₁ r₁ E₂ r₂/(E₁ r₁ + E₂ r₂). Spheres and cylinders
/// of any two materials (Albaba 2015, Eqs 3.2, 4.10, 4.16).
pub fn contact_stiffness(first: f64, second: f64) -> f64 {
    2.0 * first * second / (first + second)
}

/// The normal spring of a contact, with what would otherwise cost divisions again and again.
#[derive(Clone, Copy, Debug)]
pub struct Spring<R = f64> {
    /// k (N/m).
    pub stiffness: R,
    /// 1/k (m/N).
    pub compliance: R,
    /// ω0 = √(k/m_r) (1/s).
    pub frequency: R,
    /// √(k m_r) (N s/m).
    pub impedance: R,
}

impl<R: Real> Spring<R> {
    /// A spring of stiffness k (N/m) between bodies with 1/m_1 + 1/m_2 = `inverse_mass` (1/kg).
    #[inline(always)]
    pub fn new(stiffness: R, inverse_mass: R) -> Self {
        let frequency = (stiffness * inverse_mass).root();
        Self { stiffness, compliance: R::all(1.0) / stiffness, frequency, impedance: frequency / inverse_mass }
    }

    /// The spring of a body with E r (N/m) on what does not move, which takes part as an equal body of infinite mass: k = E r.
    #[inline(always)]
    pub fn on_fixed(side: R, inverse_mass: R) -> Self {
        Self::new(side, inverse_mass)
    }

    /// The given part of a contact that others share: spring and dashpot alike.
    pub fn part(self, share: R) -> Self {
        Self {
            stiffness: self.stiffness * share,
            compliance: self.compliance / share,
            frequency: self.frequency,
            impedance: self.impedance * share,
        }
    }
}

impl Spring {
    /// The spring of two bodies with E₁ r₁ and E₂ r₂ (N/m).
    #[inline(always)]
    pub fn between(sides: [f64; 2], inverse_mass: f64) -> Self {
        Self::new(contact_stiffness(sides[0], sides[1]), inverse_mass)
    }

    /// Normal force (N) with an overlap (m) and what the dashpot adds to the spring's (N): as [`respond`] has it, for what is shown.
    pub fn pushes(&self, overlap: f64, dashpot: f64) -> f64 {
        (self.stiffness * overlap + dashpot).max(0.0)
    }
}

/// What a contact remembers from step to step; all zero without contact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Memory<R = f64> {
    /// Force of the friction spring on the first body (N).
    pub tangential: Triple<R>,
    /// What the last normal force had beyond the spring's (N), for the energy account.
    pub dashpot: R,
}

impl Memory {
    #[inline(always)]
    pub fn quad(&self) -> Quad {
        Quad(joined(self.tangential, self.dashpot))
    }

    #[inline(always)]
    pub fn from_quad(quad: Quad) -> Self {
        let (tangential, dashpot) = parted(quad.0);
        Self { tangential, dashpot }
    }
}

/// Constants shared by all contacts of a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LawConstants {
    /// Damping ratio ζ for short steps.
    pub damping_ratio: f64,
    /// What it needs in steps of finite length.
    pub correction: StepCorrection,
    /// How many times its overlap the way of a step must be for the first force of a contact to be weighted.
    pub begins_beyond: f64,
    /// k_t/k for short steps.
    pub tangential_ratio: f64,
    /// Time step (s).
    pub time_step: f64,
}

impl LawConstants {
    pub fn of(material: &Material, time_step: f64) -> Self {
        let Material { restitution, tangential_ratio, .. } = *material;
        Self {
            damping_ratio: damping_ratio_for(restitution),
            correction: StepCorrection::of(restitution),
            begins_beyond: begins_beyond(restitution),
            tangential_ratio,
            time_step,
        }
    }

    /// The law in each of the substeps of a step.
    pub fn of_substep(self, substeps: u32) -> Self {
        Self { time_step: self.time_step / f64::from(substeps), ..self }
    }

    /// γ of a contact (N s/m).
    #[inline(always)]
    pub fn damping<R: Real>(&self, spring: &Spring<R>) -> R {
        let x = spring.frequency * self.time_step;
        let corrected = (x * (x * self.correction.quadratic + self.correction.linear) + 1.0) * self.damping_ratio;
        corrected * 2.0 * spring.impedance
    }

    /// Stiffness of the friction spring over k. A dashpot taken from the last half step acts like a smaller mass, m_r (1 − ζ ω₀ Δt),
    /// and the contact is over sooner; a friction spring that is as much stiffer, k_t/(1 − ζ ω₀ Δt), turns the bodies as it should all
    /// the same. It is made twice as stiff at most, which strong damping (ε of 0.1) needs at two thirds of the stable step.
    #[inline(always)]
    pub fn friction_spring<R: Real>(&self, spring: &Spring<R>) -> FrictionSpring<R> {
        let lighter =
            (spring.frequency * (-self.damping_ratio * self.time_step) + 1.0).or_larger(R::all(LEAST_LIGHTER));
        FrictionSpring { ratio: self.tangential_ratio, lighter }
    }
}

/// Stiffness of a friction spring over that of its contact, as a quotient.
#[derive(Clone, Copy, Debug)]
pub struct FrictionSpring<R = f64> {
    /// k_t/k for short steps.
    ratio: f64,
    /// 1 − ζ ω₀ Δt, or [`LEAST_LIGHTER`] if that is more.
    lighter: R,
}

impl FrictionSpring {
    /// k_t/k in steps of finite length.
    pub fn stiffness_ratio(&self) -> f64 {
        self.ratio / self.lighter
    }
}

/// The law's answer.
#[derive(Clone, Copy, Debug)]
pub struct Response<R = f64> {
    /// Force on the first body (N), mean over the step; the other gets the opposite.
    pub force: Triple<R>,
    /// Magnitude of its normal part (N).
    pub normal_force: R,
    pub memory: Memory<R>,
    /// Elastic energy stored now (J).
    pub stored: R,
    /// Energy lost in the dashpot in this step (J).
    pub lost_damping: R,
    /// Energy lost by slip in this step (J).
    pub lost_friction: R,
}

/// Lower bound on the effective share of the mass, 1 − ζ ω₀ Δt.
const LEAST_LIGHTER: f64 = 0.5;
/// What keeps a quotient a number where there is no contact.
const SMALLEST: f64 = 1e-100;

/// Force of one contact for one step, or of several side by side.
///
/// A contact begins somewhere within a step, a part of the step before its first force. That force is weighted by the time it stands for
/// ([`first_weight`]; not where there is next to no dashpot, [`begins_beyond`]), and its friction spring is drawn out for the part of the
/// step in contact. Without this a damped impact in coarse steps depends on where in a step it begins.
///
/// Energy is accounted by the trapezoidal rule over the step just made, which is the leapfrog integrator's discrete work but for
/// terms that swing with the contact and do not add up: dashpot ½(D_old + D_new) u̇ Δt, slip = work done minus change of stored energy.
/// In the step in which a contact begins or ends, the trapezoid of the spring is not its energy: a force that stands at one end
/// only works along the part of the way without contact too. The difference, ½k u v with u the overlap at the one end and v the gap at the
/// other, goes to the dashpot's account, lost where the contact begins and gained where it ends; without it each impact would leave
/// (Δt ω₀)²/6 · (1 − ε²) of its energy unaccounted. What a friction spring still holds when its contact parts counts as lost by slip.
#[inline(always)]
pub fn respond<R: Real>(point: &ContactPoint<R>, memory: &Memory<R>, constants: &LawConstants) -> Response<R> {
    let n = point.normal;
    let step = constants.time_step;
    let zero = R::all(0.0);
    let overlap = zero.or_larger(point.overlap);
    let stiffness = point.overlap.if_above(zero, point.spring.stiffness, zero);
    let separation_rate = dot(point.velocity, point.middle);

    // A contact that began within this step has lasted for a part of it only: its overlap over the way of the step.
    let way = (separation_rate * -step).or_larger(overlap).or_larger(R::all(SMALLEST));
    let FrictionSpring { ratio, lighter } = constants.friction_spring(&point.spring);
    let quotient = R::all(1.0) / (way * lighter);
    let part = overlap * lighter * quotient;
    let weight = way.if_above(overlap * constants.begins_beyond, first_weight(part, lighter), R::all(1.0));

    let spring = stiffness * point.overlap;
    let damping = point.overlap.if_above(zero, constants.damping(&point.spring), zero);
    let at_once = zero.or_larger(spring - damping * separation_rate);
    let normal_force = at_once * weight;
    let dashpot = normal_force - spring;
    let passed = zero.or_larger(-(point.overlap * (point.overlap + separation_rate * step)));
    let half_touching = point.overlap.if_above(zero, passed, -passed);
    let lost_damping =
        (half_touching * point.spring.stiffness - (memory.dashpot + dashpot) * separation_rate * step) * 0.5;

    let old = carried(memory.tangential, n, point.twist * step);
    let slip = flat(add_scaled(point.velocity, -separation_rate, point.middle), n);
    let trial = add_scaled(old, stiffness * overlap * quotient * (ratio * step), slip);
    let trial_squared = dot(trial, trial);
    let limit = point.friction * at_once;
    let cap = limit / trial_squared.root();
    let scale = trial_squared.if_above(limit * limit, cap, R::all(1.0));
    let tangential = scaled(trial, scale);

    let now_squared = trial_squared * scale * scale;
    // Half of what the weight adds works in the next step, with about the same slip.
    let work = (dot(old, slip) + dot(tangential, slip) * (weight * 2.0 - R::all(1.0))) * (0.5 * step);
    let half_compliance = point.spring.compliance * lighter * (0.5 / ratio);
    let change = (now_squared - dot(old, old)) * half_compliance;
    Response {
        force: add_scaled(scaled(tangential, weight), -normal_force, n),
        normal_force,
        memory: Memory { tangential, dashpot },
        stored: spring * point.overlap * 0.5 + now_squared * half_compliance,
        lost_damping,
        lost_friction: work - change,
    }
}

/// The stored tangential force carried into the present contact frame: turned about the normal by `angle`,
/// laid into the tangent plane, its magnitude kept. The frame turns little in a step, so two terms of the series of
/// 1/√(1 − x) restore the magnitude, x being the share of the square that the new plane has cut off.
#[inline(always)]
fn carried<R: Real>(force: Triple<R>, n: Triple<R>, angle: R) -> Triple<R> {
    let turned = flat(add_scaled(force, angle, cross(n, force)), n);
    let before = dot(force, force);
    let cut = (before - dot(turned, turned)) / before.or_larger(R::all(f64::MIN_POSITIVE));
    scaled(turned, cut * (cut * 0.375 + 0.5) + 1.0)
}

/// What of a vector lies in the plane of a unit normal.
#[inline(always)]
fn flat<R: Real>(vector: Triple<R>, n: Triple<R>) -> Triple<R> {
    add_scaled(vector, -dot(vector, n), n)
}

/// The normal of a contact half a step before: `normal` less what it has turned since. `motion` is the velocity of the other body's centre
/// relative to the first's, as far as the line between them turns with it (m/s), `half_over_distance` half a step over their distance (s/m).
#[inline(always)]
pub fn normal_before<R: Real>(normal: Triple<R>, motion: Triple<R>, half_over_distance: R) -> Triple<R> {
    add_scaled(normal, -half_over_distance, flat(motion, normal))
}
