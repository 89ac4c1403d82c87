//! A pressure diagram over the height of the barrier: a static triangle, cut at the barrier's top, and a block.

use crate::section::Section;

/// Pressures over the height z above the bed (m), uniform over the width.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Diagram {
    /// Growth of the static pressure with depth (Pa/m).
    pub unit: f64,
    /// Height of the surface, where the static pressure is zero (m).
    pub surface: f64,
    /// Height up to which the barrier is loaded (m).
    pub top: f64,
    /// Uniform pressure (Pa) between two heights (m).
    pub block: f64,
    pub block_from: f64,
    pub block_to: f64,
}

impl Diagram {
    /// Pressure at a height (Pa).
    pub fn at(&self, height: f64) -> f64 {
        if height > self.top {
            return 0.0;
        }
        let block = if (self.block_from..=self.block_to).contains(&height) { self.block } else { 0.0 };
        self.unit * (self.surface - height).max(0.0) + block
    }

    /// Force per width on the strip between two heights, ∫ p dz (N/m).
    pub fn force(&self, low: f64, high: f64) -> f64 {
        self.integrate(
            low,
            high,
            |a, b| b - a,
            |a, b| {
                let depth = |height: f64| (self.surface - height).max(0.0);
                0.5 * (depth(a).powi(2) - depth(b).powi(2))
            },
        )
    }

    /// Moment per width about the bed of the pressures on a strip, ∫ p z dz (N).
    pub fn moment(&self, low: f64, high: f64) -> f64 {
        self.integrate(
            low,
            high,
            |a, b| 0.5 * (b * b - a * a),
            |a, b| {
                let b = b.min(self.surface);
                let a = a.min(b);
                self.surface * 0.5 * (b * b - a * a) - (b.powi(3) - a.powi(3)) / 3.0
            },
        )
    }

    /// Force on the strip between two heights over a section, ∫ p w dz (N).
    pub fn force_over(&self, section: &Section, low: f64, high: f64) -> f64 {
        match section {
            Section::Rectangle { width } => self.force(low, high) * width,
            Section::Surveyed(_) => self.over(section, low, high),
        }
    }

    /// ∫ p w dz by Simpson's rule between the kinks of pressure and width, which is exact.
    fn over(&self, section: &Section, low: f64, high: f64) -> f64 {
        let (low, high) = (low.clamp(0.0, self.top), high.clamp(0.0, self.top));
        let mut stops = section.kinks();
        stops.extend([low, high, self.surface, self.block_from, self.block_to]);
        stops.retain(|stop| (low..=high).contains(stop));
        stops.sort_by(f64::total_cmp);
        let part = |pair: &[f64]| {
            let [from, to] = [pair[0], pair[1]];
            let middle = 0.5 * (from + to);
            let block = if middle > self.block_from && middle < self.block_to { self.block } else { 0.0 };
            let pressure = |z: f64| self.unit * (self.surface - z).max(0.0) + block;
            // The width may jump at a level bed: its ends are taken from inside.
            let [first, last] = [-0.25, 0.25].map(|share| middle + share * (to - from));
            let slope = (section.width(last) - section.width(first)) / (last - first);
            let at_the_middle = section.width(middle);
            let width = |z: f64| at_the_middle + slope * (z - middle);
            let value = |z: f64| pressure(z) * width(z);
            (to - from) / 6.0 * (value(from) + 4.0 * value(middle) + value(to))
        };
        stops.windows(2).filter(|pair| pair[1] > pair[0]).map(part).sum()
    }

