//! The outline of a net in its own plane: the ground that it is cut to, from the top of one bank to that of the other.

use crate::section::Survey;

/// A point of the barrier's plane: distance across the channel from where the section begins, and height along the plane (m).
pub type Point = [f64; 2];

/// A part of the outline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// Along the right bank and along the left one, looking downstream.
    Bank(usize),
    /// Along the lowest rope.
    Bottom,
}

/// Right bank and left bank, each from the bottom upwards, and the bottom from the right to the left.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    pub banks: [Vec<Point>; 2],
    pub bottom: Vec<Point>,
}

/// Where a line leaves the net.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    pub edge: Edge,
    /// Way along the edge to it (m).
    pub way: f64,
}

impl Outline {
    /// Of a net in a section: `up` turns a height over the bed into one along the plane, `gap` is left at either side; with an `opening`
    /// the lower edge is level at its height, else it follows the bed.
    pub fn new(survey: &Survey, up: impl Fn(f64) -> f64, top: f64, gap: f64, opening: Option<f64>) -> Self {
        let points = survey.points();
        let bed = match opening {
            Some(height) => survey.banks(height).map(|y| [y, height]).to_vec(),
            None => survey.bed().to_vec(),
        };
        let [first, last] = [bed[0], bed[bed.len() - 1]];
        let inwards = |side: usize| if side == 0 { gap } else { -gap };
        let bank = |side: usize| {
            let start = [first, last][side];
            let outer = |point: &&[f64; 2]| if side == 0 { point[0] <= start[0] } else { point[0] >= start[0] };
            let mut line: Vec<Point> = points.iter().filter(outer).copied().filter(|point| *point != start).collect();
            if side == 0 {
                line.reverse();
            }
            // What lies lower than the start, outside it, is none of this bank: the walk begins where the ground has come up.
            let begins = line.iter().position(|point| point[1] >= start[1]).unwrap_or(line.len());
            let line = [start].into_iter().chain(line.into_iter().skip(begins));
            let in_plane: Vec<Point> = line.map(|[y, z]| [y + inwards(side), up(z)]).collect();
            below(&in_plane, top)
        };
        let bottom = bed.iter().map(|[y, z]| [y.clamp(first[0] + gap, last[0] - gap), up(*z)]).collect();
        Self { banks: [bank(0), bank(1)], bottom }
    }

    fn line(&self, edge: Edge) -> &[Point] {
        match edge {
            Edge::Bank(side) => &self.banks[side],
            Edge::Bottom => &self.bottom,
        }
    }

    fn edges(&self) -> impl Iterator<Item = (Edge, &[Point])> {
        [Edge::Bank(0), Edge::Bottom, Edge::Bank(1)].into_iter().map(|edge| (edge, self.line(edge)))
    }

    /// Whether a point is above the ground and between the banks.
    pub fn is_inside(&self, point: Point) -> bool {
        // A line from the point straight down meets the outline an odd number of times.
        let meets = |pair: &[Point]| {
            let ([y1, u1], [y2, u2]) = (pair[0], pair[1]);
            (y1 <= point[0]) != (y2 <= point[0]) && u1 + (u2 - u1) * (point[0] - y1) / (y2 - y1) < point[1]
        };
        let count: usize = self.edges().map(|(_, line)| line.windows(2).filter(|pair| meets(pair)).count()).sum();
        count % 2 == 1
    }

    /// Distance of a point from the nearest part of some edges (m).
    pub fn distance(&self, point: Point, edges: impl Fn(Edge) -> bool) -> f64 {
        let parts = self.edges().filter(|(edge, _)| edges(*edge)).flat_map(|(_, line)| line.windows(2));
        parts.map(|pair| distance(pair, point)).fold(f64::INFINITY, f64::min)
    }

    /// Where a line from a point inside first leaves the net through a bank or the bottom.
    pub fn crossing(&self, from: Point, to: Point) -> Option<Crossing> {
        let mut first: Option<(f64, Crossing)> = None;
        for (edge, line) in self.edges() {
            let mut way = 0.0;
            for pair in line.windows(2) {
                let length = libm::hypot(pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]);
                if let Some([along, across]) = meet([from, to], [pair[0], pair[1]])
                    && first.is_none_or(|(nearest, _)| along < nearest)
                {
                    first = Some((along, Crossing { edge, way: way + across * length }));
                }
                way += length;
            }
        }
        first.map(|(_, crossing)| crossing)
    }

    /// Length of an edge (m).
    pub fn length(&self, edge: Edge) -> f64 {
        self.line(edge).windows(2).map(|pair| libm::hypot(pair[1][0] - pair[0][0], pair[1][1] - pair[0][1])).sum()
    }

    /// The point after a way along an edge.
    pub fn point(&self, edge: Edge, way: f64) -> Point {
        let line = self.line(edge);
        let mut left = way;
        for pair in line.windows(2) {
            let length = libm::hypot(pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]);
            if left <= length {
                return [0, 1].map(|axis| pair[0][axis] + (pair[1][axis] - pair[0][axis]) * (left / length).max(0.0));
            }
            left -= length;
        }
        line.last().copied().unwrap_or_default()
    }

    /// Way along a bank, from the bottom, to where it first reaches a height along the plane (m).
    pub fn way_to(&self, side: usize, up: f64) -> f64 {
        let mut way = 0.0;
        for pair in self.banks[side].windows(2) {
            let length = libm::hypot(pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]);
            let rise = pair[1][1] - pair[0][1];
            if pair[1][1] >= up - 1e-9 && rise > 0.0 {
                return way + length * ((up - pair[0][1]) / rise).clamp(0.0, 1.0);
            }
            way += length;
        }
        way
    }
}

