//! The section of the channel as recorders need it: how deep a mass stands in it, and where its ground is.

use serde::{Deserialize, Serialize};

use crate::Vec3;

/// What lies across the channel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Across {
    /// A level bed of this width between vertical walls (m).
    Even(f64),
    Ground(GroundLine),
}

/// Ground over the width.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct GroundLine {
    /// (y, z) of the ground, y never falling (m).
    pub points: Vec<[f64; 2]>,
    /// Slope of the bed at the barrier (rad), and (X, Z) of the bed's corners, level and plumb (m), where it has several reaches.
    pub slope: f64,
    pub bed: Vec<[f64; 2]>,
    /// The width on which fluxes are told (m).
    pub width: f64,
    /// Plumb heights of the ground, where they are told on a grid.
    pub grid: Option<HeightGrid>,
    /// Area under a level surface (m²) by its height (m), both rising from 0; between two heights in proportion.
    pub areas: Vec<[f64; 2]>,
}

/// Plumb heights over the barrier's foot on a grid of level distances along and across the channel (m), row by row along it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct HeightGrid {
    pub first: [f64; 2],
    pub step: f64,
    pub columns: usize,
    pub heights: Vec<f64>,
}

impl HeightGrid {
    /// Height (m) and the cosine of the slope across, at the nearest place of the grid.
    fn at(&self, level: f64, across: f64) -> (f64, f64) {
        let rows = self.heights.len() / self.columns.max(1);
        let split = |place: f64, count: usize| {
            let place = (place / self.step).clamp(0.0, count.saturating_sub(1) as f64);
            let before = (place as usize).min(count.saturating_sub(2));
            (before, place - before as f64)
        };
        let (row, along) = split(level - self.first[0], rows);
        let (column, side) = split(across - self.first[1], self.columns);
        let corner = |row: usize, column: usize| self.heights[row * self.columns + column];
        let mix = |column: usize| corner(row, column) + along * (corner(row + 1, column) - corner(row, column));
        let [right, left] = [mix(column), mix(column + 1)];
        (right + side * (left - right), self.step / libm::hypot(self.step, left - right))
    }
}

impl Across {
    /// Depth (m) of a mass (kg) over a length of the channel (m) at a density (kg/m³).
    pub fn depth_of(&self, mass: f64, density: f64, length: f64) -> f64 {
        match self {
            Self::Even(width) => mass / (density * width * length),
            Self::Ground(ground) => ground.height_of(mass / (density * length)),
        }
    }

    /// Mass (kg) that stands at a depth (m) over a length of the channel (m).
    pub fn mass_at(&self, depth: f64, density: f64, length: f64) -> f64 {
        match self {
            Self::Even(width) => depth * density * width * length,
            Self::Ground(ground) => ground.area_under(depth) * density * length,
        }
    }

    /// The width on which fluxes are told (m).
    pub fn width(&self) -> f64 {
        match self {
            Self::Even(width) => *width,
            Self::Ground(ground) => ground.width,
        }
    }

    /// From one side to the other (m).
    pub fn breadth(&self) -> f64 {
        match self {
            Self::Even(width) => *width,
            Self::Ground(ground) => ground.points.last().map_or(0.0, |point| point[0]),
        }
    }

    /// Height over the ground, normal to the bed at the barrier (m), and the cosine of the slope of the ground across the channel.
    pub fn clearance(&self, place: &Vec3) -> (f64, f64) {
        match self {
            Self::Even(_) => (place.z, 1.0),
            Self::Ground(GroundLine { grid: Some(grid), slope, .. }) => {
                let (sine, upright) = libm::sincos(*slope);
                let (level, plumb) = (place.x * upright + place.z * sine, place.z * upright - place.x * sine);
                let (height, cosine) = grid.at(level, place.y);
                ((plumb - height) * upright, cosine)
            }
            Self::Ground(ground) => {
                let (height, cosine) = ground.at(place.y);
                (ground.over_the_bed(place) - height, cosine)
            }
        }
    }

    /// Height over the lowest ground across the channel (m).
    pub fn over_the_bed(&self, place: &Vec3) -> f64 {
        match self {
            Self::Even(_) => place.z,
            Self::Ground(ground) => ground.over_the_bed(place),
        }
    }
}

impl GroundLine {
    fn at(&self, y: f64) -> (f64, f64) {
        let after = self.points.partition_point(|point| point[0] < y);
        match (after.checked_sub(1).map(|before| self.points[before]), self.points.get(after)) {
            (Some(a), Some(b)) => {
                let [across, rise] = [b[0] - a[0], b[1] - a[1]];
                (a[1] + rise * (y - a[0]) / across, across / libm::hypot(across, rise))
            }
            (Some(end), None) | (None, Some(&end)) => (end[1], 1.0),
            (None, None) => (0.0, 1.0),
        }
    }

