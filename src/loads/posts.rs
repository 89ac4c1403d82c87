//! A post under what its head carries: equilibrium of the head, and the post as a beam under what presses on it.
//!
//! The head is loaded by R normal to the net and Q along the rope. Two ropes with the directions u₁ and u₂ to their anchors and the post,
//! which pushes along its axis s, hold it: T₁ u₁ + T₂ u₂ + N s + R n + Q y = 0. A single rope lies in the plane of the post and of R, and
//! Q is left to the rope over the head. The foot turns freely, so that the post takes no moment there.

use nalgebra::{Matrix3, Vector3};

use crate::larger::larger_or_nan;

/// A post with its ropes, in the frame of the channel: x down the bed, y to the left bank, z out of the bed (m).
#[derive(Clone, Debug, PartialEq)]
pub struct PostInput {
    /// Of the post along the barrier's plane.
    pub length: f64,
    /// By which it leans upstream from the bed's normal (rad).
    pub lean: f64,
    /// Anchors of its ropes, from its foot: one or two.
    pub anchors: Vec<[f64; 3]>,
}

/// What holds the head of a post in equilibrium (N).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HeadState {
    /// Tension of the rope that bears most.
    pub tension: f64,
    /// Compression of the post.
    pub compression: f64,
    /// Share of the pull along the main rope that the retaining ropes hold before one of them goes slack.
    pub along: f64,
}

impl HeadState {
    /// Of a head that nothing holds in equilibrium.
    const UNKNOWN: Self = Self { tension: f64::NAN, compression: f64::NAN, along: f64::NAN };
}

impl PostInput {
    fn axis(&self) -> Vector3<f64> {
        let (sine, cosine) = libm::sincos(self.lean);
        Vector3::new(-sine, 0.0, cosine)
    }

    /// Out of the net, downstream.
    fn normal(&self) -> Vector3<f64> {
        let (sine, cosine) = libm::sincos(self.lean);
        Vector3::new(cosine, 0.0, sine)
    }

    /// From the head to an anchor (m).
    fn rope(&self, anchor: &[f64; 3]) -> Vector3<f64> {
        Vector3::from(*anchor) - self.axis() * self.length
    }

    fn direction(&self, anchor: &[f64; 3]) -> Vector3<f64> {
        self.rope(anchor).normalize()
    }

    /// Length of each retaining rope (m), and how steeply it falls from the head to its anchor against the level, on a bed of this slope (rad).
    pub fn ropes(&self, slope: f64) -> Vec<[f64; 2]> {
        let (sine, cosine) = libm::sincos(slope);
        let of = |anchor: &[f64; 3]| {
            let rope = self.rope(anchor);
            [rope.norm(), -libm::asin((rope.z * cosine - rope.x * sine) / rope.norm())]
        };
        self.anchors.iter().map(of).collect()
    }

    /// The head under a load normal to the net and up to so much along the rope, to either side (N). Not a number where nothing is in
    /// equilibrium.
    pub fn under(&self, load: f64, along: f64) -> HeadState {
        match self.anchors[..] {
            [one] => self.by_one_rope(load, &one),
            [one, other] => [along, -along]
                .map(|along| self.by_two_ropes(load, along, [&one, &other]))
                .into_iter()
                .reduce(|a, b| HeadState {
                    tension: larger_or_nan(a.tension, b.tension),
                    compression: larger_or_nan(a.compression, b.compression),
                    along: -larger_or_nan(-a.along, -b.along),
                })
                .unwrap_or_default(),
            _ => HeadState::UNKNOWN,
        }
    }

    fn by_one_rope(&self, load: f64, anchor: &[f64; 3]) -> HeadState {
        let (rope, axis, normal) = (self.direction(anchor), self.axis(), self.normal());
        // Normal to the net: T u·n + R = 0; along the post: T u·s + N = 0.
        let tension = -load / rope.dot(&normal);
        let held = tension >= 0.0;
        let state = HeadState { tension, compression: -tension * rope.dot(&axis), along: 0.0 };
        if held { state } else { HeadState::UNKNOWN }
    }

