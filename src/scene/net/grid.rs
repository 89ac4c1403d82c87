//! Where the knots of the net lie: squares on their corners, with main ropes through whole rows of knots.

use crate::design::FlexibleNet;

/// Rows and columns of half mesh diagonals. A knot sits at (column, row) where one of them is even and the other odd: so a main
/// rope has its outermost knots half a diagonal from its ends, which the net leaves free, and the side of the net has a knot on
/// every other row between two main ropes.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Number of half diagonals across the barrier; even.
    pub columns: usize,
    /// Height of each row along the barrier (m), from the bottom.
    pub row_heights: Vec<f64>,
    /// Row of each main rope, from the bottom; all even.
    pub rope_rows: Vec<usize>,
}

impl Grid {
    /// Fits the mesh to the barrier: the width takes a whole number of diagonals, and so does each bay between
    /// two main ropes; the mesh stretches a little so that it fits.
    pub fn fit(net: &FlexibleNet, width: f64) -> Self {
        let half_diagonal = net.mesh_opening * std::f64::consts::FRAC_1_SQRT_2;
        let whole = |length: f64| 2 * ((length / (2.0 * half_diagonal)).round() as usize).max(1);
        let heights = net.main_ropes.heights();
        let mut row_heights = vec![heights[0]];
        let mut rope_rows = vec![0];
        for bay in heights.windows(2) {
            let rows = whole(bay[1] - bay[0]);
            for row in 1..=rows {
                row_heights.push(bay[0] + (bay[1] - bay[0]) * row as f64 / rows as f64);
            }
            rope_rows.push(row_heights.len() - 1);
        }
        Self { columns: whole(width), row_heights, rope_rows }
    }

    /// Columns of the knots in one row, from one side to the other.
    pub fn knot_columns(&self, row: usize) -> impl Iterator<Item = usize> + use<> {
        (1 - row % 2..=self.columns).step_by(2)
    }
}
