//! How the knots of a net lie, or the contacts of its rings: in rows and columns, each with its neighbours.
//!
//! Main ropes run through rows of knots that are alike from period to period, so that any bay of whole periods fits between two of them.
//!
//! | lattice | period across | columns | period along | rows |
//! |---|---|---|---|---|
//! | diamonds on their corner (a square is one), or rings that meet four others | a diagonal | 2 | a diagonal | 2 |
//! | hexagons with two plumb sides, w between opposite sides | w | 2 | √3 w | 4 |
//! | rings that meet six others, s between centres | s | 4 | s √3/2 | 2 |

use std::f64::consts::FRAC_1_SQRT_2;

/// A place of the lattice, by column and row. Column 0 is at the right bank, and rows count from the lowest rope.
pub type Place = (i32, usize);

/// Lengths in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lattice {
    /// Meshes of rope on their corner, by their diagonals across and along the barrier.
    Diamonds { across: f64, along: f64 },
    /// Meshes of rope, so far between opposite sides.
    Hexagons { opening: f64 },
    /// Contacts of rings that meet four others.
    FourContacts { spacing: f64 },
    /// Contacts of rings that meet six others.
    SixContacts { spacing: f64 },
}

/// Corners of a ring from its centre, by columns and rows, in their order round it.
const FOUR: [(i32, i32); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];
const SIX: [(i32, i32); 6] = [(2, 0), (1, 1), (-1, 1), (-2, 0), (-1, -1), (1, -1)];

impl Lattice {
    /// Columns and rows of a period.
    pub fn steps(&self) -> [usize; 2] {
        match self {
            Self::Diamonds { .. } | Self::FourContacts { .. } => [2, 2],
            Self::Hexagons { .. } => [2, 4],
            Self::SixContacts { .. } => [4, 2],
        }
    }

    /// Width and height of a period (m).
    pub fn period(&self) -> [f64; 2] {
        match *self {
            Self::Diamonds { across, along } => [across, along],
            Self::Hexagons { opening } => [opening, 3.0_f64.sqrt() * opening],
            Self::FourContacts { spacing } => [spacing, spacing],
            Self::SixContacts { spacing } => [spacing, 0.5 * 3.0_f64.sqrt() * spacing],
        }
    }

    /// Heights of the rows of a period over its height, the first at 0.
    pub fn rows(&self) -> &'static [f64] {
        match self {
            Self::Hexagons { .. } => &[0.0, 1.0 / 6.0, 0.5, 2.0 / 3.0],
            _ => &[0.0, 0.5],
        }
    }

    /// Knots of the net to a period.
    pub fn knots(&self) -> f64 {
        match self {
            Self::Diamonds { .. } | Self::FourContacts { .. } => 2.0,
            Self::Hexagons { .. } => 4.0,
            Self::SixContacts { .. } => 3.0,
        }
    }

    /// Distance of knots from each other along a main rope (m).
    pub fn along_a_rope(&self) -> f64 {
        let [across, _] = self.period();
        if matches!(self, Self::SixContacts { .. }) { 0.5 * across } else { across }
    }

    /// Length of a side of a mesh, or of a ring from contact to contact (m).
    pub fn side(&self) -> f64 {
        match *self {
            Self::Diamonds { across, along } => 0.5 * libm::hypot(across, along),
            Self::Hexagons { opening } => opening / 3.0_f64.sqrt(),
            Self::FourContacts { spacing } => spacing * FRAC_1_SQRT_2,
            Self::SixContacts { spacing } => 0.5 * spacing,
        }
    }

    /// Sides of the net that meet in a knot.
    pub fn meeting(&self) -> f64 {
        if matches!(self, Self::Hexagons { .. }) { 3.0 } else { 4.0 }
    }

    /// Whether there is a knot, or a contact of rings, at a place.
    pub fn has_knot(&self, (column, row): Place) -> bool {
        let parity = |of: usize| column.rem_euclid(2) as usize == of % 2;
        match self {
            Self::Diamonds { .. } | Self::FourContacts { .. } => parity(row + 1),
            // Rows in pairs: knots with their plumb side below, then those with it above.
            Self::Hexagons { .. } => parity(row / 2 + row + 1),
            Self::SixContacts { .. } if row.is_multiple_of(2) => parity(1),
            Self::SixContacts { .. } => column.rem_euclid(4) == first_contact(row),
        }
    }

    /// The places to which the sides of a knot lead, as columns and rows from it.
    pub fn neighbours(&self, (column, row): Place) -> &'static [(i32, i32)] {
        match self {
            Self::Hexagons { .. } if row.is_multiple_of(2) => &[(-1, 1), (1, 1), (0, -1)],
            Self::Hexagons { .. } => &[(-1, -1), (1, -1), (0, 1)],
            // A contact of a ring below and one above, of which one lies to its left and the other to its right.
            Self::SixContacts { .. } if row.is_multiple_of(2) => {
                if (column - 1).rem_euclid(4) == first_centre(row + 1) {
                    &[(-2, 0), (1, 1), (2, 0), (-1, -1)]
                } else {
                    &[(2, 0), (-1, 1), (-2, 0), (1, -1)]
                }
            }
            _ => &[(-1, 1), (-1, -1), (1, 1), (1, -1)],
        }
    }

    /// Corners of a ring from its centre, in their order round it; none in a mesh of ropes.
    pub fn corners(&self) -> &'static [(i32, i32)] {
        match self {
            Self::Diamonds { .. } | Self::Hexagons { .. } => &[],
            Self::FourContacts { .. } => &FOUR,
            Self::SixContacts { .. } => &SIX,
        }
    }

    /// Whether a ring has its centre at a place.
    pub fn has_centre(&self, (column, row): Place) -> bool {
        match self {
            Self::Diamonds { .. } | Self::Hexagons { .. } => false,
            Self::FourContacts { .. } => row % 2 == 1 && column.rem_euclid(2) == 1,
            Self::SixContacts { .. } => row % 2 == 1 && column.rem_euclid(4) == first_centre(row),
        }
    }
}