    /// The pull along the rope is limited to what makes one of the retaining ropes go slack.
    fn by_two_ropes(&self, load: f64, along: f64, anchors: [&[f64; 3]; 2]) -> HeadState {
        let [one, other] = anchors.map(|anchor| self.direction(anchor));
        let solve = |load: f64, along: f64| {
            let matrix = Matrix3::from_columns(&[one, other, self.axis()]);
            matrix.lu().solve(&-(self.normal() * load + Vector3::y() * along))
        };
        let (Some(by_load), Some(by_along)) = (solve(load, 0.0), solve(0.0, along)) else {
            return HeadState::UNKNOWN;
        };
        // The share of the pull along the rope at which one of the ropes goes slack.
        let slackens = |rope: usize| if by_along[rope] < 0.0 { -by_load[rope] / by_along[rope] } else { f64::INFINITY };
        let share = slackens(0).min(slackens(1)).clamp(0.0, 1.0);
        let sum = by_load + by_along * share;
        let held = by_load[0] >= 0.0 && by_load[1] >= 0.0;
        match held {
            true => HeadState { tension: larger_or_nan(sum[0], sum[1]), compression: sum[2], along: share },
            false => HeadState::UNKNOWN,
        }
    }
}

/// Slices of a post over which what presses on it is summed.
const SLICES: usize = 50;

/// A post as a beam between its foot and its head.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BeamState {
    /// Reactions at head and foot (N), and the largest moment between them (N m).
    pub head: f64,
    pub foot: f64,
    pub moment: f64,
}

/// A beam of a length (m) on which so much presses at a distance from its foot (N/m).
pub fn beam(length: f64, pressing: impl Fn(f64) -> f64) -> BeamState {
    let slice = length / SLICES as f64;
    let place = |number: usize| (number as f64 + 0.5) * slice;
    let forces: Vec<f64> = (0..SLICES).map(|number| pressing(place(number)) * slice).collect();
    let total: f64 = forces.iter().sum();
    let head = forces.iter().enumerate().map(|(number, force)| force * place(number)).sum::<f64>() / length;
    let foot = total - head;
    let (mut shear, mut moment, mut most, mut before) = (foot, 0.0, 0.0_f64, 0.0);
    for (number, force) in forces.iter().enumerate() {
        moment += shear * (place(number) - before);
        most = larger_or_nan(most, moment);
        (shear, before) = (shear - force, place(number));
    }
    BeamState { head, foot, moment: most }
}

/// A strut of steel, hinged at both ends: lengths in m, stresses in Pa.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    pub length: f64,
    pub area: f64,
    pub modulus: f64,
    /// √(I/A) about the weaker axis.
    pub radius_of_gyration: f64,
    /// Elastic section modulus W in the direction of bending (m³).
    pub section_modulus: f64,
    pub yield_strength: f64,
    /// α of its buckling curve.
    pub imperfection: f64,
}

/// Design resistances of a post: to compression (N), to bending (N m), and the load at which an ideal one buckles (N).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strut {
    pub compression: f64,
    pub bending: f64,
    pub critical: f64,
}

impl Column {
    /// Load at which an ideal strut buckles, N_cr = π² E I/L² (Euler; N).
    pub fn critical(&self) -> f64 {
        let bending = self.modulus * self.area * self.radius_of_gyration.powi(2);
        (std::f64::consts::PI / self.length).powi(2) * bending
    }

