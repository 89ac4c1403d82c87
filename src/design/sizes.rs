//! Grain-size distributions.

/// Share of the mass up to which a curve must be given for its coarse end to be continued.
const COARSE_END: f64 = 0.84;

/// How grain sizes are distributed. Diameters are of the sphere of equal volume (m).
#[derive(Clone, Debug, PartialEq)]
pub enum SizeCurve {
    /// Uniform in number between two diameters.
    ByNumber { smallest: f64, largest: f64 },
    /// Cumulative curve by mass.
    ByMass {
        /// (share of mass that is finer, diameter), both increasing, from 0 to 1.
        points: Vec<(f64, f64)>,
        /// Share of the mass that is finer than the coarsest size that is given; beyond it the curve is continued.
        known_to: f64,
    },
    /// Nothing is said of the grains, which the equations do not need: every size is NaN.
    Unknown,
}

impl SizeCurve {
    /// A curve by mass through some quantiles, such as d30, d50, d70 and d90. The ends at 0 and 1 continue the
    /// outermost slopes on a logarithmic diameter axis. Needs two quantiles or more.
    pub fn through(quantiles: &[(f64, f64)]) -> Self {
        let extend = |from: (f64, f64), to: (f64, f64), share: f64| {
            let slope = libm::log(to.1 / from.1) / (to.0 - from.0);
            (share, to.1 * libm::exp(slope * (share - to.0)))
        };
        let mut points = quantiles.to_vec();
        let count = points.len();
        if points[0].0 > 0.0 {
            points.insert(0, extend(points[1], points[0], 0.0));
        }
        if quantiles[count - 1].0 < 1.0 {
            points.push(extend(quantiles[count - 2], quantiles[count - 1], 1.0));
        }
        Self::ByMass { points, known_to: quantiles[count - 1].0 }
    }

    /// Whether the largest grain can be told: the curve is given up to D84 at least, from where on it is continued.
    pub fn tells_the_largest(&self) -> bool {
        match self {
            Self::ByNumber { .. } => true,
            Self::ByMass { known_to, .. } => *known_to >= COARSE_END,
            Self::Unknown => false,
        }
    }

    /// Share of the mass that is finer than the coarsest size given, where the curve is continued beyond that.
    pub fn continued_from(&self) -> Option<f64> {
        match self {
            Self::ByMass { known_to, .. } if *known_to < 1.0 => Some(*known_to),
            _ => None,
        }
    }

    /// Diameter below which the given share of the mass lies.
    pub fn quantile(&self, share: f64) -> f64 {
        match self {
            Self::ByNumber { smallest, largest } => {
                // Uniform in number: the mass finer than d grows with the fourth power of d.
                let (low, high) = (smallest.powi(4), largest.powi(4));
                libm::pow(low + share * (high - low), 0.25)
            }
            Self::Unknown => f64::NAN,
            Self::ByMass { points, .. } => {
                let upper = points.iter().position(|point| point.0 >= share).unwrap_or(points.len() - 1).max(1);
                let ((s0, d0), (s1, d1)) = (points[upper - 1], points[upper]);
                d0 * libm::pow(d1 / d0, ((share - s0) / (s1 - s0)).clamp(0.0, 1.0))
            }
        }
    }

    /// The same distribution of grains `factor` times as large.
    pub fn scaled(&self, factor: f64) -> Self {
        match self {
            Self::ByNumber { smallest, largest } => {
                Self::ByNumber { smallest: smallest * factor, largest: largest * factor }
            }
            Self::ByMass { points, known_to } => Self::ByMass {
                points: points.iter().map(|&(share, diameter)| (share, diameter * factor)).collect(),
                known_to: *known_to,
            },
            Self::Unknown => Self::Unknown,
        }
    }

    /// D with a number, such as D90: the diameter below which that share of the grains lies, in the measure in which the sizes are given,
    /// by mass for a curve by mass and by number for a range that is uniform by number.
    pub fn named(&self, share: f64) -> f64 {
        match self {
            Self::ByNumber { smallest, largest } => smallest + share * (largest - smallest),
            Self::ByMass { .. } | Self::Unknown => self.quantile(share),
        }
    }