/// The first column of a centre of rings that meet six others, in a row of centres, and that of their contacts with those beside them.
fn first_centre(row: usize) -> i32 {
    if (row / 2).is_multiple_of(2) { 2 } else { 0 }
}

fn first_contact(row: usize) -> i32 {
    2 - first_centre(row)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const ALL: [Lattice; 4] = [
        Lattice::Diamonds { across: 0.2, along: 0.3464 },
        Lattice::Hexagons { opening: 0.1 },
        Lattice::FourContacts { spacing: 0.3 },
        Lattice::SixContacts { spacing: 0.3 },
    ];

    fn place(lattice: &Lattice, (column, row): Place) -> [f64; 2] {
        let ([across, along], [columns, rows]) = (lattice.period(), lattice.steps());
        let up = (row / rows) as f64 + lattice.rows()[row % rows];
        [f64::from(column) * across / columns as f64, up * along]
    }

    fn knots(lattice: &Lattice) -> impl Iterator<Item = Place> {
        let all = (-8..8).flat_map(|column| (0..12_usize).map(move |row| (column, row)));
        all.filter(|place| lattice.has_knot(*place))
    }

    fn from((column, row): Place, (by, up): (i32, i32)) -> Option<Place> {
        Some((column + by, row.checked_add_signed(up as isize)?))
    }

    /// A side leads from knot to knot and back, and all sides of a lattice are as long as it says.
    #[test]
    fn sides_lead_from_knot_to_knot() {
        for lattice in ALL {
            for knot in knots(&lattice) {
                assert_eq!(lattice.neighbours(knot).len() as f64, lattice.meeting());
                for &(by, up) in lattice.neighbours(knot) {
                    let Some(other) = from(knot, (by, up)) else { continue };
                    assert!(lattice.has_knot(other), "{lattice:?}: {knot:?} to {other:?}");
                    assert!(lattice.neighbours(other).contains(&(-by, -up)), "{lattice:?}: {other:?} to {knot:?}");
                    let [a, b] = [knot, other].map(|of| place(&lattice, of));
                    assert_relative_eq!(libm::hypot(a[0] - b[0], a[1] - b[1]), lattice.side(), max_relative = 1e-3);
                }
            }
        }
    }

    /// Every corner of a ring is a contact, and every contact away from the edges is a corner of two rings.
    #[test]
    fn rings_share_their_contacts() {
        for lattice in ALL {
            let mut met = std::collections::BTreeMap::new();
            let centres = (-12..12).flat_map(|column| (0..14_usize).map(move |row| (column, row)));
            for centre in centres.filter(|place| lattice.has_centre(*place)) {
                for corner in lattice.corners() {
                    let corner = from(centre, *corner).expect("a row");
                    assert!(lattice.has_knot(corner), "{lattice:?}: {corner:?} of {centre:?}");
                    *met.entry(corner).or_insert(0) += 1;
                }
            }
            let inside = knots(&lattice).filter(|(_, row)| (1..12).contains(row));
            let rings = !lattice.corners().is_empty();
            assert!(inside.into_iter().all(|knot| met.get(&knot) == rings.then_some(&2)), "{lattice:?}");
        }
    }

    /// Knots to a period, counted; along a rope, and the area of a period by hand: a hexagon of w = 0.1 m has √3/2 w² = 8.66e-3 m², and two fill
    /// a period.
    #[test]
    fn periods_hold_their_knots() {
        for lattice in ALL {
            let [columns, rows] = lattice.steps();
            let count = (0..4 * columns as i32)
                .flat_map(|column| (0..2 * rows).map(move |row| (column, row)))
                .filter(|place| lattice.has_knot(*place))
                .count();
            assert_eq!(count as f64, 8.0 * lattice.knots(), "{lattice:?}");
            for row in [0, rows, 2 * rows] {
                let on_a_rope: Vec<i32> = (0..12).filter(|column| lattice.has_knot((*column, row))).collect();
                let apart = f64::from(on_a_rope[1] - on_a_rope[0]) * lattice.period()[0] / columns as f64;
                assert_relative_eq!(apart, lattice.along_a_rope(), max_relative = 1e-12);
                assert_eq!(on_a_rope[0], 1, "the outermost lies off the end of the rope");
            }
        }
        let [across, along] = ALL[1].period();
        assert_relative_eq!(across * along, 2.0 * 0.866_025_4 * 0.01, max_relative = 1e-7);
    }
}
