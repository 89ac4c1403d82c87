//! The cross-section of a channel, normal to its bed: ground over the width, and what follows for a level surface at a height.
//!
//! y runs across the channel from the right bank to the left (x is downstream and z up), z from the lowest point of the bed upwards. Where
//! g(y) is the ground, a level surface at z spans w(z), and under it lie
//!
//! A(z) = ∫ w dz = ∫ max(0, z − g) dy  and  S(z) = ∫ A dz = ½ ∫ max(0, z − g)² dy,
//!
//! the area and its first moment about the surface. A rectangle of width b has A = b z and S = ½ b z².

/// A cross-section; lengths in m.
#[derive(Clone, Debug, PartialEq)]
pub enum Section {
    /// Vertical walls that are as high as one likes, over a level bed.
    Rectangle {
        width: f64,
    },
    Surveyed(Survey),
}

/// A section given by points.
#[derive(Clone, Debug, PartialEq)]
pub struct Survey {
    /// (y, z) from the right bank to the left, y never falling; the lowest z is 0.
    points: Vec<[f64; 2]>,
    /// The points between which the ground is bed; beyond them it is bank.
    bed: [usize; 2],
    /// Where y = 0 lies as it was surveyed, to the right looking downstream.
    datum: f64,
    levels: Vec<Level>,
}

/// A strip of ground between two points of a survey.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strip {
    pub ends: [[f64; 2]; 2],
    pub is_bed: bool,
}

impl Survey {
    /// From points of (distance to the right, height) as they are listed looking downstream, from the left to the right, heights normal to the
    /// bed; strips flatter than `steepest` (rad) beside the lowest point are bed.
    pub fn new(listed: &[[f64; 2]], steepest: f64) -> Self {
        let datum = listed.iter().map(|point| point[0]).fold(f64::NEG_INFINITY, f64::max);
        let lowest = listed.iter().map(|point| point[1]).fold(f64::INFINITY, f64::min);
        let points: Vec<[f64; 2]> = listed.iter().rev().map(|[right, up]| [datum - right, up - lowest]).collect();
        let deepest = points.iter().position(|point| point[1] <= 0.0).unwrap_or(0);
        let flat =
            |pair: &[[f64; 2]]| (pair[1][1] - pair[0][1]).abs() <= libm::tan(steepest) * (pair[1][0] - pair[0][0]);
        let outwards = |path: &[usize]| {
            let mut end = 0;
            while end + 1 < path.len() {
                let pair = [path[end].min(path[end + 1]), path[end].max(path[end + 1])];
                let level = points[path[end]][1];
                let back = (end + 1..path.len()).find(|&next| points[path[next]][1] <= level);
                end = match back {
                    _ if flat(&points[pair[0]..=pair[1]]) => end + 1,
                    // A step in the bed, beyond which it goes on.
                    Some(back) => back,
                    None => break,
                };
            }
            path[end]
        };
        let first = outwards(&(0..=deepest).rev().collect::<Vec<_>>());
        let last = outwards(&(deepest..points.len()).collect::<Vec<_>>());
        Self { levels: levels(&points), points, bed: [first, last], datum }
    }

    /// A level bed between vertical walls (m).
    pub fn between_walls(width: f64, height: f64) -> Self {
        let (left, right) = (-0.5 * width, 0.5 * width);
        Self::new(&[[left, height], [left, 0.0], [right, 0.0], [right, height]], 0.0)
    }

    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// y as surveyed, to the right looking downstream (m).
    pub fn surveyed(&self, y: f64) -> f64 {
        self.datum - y
    }

