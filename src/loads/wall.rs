//! A wall that stands by its weight on a base of slope β, per metre of width: sliding along the base and overturning about its
//! downstream edge, under a load R along a bed of slope α.
//!
//! Its weight W = ρ g t H presses N = W cos β on the base and pulls T = W sin β down it. Sliding: R cos(α − β) + T ≤ N tan φ.
//! Overturning: M_R + T H/2 ≤ N (b − t/2), with b the width of the base from the wall's upstream face and M_R the moment of
//! the load about the upstream end of the base: no less than about the downstream edge. That R also presses the wall down, the weight of the flow and its friction on the wall are left
//! out, which is on the safe side.

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
}

impl WallInput {
    /// N/m
    pub fn weight(&self) -> f64 {
        self.density * crate::units::GRAVITY * self.thickness * self.height
    }

    /// Share of the load that acts along the base, cos(α − β).
    pub fn load_share(&self) -> f64 {
        (self.bed_slope - self.base_slope).cos()
    }

    /// Force per width that friction can hold beyond the wall's own pull down the slope, without partial factor on it (N/m):
    /// N tan φ, and T.
    pub fn sliding(&self) -> [f64; 2] {
        [self.weight() * self.base_slope.cos() * self.base_friction, self.weight() * self.base_slope.sin()]
    }

    /// Moments about the downstream edge (N m/m): what holds, and what the wall's own pull adds to the load.
    pub fn overturning(&self) -> [f64; 2] {
        let arm = self.base_width - 0.5 * self.thickness;
        [self.weight() * self.base_slope.cos() * arm, self.weight() * self.base_slope.sin() * 0.5 * self.height]
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
            base_friction: slope.tan(),
            base_slope: slope,
            bed_slope: slope,
        };
        let [hold, pull] = wall.sliding();
        assert_relative_eq!(hold, pull, max_relative = 1e-12);
    }
}
