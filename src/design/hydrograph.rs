//! The flow by time at an inlet: depth and velocity, straight between the times that are given.

use crate::section::Section;

/// One row of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HydrographPoint {
    /// s
    pub time: f64,
    /// Normal to the bed (m).
    pub depth: f64,
    /// m/s
    pub velocity: f64,
}

/// A moment that loads a barrier as no other does, and what has come before it (m³).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GoverningPoint {
    pub moment: HydrographPoint,
    pub before: f64,
}

/// Times rise from 0; flow comes between the first and the last.
#[derive(Clone, Debug, PartialEq)]
pub struct Hydrograph {
    pub rows: Vec<HydrographPoint>,
    /// The moments than which none is both deeper and faster, that of the largest momentum A v² first.
    pub governing: Vec<GoverningPoint>,
}

/// Parts of an interval over which what passes is summed, by Simpson's rule in each: exact in a rectangle.
const PARTS: usize = 8;

/// Governing moments at the most: beyond that those of like depth are taken together, with the largest depth and velocity of them.
const MOST_GOVERNING: usize = 16;

impl Hydrograph {
    /// Of rows in a section.
    pub fn new(rows: Vec<HydrographPoint>, section: &Section) -> Self {
        let mut hydrograph = Self { rows, governing: Vec::new() };
        let governing = hydrograph.governing_points(section).into_iter();
        hydrograph.governing = governing
            .map(|moment| GoverningPoint { moment, before: hydrograph.volume(section, moment.time) })
            .collect();
        hydrograph
    }

    /// Depth and velocity at a time (s); none before the first and after the last.
    pub fn at(&self, time: f64) -> HydrographPoint {
        let rows = &self.rows;
        let next = rows.partition_point(|row| row.time <= time);
        match (next.checked_sub(1).map(|before| rows[before]), rows.get(next)) {
            (Some(before), Some(next)) => {
                let share = (time - before.time) / (next.time - before.time);
                let between = |from: f64, to: f64| from + share * (to - from);
                HydrographPoint {
                    time,
                    depth: between(before.depth, next.depth),
                    velocity: between(before.velocity, next.velocity),
                }
            }
            (Some(last), None) if last.time == time => last,
            _ => HydrographPoint { time, depth: 0.0, velocity: 0.0 },
        }
    }

    /// Time over which flow comes (s).
    pub fn duration(&self) -> f64 {
        self.rows.last().map_or(0.0, |last| last.time)
    }

    /// Volume that has passed at a time (m³), ∫ A(h) v dt.
    pub fn volume(&self, section: &Section, time: f64) -> f64 {
        self.sum(time, |row| section.area(row.depth) * row.velocity)
    }

    /// ∫ A(h) v² dt up to a time (m⁴/s): times the density the momentum that has passed.
    pub fn momentum(&self, section: &Section, time: f64) -> f64 {
        self.sum(time, |row| section.area(row.depth) * row.velocity * row.velocity)
    }

    /// ∫ S(h) v dt up to a time (m⁴), S being the first moment of the section's area: times the unit weight the work of its static pressure.
    pub fn moment(&self, section: &Section, time: f64) -> f64 {
        self.sum(time, |row| section.moment(row.depth) * row.velocity)
    }

    /// Way of what passes up to a time (m), ∫ v dt.
    pub fn way(&self, time: f64) -> f64 {
        self.sum(time, |row| row.velocity)
    }

    /// Sum over time of what a row passes in a second.
    fn sum(&self, time: f64, rate: impl Fn(HydrographPoint) -> f64) -> f64 {
        let mut sum = 0.0;
        for pair in self.rows.windows(2) {
            let (from, to) = (pair[0].time, pair[1].time.min(time));
            if to <= from {
                break;
            }
            let part = (to - from) / PARTS as f64;
            let inside = |share: f64| {
                let share = (from + share * (to - from) - pair[0].time) / (pair[1].time - pair[0].time);
                let between = |a: f64, b: f64| a + share * (b - a);
                rate(HydrographPoint {
                    time: from,
                    depth: between(pair[0].depth, pair[1].depth),
                    velocity: between(pair[0].velocity, pair[1].velocity),
                })
            };
            for index in 0..PARTS {
                let at = |offset: f64| inside((index as f64 + offset) / PARTS as f64);
                sum += part / 6.0 * (at(0.0) + 4.0 * at(0.5) + at(1.0));
            }
        }
        sum
    }

