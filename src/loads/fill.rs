//! How high and how far a deposit stands behind the barrier, and how many surges fill it.

use crate::section::Section;

/// Height normal to the bed, at the barrier, of a deposit of a volume per width V whose plane surface falls upstream at an angle
/// ψ below the horizontal, on a bed of slope α behind a barrier that leans upstream by θ from the bed's normal:
/// V = ½ H² (cot(α + ψ) + tan θ). ψ = 0 is the level surface of a fluid; a granular flow that is stopped while it runs up leaves a
/// heap against the barrier, and ψ may be as much as its angle of repose. Infinite where surface and barrier do not meet the bed in a
/// triangle.
/// In a section the triangle's ½ H² per width is the first moment S(H) of its area, over its mean width.
pub fn deposit_height(volume: &Spread, slope: f64, falls: f64, lean: f64) -> f64 {
    let spread = libm::tan(slope + falls).recip() + libm::tan(lean);
    if spread > 0.0 && slope + falls < std::f64::consts::FRAC_PI_2 + lean {
        volume.height(spread)
    } else {
        f64::INFINITY
    }
}

/// A volume in a channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Spread {
    /// Volume over the width of a rectangle, or over the mean width of another section (m²).
    pub per_width: f64,
    /// m
    pub width: f64,
    pub section: Section,
}

impl Spread {
    /// H of the first moment V/spread (m).
    fn height(&self, spread: f64) -> f64 {
        match &self.section {
            Section::Rectangle { .. } => (2.0 * self.per_width / spread).sqrt(),
            section @ Section::Surveyed(_) => section.height_of_moment(self.per_width * self.width / spread),
        }
    }
}

/// A deposit with a plane surface behind a barrier in a prismatic channel; lengths in m, angles in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deposit {
    pub width: f64,
    /// Of the bed, θ.
    pub slope: f64,
    /// By which the barrier leans upstream from the bed's normal.
    pub lean: f64,
    /// At the barrier, normal to the bed, H.
    pub height: f64,
    /// Slope of its surface, θ'.
    pub surface: f64,
}

/// What a barrier can hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Retention {
    pub deposit: Deposit,
    /// Volume held V (m³).
    pub volume: f64,
    /// Length of the deposit, level (m).
    pub length: f64,
    /// Volume held over that of one surge, the design flow: surges until it is full.
    pub surges: f64,
}

impl Deposit {
    /// V = ½ b H² (cot(θ − θ') + tan lean); for a plumb barrier b h'²/(2 (tan θ − tan θ')) with h' = H/cos θ. Derived.
    /// In a section V = S(H) (cot(θ − θ') + tan lean).
    pub fn retention(self, section: &Section, flow_volume: f64) -> Retention {
        let spread = libm::tan(self.slope - self.surface).recip() + libm::tan(self.lean);
        let base = self.height * spread;
        let volume = match section {
            Section::Rectangle { .. } => 0.5 * self.width * self.height * base,
            Section::Surveyed(_) => section.moment(self.height) * spread,
        };
        Retention { deposit: self, volume, length: base * libm::cos(self.slope), surges: volume / flow_volume }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Of a rectangle of any width.
    fn even(per_width: f64) -> Spread {
        Spread { per_width, width: 3.0, section: Section::Rectangle { width: 3.0 } }
    }

    #[test]
    fn a_level_deposit_fills_the_triangle_behind_the_barrier() {
        let height = deposit_height(&even(10.0), 0.5, 0.0, 0.3);
        assert_relative_eq!(
            0.5 * height * height * (1.0 / libm::tan(0.5_f64) + libm::tan(0.3_f64)),
            10.0,
            max_relative = 1e-12
        );
        assert_eq!(deposit_height(&even(10.0), 0.0, 0.0, 0.0), 0.0);
    }

    #[test]
    fn a_heap_at_the_angle_of_repose_stands_higher_than_a_level_deposit() {
        // A triangle of 12.5 m² on a level bed with a surface at 45°: 5 m by 5 m.
        assert_relative_eq!(
            deposit_height(&even(12.5), 0.0, std::f64::consts::FRAC_PI_4, 0.0),
            5.0,
            max_relative = 1e-12
        );
        let slope = 5_f64.to_radians();
        let [level, heap] = [0.0, 35_f64.to_radians()].map(|falls| deposit_height(&even(12.5), slope, falls, 0.0));
        assert_relative_eq!(level, 1.479, max_relative = 1e-3);
        assert_relative_eq!(heap, 4.580, max_relative = 1e-3);
        // Too steep to end at the bed.
        assert_eq!(deposit_height(&even(1.0), 1.0, 1.0, 0.0), f64::INFINITY);
    }

    #[test]
    fn matches_the_derived_volume() {
        // Plumb, H_b 5 m filled to 3/4, θ 20°, θ' 13.33°, b 12 m: 664.5 m³ over 29.5 m.
        let slope = 20_f64.to_radians();
        let shape = Deposit {
            width: 12.0,
            slope,
            lean: slope,
            height: 3.75 * libm::cos(slope),
            surface: 13.333_f64.to_radians(),
        };
        let held = shape.retention(&Section::Rectangle { width: 12.0 }, 332.25);
        assert_relative_eq!(held.volume, 664.5, max_relative = 1e-3);
        assert_relative_eq!(held.length, 29.5, max_relative = 2e-3);
        assert_relative_eq!(held.surges, 2.0, max_relative = 1e-3);
    }

    /// A surface that falls by 60° and a bed of 20° meet behind a face that leans by 30°, not behind one that leans downstream by 15°.
    #[test]
    fn a_heap_needs_a_face_that_leans_less_than_its_surface_is_steep() {
        let height =
            |lean: f64| deposit_height(&even(2.0), 20_f64.to_radians(), 60_f64.to_radians(), lean.to_radians());
        let by_hand = (4.0 / (1.0 / 5.671_282 + 0.577_350_f64)).sqrt();
        assert_relative_eq!(height(30.0), by_hand, max_relative = 1e-6);
        assert_eq!(height(-15.0), f64::INFINITY);
        // Beyond the plumb of the bed's normal the surface overhangs.
        let steep = deposit_height(&even(2.0), 40_f64.to_radians(), 60_f64.to_radians(), 20_f64.to_radians());
        assert_relative_eq!(steep, (4.0 / (-0.176_327 + 0.363_970_f64)).sqrt(), max_relative = 1e-5);
        assert_eq!(
            deposit_height(&even(2.0), 40_f64.to_radians(), 60_f64.to_radians(), 5_f64.to_radians()),
            f64::INFINITY
        );
    }
}