    pub fn strips(&self) -> impl Iterator<Item = Strip> + '_ {
        self.points.windows(2).enumerate().map(|(index, pair)| Strip {
            ends: [pair[0], pair[1]],
            is_bed: (self.bed[0]..self.bed[1]).contains(&index),
        })
    }

    /// The ground between the banks, from the right to the left.
    pub fn bed(&self) -> &[[f64; 2]] {
        &self.points[self.bed[0]..=self.bed[1]]
    }

    /// Height of the lower of the two banks where the survey ends (m).
    pub fn lower_end(&self) -> f64 {
        let end = |point: Option<&[f64; 2]>| point.map_or(0.0, |point| point[1]);
        end(self.points.first()).min(end(self.points.last()))
    }

    /// Height of the ground (m); beyond the ends that of the end.
    pub fn ground(&self, y: f64) -> f64 {
        let after = self.points.partition_point(|point| point[0] < y);
        match (after.checked_sub(1).map(|before| self.points[before]), self.points.get(after)) {
            (Some(a), Some(b)) if b[0] > a[0] => a[1] + (b[1] - a[1]) * (y - a[0]) / (b[0] - a[0]),
            (Some(a), None) => a[1],
            (_, Some(b)) => b[1],
            (None, None) => 0.0,
        }
    }

    /// Where a level line at z meets the right and the left bank: going outwards from the lowest point (m).
    pub fn banks(&self, z: f64) -> [f64; 2] {
        let deepest = self.points.iter().position(|point| point[1] <= 0.0).unwrap_or(0);
        let crossing = |from: [f64; 2], to: [f64; 2]| {
            (to[1] >= z).then(|| match to[1] - from[1] {
                rise if rise > 0.0 => from[0] + (to[0] - from[0]) * ((z - from[1]) / rise).clamp(0.0, 1.0),
                _ => to[0],
            })
        };
        // A level line on a level bed ends where the bed does.
        let rises = |to: [f64; 2]| to[1] > z || (to[1] >= z && z > 0.0);
        let outwards = |path: &mut dyn Iterator<Item = usize>| {
            let mut from = self.points[deepest];
            for index in path {
                let to = self.points[index];
                if rises(to) {
                    return crossing(from, to).unwrap_or(to[0]);
                }
                from = to;
            }
            from[0]
        };
        [outwards(&mut (0..deepest).rev()), outwards(&mut (deepest + 1..self.points.len()))]
    }

    /// What a level surface at z spans, over the last kink below it: width, its gain with height, area and moment there, and the height over it.
    fn over_a_kink(&self, z: f64) -> Option<(&Level, f64)> {
        let level = self.levels.partition_point(|level| level.z < z).checked_sub(1).map(|below| &self.levels[below])?;
        Some((level, z - level.z))
    }

    fn area(&self, z: f64) -> f64 {
        self.over_a_kink(z).map_or(0.0, |(level, up)| level.area + up * (level.width + 0.5 * level.gain * up))
    }

    fn moment(&self, z: f64) -> f64 {
        self.over_a_kink(z).map_or(0.0, |(level, up)| {
            level.moment + up * (level.area + up * (0.5 * level.width + level.gain * up / 6.0))
        })
    }

    fn width(&self, z: f64) -> f64 {
        self.over_a_kink(z).map_or(0.0, |(level, up)| level.width + level.gain * up)
    }
}

/// A height at which w(z) has a kink, and what is there for what lies just above it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Level {
    z: f64,
    /// w (m) and dw/dz.
    width: f64,
    gain: f64,
    /// A (m²) and S (m³).
    area: f64,
    moment: f64,
}

/// The kinks of w(z), rising: the heights of the points.
fn levels(points: &[[f64; 2]]) -> Vec<Level> {
    let mut heights: Vec<f64> = points.iter().map(|point| point[1]).collect();
    heights.sort_by(f64::total_cmp);
    heights.dedup();
    let at = |z: f64| heights.partition_point(|height| *height < z);
    let mut levels: Vec<Level> =
        heights.iter().map(|z| Level { z: *z, width: 0.0, gain: 0.0, area: 0.0, moment: 0.0 }).collect();
    // Width of all strips that are wholly below a level from there on.
    let mut whole = vec![0.0; levels.len()];
    for pair in points.windows(2) {
        let width = pair[1][0] - pair[0][0];
        let [low, high] = [pair[0][1].min(pair[1][1]), pair[0][1].max(pair[1][1])];
        whole[at(high)] += width;
        for level in &mut levels[at(low)..at(high)] {
            level.width += width * (level.z - low) / (high - low);
            level.gain += width / (high - low);
        }
    }
    let (mut below, mut before) = (0.0, None::<Level>);
    for (level, whole) in levels.iter_mut().zip(whole) {
        below += whole;
        level.width += below;
        if let Some(Level { z, width, gain, area, moment }) = before {
            let up = level.z - z;
            level.area = area + up * (width + 0.5 * gain * up);
            level.moment = moment + up * (area + up * (0.5 * width + gain * up / 6.0));
        }
        before = Some(*level);
    }
    levels
}

