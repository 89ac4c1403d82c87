//! The ground around a barrier as a grid of heights, in the barrier's own directions.
//!
//! X runs level and downstream from the line between the barrier's ends, y across from the right bank to the left, and heights are plumb over
//! the lowest ground on that line. Between the corners of the grid the ground is that of two triangles to each cell.

/// Length over which a turn of the lowest line is told (m).
const TURNS: f64 = 6.0;
/// Least length of a piece of the lowest line (m).
const REACH: f64 = 2.0;

/// Heights on a grid (m).
#[derive(Clone, Debug, PartialEq)]
pub struct Relief {
    /// X of the first row and y of the first column, and the distance between both.
    first: [f64; 2],
    step: f64,
    rows: usize,
    columns: usize,
    /// Row by row, each from the right to the left.
    heights: Vec<f64>,
    /// The lowest column of each row, followed from the barrier.
    thalweg: Vec<usize>,
}

impl Relief {
    /// `height` gives that at (X, y), from `first` on in steps; nothing where one is missing, with where it is.
    pub fn sample(
        first: [f64; 2],
        step: f64,
        [rows, columns]: [usize; 2],
        height: impl Fn(f64, f64) -> Option<f64>,
    ) -> Result<Self, [f64; 2]> {
        let mut heights = Vec::with_capacity(rows * columns);
        for row in 0..rows {
            for column in 0..columns {
                let place = [first[0] + step * row as f64, first[1] + step * column as f64];
                heights.push(height(place[0], place[1]).ok_or(place)?);
            }
        }
        let mut relief = Self { first, step, rows, columns, heights, thalweg: Vec::new() };
        relief.thalweg = relief.followed();
        Ok(relief)
    }

    /// The same with one in so many points along either side.
    pub fn every(&self, count: usize) -> Self {
        let [rows, columns] = [self.rows, self.columns].map(|points| (points - 1) / count + 1);
        let heights =
            (0..rows).flat_map(|row| (0..columns).map(move |column| self.corner(row * count, column * count)));
        let (first, step) = (self.first, self.step * count as f64);
        let mut relief = Self { first, step, rows, columns, heights: heights.collect(), thalweg: Vec::new() };
        relief.thalweg = relief.followed();
        relief
    }

    /// The same with its heights counted from a level (m).
    pub fn over(&self, level: f64) -> Self {
        let heights = self.heights.iter().map(|height| height - level).collect();
        Self { heights, ..self.clone() }
    }

    pub fn rows(&self) -> usize {
        self.rows
    }

    pub fn columns(&self) -> usize {
        self.columns
    }

    /// X of a row, y of a column (m).
    pub fn x(&self, row: usize) -> f64 {
        self.first[0] + self.step * row as f64
    }

    pub fn y(&self, column: usize) -> f64 {
        self.first[1] + self.step * column as f64
    }

    pub fn corner(&self, row: usize, column: usize) -> f64 {
        self.heights[row * self.columns + column]
    }

    /// From where to where the rows go (m).
    pub fn stretch(&self) -> [f64; 2] {
        [self.x(0), self.x(self.rows - 1)]
    }

    /// The row before a place and the share of the way to the next; the outermost beyond the ends.
    fn between(&self, x: f64) -> (usize, f64) {
        let place = ((x - self.first[0]) / self.step).clamp(0.0, (self.rows - 1) as f64);
        let row = (place as usize).min(self.rows.saturating_sub(2));
        (row, place - row as f64)
    }

    pub fn nearest_row(&self, x: f64) -> usize {
        let (row, share) = self.between(x);
        if share > 0.5 { (row + 1).min(self.rows - 1) } else { row }
    }

    /// Heights across at a place along the channel, by columns.
    pub fn across(&self, x: f64) -> Vec<f64> {
        let (row, share) = self.between(x);
        let next = (row + 1).min(self.rows - 1);
        (0..self.columns)
            .map(|column| {
                let [a, b] = [row, next].map(|row| self.corner(row, column));
                a + share * (b - a)
            })
            .collect()
    }

    /// The lowest column of each row, followed from the barrier.
    pub fn thalweg(&self) -> &[usize] {
        &self.thalweg
    }

    /// The lowest column at each row: from the lowest at X = 0 on, at most two columns aside from row to row.
    fn followed(&self) -> Vec<usize> {
        let origin = self.row_of_the_barrier();
        let lowest = |row: usize, columns: std::ops::Range<usize>| {
            columns.min_by(|a, b| self.corner(row, *a).total_cmp(&self.corner(row, *b))).unwrap_or(0)
        };
        let mut line = vec![0; self.rows];
        line[origin] = lowest(origin, 0..self.columns);
        let near = |column: usize| column.saturating_sub(2)..(column + 3).min(self.columns);
        for row in (0..origin).rev() {
            line[row] = lowest(row, near(line[row + 1]));
        }
        for row in origin + 1..self.rows {
            line[row] = lowest(row, near(line[row - 1]));
        }
        line
    }