    fn integrate(
        &self,
        low: f64,
        high: f64,
        block: impl Fn(f64, f64) -> f64,
        triangle: impl Fn(f64, f64) -> f64,
    ) -> f64 {
        let (low, high) = (low.clamp(0.0, self.top), high.clamp(0.0, self.top));
        if low >= high {
            return 0.0;
        }
        let (from, to) = (low.max(self.block_from), high.min(self.block_to).min(self.top));
        let blocks = if to > from { self.block * block(from, to) } else { 0.0 };
        blocks + self.unit * triangle(low, high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_triangle_acts_at_a_third_and_a_block_at_its_middle() {
        let triangle = Diagram { unit: 10.0, surface: 3.0, top: 3.0, ..Diagram::default() };
        assert_relative_eq!(triangle.force(0.0, 9.0), 45.0);
        assert_relative_eq!(triangle.moment(0.0, 9.0), 45.0);
        let block = Diagram { block: 5.0, block_from: 1.0, block_to: 2.0, top: 3.0, ..Diagram::default() };
        assert_relative_eq!(block.moment(0.0, 3.0), 1.5 * block.force(0.0, 3.0));
        assert_eq!(block.at(1.5), 5.0);
    }

    #[test]
    fn integrals_match_a_fine_sum_of_pressures() {
        let diagram = Diagram { unit: 7.0, surface: 3.6, top: 3.0, block: 4.0, block_from: 2.2, block_to: 3.6 };
        let slices = 300_000;
        let width = 2.5 / slices as f64;
        let middles = (0..slices).map(|slice| 0.5 + (slice as f64 + 0.5) * width);
        let (force, moment) = middles
            .fold((0.0, 0.0), |(force, moment), z| (force + diagram.at(z) * width, moment + diagram.at(z) * z * width));
        assert_relative_eq!(diagram.force(0.5, 3.0), force, max_relative = 1e-5);
        assert_relative_eq!(diagram.moment(0.5, 3.0), moment, max_relative = 1e-5);
    }

    /// A trapezoid with w = 4 + 3 z: ∫ 7 (3.6 − z) (4 + 3 z) dz from 0 to 3 and 4 (4 + 3 z) from 2.2 to 3. In a rectangle, width by force.
    #[test]
    fn pressures_are_integrated_over_the_width_at_each_height() {
        let points = [[-7.0, 8.0], [-2.0, 3.0], [2.0, 3.0], [12.0, 8.0]];
        let section = Section::Surveyed(crate::section::Survey::new(&points, 0.1));
        let diagram = Diagram { unit: 7.0, surface: 3.6, top: 3.0, block: 4.0, block_from: 2.2, block_to: 3.6 };
        // 7 (14.4 z + 3.4 z² − z³) and 16 z + 6 z².
        let force = 7.0 * (43.2 + 30.6 - 27.0) + 16.0 * 0.8 + 6.0 * (9.0 - 4.84);
        assert_relative_eq!(diagram.force_over(&section, 0.0, 9.0), force, max_relative = 1e-12);
        let strips = diagram.force_over(&section, 0.0, 1.3) + diagram.force_over(&section, 1.3, 3.0);
        assert_relative_eq!(strips, force, max_relative = 1e-12);
        let even = Section::Rectangle { width: 2.5 };
        assert_eq!(diagram.force_over(&even, 0.5, 3.0), 2.5 * diagram.force(0.5, 3.0));
    }

    /// A strip whose lower end is above its upper one is none.
    #[test]
    fn a_strip_upside_down_carries_nothing() {
        let diagram = Diagram { unit: 7.0, surface: 3.6, top: 3.0, block: 4.0, block_from: 2.2, block_to: 3.6 };
        assert_eq!((diagram.force(1.5, 1.0), diagram.moment(1.5, 1.0)), (0.0, 0.0));
    }

    /// A groove of 45° filled to its top, at rest: ½ ∫ (z' − z) 2 z dz = ρ g h³/3 of a fluid.
    #[test]
    fn a_groove_carries_a_third_of_the_cube() {
        let section = Section::Surveyed(crate::section::Survey::new(&[[-4.0, 4.0], [0.0, 0.0], [4.0, 4.0]], 0.1));
        let diagram = Diagram { unit: 10.0, surface: 2.0, top: 2.0, ..Diagram::default() };
        assert_relative_eq!(diagram.force_over(&section, 0.0, 2.0), 10.0 * 8.0 / 3.0, max_relative = 1e-12);
    }

    /// Up to its top, which is loaded; a surface above it leaves a trapezium.
    #[test]
    fn a_diagram_ends_at_the_top_of_the_barrier() {
        let diagram = Diagram { unit: 10.0, surface: 3.0, top: 2.0, block: 5.0, block_from: 1.0, block_to: 2.0 };
        assert_eq!([0.5, 1.5, 2.0, 2.1].map(|height| diagram.at(height)), [25.0, 20.0, 15.0, 0.0]);
        assert_relative_eq!(diagram.force(0.0, 9.0), 10.0 * (0.5 * 9.0 - 0.5) + 5.0, max_relative = 1e-12);
        // ∫ 10 (3 − z) z dz + 5 · 1.5
        assert_relative_eq!(diagram.moment(0.0, 9.0), 10.0 * (6.0 - 8.0 / 3.0) + 7.5, max_relative = 1e-12);
    }
}
