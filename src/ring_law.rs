//! What a ring of a ring net does when it is pulled: bending first, then tension.
//!
//! Both stages are read off a chain of rings that is pulled until it breaks. Up to the end of bending the force rises gently while the rings
//! turn from circles into straight double strands; then the wires are stretched. With D the diameter, e₁ and F₁ elongation and force at
//! which bending ends, e₂ and F₂ those of the break (elongations over the length of the chain, so over D for each ring), a ring between two
//! contacts has
//!
//! - the stiffness of bending b = F₁/(e₁ D), for each pair of opposite contacts;
//! - a way round its contacts P₁ = 2 D (1 + e₁) from which it is taut;
//! - the stiffness against a longer way k = T₂/(2 D (e₂ − e₁)), T₂ = ½ (F₂ − b e₂ D).
//!
//! Where no test of the very rings is given, the chain follows from their wires: F₂ = 2 η n A f, with n windings of wires of the section A
//! and the strength f, and the shape of the curve of rings of 300 mm with 3 mm wires of 1770 MPa. Its four numbers are means of the tests
//! with 7 and with 12 windings (Guo 2022, Zenodo 6482654; three rings each): η = 0.398 and 0.369; e₂ = 0.535 m and 0.509 m, 0.523 m and
//! 0.491 m over 0.9 m in the two versions of that file; bending ends at 15 % of the force and 85 % of the elongation. Chains of 5, 9, 16 and
//! 19 windings are predicted by it within 15 % (validation case D28).
//!
//! The share η is that of a ring that every contact turns by 180°. A ring pulled by four others, each of which turns it by 90°, used 0.554
//! of its wires with 7 windings (the same source; 0.551 and 0.559 with 5 and 9): by the same case because one of the others broke, so that
//! it holds as much at the least.

use std::f64::consts::{FRAC_PI_4, PI};

/// Share of the wires' strength, without a unit, that a ring uses which its contacts turn by 180°, as in a chain, and by 90°, as in a net.
pub const IN_CHAIN: f64 = 0.3835;
pub const IN_NET: f64 = 0.554;
/// Elongation of a chain at its break.
const BREAKS_AT: f64 = 0.5717;
/// Share of the force, and of the elongation, at which bending ends.
const BENDING_ENDS: [f64; 2] = [0.15, 0.85];

/// Lowest single test over what the law predicts: 71.7 kN of 86.3 kN, with 9 windings.
pub const LOWEST_OF_TESTS: f64 = 0.83;

/// Windings, diameters of wires (m), their strength (Pa) and diameters of rings (m) for which the law from the wires is known.
const KNOWN: [[f64; 2]; 4] = [[5.0, 19.0], [2.9e-3, 3.1e-3], [1.7e9, 1.85e9], [0.29, 0.31]];

/// Wires of a ring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wires {
    pub windings: u32,
    /// m
    pub diameter: f64,
    /// Pa
    pub strength: f64,
}

impl Wires {
    /// Steel of one leg (m²).
    pub fn area(&self) -> f64 {
        f64::from(self.windings) * FRAC_PI_4 * self.diameter.powi(2)
    }

    /// Breaking load of all wires of one leg, pulled straight (N).
    pub fn breaking_load(&self) -> f64 {
        self.area() * self.strength
    }

    /// Diameter of the bundle (m): 7 wires lie within three of their diameters and 19 within five, so that they fill three quarters and more
    /// of the circle.
    pub fn bundle(&self) -> f64 {
        const FILLED: f64 = 7.0 / 9.0;
        self.diameter * (f64::from(self.windings) / FILLED).sqrt()
    }
}

/// A chain of rings as it was pulled: elongation over the length, and force (N), at the end of bending and at the break.
pub type Chain = [[f64; 2]; 2];

