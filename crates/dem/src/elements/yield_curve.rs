//! Force at which a dissipator yields, against the stroke that it has paid out.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

/// The shape of a yield curve: points of stroke and force, straight between them, as shares of the whole stroke and of the largest force.
/// By default a plateau: the largest force from the beginning to the end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct YieldCurve(Arc<[[f64; 2]]>);

impl Default for YieldCurve {
    fn default() -> Self {
        Self::new(&[[0.0, 1.0], [1.0, 1.0]])
    }
}

impl YieldCurve {
    /// Through points of stroke and force as shares of the whole stroke and of the largest force: two at least, from no stroke to all of it.
    pub fn new(points: &[[f64; 2]]) -> Self {
        Self(points.into())
    }

    /// How far it pays out under an elongation (m), and the work of that (J), for a dissipator of the given largest force (N), whole
    /// stroke (m) and elastic stiffness (N/m), which has paid out `used` (m) already. A force that falls must do so by less than the elastic
    /// stiffness, or how far it pays out would have no single answer.
    pub fn pay_out(&self, [largest, whole]: [f64; 2], stiffness: f64, used: f64, elongation: f64) -> [f64; 2] {
        let points = &self.0;
        let (mut paid, mut work) = (used, 0.0);
        for (index, pair) in points.windows(2).enumerate() {
            let last = index + 2 == points.len();
            let [from, to] = [pair[0][0], pair[1][0]].map(|share| if share == 0.0 { 0.0 } else { share * whole });
            if paid >= to && !last {
                continue;
            }
            let [start, end] = [pair[0][1] * largest, pair[1][1] * largest];
            let slope = (end - start) / (to - from);
            // k (e − p) = Y + m (p − p₀): where elastic force and yield force are the same.
            let meeting = from + (elongation - from - start / stiffness) * (stiffness / (stiffness + slope));
            let wanted = meeting.max(paid).min(to.max(paid));
            let [before, after] = [paid, wanted].map(|stroke| start + slope * (stroke - from));
            work += 0.5 * (before + after) * (wanted - paid);
            paid = wanted;
            if wanted < to {
                break;
            }
        }
        [paid, work]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// 40 kN rising to 100 kN over 0.6 m, falling to 70 kN at 1 m.
    fn example() -> (YieldCurve, [f64; 2]) {
        (YieldCurve::new(&[[0.0, 0.4], [0.6, 1.0], [1.0, 0.7]]), [100e3, 1.0])
    }

    /// N
    fn force(stroke: f64) -> f64 {
        if stroke < 0.6 { 40e3 + 100e3 * stroke } else { 100e3 - 75e3 * (stroke - 0.6) }
    }

    /// Whatever the steps, it pulls with the force of the curve at the stroke, and the work is the area under it.
    #[test]
    fn it_follows_the_curve_in_steps_of_any_size() {
        let (curve, scale) = example();
        let stiffness = 2e6;
        for steps in [1, 7, 1000] {
            let (mut used, mut lost) = (0.0, 0.0);
            for step in 1..=steps {
                let elongation = 0.9 * f64::from(step) / f64::from(steps);
                let [paid, work] = curve.pay_out(scale, stiffness, used, elongation);
                (used, lost) = (paid, lost + work);
                let elastic = stiffness * elongation < 40e3;
                let wanted = if elastic { stiffness * elongation } else { force(used) };
                assert!(elastic == (used == 0.0));
                assert_relative_eq!(stiffness * (elongation - used), wanted, max_relative = 1e-9);
            }
            let area = 0.6 * 70e3 + (used - 0.6) * 0.5 * (100e3 + force(used));
            assert_relative_eq!(lost, area, max_relative = 1e-9);
            // Back and out again nothing is paid out before the force is there anew.
            assert_eq!(curve.pay_out(scale, stiffness, used, 0.5), [used, 0.0]);
            // At the end of its stroke it stays.
            let [paid, work] = curve.pay_out(scale, stiffness, used, 5.0);
            assert_eq!(paid, 1.0);
            assert_relative_eq!(lost + work, 0.6 * 70e3 + 0.4 * 85e3, max_relative = 1e-9);
        }
    }

    /// Of two points with the same force to the last bit what a plateau gives.
    #[test]
    fn a_plateau_is_the_curve_of_two_points() {
        let (two, scale) = (YieldCurve::new(&[[0.0, 1.0], [1.0, 1.0]]), [123e3, 0.7]);
        let mut random = fastrand::Rng::with_seed(3);
        let (mut used, plateau) = (0.0_f64, YieldCurve::default());
        for _ in 0..2000 {
            let elongation = 0.9 * random.f64();
            let by_hand = (elongation - 123e3 / 7.7e6).max(used).min(0.7_f64.max(used));
            let paid = two.pay_out(scale, 7.7e6, used, elongation);
            assert_eq!(paid, plateau.pay_out(scale, 7.7e6, used, elongation));
            assert_eq!(paid, [by_hand, 123e3 * (by_hand - used)]);
            used = if random.f64() < 0.05 { 0.0 } else { paid[0] };
        }
        // And without an end.
        assert_eq!(plateau.pay_out([5.0, f64::INFINITY], 10.0, 0.0, 3.0), [2.5, 12.5]);
    }
}
