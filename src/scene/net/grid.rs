//! Where the knots of the net lie: squares or diamonds on their corners, with main ropes through whole rows of knots.

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
        let [across, along] = net.diagonals();
        let whole = |length: f64, diagonal: f64| 2 * ((length / diagonal).round() as usize).max(1);
        let heights = net.main_ropes.heights();
        let mut row_heights = vec![heights[0]];
        let mut rope_rows = vec![0];
        for bay in heights.windows(2) {
            let rows = whole(bay[1] - bay[0], along);
            for row in 1..=rows {
                row_heights.push(bay[0] + (bay[1] - bay[0]) * row as f64 / rows as f64);
            }
            rope_rows.push(row_heights.len() - 1);
        }
        Self { columns: whole(width, across), row_heights, rope_rows }
    }

    /// Columns of the knots in one row, from one side to the other.
    pub fn knot_columns(&self, row: usize) -> impl Iterator<Item = usize> + use<> {
        (1 - row % 2..=self.columns).step_by(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::BarrierDesign;
    use crate::design::read::read_design;

    /// Sides of 200 mm: a square is 283 mm wide and tall, a diamond of 60° 200 mm wide and 346 mm tall; on 2.8 m of width and bays of 0.9 m ten
    /// and three, or fourteen and three.
    #[test]
    fn a_diamond_is_as_wide_and_tall_as_its_angle_says() {
        let text = include_str!("../../../designs/small_net.yaml");
        let grid = |angle: Option<f64>| {
            let design = read_design("x", text.as_bytes()).unwrap().design;
            let BarrierDesign::FlexibleNet(mut net) = design.barrier else { panic!("a net") };
            net.mesh_angle = angle;
            Grid::fit(&net, 2.8)
        };
        let [square, diamond] = [None, Some(60_f64.to_radians())].map(grid);
        assert_eq!((square.columns, square.rope_rows.as_slice()), (20, &[0, 6, 12][..]));
        assert_eq!((diamond.columns, diamond.rope_rows.as_slice()), (28, &[0, 6, 12][..]));
        let right = grid(Some(std::f64::consts::FRAC_PI_2));
        assert_eq!((right.columns, right.rope_rows), (square.columns, square.rope_rows));
    }
}