/// The line up to where it first reaches the top.
fn below(line: &[Point], top: f64) -> Vec<Point> {
    let mut kept = vec![line[0]];
    for pair in line.windows(2) {
        let rise = pair[1][1] - pair[0][1];
        if pair[1][1] >= top && rise > 0.0 {
            let share = ((top - pair[0][1]) / rise).clamp(0.0, 1.0);
            kept.push([pair[0][0] + (pair[1][0] - pair[0][0]) * share, top]);
            break;
        }
        kept.push(pair[1]);
    }
    kept
}

fn distance(pair: &[Point], point: Point) -> f64 {
    let [along, from] =
        [[pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]], [point[0] - pair[0][0], point[1] - pair[0][1]]];
    let square = along[0] * along[0] + along[1] * along[1];
    let share = if square > 0.0 { ((from[0] * along[0] + from[1] * along[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
    libm::hypot(from[0] - share * along[0], from[1] - share * along[1])
}

/// Shares of the way along two lines at which they cross, if they do.
fn meet(one: [Point; 2], other: [Point; 2]) -> Option<[f64; 2]> {
    let [a, b] = [one, other].map(|[from, to]| [to[0] - from[0], to[1] - from[1]]);
    let between = [other[0][0] - one[0][0], other[0][1] - one[0][1]];
    let turn = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let both = turn(a, b);
    if both == 0.0 {
        return None;
    }
    let shares = [turn(between, b) / both, turn(between, a) / both];
    (shares[0] >= 0.0 && shares[0] <= 1.0 && shares[1] >= -1e-12 && shares[1] <= 1.0 + 1e-12).then_some(shares)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Bed of 4 m, banks of 45°, 5 m high; the net is 3 m high and leaves 0.1 m.
    fn outline(opening: Option<f64>) -> Outline {
        let survey = Survey::new(&[[-7.0, 5.0], [-2.0, 0.0], [2.0, 0.0], [7.0, 5.0]], 0.0);
        Outline::new(&survey, |z| z - opening.unwrap_or(0.0), 3.0, 0.1, opening)
    }

    #[test]
    fn a_net_is_cut_to_its_banks() {
        let outline = outline(None);
        assert_eq!(outline.bottom, [[5.1, 0.0], [8.9, 0.0]]);
        for (found, by_hand) in outline.banks[0].iter().zip([[5.1, 0.0], [2.1, 3.0]]) {
            assert_relative_eq!(found[0], by_hand[0], max_relative = 1e-12);
            assert_relative_eq!(found[1], by_hand[1], epsilon = 1e-12);
        }
        assert!(outline.is_inside([7.0, 1.0]) && outline.is_inside([3.5, 2.0]));
        assert!(!outline.is_inside([3.5, 1.0]) && !outline.is_inside([7.0, -0.1]));
        // From (7, 1) downwards to the right at 45° to the bed; level to the right bank.
        let down = outline.crossing([7.0, 1.0], [5.5, -0.5]).expect("the bed");
        assert_eq!(down.edge, Edge::Bottom);
        assert_relative_eq!(down.way, 0.9, max_relative = 1e-12);
        let level = outline.crossing([7.0, 1.0], [2.0, 1.0]).expect("the right bank");
        assert_eq!(level.edge, Edge::Bank(0));
        assert_relative_eq!(level.way, 2_f64.sqrt(), max_relative = 1e-12);
        assert_relative_eq!(outline.point(Edge::Bank(0), level.way)[0], 4.1, max_relative = 1e-12);
        assert_relative_eq!(outline.way_to(1, 2.0), 8_f64.sqrt(), max_relative = 1e-12);
        assert_relative_eq!(outline.distance([7.0, 1.0], |_| true), 1.0, max_relative = 1e-12);
        assert_eq!(outline.crossing([7.0, 1.0], [7.2, 1.2]), None);
    }

    #[test]
    fn over_an_opening_the_lower_edge_is_level_and_wider() {
        let outline = outline(Some(0.5));
        assert_eq!(outline.bottom, [[4.6, 0.0], [9.4, 0.0]]);
        assert_relative_eq!(outline.banks[1][1][0], 9.4 + 3.0, max_relative = 1e-12);
    }
}
