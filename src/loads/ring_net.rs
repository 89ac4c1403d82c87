//! Force of a leg of the rings of a net that hangs between two main ropes, under an even load.
//!
//! Between the ropes, b apart, the net bulges by f, and a width of one ring pulls at them with V = D q √((b/8f)² + ¼), q being the load of the
//! bay per width. The rings stay side by side, so that a taut one is D wide and, with a way P₁ round its four contacts, d = √((P₁/2)² − D²)
//! high: the net is longer than the bay by the share e = d/D − 1, and f = b √(3e/8). Each of the two legs that meet in a contact pulls along
//! its side, T = V P₁/(4 d). That the ring stretches is left out, so that it bulges less and is loaded more.

/// What the equations know of a ring net.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RingNet {
    /// Diameter of a ring D, and way round its contacts from which it is taut P₁ (m).
    pub diameter: f64,
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
    /// Height of a taut ring that is D wide, d (m).
    pub fn height(&self) -> f64 {
        (0.25 * self.taut_from * self.taut_from - self.diameter * self.diameter).max(0.0).sqrt()
    }

    /// The rings of a `bay` (m) under a `load` (N per metre of width).
    pub fn under(&self, bay: f64, load: f64) -> RingLoad {
        let longer = (self.height() / self.diameter - 1.0).max(0.0);
        let bulge = bay * (0.375 * longer).sqrt();
        let pull = self.diameter * load * libm::hypot(bay / (8.0 * bulge), 0.5);
        RingLoad { bay, load, bulge, leg: pull * self.taut_from / (4.0 * self.height()) }
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
        let net = RingNet { diameter: 0.3, taut_from: 0.8916 };
        let found = net.under(2.0, 60e3);
        assert_relative_eq!(net.height(), 0.3298, max_relative = 1e-3);
        assert_relative_eq!(found.bulge, 0.386, max_relative = 2e-3);
        assert_relative_eq!(found.leg, 9.96e3, max_relative = 3e-3);
        // In proportion to the load.
        assert_relative_eq!(net.under(2.0, 120e3).leg, 2.0 * found.leg, max_relative = 1e-12);
    }
}
