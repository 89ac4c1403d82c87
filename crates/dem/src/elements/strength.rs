//! What ropes withstand: beyond an elastic limit they draw out, at their breaking load they break; by default they do neither.
//!
//! Source: Albaba 2015, section 4.3.4, equation 4.17 with its limits of bending and twisting, which are printed crossed, put right.
//! With F the force at which a straight piece yields, its stress is σ = F/A, and the fibre at the surface of a round section yields
//! first under M = σ I/R = F R/4 or T = (σ/√3) J/R = F R/(2√3). Each of the three limits stands alone. A piece that yields keeps its
//! force; what it gives way by stays.

use serde::{Deserialize, Serialize};

/// What an element withstands, and what it has suffered.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Strength {
    /// Tension at which it draws out (N); infinite if it never does.
    pub elastic: f64,
    /// Tension at which it breaks (N); infinite if it never does.
    pub breaking: f64,
    /// Permanent elongation so far (m), and the length that the piece had at first (m), whatever has slid in and out since.
    pub drawn_out: f64,
    pub first_length: f64,
    pub broken: bool,
}

impl Default for Strength {
    fn default() -> Self {
        Self {
            elastic: f64::INFINITY,
            breaking: f64::INFINITY,
            drawn_out: 0.0,
            first_length: f64::INFINITY,
            broken: false,
        }
    }
}

impl Strength {
    /// The tension (N) up to which nothing happens.
    #[inline]
    pub fn least(&self) -> f64 {
        self.elastic.min(self.breaking)
    }

    /// Largest elastic moments across and along a round piece of `radius` (m): (N m). What breaks without yielding before has none.
    pub fn moments(&self, radius: f64) -> [f64; 2] {
        [self.elastic * radius / 4.0, self.elastic * radius / (2.0 * 3.0_f64.sqrt())]
    }

    /// Rest length (m) with which a piece of axial stiffness EA (N), now `length` long, has just its elastic limit.
    pub fn rest_length_at_limit(&self, axial: f64, length: f64) -> f64 {
        length / (1.0 + self.elastic / axial)
    }
}