/// The chain that wires make.
pub fn chain_of(wires: &Wires) -> Chain {
    let force = 2.0 * IN_CHAIN * wires.breaking_load();
    [[BENDING_ENDS[1] * BREAKS_AT, BENDING_ENDS[0] * force], [BREAKS_AT, force]]
}

/// Whether the law from the wires is known for such rings.
pub fn is_known(wires: &Wires, diameter: f64) -> bool {
    let of = [f64::from(wires.windings), wires.diameter, wires.strength, diameter];
    of.iter().zip(KNOWN).all(|(value, [low, high])| (low..=high).contains(value))
}

/// The two stages of a ring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RingLaw {
    /// Stiffness between two opposite contacts while it bends (N/m).
    pub bending: f64,
    /// Way round all contacts from which it is taut (m).
    pub taut_from: f64,
    /// Stiffness of the taut ring against a longer way (N/m).
    pub stiffness: f64,
}

impl RingLaw {
    /// Of a ring of a diameter (m) in a chain.
    pub fn of(chain: &Chain, diameter: f64) -> Self {
        let [[bent, knee], [broken, force]] = *chain;
        let bending = knee / (bent * diameter);
        let tension = 0.5 * (force - bending * broken * diameter);
        Self {
            bending,
            taut_from: 2.0 * diameter * (1.0 + bent),
            stiffness: tension / (2.0 * diameter * (broken - bent)),
        }
    }

    /// The tension that a taut ring has at the break of a chain, over its strain from [`Self::taut_from`]: EA (N).
    pub fn axial_stiffness(&self) -> f64 {
        self.stiffness * self.taut_from
    }
}

/// Mass of a ring (kg), with steel of a density (kg/m³).
pub fn mass(wires: &Wires, diameter: f64, density: f64) -> f64 {
    density * wires.area() * PI * diameter
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Force of a chain (N) at an elongation over its length.
    fn chain_force(law: &RingLaw, elongation: f64, diameter: f64) -> f64 {
        let bending = law.bending * diameter * elongation.max(0.0);
        bending + 2.0 * law.stiffness * (2.0 * diameter * (1.0 + elongation) - law.taut_from).max(0.0)
    }

    const TWELVE: Wires = Wires { windings: 12, diameter: 3e-3, strength: 1.77e9 };

    /// By hand: 12 windings have 84.82 mm², 150.1 kN, and their chain breaks at 2 × 0.3835 × 150.1 = 115.2 kN.
    #[test]
    fn the_law_passes_through_both_points_of_its_chain() {
        let chain = chain_of(&TWELVE);
        assert_relative_eq!(chain[1][1], 115.2e3, max_relative = 1e-3);
        let law = RingLaw::of(&chain, 0.3);
        for [elongation, force] in chain {
            assert_relative_eq!(chain_force(&law, elongation, 0.3), force, max_relative = 1e-12);
        }
        assert_relative_eq!(chain_force(&law, 0.5 * chain[0][0], 0.3), 0.5 * chain[0][1], max_relative = 1e-12);
        assert_eq!(chain_force(&law, -0.1, 0.3), 0.0);
    }

    #[test]
    fn a_bundle_of_nineteen_wires_is_five_wide() {
        let wires = Wires { windings: 19, ..TWELVE };
        assert_relative_eq!(wires.bundle(), 15e-3, max_relative = 0.02);
        assert_relative_eq!(Wires { windings: 7, ..TWELVE }.bundle(), 9e-3, max_relative = 1e-12);
    }

    #[test]
    fn the_law_from_wires_is_known_for_tested_rings_alone() {
        assert!(is_known(&TWELVE, 0.3));
        assert!(!is_known(&Wires { windings: 4, ..TWELVE }, 0.3));
        assert!(!is_known(&Wires { diameter: 4e-3, ..TWELVE }, 0.3));
        assert!(!is_known(&TWELVE, 0.42));
        assert!(!is_known(&Wires { strength: 2.16e9, ..TWELVE }, 0.3));
    }
}
