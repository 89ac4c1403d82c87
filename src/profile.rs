//! The bed along a channel: reaches of even slope, with sharp or rounded breaks between them.
//!
//! X runs level, downstream from the barrier's foot, and Z plumb upwards. A break that is rounded is a parabola over its length, on which the
//! slope changes evenly.

/// Change of slope within one straight piece of a rounded break (tan).
const FINEST: f64 = 0.02;
/// Pieces of a rounded break at the most.
const MOST_PIECES: f64 = 16.0;

/// A bed (m).
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// (X, Z) of its corners, X rising; the foot of the barrier, (0, 0), is among them.
    corners: Vec<[f64; 2]>,
    /// Slope of the first and of the last reach, which go on for ever (tan, falling downstream).
    ends: [f64; 2],
}

/// A place on the bed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BedPoint {
    /// Level and plumb (m).
    pub x: f64,
    pub z: f64,
    /// Slope there, falling downstream (rad).
    pub slope: f64,
}

/// From how far upstream or downstream of the barrier (m, level) the bed has which slope (rad).
pub type Reach = [f64; 2];

impl Profile {
    /// With `slope` (rad) at the barrier, other reaches upstream and downstream of it, each list with rising distances, and breaks that are
    /// rounded over a level length (m), half of it on either side.
    pub fn new(slope: f64, upstream: &[Reach], downstream: &[Reach], rounding: f64) -> Self {
        let side = |reaches: &[Reach], direction: f64| -> (Vec<[f64; 2]>, f64) {
            let mut corners = Vec::new();
            let (mut place, mut level, mut falls) = (0.0, 0.0, libm::tan(slope));
            for [distance, slope] in reaches {
                let next = libm::tan(*slope);
                let half = 0.5 * rounding;
                let pieces = match rounding > 0.0 {
                    true => ((next - falls).abs() / FINEST).ceil().clamp(1.0, MOST_PIECES),
                    false => 1.0,
                };
                // Straight to where the break begins, then in pieces whose slopes change evenly.
                for piece in 0..=pieces as usize {
                    let to = distance - half + rounding * piece as f64 / pieces;
                    let share = (piece as f64 - 0.5).max(0.0) / pieces;
                    let slope_here = if piece == 0 { falls } else { falls + (next - falls) * share };
                    level -= direction * slope_here * (to - place);
                    if to > place {
                        corners.push([direction * to, level]);
                    }
                    place = to;
                }
                falls = next;
            }
            (corners, falls)
        };
        let (mut corners, first) = side(upstream, -1.0);
        let (after, last) = side(downstream, 1.0);
        corners.reverse();
        corners.push([0.0, 0.0]);
        corners.extend(after);
        Self { corners, ends: [first, last] }
    }

    /// Through corners (X, Z) that rise upstream, (0, 0) among them; the first and the last reach go on.
    pub fn through(corners: &[[f64; 2]]) -> Self {
        let falls = |pair: &[[f64; 2]]| (pair[0][1] - pair[1][1]) / (pair[1][0] - pair[0][0]);
        let ends = match corners.len() {
            0 | 1 => [0.0; 2],
            count => [falls(&corners[..2]), falls(&corners[count - 2..])],
        };
        Self { corners: corners.to_vec(), ends }
    }

    pub fn corners(&self) -> &[[f64; 2]] {
        &self.corners
    }

    /// The piece of the bed at a place: its first end, and its slope (tan). At a corner the one downstream of it.
    fn piece(&self, x: f64) -> ([f64; 2], f64) {
        let after = self.corners.partition_point(|corner| corner[0] <= x);
        match (after.checked_sub(1).map(|before| self.corners[before]), self.corners.get(after)) {
            (Some(from), Some(to)) => (from, (from[1] - to[1]) / (to[0] - from[0])),
            (Some(from), None) => (from, self.ends[1]),
            (None, Some(to)) => (*to, self.ends[0]),
            (None, None) => ([0.0, 0.0], self.ends[1]),
        }
    }

    /// Z of the bed (m).
    pub fn elevation(&self, x: f64) -> f64 {
        let (from, falls) = self.piece(x);
        from[1] - falls * (x - from[0])
    }

    /// tan of its slope, falling downstream.
    pub fn falls(&self, x: f64) -> f64 {
        self.piece(x).1
    }

    /// The place at a distance along the bed (m), upstream of the foot where it is negative.
    pub fn at(&self, along: f64) -> BedPoint {
        let downstream = along >= 0.0;
        let foot = self.corners.iter().position(|corner| corner[0] == 0.0).unwrap_or(0);
        let path: Vec<[f64; 2]> = match downstream {
            true => self.corners[foot..].to_vec(),
            false => self.corners[..=foot].iter().rev().copied().collect(),
        };
        let mut left = along.abs();
        for pair in path.windows(2) {
            let [across, rise] = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
            let length = libm::hypot(across, rise);
            if left <= length {
                let share = left / length;
                let slope = libm::atan(-rise / across);
                return BedPoint { x: pair[0][0] + share * across, z: pair[0][1] + share * rise, slope };
            }
            left -= length;
        }
        let falls = self.ends[usize::from(downstream)];
        let slope = libm::atan(falls);
        let end = path[path.len() - 1];
        let level = left * libm::cos(slope) * if downstream { 1.0 } else { -1.0 };
        BedPoint { x: end[0] + level, z: end[1] - falls * level, slope }
    }

    /// What gravity less a friction (tan φ) gives a body on its way down to the foot from a distance along the bed upstream: half the gain
    /// in v² over g, ΔZ − tan φ ΔX (m).
    pub fn gain(&self, upstream: f64, friction: f64) -> f64 {
        let start = self.at(-upstream);
        start.z + friction * start.x
    }

