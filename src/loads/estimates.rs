//! What a flow may be like when only its volume is known: peak discharge, velocity, depth.
//!
//! Empirical, scattered by a factor of two and more, and from memory: shown as estimates, never used in a check.

use crate::section::Section;

/// One estimate of a discharge (m³/s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    pub name: &'static str,
    pub formula: &'static str,
    pub value: f64,
}

/// Peak discharge for a volume V (m³).
pub fn peak_discharge(volume: f64) -> [Estimate; 3] {
    let estimate =
        |name, formula, factor: f64, exponent| Estimate { name, formula, value: factor * libm::pow(volume, exponent) };
    [
        estimate("Rickenmann 1999", "Q = 0.1 V^0.833", 0.1, 0.833),
        estimate("Mizuyama 1992, granular", "Q = 0.135 V^0.78", 0.135, 0.78),
        estimate("Mizuyama 1992, muddy", "Q = 0.0188 V^0.79", 0.0188, 0.79),
    ]
}

/// v = 2.1 Q^0.33 S^0.33 (Rickenmann), S = tan of the slope; h = Q/(v b), or the depth of the area Q/v in another section.
pub fn velocity_and_depth(discharge: f64, slope: f64, section: &Section) -> [f64; 2] {
    let velocity = 2.1 * libm::pow(discharge, 0.33) * libm::pow(libm::tan(slope), 0.33);
    [velocity, section.depth_of(discharge, velocity)]
}

/// v = h^⅔ S^½/n (Manning-Strickler); n is 0.05 to 0.18 s/m^⅓ for debris flows.
pub fn manning_strickler(depth: f64, slope: f64, roughness: f64) -> f64 {
    libm::pow(depth, 2.0 / 3.0) * libm::tan(slope).sqrt() / roughness
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn match_the_derived_numbers() {
        // V 1000 m³: 31.6, 29.5, 4.41 m³/s; Q 29.5, S = tan 20°, b 12 m: 4.60 m/s, 0.535 m.
        for (estimate, expected) in peak_discharge(1000.0).iter().zip([31.6, 29.5, 4.41]) {
            assert_relative_eq!(estimate.value, expected, max_relative = 3e-3);
        }
        let [velocity, depth] = velocity_and_depth(29.5, 20_f64.to_radians(), &Section::Rectangle { width: 12.0 });
        assert_relative_eq!(velocity, 4.60, max_relative = 2e-3);
        assert_relative_eq!(depth, 0.535, max_relative = 2e-3);
        let slope = libm::atan(1_f64);
        assert_relative_eq!(manning_strickler(1.0, slope, 0.1), 10.0, max_relative = 1e-12);
    }

    #[test]
    fn manning_and_strickler_grow_with_depth_and_slope() {
        // 8^⅔ = 4, √tan 45° = 1; 0.05: 80 m/s of a flow no one would wade. At tan = ¼ half of it.
        assert_relative_eq!(manning_strickler(8.0, libm::atan(1.0), 0.05), 80.0, max_relative = 1e-12);
        assert_relative_eq!(manning_strickler(8.0, libm::atan(0.25), 0.05), 40.0, max_relative = 1e-12);
    }
}