impl Section {
    /// Width of a level surface w(z) (m). At the lowest point it is that of the level bed, if there is one.
    pub fn width(&self, z: f64) -> f64 {
        match self {
            Self::Rectangle { width } => *width,
            Self::Surveyed(survey) if z <= 0.0 => survey.banks(0.0)[1] - survey.banks(0.0)[0],
            Self::Surveyed(survey) => survey.width(z),
        }
    }

    /// Area under a level surface A(z) (m²).
    pub fn area(&self, z: f64) -> f64 {
        match self {
            Self::Rectangle { width } => width * z.max(0.0),
            Self::Surveyed(survey) => survey.area(z),
        }
    }

    /// First moment of that area about the surface S(z) (m³).
    pub fn moment(&self, z: f64) -> f64 {
        match self {
            Self::Rectangle { width } => 0.5 * width * z.max(0.0).powi(2),
            Self::Surveyed(survey) => survey.moment(z),
        }
    }

    /// Height of the surface over an area (m).
    pub fn height_of_area(&self, area: f64) -> f64 {
        match self {
            Self::Rectangle { width } => area / width,
            Self::Surveyed(survey) => inverse(|z| survey.area(z), area),
        }
    }

    /// Depth of a volume (m³) over a length along the channel (m).
    pub fn depth_of(&self, volume: f64, length: f64) -> f64 {
        match self {
            Self::Rectangle { width } => volume / (length * width),
            Self::Surveyed(_) => self.height_of_area(volume / length),
        }
    }

    /// Height of the surface over a first moment (m).
    pub fn height_of_moment(&self, moment: f64) -> f64 {
        match self {
            Self::Rectangle { width } => (2.0 * moment / width).sqrt(),
            Self::Surveyed(survey) => inverse(|z| survey.moment(z), moment),
        }
    }

    /// Width that a rectangle of the same area has up to a height, A/z (m).
    pub fn mean_width(&self, z: f64) -> f64 {
        match self {
            Self::Rectangle { width } => *width,
            Self::Surveyed(survey) => survey.area(z) / z,
        }
    }

    /// Ends of a level line between the banks, from the right to the left (m).
    pub fn banks(&self, z: f64) -> [f64; 2] {
        match self {
            Self::Rectangle { width } => [0.0, *width],
            Self::Surveyed(survey) => survey.banks(z),
        }
    }

    /// Ends of the bed, between the banks (m).
    pub fn bed_ends(&self) -> [f64; 2] {
        match self {
            Self::Rectangle { width } => [0.0, *width],
            Self::Surveyed(survey) => {
                let bed = survey.bed();
                [bed[0][0], bed[bed.len() - 1][0]]
            }
        }
    }

    /// Width of the bed, between the banks (m).
    pub fn bed_width(&self) -> f64 {
        let [right, left] = self.bed_ends();
        left - right
    }

    /// Length of the ground of the bed across the channel (m).
    pub fn bed_length(&self) -> f64 {
        match self {
            Self::Rectangle { width } => *width,
            Self::Surveyed(survey) => {
                let length = |pair: &[[f64; 2]]| libm::hypot(pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]);
                survey.bed().windows(2).map(length).sum()
            }
        }
    }

    /// From the one end to the other (m).
    pub fn breadth(&self) -> f64 {
        match self {
            Self::Rectangle { width } => *width,
            Self::Surveyed(survey) => survey.points.last().map_or(0.0, |point| point[0]),
        }
    }

    /// Area that is under a level surface and deeper than `least` (m²).
    pub fn deep_area(&self, z: f64, least: f64) -> f64 {
        self.area(z - least) + least * self.width((z - least).max(0.0))
    }

    /// Heights at which w(z) has a kink, rising (m).
    pub fn kinks(&self) -> Vec<f64> {
        match self {
            Self::Rectangle { .. } => Vec::new(),
            Self::Surveyed(survey) => survey.levels.iter().map(|level| level.z).collect(),
        }
    }
}