    /// Resistances over a partial factor, with χ = 1/(Φ + √(Φ² − λ²)), Φ = ½ (1 + α (λ − 0.2) + λ²), λ = √(A f_y/N_cr) (EN 1993-1-1, 6.3.1).
    pub fn strut(&self, factor: f64) -> Strut {
        let squash = self.area * self.yield_strength;
        let slender = (squash / self.critical()).sqrt();
        let bow = 0.5 * (1.0 + self.imperfection * (slender - 0.2) + slender * slender);
        let share = if slender <= 0.2 { 1.0 } else { (bow + (bow * bow - slender * slender).sqrt()).recip().min(1.0) };
        Strut {
            compression: share * squash / factor,
            bending: self.section_modulus * self.yield_strength / factor,
            critical: self.critical(),
        }
    }
}

impl Strut {
    /// Compression that uses up as much of the post as a compression with a moment does (N): N + k N_b M/M_R with k = 1/(1 − N/N_cr), by which
    /// the compression makes the moment larger (linear interaction in the manner of EN 1993-1-1, 6.3.3; M_R is that with lateral-torsional buckling).
    pub fn with_moment(&self, compression: f64, moment: f64) -> f64 {
        let grows = (1.0 - compression.max(0.0) / self.critical).recip();
        // Asked so that what is not a number stays so.
        if grows < 0.0 || grows == f64::INFINITY {
            return f64::INFINITY;
        }
        compression + grows * self.compression * moment / self.bending
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Plumb to a level bed, 3 m high; one anchor 4 m upstream: the rope falls 3 on 5 m, T = R 5/4 and N = R 3/4.
    #[test]
    fn one_rope_holds_a_post_as_the_triangle_says() {
        let post = PostInput { length: 3.0, lean: 0.0, anchors: vec![[-4.0, 0.0, 0.0]] };
        let state = post.under(80e3, 30e3);
        assert_relative_eq!(state.tension, 100e3, max_relative = 1e-12);
        assert_relative_eq!(state.compression, 60e3, max_relative = 1e-12);
    }

    /// 5 m long, and 3 m down on a level bed; on one of 30° the anchor 4 m up the bed is 2 m higher and the head 3 cos 30° over the foot.
    #[test]
    fn a_rope_is_as_long_and_steep_as_its_triangle() {
        let post = PostInput { length: 3.0, lean: 0.0, anchors: vec![[-4.0, 0.0, 0.0]] };
        let [[length, falls]] = post.ropes(0.0)[..] else { panic!("a rope") };
        assert_relative_eq!(length, 5.0, max_relative = 1e-12);
        assert_relative_eq!(libm::sin(falls), 0.6, max_relative = 1e-12);
        let [[_, falls]] = post.ropes(std::f64::consts::FRAC_PI_6)[..] else { panic!("a rope") };
        assert_relative_eq!(libm::sin(falls), (3.0 * 0.75_f64.sqrt() - 2.0) / 5.0, max_relative = 1e-12);
    }

    /// Two ropes of √(4² + 2² + 3²) = √29 m: 2 T · 4/√29 = R, N = 2 T · 3/√29; Q = 20 kN goes to one of them, ΔT · 2/√29 = Q/2.
    #[test]
    fn two_ropes_share_a_load_and_hold_it_sideways() {
        let post = PostInput { length: 3.0, lean: 0.0, anchors: vec![[-4.0, 2.0, 0.0], [-4.0, -2.0, 0.0]] };
        let root = 29_f64.sqrt();
        let straight = post.under(80e3, 0.0);
        assert_relative_eq!(straight.tension, 10e3 * root, max_relative = 1e-12);
        assert_relative_eq!(straight.compression, 60e3, max_relative = 1e-12);
        let aslant = post.under(80e3, 20e3);
        assert_relative_eq!(aslant.tension, 10e3 * root + 5e3 * root, max_relative = 1e-12);
        // With 40 kN one of them is slack, and more cannot act.
        assert_relative_eq!(post.under(80e3, 100e3).tension, 20e3 * root, max_relative = 1e-9);
    }

    /// By hand, a post that leans upstream by 20°, its anchor level with its foot 5 m upstream: normal to the net T (u·n) = −R.
    #[test]
    fn a_post_that_leans_is_pressed_more() {
        let (sine, cosine) = libm::sincos(20_f64.to_radians());
        let post = PostInput { length: 3.0, lean: 20_f64.to_radians(), anchors: vec![[-5.0, 0.0, 0.0]] };
        let state = post.under(100e3, 0.0);
        let (x, z) = (-5.0 + 3.0 * sine, -3.0 * cosine);
        let way = libm::hypot(x, z);
        // Balance in x and in z.
        assert_relative_eq!(state.tension * x / way - state.compression * sine + 100e3 * cosine, 0.0, epsilon = 1e-6);
        assert_relative_eq!(state.tension * z / way + state.compression * cosine + 100e3 * sine, 0.0, epsilon = 1e-6);
    }

    #[test]
    fn what_is_in_no_equilibrium_is_not_a_number() {
        let post = PostInput { length: 3.0, lean: 0.0, anchors: vec![[4.0, 0.0, 0.0]] };
        assert!(post.under(80e3, 0.0).tension.is_nan());
    }

    /// A pipe of 168.3 × 8 mm, 4 m long: A 40.3 cm², i 56.7 mm, W 154 cm³, S355, curve c. By hand: λ₁ = 93.9 ε = 76.4, λ = 4000/56.7/76.4 =
    /// 0.923, Φ = ½ (1 + 0.49 · 0.723 + 0.852) = 1.103, χ = 1/(1.103 + √(1.103² − 0.852)) = 0.586, N_b = 0.586 · 1430.7/1.1 = 762 kN.
    #[test]
    fn a_pipe_buckles_as_the_code_says() {
        let pipe = Column {
            length: 4.0,
            area: 40.3e-4,
            modulus: 210e9,
            radius_of_gyration: 56.7e-3,
            section_modulus: 154e-6,
            yield_strength: 355e6,
            imperfection: 0.49,
        };
        let strut = pipe.strut(1.1);
        assert_relative_eq!(strut.compression, 762e3, max_relative = 3e-3);
        assert_relative_eq!(strut.bending, 49.7e3, max_relative = 1e-3);
        assert_eq!(strut.with_moment(100e3, 0.0), 100e3);
        // Half of each: a moment of half its resistance, grown by 1/(1 − 381/1680).
        let critical = 9.869_604 * 210e9 * 40.3e-4 * 56.7e-3_f64.powi(2) / 16.0;
        assert_relative_eq!(strut.critical, critical, max_relative = 1e-6);
        let both = strut.with_moment(0.5 * strut.compression, 0.5 * strut.bending) / strut.compression;
        assert_relative_eq!(both, 0.5 + 0.5 / (1.0 - 381e3 / critical), max_relative = 3e-3);
        assert_eq!(strut.with_moment(1.01 * critical, 1.0), f64::INFINITY);
        assert!(strut.with_moment(f64::NAN, 1.0).is_nan() && strut.with_moment(1.0, f64::NAN).is_nan());
        // A short one is squashed.
        assert_relative_eq!(
            Column { length: 0.5, ..pipe }.strut(1.0).compression,
            40.3e-4 * 355e6,
            max_relative = 1e-12
        );
    }

    /// An even load of 10 kN/m on 4 m: reactions of 20 kN, q L²/8 = 20 kN m; a triangle with its top at the head: q L/3 there, q L²/(9 √3).
    #[test]
    fn a_beam_has_the_moments_of_the_tables() {
        let even = beam(4.0, |_| 10e3);
        assert_relative_eq!(even.head, 20e3, max_relative = 1e-9);
        assert_relative_eq!(even.moment, 20e3, max_relative = 1e-3);
        let rising = beam(4.0, |place| 10e3 * place / 4.0);
        assert_relative_eq!(rising.head, 40e3 / 3.0, max_relative = 1e-3);
        assert_relative_eq!(rising.moment, 160e3 / (9.0 * 3_f64.sqrt()), max_relative = 1e-2);
    }
}
