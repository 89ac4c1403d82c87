//! Force of a leg of the rings of a net that hangs between two main ropes, under an even load.
//!
//! Between the ropes, b apart, the net bulges by f, and a width s of one ring pulls at them with V = s q √((b/8f)² + ¼), q being the load of the
//! bay per width. The rings stay side by side, s from centre to centre, so that a taut one, with a way P₁ round its contacts, is
//!
//! - with four contacts d = √((P₁/2)² − s²) high, the four sides of a rhombus;
//! - with six d = √((L/2)² − (s/2)²) from its upper to its lower contacts, L = P₁ − s: two level sides of s/2, and four that rise by d/2
//!   over s/4 each.
//!
//! Hung without load it is d₀ = s, or √3/2 s, high. So the net is longer than the bay by the share e = d/d₀ − 1, and f = b √(3e/8). The sides
//! that rise bear V with one tension, T = V L/(4 d), L being their length together (P₁ with four contacts). That the ring stretches is left
//! out, so that it bulges less and is loaded more.

use crate::lattice::Lattice;

/// What the equations know of a ring net.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RingNet {
    /// How the contacts of the rings lie.
    pub lattice: Lattice,
    /// Way round its contacts from which a ring is taut P₁ (m).
    pub taut_from: f64,
}

/// What the rings of a bay bear.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RingLoad {
    /// Height of the bay along the net b (m).
    pub bay: f64,
    /// Load on it per width q (N/m).
    pub load: f64,
    /// How far it bulges f (m).
    pub bulge: f64,
    /// Force of a leg T (N).
    pub leg: f64,
}

impl RingNet {
    /// Distance of centres side by side s (m).
    pub fn spacing(&self) -> f64 {
        self.lattice.period()[0]
    }

    /// Length of the level sides of a ring (m).
    fn level(&self) -> f64 {
        match self.lattice {
            Lattice::SixContacts { spacing } => spacing,
            _ => 0.0,
        }
    }

    /// Length of all sides of a taut ring that rise, L (m).
    pub fn rising(&self) -> f64 {
        self.taut_from - self.level()
    }

    /// Height of a ring that hangs without load, d₀ (m).
    pub fn hung(&self) -> f64 {
        self.lattice.period()[1]
    }

    /// Height of a taut ring, d (m).
    pub fn height(&self) -> f64 {
        let over = self.spacing() - 0.5 * self.level();
        (0.25 * self.rising() * self.rising() - over * over).max(0.0).sqrt()
    }

    /// The rings of a `bay` (m) under a `load` (N per metre of width).
    pub fn under(&self, bay: f64, load: f64) -> RingLoad {
        let longer = (self.height() / self.hung() - 1.0).max(0.0);
        let bulge = bay * (0.375 * longer).sqrt();
        let pull = self.spacing() * load * libm::hypot(bay / (8.0 * bulge), 0.5);
        RingLoad { bay, load, bulge, leg: pull * self.rising() / (4.0 * self.height()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// By hand: rings of 300 mm, taut from 891.6 mm: d = √(445.8² − 300²) = 329.8 mm, e = 9.92 %, f = 0.193 b; a bay of 2 m under 60 kN/m
    /// bulges by 0.386 m, V = 0.3 · 60 · √(0.648² + 0.25) = 14.7 kN, T = 14.7 · 891.6/(4 · 329.8) = 9.96 kN.
    #[test]
    fn a_bay_of_two_metres_is_that_of_the_hand() {
        let net = RingNet { lattice: Lattice::FourContacts { spacing: 0.3 }, taut_from: 0.8916 };
        let found = net.under(2.0, 60e3);
        assert_relative_eq!(net.height(), 0.3298, max_relative = 1e-3);
        assert_relative_eq!(found.bulge, 0.386, max_relative = 2e-3);
        assert_relative_eq!(found.leg, 9.96e3, max_relative = 3e-3);
        // In proportion to the load.
        assert_relative_eq!(net.under(2.0, 120e3).leg, 2.0 * found.leg, max_relative = 1e-12);
    }

    /// By hand: the same rings with six contacts, 288 mm apart: L = 603.6 mm, d = √(301.8² − 144²) = 265.2 mm, d₀ = 249.4 mm, e = 6.34 %,
    /// f = 0.1542 b = 0.308 m, V = 0.288 · 60 · √(0.811² + 0.25) = 16.46 kN, T = 16.46 · 603.6/(4 · 265.2) = 9.37 kN.
    #[test]
    fn rings_of_six_contacts_are_those_of_the_hand() {
        let net = RingNet { lattice: Lattice::SixContacts { spacing: 0.288 }, taut_from: 0.8916 };
        let found = net.under(2.0, 60e3);
        assert_relative_eq!(net.height(), 0.2652, max_relative = 1e-3);
        assert_relative_eq!(found.bulge, 0.308, max_relative = 2e-3);
        assert_relative_eq!(found.leg, 9.37e3, max_relative = 3e-3);
    }
}
