//! Which grains have passed the barrier, and which way.

use serde::{Deserialize, Serialize};

use crate::Vec3;
use crate::tables::barrier::Barrier;

/// The face of a rigid wall, whose foot is at x = 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WallFace {
    /// Along the face (m).
    pub height: f64,
    /// m
    pub width: f64,
    /// Upstream from the bed's normal (rad).
    pub lean: f64,
}

/// The way a grain passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Way {
    Through,
    Under,
    Beside,
    Over,
}

/// Number of ways, for arrays indexed by `Way as usize`.
pub const WAYS: usize = 4;

/// The barrier as a surface across the channel: rows from the bottom up, each a line of points from one side
/// to the other.
#[derive(Clone, Debug, Default)]
pub struct Screen {
    rows: Vec<Vec<Vec3>>,
    nearest_x: f64,
}

impl Screen {
    /// The screen that the knots of a net form now.
    pub fn of_net(barrier: &Barrier, rows: &[Vec<u32>]) -> Self {
        let rows: Vec<Vec<Vec3>> =
            rows.iter().map(|row| row.iter().map(|&node| barrier.nodes[node as usize].position).collect()).collect();
        let nearest_x = rows.iter().flatten().map(|point| point.x).fold(f64::INFINITY, f64::min);
        Self { rows, nearest_x }
    }

    /// A wall with its foot at x = 0.
    pub fn of_wall(wall: &WallFace) -> Self {
        let (sine, cosine) = libm::sincos(wall.lean);
        let row = |up: f64| [0.0, wall.width].map(|across| Vec3::new(-sine * up, across, cosine * up)).to_vec();
        Self { rows: vec![row(0.0), row(wall.height)], nearest_x: (-sine * wall.height).min(0.0) }
    }

    /// How a grain of the given radius at `point` has passed, if it has.
    pub fn way_of(&self, point: &Vec3, radius: f64) -> Option<Way> {
        if point.x <= self.nearest_x + radius {
            return None;
        }
        let behind = |x: f64| point.x > x + radius;
        let (edge, outwards) = self.edge(point.y);
        if let Some(side) = at_height(&edge, point.z).filter(|side| (point.y - side.y) * outwards > 0.0) {
            return behind(side.x).then_some(Way::Beside);
        }
        let profile: Vec<Vec3> = self.rows.iter().filter_map(|row| at_width(row, point.y)).collect();
        let (low, high) = (profile.first()?, profile.last()?);
        match at_height(&profile, point.z) {
            Some(screen) => behind(screen.x).then_some(Way::Through),
            None if point.z > high.z => behind(high.x).then_some(Way::Over),
            None => behind(low.x).then_some(Way::Under),
        }
    }

    /// The edge of the screen on the side of `y`, and the sign of y that leads away from it.
    fn edge(&self, y: f64) -> (Vec<Vec3>, f64) {
        let ends = |row: &Vec<Vec3>| Some((*row.first()?, *row.last()?));
        let middle = self.rows.first().and_then(ends).map_or(0.0, |(a, b)| 0.5 * (a.y + b.y));
        let first_side = y < middle;
        let edge = self.rows.iter().filter_map(ends).map(|(a, b)| if first_side { a } else { b });
        (edge.collect(), if first_side { -1.0 } else { 1.0 })
    }
}

/// The point of a row at width `y`; beyond its ends, the end.
fn at_width(row: &[Vec3], y: f64) -> Option<Vec3> {
    let upper = row.partition_point(|point| point.y < y);
    let (Some(a), Some(b)) = (upper.checked_sub(1).and_then(|index| row.get(index)), row.get(upper)) else {
        return if upper == 0 { row.first().copied() } else { row.last().copied() };
    };
    let share = (y - a.y) / (b.y - a.y);
    Some(a + (b - a) * share)
}

/// The point at height `z` of a line that may fold over itself: the furthest downstream of several.
fn at_height(line: &[Vec3], z: f64) -> Option<Vec3> {
    let crossing = |pair: &[Vec3]| {
        let (a, b) = (pair[0], pair[1]);
        let inside = (a.z - z) * (b.z - z) <= 0.0 && a.z != b.z;
        inside.then(|| a + (b - a) * ((z - a.z) / (b.z - a.z)))
    };
    line.windows(2).filter_map(crossing).max_by(|a, b| a.x.total_cmp(&b.x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tells_the_four_ways_apart() {
        let rows = [(0.5, 0.0), (1.5, 1.0), (2.5, 0.0)]
            .map(|(z, bulge)| vec![Vec3::new(0.0, 1.0, z), Vec3::new(bulge, 2.0, z), Vec3::new(0.0, 3.0, z)]);
        let screen = Screen { rows: rows.to_vec(), nearest_x: 0.0 };
        let way = |x, y, z| screen.way_of(&Vec3::new(x, y, z), 0.1);
        assert_eq!(way(0.8, 2.0, 1.5), None);
        assert_eq!(way(1.2, 2.0, 1.5), Some(Way::Through));
        assert_eq!(way(0.5, 2.0, 0.2), Some(Way::Under));
        assert_eq!(way(0.5, 2.0, 2.8), Some(Way::Over));
        assert_eq!(way(0.5, 0.4, 1.5), Some(Way::Beside));
        assert_eq!(way(0.05, 0.4, 1.5), None);
        // Outside all rows in width, and above or below the screen.
        assert_eq!(way(0.5, 0.4, 2.8), Some(Way::Over));
        assert_eq!(way(0.5, 0.4, 0.2), Some(Way::Under));
    }
}