    /// The time (s) at which a sum that rises with it reaches a value.
    pub fn when(&self, sum: impl Fn(f64) -> f64, value: f64) -> f64 {
        let (mut early, mut late) = (0.0, self.duration());
        for _ in 0..60 {
            let middle = 0.5 * (early + late);
            if sum(middle) < value { early = middle } else { late = middle }
        }
        late
    }

    /// The moments than which none is both deeper and faster, that of the largest momentum A v² first.
    fn governing_points(&self, section: &Section) -> Vec<HydrographPoint> {
        let mut all: Vec<HydrographPoint> = self.rows.windows(2).flat_map(|pair| between(pair[0], pair[1])).collect();
        all.retain(|moment| moment.depth > 0.0 && moment.velocity > 0.0);
        all.sort_by(|a, b| b.depth.total_cmp(&a.depth).then(b.velocity.total_cmp(&a.velocity)));
        let mut fastest = 0.0;
        all.retain(|moment| {
            let faster = moment.velocity > fastest;
            fastest = fastest.max(moment.velocity);
            faster
        });
        let momentum = |moment: &HydrographPoint| section.area(moment.depth) * moment.velocity * moment.velocity;
        let leads = all.iter().copied().max_by(|a, b| momentum(a).total_cmp(&momentum(b)));
        let alike = all.len().div_ceil(MOST_GOVERNING).max(1);
        let together = |some: &[HydrographPoint]| HydrographPoint {
            depth: some[0].depth,
            velocity: some[some.len() - 1].velocity,
            time: some.iter().map(|moment| moment.time).fold(0.0, f64::max),
        };
        let mut governing: Vec<HydrographPoint> = leads.into_iter().collect();
        governing.extend(all.chunks(alike).map(together).filter(|moment| Some(*moment) != leads));
        governing
    }

    /// The same flow in so many times the time.
    pub fn longer(&self, factor: f64) -> Self {
        self.changed(|row| HydrographPoint { time: row.time * factor, ..row }, factor)
    }

    /// The same volume with so many times the velocity, in the less time.
    pub fn faster(&self, factor: f64) -> Self {
        self.changed(|row| HydrographPoint { time: row.time / factor, velocity: row.velocity * factor, ..row }, 1.0)
    }

    fn changed(&self, change: impl Fn(HydrographPoint) -> HydrographPoint, volume: f64) -> Self {
        let governing = |governing: &GoverningPoint| GoverningPoint {
            moment: change(governing.moment),
            before: governing.before * volume,
        };
        Self {
            rows: self.rows.iter().copied().map(&change).collect(),
            governing: self.governing.iter().map(governing).collect(),
        }
    }
}

