//! The lattice of a net fitted to its barrier: whole periods across the width and in each bay between two main ropes.

use crate::design::FlexibleNet;
use crate::lattice::{Lattice, Place};

/// Where the knots of a net lie. A main rope has its outermost knots off its ends, which the net leaves free.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    pub lattice: Lattice,
    /// Columns across the barrier.
    pub columns: i32,
    /// Height of each row along the barrier (m), from the bottom.
    pub row_heights: Vec<f64>,
    /// Row of each main rope, from the bottom.
    pub rope_rows: Vec<usize>,
}

impl Grid {
    /// Fits the net to the barrier: the width takes a whole number of periods, and so does each bay between two main ropes; the net stretches a
    /// little so that it fits.
    pub fn fit(net: &FlexibleNet, width: f64) -> Self {
        let lattice = net.lattice();
        let ([across, along], [columns, _]) = (lattice.period(), lattice.steps());
        let whole = |length: f64, period: f64| ((length / period).round() as usize).max(1);
        let heights = net.main_ropes.heights();
        let shares = lattice.rows();
        let (mut row_heights, mut rope_rows) = (vec![heights[0]], vec![0]);
        for bay in heights.windows(2) {
            let periods = whole(bay[1] - bay[0], along);
            for row in 1..=periods * shares.len() {
                let up = (row / shares.len()) as f64 + shares[row % shares.len()];
                row_heights.push(bay[0] + (bay[1] - bay[0]) * up / periods as f64);
            }
            rope_rows.push(row_heights.len() - 1);
        }
        Self { lattice, columns: (columns * whole(width, across)) as i32, row_heights, rope_rows }
    }

    /// Columns of the knots in one row, from one side to the other.
    pub fn knot_columns(&self, row: usize) -> impl Iterator<Item = i32> + use<> {
        let lattice = self.lattice;
        (0..=self.columns).filter(move |column| lattice.has_knot((*column, row)))
    }

    /// The place so many columns and rows from another; nothing below the lowest row or above the uppermost.
    pub fn from(&self, (column, row): Place, (by, up): (i32, i32)) -> Option<Place> {
        let row = row.checked_add_signed(up as isize).filter(|row| *row < self.row_heights.len())?;
        Some((column + by, row))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::read::read_design;
    use crate::design::{BarrierDesign, MeshShape};

    /// Sides of 200 mm: a square is 283 mm wide and tall, a diamond of 60° 200 mm wide and 346 mm tall; on 2.8 m of width and bays of 0.9 m ten
    /// and three, or fourteen and three.
    #[test]
    fn a_diamond_is_as_wide_and_tall_as_its_angle_says() {
        let text = include_str!("../../../designs/small_net.yaml");
        let grid = |angle: Option<f64>| {
            let design = read_design("x", text.as_bytes()).unwrap().design;
            let BarrierDesign::FlexibleNet(mut net) = design.barrier else { panic!("a net") };
            net.mesh = angle.map_or(MeshShape::Square, MeshShape::Diamond);
            Grid::fit(&net, 2.8)
        };
        let [square, diamond] = [None, Some(60_f64.to_radians())].map(grid);
        assert_eq!((square.columns, square.rope_rows.as_slice()), (20, &[0, 6, 12][..]));
        assert_eq!((diamond.columns, diamond.rope_rows.as_slice()), (28, &[0, 6, 12][..]));
        let right = grid(Some(std::f64::consts::FRAC_PI_2));
        assert_eq!((right.columns, right.rope_rows), (square.columns, square.rope_rows));
    }
}