    /// The largest of these gains from any place between the foot and a distance, 0 at the foot itself (m).
    pub fn largest_gain(&self, upstream: f64, friction: f64) -> f64 {
        let start = self.at(-upstream);
        let corners = self.corners.iter().filter(|corner| corner[0] > start.x && corner[0] <= 0.0);
        corners.map(|[x, z]| z + friction * x).chain([start.z + friction * start.x]).fold(0.0, f64::max)
    }

    /// Slope of the flattest reach between the foot and a distance along the bed upstream (rad).
    pub fn flattest(&self, upstream: f64) -> f64 {
        let start = self.at(-upstream);
        let mut places: Vec<f64> =
            self.corners.iter().map(|corner| corner[0]).filter(|x| *x > start.x && *x < 0.0).collect();
        places.extend([start.x, 0.0]);
        places.sort_by(f64::total_cmp);
        let falls = places.windows(2).map(|pair| self.falls(0.5 * (pair[0] + pair[1])));
        libm::atan(falls.fold(f64::INFINITY, f64::min))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const fn degrees(angle: f64) -> f64 {
        angle * std::f64::consts::PI / 180.0
    }

    #[test]
    fn an_even_bed_is_a_line() {
        let bed = Profile::new(degrees(20.0), &[], &[], 0.0);
        let there = bed.at(-10.0);
        assert_relative_eq!(there.x, -10.0 * libm::cos(degrees(20.0)), max_relative = 1e-12);
        assert_relative_eq!(there.z, 10.0 * libm::sin(degrees(20.0)), max_relative = 1e-12);
        assert_relative_eq!(bed.elevation(7.0), -7.0 * libm::tan(degrees(20.0)), max_relative = 1e-12);
        // g (sin α − tan φ cos α) s
        let by_hand = 10.0 * (libm::sin(degrees(20.0)) - 0.5 * libm::cos(degrees(20.0)));
        assert_relative_eq!(bed.gain(10.0, 0.5), by_hand, max_relative = 1e-12);
    }

    /// 18° at the barrier, 14° from 25 m upstream on, 30° from 5 m downstream on.
    #[test]
    fn reaches_join_at_their_breaks() {
        let bed = Profile::new(degrees(18.0), &[[25.0, degrees(14.0)]], &[[5.0, degrees(30.0)]], 0.0);
        let [steep, flat, last] = [18.0, 14.0, 30.0].map(|angle| libm::tan(degrees(angle)));
        assert_relative_eq!(bed.elevation(-25.0), 25.0 * steep, max_relative = 1e-12);
        assert_relative_eq!(bed.elevation(-40.0), 25.0 * steep + 15.0 * flat, max_relative = 1e-12);
        assert_relative_eq!(bed.elevation(8.0), -5.0 * steep - 3.0 * last, max_relative = 1e-12);
        assert_eq!(bed.corners().len(), 3);
        for x in [-60.0, -25.0, -3.0, 0.0, 2.0, 5.0, 9.0] {
            let along = if x < 0.0 { -1.0 } else { 1.0 };
            let length = match x {
                x if x < -25.0 => 25.0 * libm::hypot(1.0, steep) + (-25.0 - x) * libm::hypot(1.0, flat),
                x if x <= 5.0 => x.abs() * libm::hypot(1.0, steep),
                x => 5.0 * libm::hypot(1.0, steep) + (x - 5.0) * libm::hypot(1.0, last),
            };
            let there = bed.at(along * length);
            assert_relative_eq!(there.x, x, epsilon = 1e-9);
            assert_relative_eq!(there.z, bed.elevation(x), epsilon = 1e-9);
        }
    }

    /// A flat reach before a steep one: what comes to rest on the flat gains what the steep one gives.
    #[test]
    fn the_largest_gain_is_from_where_nothing_stops_it() {
        let bed = Profile::new(degrees(40.0), &[[8.0, degrees(5.0)]], &[], 0.0);
        let friction = libm::tan(degrees(22.0));
        let by_hand = 8.0 * (libm::tan(degrees(40.0)) - friction);
        assert_relative_eq!(bed.largest_gain(40.0, friction), by_hand, max_relative = 1e-12);
        assert!(bed.gain(40.0, friction) < 0.5 * by_hand);
        assert_relative_eq!(bed.largest_gain(4.0, friction), bed.gain(4.0, friction), max_relative = 1e-12);
        assert_relative_eq!(bed.flattest(40.0), degrees(5.0), max_relative = 1e-12);
        assert_relative_eq!(bed.flattest(4.0), degrees(40.0), max_relative = 1e-12);
    }

    /// A parabola: beyond it the bed is where it would be with a sharp break.
    #[test]
    fn a_rounded_break_changes_the_slope_evenly() {
        let sharp = Profile::new(degrees(10.0), &[[20.0, degrees(25.0)]], &[], 0.0);
        let round = Profile::new(degrees(10.0), &[[20.0, degrees(25.0)]], &[], 6.0);
        for x in [-40.0, -23.0, -17.0, -5.0] {
            assert_relative_eq!(round.elevation(x), sharp.elevation(x), max_relative = 1e-9);
        }
        let [before, after] = [10.0, 25.0].map(|angle| libm::tan(degrees(angle)));
        // In the middle the parabola stands an eighth of length times change above the break.
        let above = round.elevation(-20.0) - sharp.elevation(-20.0);
        assert_relative_eq!(above, 6.0 / 8.0 * (after - before), max_relative = 0.01);
        let steps: Vec<f64> =
            round.corners().windows(2).map(|pair| (pair[0][1] - pair[1][1]) / (pair[1][0] - pair[0][0])).collect();
        assert!(steps.windows(2).all(|pair| pair[1] < pair[0] + 1e-12), "{steps:?}");
    }
}