/// The argument of a rising function that is 0 at 0, by bisection.
fn inverse(function: impl Fn(f64) -> f64, value: f64) -> f64 {
    if value.is_nan() || value <= 0.0 {
        return value.max(0.0);
    }
    let (mut low, mut high) = (0.0, 1.0);
    while function(high) < value && high < 1e12 {
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if function(middle) < value { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    const FLAT: f64 = 0.4;

    fn surveyed(points: &[[f64; 2]]) -> Section {
        Section::Surveyed(Survey::new(points, FLAT))
    }

    /// Bed of 4 m, banks of 1 : 1 on the left and 1 : 2 on the right: w = 4 + 3 z, A = 4 z + 1.5 z², S = 2 z² + 0.5 z³.
    fn trapezoid() -> Section {
        surveyed(&[[-7.0, 8.0], [-2.0, 3.0], [2.0, 3.0], [12.0, 8.0]])
    }

    #[test]
    fn a_trapezoid_has_its_width_area_and_moment() {
        let section = trapezoid();
        for z in [0.5, 2.0, 5.0] {
            assert_relative_eq!(section.width(z), 4.0 + 3.0 * z, max_relative = 1e-12);
            assert_relative_eq!(section.area(z), 4.0 * z + 1.5 * z * z, max_relative = 1e-12);
            assert_relative_eq!(section.moment(z), 2.0 * z * z + 0.5 * z * z * z, max_relative = 1e-12);
        }
        assert_eq!((section.width(0.0), section.bed_width(), section.breadth()), (4.0, 4.0, 19.0));
        // The right bank is the flatter one; y runs from it to the left.
        let [right, left] = section.banks(2.0);
        assert_relative_eq!(right, 10.0 - 4.0, max_relative = 1e-12);
        assert_relative_eq!(left, 14.0 + 2.0, max_relative = 1e-12);
        let Section::Surveyed(survey) = section else { panic!("surveyed") };
        assert_relative_eq!(survey.surveyed(right), 6.0, max_relative = 1e-12);
        assert_eq!(survey.strips().map(|strip| strip.is_bed).collect::<Vec<_>>(), [false, true, false]);
        assert_eq!(survey.lower_end(), 5.0);
        // 2 m deep over the bed and as far up as it is half a metre deep: 14 m² less two wedges.
        let section = Section::Surveyed(survey);
        assert_relative_eq!(section.deep_area(2.0, 0.5), 14.0 - 0.125 - 0.25, max_relative = 1e-12);
    }

    #[test]
    fn a_groove_has_no_width_at_its_foot_and_vertical_walls_have_no_width_of_their_own() {
        let groove = surveyed(&[[-3.0, 3.0], [0.0, 0.0], [3.0, 3.0]]);
        assert_eq!(groove.width(0.0), 0.0);
        assert_relative_eq!(groove.area(2.0), 4.0, max_relative = 1e-12);
        let walls = surveyed(&[[0.0, 5.0], [0.0, 0.0], [6.0, 0.0], [6.0, 5.0]]);
        let rectangle = Section::Rectangle { width: 6.0 };
        for z in [0.3, 2.0, 4.0] {
            assert_eq!(walls.width(z), 6.0);
            for (of_walls, of_rectangle, by_hand) in
                [(walls.area(z), rectangle.area(z), 6.0 * z), (walls.moment(z), rectangle.moment(z), 3.0 * z * z)]
            {
                assert_relative_eq!(of_walls, by_hand, max_relative = 1e-12);
                assert_relative_eq!(of_rectangle, by_hand, max_relative = 1e-12);
            }
            assert_eq!(walls.banks(z), rectangle.banks(z));
        }
        assert_eq!((walls.banks(0.0), walls.bed_width()), ([0.0, 6.0], 6.0));
    }

    /// A block with steep sides on a level bed is part of the bed; a terrace above a bank is none.
    #[test]
    fn the_bed_goes_on_beyond_a_step() {
        let bed = |points: &[[f64; 2]]| {
            let section = surveyed(points);
            let [right, left] = section.bed_ends();
            let Section::Surveyed(survey) = section else { panic!("surveyed") };
            [survey.surveyed(left), survey.surveyed(right)]
        };
        let block =
            [[-6.0, 4.0], [-2.0, 0.0], [-0.35, 0.0], [-0.35, 0.14], [0.35, 0.14], [0.35, 0.0], [2.0, 0.0], [6.0, 4.0]];
        assert_eq!(bed(&block), [-2.0, 2.0]);
        let terrace = [[-6.0, 4.0], [-2.0, 0.0], [2.0, 0.0], [3.0, 1.0], [8.0, 1.1], [12.0, 6.0]];
        assert_eq!(bed(&terrace), [-2.0, 2.0]);
    }

    /// A bar of 1 m in the middle of a bed 10 m wide, between vertical walls.
    #[test]
    fn a_level_surface_fills_both_sides_of_a_bar() {
        let bar = surveyed(&[[0.0, 9.0], [0.0, 0.0], [4.0, 0.0], [5.0, 1.0], [6.0, 0.0], [10.0, 0.0], [10.0, 9.0]]);
        assert_relative_eq!(bar.width(0.5), 9.0, max_relative = 1e-12);
        assert_relative_eq!(bar.area(0.5), 4.0 + 2.0 * 0.5 * 0.25, max_relative = 1e-12);
        assert_relative_eq!(bar.area(2.0), 20.0 - 1.0, max_relative = 1e-12);
        assert_eq!(bar.kinks(), [0.0, 1.0, 9.0]);
    }

    #[test]
    fn ground_follows_the_points() {
        let Section::Surveyed(survey) = trapezoid() else { panic!("surveyed") };
        for (y, z) in
            [(-1.0, 5.0), (0.0, 5.0), (5.0, 2.5), (10.0, 0.0), (12.0, 0.0), (15.0, 1.0), (19.0, 5.0), (20.0, 5.0)]
        {
            assert_relative_eq!(survey.ground(y), z, epsilon = 1e-12);
        }
    }

    proptest! {
        /// w is the derivative of A, and A that of S; both are found back by their inverses.
        #[test]
        fn area_and_moment_are_integrals(heights in prop::collection::vec(0.0..5.0_f64, 3..9), z in 0.3..9.0_f64) {
            let points: Vec<[f64; 2]> = heights.iter().enumerate().map(|(index, z)| [1.3 * index as f64, *z]).collect();
            let section = surveyed(&points);
            let step = 1e-5;
            let slope = |of: &dyn Fn(f64) -> f64| (of(z + step) - of(z - step)) / (2.0 * step);
            prop_assert!((slope(&|z| section.area(z)) - section.width(z)).abs() < 1e-3 * section.breadth());
            prop_assert!((slope(&|z| section.moment(z)) - section.area(z)).abs() < 1e-4 * section.area(z).max(1.0));
            prop_assert!((section.height_of_area(section.area(z)) - z).abs() < 1e-9);
            prop_assert!((section.height_of_moment(section.moment(z)) - z).abs() < 1e-9);
            // Fine sums by other means.
            let Section::Surveyed(survey) = &section else { panic!("surveyed") };
            let count = 20_000;
            let across = section.breadth() / f64::from(count);
            let sum: f64 = (0..count).map(|cell| (z - survey.ground((f64::from(cell) + 0.5) * across)).max(0.0) * across).sum();
            prop_assert!((sum - section.area(z)).abs() < 1e-3 * section.area(z).max(1e-2));
        }
    }
}
