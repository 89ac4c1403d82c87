//! How high and how far a deposit stands behind the barrier, and how many surges fill it.

/// Height normal to the bed of a deposit whose surface is level, for a volume per width V on a bed of slope α behind a
/// barrier that leans upstream by θ from the bed's normal: V = ½ H² (cot α + tan θ).
/// A level surface is the highest a deposit can have at the barrier; on a level bed it is 0.
pub fn level_deposit_height(volume_per_width: f64, slope: f64, lean: f64) -> f64 {
    let spread = slope.tan().recip() + lean.tan();
    if spread > 0.0 { (2.0 * volume_per_width / spread).sqrt() } else { f64::INFINITY }
}

/// What a barrier can hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Retention {
    /// Plumb height of the filled barrier h' (m).
    pub filled_height: f64,
    /// Slope of the deposit's surface θ' (rad).
    pub deposit_slope: f64,
    /// Volume held V (m³).
    pub volume: f64,
    /// Length of the deposit, level (m).
    pub length: f64,
    /// Volume held over that of the design flow: surges until it is full.
    pub surges: f64,
}

/// V = b h'²/(2 (tan θ − tan θ')) and length h'/(tan θ − tan θ') for a plumb barrier in a prismatic channel of width b and
/// slope θ. Derived; the shares of height and slope are the designer's.
pub fn retention(width: f64, slope: f64, filled_height: f64, deposit_slope: f64, flow_volume: f64) -> Retention {
    let difference = slope.tan() - deposit_slope.tan();
    let length = filled_height / difference;
    let volume = 0.5 * width * filled_height * length;
    Retention { filled_height, deposit_slope, volume, length, surges: volume / flow_volume }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_level_deposit_fills_the_triangle_behind_the_barrier() {
        let height = level_deposit_height(10.0, 0.5, 0.3);
        assert_relative_eq!(0.5 * height * height * (1.0 / 0.5_f64.tan() + 0.3_f64.tan()), 10.0, max_relative = 1e-12);
        assert_eq!(level_deposit_height(10.0, 0.0, 0.0), 0.0);
    }

    #[test]
    fn matches_the_derived_volume() {
        // H_b 5 m filled to 3/4, θ 20°, θ' 13.33°, b 12 m: 664.5 m³ over 29.5 m.
        let held = retention(12.0, 20_f64.to_radians(), 3.75, 13.333_f64.to_radians(), 332.25);
        assert_relative_eq!(held.volume, 664.5, max_relative = 1e-3);
        assert_relative_eq!(held.length, 29.5, max_relative = 2e-3);
        assert_relative_eq!(held.surges, 2.0, max_relative = 1e-3);
    }
}