    /// Corners (X, Z) of the lowest line, the barrier's foot among them, at least some metres apart, and never falling upstream: what lies lower
    /// there is a pool.
    pub fn lowest_line(&self) -> Vec<[f64; 2]> {
        let line = self.thalweg();
        let origin = self.row_of_the_barrier();
        let apart = (REACH / self.step).ceil().max(1.0) as usize;
        let height = |row: usize| self.corner(row, line[row]);
        let mut corners = vec![[0.0, 0.0]];
        let mut level = 0.0_f64;
        for row in (0..origin).rev().filter(|row| (origin - row).is_multiple_of(apart) || *row == 0) {
            level = level.max(height(row));
            corners.insert(0, [self.x(row), level]);
        }
        level = 0.0;
        for row in (origin + 1..self.rows).filter(|row| (row - origin).is_multiple_of(apart) || *row == self.rows - 1) {
            level = level.min(height(row));
            corners.push([self.x(row), level]);
        }
        corners
    }

    /// The steepest rise between two neighbours of a row (m over a metre), and where it is along X.
    pub fn steepest(&self) -> Option<[f64; 2]> {
        let rise = |row: usize, column: usize| {
            let [here, across] = [self.corner(row, column), self.corner(row, column + 1)];
            let along = if row + 1 < self.rows { self.corner(row + 1, column) } else { here };
            (across - here).abs().max((along - here).abs()) / self.step
        };
        let places = (0..self.rows).flat_map(|row| (0..self.columns - 1).map(move |column| (row, column)));
        places.map(|(row, column)| [self.x(row), rise(row, column)]).max_by(|a, b| a[1].total_cmp(&b[1]))
    }

    /// Angle between the lowest line and X over pieces of some metres, at the most (rad).
    pub fn most_turned(&self) -> f64 {
        let apart = (TURNS / self.step).ceil().max(1.0) as usize;
        let turned = |row: usize| {
            let aside = self.y(self.thalweg[row + apart]) - self.y(self.thalweg[row]);
            libm::atan2(aside, apart as f64 * self.step).abs()
        };
        (0..self.rows.saturating_sub(apart)).map(turned).fold(0.0, f64::max)
    }

    /// The row at X = 0.
    pub fn row_of_the_barrier(&self) -> usize {
        ((-self.first[0] / self.step).round() as usize).min(self.rows - 1)
    }

    /// Area (m²) of what lies under a level across the channel, contiguous with the lowest ground there near a column, and whether it reaches
    /// an edge of the grid.
    pub fn area_under(&self, x: f64, level: f64, near: usize) -> (f64, bool) {
        let (row, share) = self.between(x);
        let next = (row + 1).min(self.rows - 1);
        let ground = |column: usize| {
            let [a, b] = [row, next].map(|row| self.corner(row, column));
            a + share * (b - a)
        };
        if ground(near) >= level {
            return (0.0, false);
        }
        let mut area = 0.0;
        let mut edge = false;
        let mut side = |columns: &mut dyn Iterator<Item = usize>| {
            let mut before = near;
            for column in columns {
                let [a, b] = [level - ground(before), level - ground(column)];
                if b <= 0.0 {
                    area += 0.5 * a * self.step * a / (a - b);
                    return;
                }
                area += 0.5 * (a + b) * self.step;
                before = column;
            }
            edge = true;
        };
        side(&mut (0..near).rev());
        side(&mut (near + 1..self.columns));
        (area, edge)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// A gully of banks of 45° whose lowest line rises by 20 % upstream and turns by one in ten, 40 m long and 20 m wide.
    fn gully() -> Relief {
        let height = |x: f64, y: f64| Some(-0.2 * x + (y - 10.0 - 0.1 * x).abs());
        Relief::sample([-30.0, 0.0], 1.0, [41, 21], height).unwrap()
    }

    #[test]
    fn the_lowest_line_is_followed_from_the_barrier() {
        let gully = gully();
        assert_eq!(gully.row_of_the_barrier(), 30);
        let line = gully.thalweg();
        assert_eq!((line[30], line[0], line[40]), (10, 7, 11));
        assert_eq!(gully.stretch(), [-30.0, 10.0]);
    }

    #[test]
    fn an_area_ends_at_the_banks() {
        let gully = gully();
        let (area, edge) = gully.area_under(0.0, 3.0, 10);
        assert_relative_eq!(area, 9.0, max_relative = 1e-12);
        assert!(!edge);
        assert!(gully.area_under(0.0, 30.0, 10).1);
        assert_eq!(gully.area_under(0.0, -1.0, 10), (0.0, false));
        // Between two rows.
        let (area, _) = gully.area_under(-0.5, 3.1, 10);
        assert!((area - 9.0).abs() < 0.15, "{area}");
    }

    #[test]
    fn one_in_so_many_points_is_the_same_ground() {
        let (gully, coarse) = (gully(), gully().every(2));
        assert_eq!((coarse.rows(), coarse.columns(), coarse.stretch()), (21, 11, gully.stretch()));
        assert_eq!((coarse.row_of_the_barrier(), coarse.x(15), coarse.y(5)), (15, 0.0, 10.0));
        assert_eq!(coarse.corner(3, 4), gully.corner(6, 8));
    }

    #[test]
    fn what_is_missing_is_told_with_its_place() {
        let missing = Relief::sample([-2.0, 0.0], 1.0, [3, 3], |x, y| (x != -1.0 || y != 2.0).then_some(0.0));
        assert_eq!(missing.unwrap_err(), [-1.0, 2.0]);
    }
}
