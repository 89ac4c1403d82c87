//! The shape of the meshes of a net of ropes.

use std::f64::consts::SQRT_2;

use crate::design::entries::Entries;
use crate::design::show::at;
use crate::lattice::Lattice;

/// Shapes that a design may name.
pub const SHAPES: [&str; 2] = ["squares", "hexagons"];

/// A mesh of ropes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MeshShape {
    /// On its corner.
    Square,
    /// On its corner, with this angle between its sides at the upper and the lower one (rad).
    Diamond(f64),
    /// Regular, with two of its sides plumb.
    Hexagon,
}

impl MeshShape {
    /// What a design says; a square where it says nothing.
    pub fn of(e: &Entries) -> Self {
        match (e.text(&at("mesh_shape")), e.number(&at("mesh_angle"))) {
            (Some("hexagons"), _) => Self::Hexagon,
            (_, Some(angle)) => Self::Diamond(angle),
            _ => Self::Square,
        }
    }

    /// The lattice of meshes of this opening (m): between opposite sides, or the side of a diamond.
    pub fn lattice(self, opening: f64) -> Lattice {
        match self {
            Self::Square => Lattice::Diamonds { across: opening * SQRT_2, along: opening * SQRT_2 },
            Self::Diamond(angle) => {
                let (sine, cosine) = libm::sincos(0.5 * angle);
                Lattice::Diamonds { across: 2.0 * opening * sine, along: 2.0 * opening * cosine }
            }
            Self::Hexagon => Lattice::Hexagons { opening },
        }
    }
}