/// Two rows and eight places between them.
fn between(from: HydrographPoint, to: HydrographPoint) -> Vec<HydrographPoint> {
    let place = |index: u32| {
        let share = f64::from(index) / 9.0;
        let between = |a: f64, b: f64| a + share * (b - a);
        HydrographPoint {
            time: between(from.time, to.time),
            depth: between(from.depth, to.depth),
            velocity: between(from.velocity, to.velocity),
        }
    };
    std::iter::once(from).chain((1..9).map(place)).chain([to]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn row(time: f64, depth: f64, velocity: f64) -> HydrographPoint {
        HydrographPoint { time, depth, velocity }
    }

    /// Up to 1 m and 4 m/s in 2 s, and down in 6 s, 3 m wide: ∫ h v dt of a triangle times a triangle is t/3 of the product of the peaks.
    #[test]
    fn a_triangle_has_its_volume_way_and_momentum() {
        let section = Section::Rectangle { width: 3.0 };
        let table = Hydrograph::new(vec![row(0.0, 0.0, 0.0), row(2.0, 1.0, 4.0), row(8.0, 0.0, 0.0)], &section);
        assert_relative_eq!(table.volume(&section, 2.0), 3.0 * 2.0 * 4.0 / 3.0, max_relative = 1e-12);
        assert_relative_eq!(table.volume(&section, 99.0), 3.0 * 8.0 * 4.0 / 3.0, max_relative = 1e-12);
        assert_relative_eq!(table.way(8.0), 16.0, max_relative = 1e-12);
        // ∫ h v² dt: a quarter of the product.
        assert_relative_eq!(table.momentum(&section, 8.0), 3.0 * 8.0 * 16.0 / 4.0, max_relative = 1e-6);
        let half = table.when(|time| table.way(time), 8.0);
        assert_relative_eq!(table.way(half), 8.0, max_relative = 1e-9);
        assert_eq!(table.at(1.0), row(1.0, 0.5, 2.0));
        assert_eq!((table.at(-1.0).depth, table.at(9.0).velocity), (0.0, 0.0));
    }

    #[test]
    fn no_moment_is_both_deeper_and_faster_than_a_hard_one() {
        let section = Section::Rectangle { width: 3.0 };
        let governing = |rows: &[HydrographPoint]| Hydrograph::new(rows.to_vec(), &section).governing;
        // Every row of a table that gets deeper as it slows, and what is between them.
        let rows = [row(0.0, 0.2, 7.0), row(1.0, 1.0, 6.0), row(2.0, 1.5, 2.0)];
        let found = governing(&rows);
        assert_eq!((found[0].moment.depth, found[0].moment.velocity), (1.0, 6.0));
        for row in rows {
            assert!(
                found
                    .iter()
                    .any(|governing| governing.moment.depth >= row.depth && governing.moment.velocity >= row.velocity)
            );
        }
        // 3 m · (0.2 · 7 + 4 · 0.6 · 6.5 + 1 · 6)/6 m²/s have come before the second.
        assert_relative_eq!(found[0].before, 3.0 * (1.4 + 15.6 + 6.0) / 6.0, max_relative = 1e-9);
        // One that is deepest and fastest at once is alone; where h v² is largest between two rows that is found.
        assert_eq!(governing(&[row(0.0, 0.5, 4.0), row(1.0, 1.0, 5.0), row(2.0, 0.4, 3.0)]).len(), 1);
        let crossing = governing(&[row(0.0, 0.1, 6.0), row(3.0, 2.0, 1.0)])[0].moment;
        assert!(crossing.time > 0.0 && crossing.time < 3.0, "{crossing:?}");
        // However long the table is.
        let long: Vec<HydrographPoint> =
            (0..1000).map(|n| row(f64::from(n), 0.1 + 1e-3 * f64::from(n), 9.0 - 8e-3 * f64::from(n))).collect();
        let found = governing(&long);
        assert!(found.len() <= MOST_GOVERNING + 1, "{}", found.len());
        for row in long {
            assert!(
                found
                    .iter()
                    .any(|governing| governing.moment.depth >= row.depth && governing.moment.velocity >= row.velocity)
            );
        }
    }

    #[test]
    fn stretched_or_sped_up_it_carries_its_share() {
        let section = Section::Rectangle { width: 2.0 };
        let table = Hydrograph::new(vec![row(0.0, 0.2, 3.0), row(4.0, 0.6, 5.0)], &section);
        let volume = table.volume(&section, 4.0);
        assert_relative_eq!(table.longer(1.5).volume(&section, 6.0), 1.5 * volume, max_relative = 1e-12);
        assert_relative_eq!(table.faster(2.0).volume(&section, 2.0), volume, max_relative = 1e-12);
    }
}