    /// That measure, in words.
    pub fn measure(&self) -> &'static str {
        match self {
            Self::ByNumber { .. } => "by number",
            Self::ByMass { .. } | Self::Unknown => "by mass",
        }
    }

    /// Share of the mass that is finer than a diameter.
    pub fn finer_than(&self, diameter: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.quantile(middle) < diameter { low = middle } else { high = middle }
        }
        high
    }

    /// The curve with its finest part made as coarse as the grains at the given share of the mass.
    pub fn cut_below(&self, share: f64) -> Self {
        let finest = self.quantile(share);
        // A curve must rise: by no more than rounding where it is cut.
        let mut points = vec![(0.0, finest * (1.0 - 1e-9)), (share, finest)];
        points.extend(
            (1..=20)
                .map(|step| share + (1.0 - share) * f64::from(step) / 20.0)
                .map(|share| (share, self.quantile(share))),
        );
        Self::ByMass { points, known_to: self.continued_from().unwrap_or(1.0) }
    }

    /// About how many grains a solid volume (m³) makes.
    pub fn count(&self, solid_volume: f64) -> f64 {
        const SLICES: usize = 1000;
        let slice = solid_volume / SLICES as f64;
        let grains_in = |index: usize| {
            let diameter = self.quantile((index as f64 + 0.5) / SLICES as f64);
            slice / (std::f64::consts::PI / 6.0 * diameter.powi(3))
        };
        (0..SLICES).map(grains_in).sum()
    }

    /// Diameters of grains that together weigh `mass`, from fine to coarse. Each grain is the quantile at the
    /// middle of the mass it adds, so the curve is met to within the mass of one grain.
    pub fn grains(&self, mass: f64, solid_density: f64) -> Vec<f64> {
        let (mut diameters, scale) = self.whole_grains(mass, solid_density);
        diameters.iter_mut().for_each(|diameter| *diameter *= scale);
        diameters
    }

    /// The number of grains nearest to `mass`, one at the least, with the factor on their diameters that makes the mass exact.
    pub fn whole_grains(&self, mass: f64, solid_density: f64) -> (Vec<f64>, f64) {
        let mass_of = |diameter: f64| solid_density * std::f64::consts::PI / 6.0 * diameter.powi(3);
        let mut diameters = Vec::new();
        let mut sum = 0.0;
        while sum < mass {
            let first = self.quantile(sum / mass);
            let middle = self.quantile(((sum + 0.5 * mass_of(first)) / mass).min(1.0));
            // One more only where that is nearer than none.
            if !diameters.is_empty() && sum + 0.5 * mass_of(middle) > mass {
                break;
            }
            diameters.push(middle);
            sum += mass_of(middle);
        }
        (diameters, libm::cbrt(mass / sum))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn mass_fractions_are_met_to_one_percent() {
        let curve = SizeCurve::through(&[(0.3, 0.30), (0.5, 0.45), (0.7, 0.60), (0.9, 0.80)]);
        let grains = curve.grains(340e3, 2701.0);
        let mass = |d: &f64| 2701.0 * std::f64::consts::PI / 6.0 * d.powi(3);
        let total: f64 = grains.iter().map(mass).sum();
        assert_relative_eq!(total, 340e3, max_relative = 1e-9);
        for (share, diameter) in [(0.3, 0.30), (0.5, 0.45), (0.7, 0.60), (0.9, 0.80)] {
            let finer: f64 = grains.iter().filter(|d| **d <= diameter).map(mass).sum();
            assert!((finer / total - share).abs() < 0.01, "{share}: {}", finer / total);
        }
    }

    /// One grain of 0.3 m weighs 38.2 kg: as much, a little more and a little less are one grain, 1.6 times as much are two.
    #[test]
    fn the_number_of_grains_is_rounded_to_the_nearest() {
        let curve = SizeCurve::ByNumber { smallest: 0.2999, largest: 0.3001 };
        let one = 2701.0 * std::f64::consts::PI / 6.0 * 0.3_f64.powi(3);
        for (mass, count) in [(0.3, 1), (1.0, 1), (1.04, 1), (1.4, 1), (1.6, 2), (2.4, 2), (2.6, 3)] {
            let grains = curve.grains(mass * one, 2701.0);
            assert_eq!(grains.len(), count, "{mass}");
            let total: f64 = grains.iter().map(|diameter| (diameter / 0.3).powi(3)).sum();
            assert_relative_eq!(total, mass, max_relative = 1e-3);
        }
    }

    #[test]
    fn a_cut_curve_keeps_its_coarse_part_and_has_fewer_grains() {
        let curve = SizeCurve::through(&[(0.3, 0.12), (0.5, 0.15), (0.9, 0.5)]);
        let cut = curve.cut_below(0.6);
        for share in [0.6, 0.8, 1.0] {
            assert_relative_eq!(cut.quantile(share), curve.quantile(share), max_relative = 1e-2);
        }
        assert_relative_eq!(cut.quantile(0.0), curve.quantile(0.6), max_relative = 1e-6);
        assert!(cut.count(100.0) < 0.5 * curve.count(100.0));
        assert_relative_eq!(curve.finer_than(0.15), 0.5, max_relative = 1e-6);
    }

    #[test]
    fn a_curve_given_up_to_its_middle_does_not_tell_its_largest_grain() {
        let tells = |coarsest: f64| SizeCurve::through(&[(0.1, 0.05), (coarsest, 0.3)]).tells_the_largest();
        assert_eq!([0.5, 0.7, 0.84, 0.9, 1.0].map(tells), [false, false, true, true, true]);
        assert!(!SizeCurve::through(&[(0.1, 0.05), (0.5, 0.3)]).scaled(2.0).cut_below(0.2).tells_the_largest());
        assert_eq!(SizeCurve::through(&[(0.1, 0.05), (0.9, 0.3)]).continued_from(), Some(0.9));
        assert_eq!(SizeCurve::through(&[(0.1, 0.05), (1.0, 0.3)]).continued_from(), None);
    }

    #[test]
    fn a_named_size_is_in_the_measure_of_the_sizes() {
        let range = SizeCurve::ByNumber { smallest: 0.289, largest: 0.579 };
        assert_relative_eq!(range.named(0.3), 0.376, max_relative = 1e-3);
        assert_relative_eq!(range.quantile(0.3), 0.443, max_relative = 2e-3);
        let curve = SizeCurve::through(&[(0.3, 0.30), (0.9, 0.80)]);
        assert_relative_eq!(curve.named(0.3), 0.30, max_relative = 1e-9);
    }

    #[test]
    fn uniform_in_number_is_uniform_in_number() {
        let grains = SizeCurve::ByNumber { smallest: 9.832e-3, largest: 19.664e-3 }.grains(27.25, 2701.0);
        let middle = grains.iter().filter(|d| **d < 14.748e-3).count() as f64;
        assert!((middle / grains.len() as f64 - 0.5).abs() < 0.01);
        assert!((grains.len() as f64 - 5406.0).abs() < 4.0, "{}", grains.len());
        let counted = SizeCurve::ByNumber { smallest: 9.832e-3, largest: 19.664e-3 }.count(27.25 / 2701.0);
        assert_relative_eq!(counted, grains.len() as f64, max_relative = 0.01);
    }
}
