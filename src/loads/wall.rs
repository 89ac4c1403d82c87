//! A wall that stands by its weight on a base of slope β, per metre of width: sliding along the base and overturning about its
//! downstream edge, under a load R along a bed of slope α.
//!
//! Its weight W = ρ g t H presses N = W cos β on the base and pulls T = W sin β down it. Its face leans upstream by θ from the bed's
//! normal; the flow pushes normal to the face, R along the bed and R tan θ off it. With δ = α − β that is R (cos δ + tan θ sin δ)
//! along the base, and a lift L = R (tan θ cos δ − sin δ) off it where that is positive; where it is negative it presses the wall down,
//! which is left out. Sliding: R (cos δ + tan θ sin δ) + T ≤ (N − L) tan φ. Overturning: M_R + L b + T H/2 ≤ N (b − t/2), with b the
//! width of the base from the wall's upstream face and M_R the moment of the load about the upstream end of the base. The weight of the
//! flow and its friction on the wall are left out, which is on the safe side.

/// A gravity wall, SI; it stands upright on its base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallInput {
    /// Along the wall (m): its height normal to the bed over cos(α − β).
    pub height: f64,
    pub thickness: f64,
    pub base_width: f64,
    pub density: f64,
    pub base_friction: f64,
    /// Of the base, and of the bed along which the load acts (rad).
    pub base_slope: f64,
    pub bed_slope: f64,
    /// Of the face, upstream from the bed's normal (rad).
    pub face_lean: f64,
}

impl WallInput {
    /// N/m
    pub fn weight(&self) -> f64 {
        self.density * crate::units::GRAVITY * self.thickness * self.height
    }

    fn difference(&self) -> f64 {
        self.bed_slope - self.base_slope
    }

    /// Demand on sliding over the load R along the bed: its part along the base, and what its lift takes of the friction.
    pub fn sliding_share(&self) -> f64 {
        let (sine, cosine) = libm::sincos(self.difference());
        cosine + libm::tan(self.face_lean) * sine + self.base_friction * self.lift_share()
    }

    /// Lift off the base over the load R along the bed.
    pub fn lift_share(&self) -> f64 {
        let (sine, cosine) = libm::sincos(self.difference());
        (libm::tan(self.face_lean) * cosine - sine).max(0.0)
    }

    /// Demand on sliding of a force on the wall (N/m), along the bed and normal to it, likewise.
    pub fn sliding_demand(&self, along: f64, off: f64) -> f64 {
        let (sine, cosine) = libm::sincos(self.difference());
        along * cosine + off * sine + self.base_friction * self.lift(along, off)
    }

    /// Lift off the base of that force (N/m).
    pub fn lift(&self, along: f64, off: f64) -> f64 {
        let (sine, cosine) = libm::sincos(self.difference());
        let lift = off * cosine - along * sine;
        // Asked so that what is not a number stays so.
        if lift <= 0.0 { 0.0 } else { lift }
    }

    /// Force per width that friction can hold beyond the wall's own pull down the slope, without partial factor on it (N/m):
    /// N tan φ, and T.
    pub fn sliding(&self) -> [f64; 2] {
        [self.weight() * libm::cos(self.base_slope) * self.base_friction, self.weight() * libm::sin(self.base_slope)]
    }

    /// Moments about the downstream edge (N m/m): what holds, and what the wall's own pull adds to the load.
    pub fn overturning(&self) -> [f64; 2] {
        let arm = self.base_width - 0.5 * self.thickness;
        [
            self.weight() * libm::cos(self.base_slope) * arm,
            self.weight() * libm::sin(self.base_slope) * 0.5 * self.height,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_block_on_level_ground_slides_at_w_tan_phi_and_tips_at_half_its_thickness() {
        let wall = WallInput {
            height: 2.0,
            thickness: 1.0,
            base_width: 1.0,
            density: 2400.0,
            base_friction: 0.5,
            base_slope: 0.0,
            bed_slope: 0.0,
            face_lean: 0.0,
        };
        assert_relative_eq!(wall.weight(), 2400.0 * 9.81 * 2.0, max_relative = 1e-4);
        assert_eq!(wall.sliding(), [0.5 * wall.weight(), 0.0]);
        assert_eq!(wall.overturning(), [0.5 * wall.weight(), 0.0]);
    }

    #[test]
    fn a_block_on_its_friction_angle_holds_nothing_more() {
        let slope = 0.4_f64;
        let wall = WallInput {
            height: 2.0,
            thickness: 1.0,
            base_width: 1.0,
            density: 2400.0,
            base_friction: libm::tan(slope),
            base_slope: slope,
            bed_slope: slope,
            face_lean: 0.0,
        };
        let [hold, pull] = wall.sliding();
        assert_relative_eq!(hold, pull, max_relative = 1e-12);
    }

    #[test]
    fn a_plumb_face_is_pushed_level_and_an_overhanging_one_is_lifted() {
        let wall = |face_lean: f64| WallInput {
            height: 2.0,
            thickness: 1.0,
            base_width: 1.0,
            density: 2400.0,
            base_friction: 0.7,
            base_slope: 0.0,
            bed_slope: 0.7,
            face_lean,
        };
        // Plumb on a level base: a force R along the bed is R / cos α, level, and lifts nothing.
        let plumb = wall(0.7);
        assert_relative_eq!(plumb.sliding_share(), 1.0 / libm::cos(0.7_f64), max_relative = 1e-12);
        assert!(plumb.lift_share() < 1e-12);
        let force = [libm::cos(0.7_f64), libm::sin(0.7_f64)];
        assert_relative_eq!(plumb.sliding_demand(force[0], force[1]), 1.0, max_relative = 1e-12);
        // Normal to the bed it is pressed down.
        assert_relative_eq!(wall(0.0).sliding_share(), libm::cos(0.7_f64), max_relative = 1e-12);
        let over = wall(1.0);
        assert!(over.lift_share() > 0.0 && over.sliding_share() > plumb.sliding_share());
        assert!(plumb.lift(f64::NAN, 1.0).is_nan());
    }
}