    fn over_the_bed(&self, place: &Vec3) -> f64 {
        if self.bed.is_empty() {
            return place.z;
        }
        let (sine, cosine) = libm::sincos(self.slope);
        let (level, plumb) = (place.x * cosine + place.z * sine, place.z * cosine - place.x * sine);
        (plumb - along(&self.bed, level, 0, 1)) * cosine
    }

    fn height_of(&self, area: f64) -> f64 {
        along(&self.areas, area, 1, 0)
    }

    fn area_under(&self, height: f64) -> f64 {
        along(&self.areas, height, 0, 1)
    }
}

/// The column `to` of a table where its column `from` has a value; beyond the end as in the last interval.
fn along(table: &[[f64; 2]], value: f64, from: usize, to: usize) -> f64 {
    let Some(last) = table.len().checked_sub(2) else { return 0.0 };
    let index = table.partition_point(|row| row[from] < value).saturating_sub(1).min(last);
    let [a, b] = [table[index], table[index + 1]];
    a[to] + (b[to] - a[to]) * (value - a[from]) / (b[from] - a[from])
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// A bed of 2 m between banks of 45°, A = 2 z + z².
    fn trapezoid() -> Across {
        let areas = (0..=400).map(|step| 0.01 * f64::from(step)).map(|z| [z, 2.0 * z + z * z]).collect();
        let points = vec![[0.0, 4.0], [4.0, 0.0], [6.0, 0.0], [10.0, 4.0]];
        Across::Ground(GroundLine { points, areas, ..GroundLine::default() })
    }

    #[test]
    fn a_mass_stands_as_deep_as_its_area_is_high() {
        // 1000 kg/m³ over 2 m: 16 t is 8 m², which is 2 m deep.
        assert_relative_eq!(trapezoid().depth_of(16e3, 1000.0, 2.0), 2.0, max_relative = 1e-4);
        assert_relative_eq!(trapezoid().mass_at(2.0, 1000.0, 2.0), 16e3, max_relative = 1e-4);
        assert_relative_eq!(Across::Even(4.0).depth_of(16e3, 1000.0, 2.0), 2.0);
        assert_relative_eq!(Across::Even(4.0).mass_at(2.0, 1000.0, 2.0), 16e3);
        assert_eq!(trapezoid().depth_of(0.0, 1000.0, 2.0), 0.0);
        assert!(trapezoid().depth_of(1e6, 1000.0, 2.0) > 4.0);
    }

    /// A plane that rises by a tenth across and by two tenths upstream, on a bed of that slope.
    #[test]
    fn a_grid_tells_the_ground_below() {
        let heights =
            (0..5).flat_map(|row| (0..4).map(move |column| 0.2 * (2.0 - f64::from(row)) + 0.1 * f64::from(column)));
        let grid = HeightGrid { first: [-2.0, 0.0], step: 1.0, columns: 4, heights: heights.collect() };
        let slope = libm::atan(0.2);
        let across = Across::Ground(GroundLine { grid: Some(grid), slope, ..GroundLine::default() });
        let (clear, cosine) = across.clearance(&Vec3::new(1.0, 1.5, 0.9));
        assert_relative_eq!(clear, 0.9 - 0.15 * libm::cos(slope), max_relative = 1e-12);
        assert_relative_eq!(cosine, 1.0 / libm::hypot(1.0, 0.1), max_relative = 1e-12);
    }

    #[test]
    fn heights_count_from_the_ground_below() {
        let at = |y: f64, z: f64| Vec3::new(-3.0, y, z);
        let (clear, cosine) = trapezoid().clearance(&at(1.0, 3.5));
        assert_relative_eq!(clear, 0.5, max_relative = 1e-12);
        assert_relative_eq!(cosine, std::f64::consts::FRAC_1_SQRT_2, max_relative = 1e-12);
        assert_eq!(trapezoid().clearance(&at(5.0, 1.0)), (1.0, 1.0));
        assert_eq!((trapezoid().clearance(&at(11.0, 5.0)).0, trapezoid().breadth()), (1.0, 10.0));
        assert_eq!((Across::Even(3.0).clearance(&at(9.0, 2.0)), Across::Even(3.0).breadth()), ((2.0, 1.0), 3.0));
        assert_eq!(trapezoid().over_the_bed(&at(1.0, 3.5)), 3.5);
    }
}
