//! Force at which a dissipator yields, against the stroke that it has paid out.

/// The shape of a yield curve: points of stroke and force, straight between them, as shares of the whole stroke and of the largest force.
/// By default a plateau: the largest force from the beginning to the end.
#[derive(Clone, Debug, PartialEq)]
pub struct YieldCurve(Vec<[f64; 2]>);

impl Default for YieldCurve {
    fn default() -> Self {
        Self(vec![[0.0, 1.0], [1.0, 1.0]])
    }
}

impl YieldCurve {
    /// From points of stroke (m) and force (N), two at least, the first without stroke and the strokes rising; with them the largest force (N)
    /// and the whole stroke (m).
    pub fn of(points: &[[f64; 2]]) -> (Self, [f64; 2]) {
        let largest = points.iter().map(|[_, force]| *force).fold(0.0, f64::max);
        let whole = points.last().map_or(0.0, |[stroke, _]| *stroke);
        let shares = points.iter().map(|[stroke, force]| [stroke / whole, force / largest]);
        (Self(shares.collect()), [largest, whole])
    }

    /// Points as shares of the whole stroke and of the largest force.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.0
    }

    /// Whether it yields at one force only.
    pub fn is_plateau(&self) -> bool {
        self.points().iter().all(|[_, force]| *force == 1.0)
    }

    /// The smallest force over the largest: below it nothing yields.
    pub fn least(&self) -> f64 {
        self.points().iter().map(|[_, force]| *force).fold(1.0, f64::min)
    }

    /// Force at a stroke, as shares.
    pub fn force(&self, stroke: f64) -> f64 {
        let points = self.points();
        let next = points.partition_point(|[at, _]| *at <= stroke).clamp(1, points.len() - 1);
        let [[from, before], [to, after]] = [points[next - 1], points[next]];
        before + (after - before) * ((stroke - from) / (to - from)).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn force_is_straight_between_the_points() {
        let (curve, scale) = YieldCurve::of(&[[0.0, 40e3], [0.6, 100e3], [1.0, 70e3]]);
        assert_eq!(scale, [100e3, 1.0]);
        for (stroke, force) in [(0.0, 40e3), (0.3, 70e3), (0.6, 100e3), (0.8, 85e3), (1.0, 70e3), (2.0, 70e3)] {
            assert_relative_eq!(curve.force(stroke) * 100e3, force, max_relative = 1e-12);
        }
        assert_relative_eq!(curve.least(), 0.4);
        assert!(!curve.is_plateau() && YieldCurve::default().is_plateau());
    }
}
