//! K and λ that the simulation shows, over time: the force of the grains at rest and of the moving ones against what the
//! guideline makes of the same depths and velocities (Albaba 2015, section 5.2, with the depth that its Eq. 5.4 lacks).
//!
//! F₁ = K ρ g' H_d (H_d/2 + h) and F₂ = ½ K ρ g' h² + λ ρ v² h, so that
//! K_eff = 2 F₁/(ρ g' H_d (H_d + 2 h)) and λ_eff = (F₂ − ½ K ρ g' h²)/(ρ v² h), with the design's K.

use serde::{Deserialize, Serialize};

use crate::loads::input::GuidelineInput;
use crate::loads::pressure::Diagram;
use crate::section::Section;
use dem::recorders::histories::{Histories, peak, smoothed};

/// Share of the mass in a gauge that may be at rest without the gauge telling of a deposit.
pub const STANDING: f64 = 0.01;

/// Time series, one value for each sample; forces per width (N/m). A coefficient is NaN where its depth is less than a grain
/// or its velocity too small to tell, and with the velocity upstream also where the window in which it is gauged holds grains at rest.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Coefficients {
    pub time: Vec<f64>,
    /// Depth of the grains at rest H_d and of those that move over them h (m).
    pub deposit: Vec<f64>,
    pub moving: Vec<f64>,
    /// m/s
    pub velocity_upstream: Vec<f64>,
    pub velocity_mean: Vec<f64>,
    /// By the simulation: of the grains at rest, and of the moving ones.
    pub force_dead: Vec<f64>,
    pub force_moving: Vec<f64>,
    /// By the guideline with the design's K and λ, from the same depths and the mean velocity of all grains.
    pub guideline_dead: Vec<f64>,
    pub guideline_moving: Vec<f64>,
    pub earth_pressure: Vec<f64>,
    /// With the velocity just upstream of the barrier, and with the mean velocity of all grains.
    pub dynamic_upstream: Vec<f64>,
    pub dynamic_mean: Vec<f64>,
}

/// The section of the channel, and the width on which forces per width are told (m).
pub struct Across<'a> {
    pub section: &'a Section,
    pub width: f64,
}

impl Across<'_> {
    /// Per width, of a deposit and a depth of flow over it: the pressures of a fluid of this weight (N/m³) that the deposit books and the flow
    /// books (N/m), and the area of the flow (m).
    fn of(&self, weight: f64, deposit: f64, depth: f64) -> [f64; 3] {
        if let Section::Rectangle { .. } = self.section {
            return [weight * deposit * (0.5 * deposit + depth), 0.5 * weight * depth * depth, depth];
        }
        let surface = deposit + depth;
        let fluid = Diagram { unit: weight, surface, top: surface, ..Diagram::default() };
        let own = fluid.force_over(self.section, deposit, surface);
        let moves = self.section.area(surface) - self.section.area(deposit);
        [weight * self.section.moment(surface) - own, own, moves].map(|whole| whole / self.width)
    }
}

/// Share of the highest velocity below which λ is not told.
const SLOW: f64 = 0.2;

/// Splits the force of a run, smoothed over `window` samples, and reads K and λ from it; depths below `grain` (m) are none.
pub fn coefficients(
    histories: &Histories,
    input: &GuidelineInput,
    across: &Across,
    window: usize,
    grain: f64,
) -> Coefficients {
    let along: Vec<f64> = histories.force.iter().map(|force| force.x / across.width).collect();
    let along = smoothed(&along, window);
    let by_state = |state: usize| {
        let touch: Vec<f64> = histories.pushes_by_state.iter().map(|pushes| pushes[state]).collect();
        smoothed(&touch, window)
    };
    let (dead, moving) = (by_state(0), by_state(1));
    let deposit = smoothed(&histories.dead_depth, window);
    let total_depth = smoothed(&histories.barrier_depth, window);
    let upstream: Vec<f64> = histories.incoming.iter().map(|gauge| gauge.velocity).collect();
    let mean: Vec<f64> = histories.velocity.iter().map(|velocity| velocity[0]).collect();
    let slow = SLOW * peak(&mean).1;
    // Without K: that is what is sought.
    let weight = input.density * input.gravity_normal;
    let mut told = Coefficients::default();
    for sample in 0..along.len() {
        let both = dead[sample] + moving[sample];
        let share = if both > 0.0 { (dead[sample] / both).clamp(0.0, 1.0) } else { 0.0 };
        let (first, second) = (share * along[sample], (1.0 - share) * along[sample]);
        let (deposit, depth) = (deposit[sample], (total_depth[sample] - deposit[sample]).max(0.0));
        let [fixed, own, moves] = across.of(weight, deposit, depth);
        let flux = |velocity: f64| input.density * velocity * velocity * moves;
        let standing = histories.incoming[sample].at_rest > STANDING;
        let lambda = |velocity: f64| {
            if depth > grain && velocity > slow {
                (second - input.earth_pressure * own) / flux(velocity)
            } else {
                f64::NAN
            }
        };
        told.time.push(histories.time.get(sample).copied().unwrap_or(0.0));
        told.deposit.push(deposit);
        told.moving.push(depth);
        told.velocity_upstream.push(upstream[sample]);
        told.velocity_mean.push(mean[sample]);
        told.force_dead.push(first);
        told.force_moving.push(second);
        told.guideline_dead.push(input.earth_pressure * fixed);
        told.guideline_moving.push(input.earth_pressure * own + input.dynamic_pressure * flux(mean[sample].max(0.0)));
        told.earth_pressure.push(if deposit > grain { first / fixed } else { f64::NAN });
        told.dynamic_upstream.push(if standing { f64::NAN } else { lambda(upstream[sample]) });
        told.dynamic_mean.push(lambda(mean[sample]));
    }
    told
}

impl Coefficients {
    /// Whether every series has a value for each moment.
    pub fn is_whole(&self) -> bool {
        let series = [
            &self.deposit,
            &self.moving,
            &self.velocity_upstream,
            &self.velocity_mean,
            &self.force_dead,
            &self.force_moving,
            &self.guideline_dead,
            &self.guideline_moving,
            &self.earth_pressure,
            &self.dynamic_upstream,
            &self.dynamic_mean,
        ];
        series.iter().all(|series| series.len() == self.time.len())
    }

    /// The sample at which a force is largest.
    pub fn peak_of(force: &[f64]) -> usize {
        peak(force).0
    }

    /// The value at the sample where `force` is largest.
    pub fn at_peak_of(series: &[f64], force: &[f64]) -> Option<f64> {
        series.get(Self::peak_of(force)).copied().filter(|value| value.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use dem::Vec3;
    use dem::recorders::gauge::Gauge;

    #[test]
    fn a_barrier_loaded_by_the_guideline_shows_the_guideline_s_coefficients() {
        let input = GuidelineInput { earth_pressure: 1.3, ..crate::loads::cases::tests::input() };
        let (width, deposit, depth, velocity) = (3.0, 1.5, 0.5, 4.0);
        let unit = input.density * input.gravity_normal;
        let first = 1.3 * unit * deposit * (0.5 * deposit + depth);
        let second = 0.5 * 1.3 * unit * depth * depth + 0.8 * input.density * velocity * velocity * depth;
        let count = 20;
        let histories = Histories {
            force: vec![Vec3::new((first + second) * width, 0.0, 0.0); count],
            pushes_by_state: vec![[first, second]; count],
            dead_depth: vec![deposit; count],
            barrier_depth: vec![deposit + depth; count],
            incoming: vec![Gauge { velocity, ..Gauge::default() }; count],
            velocity: vec![[2.0 * velocity, 0.0]; count],
            ..Histories::default()
        };
        let told = coefficients(&histories, &input, &Across { section: &Section::Rectangle { width }, width }, 5, 0.1);
        assert_relative_eq!(told.earth_pressure[10], 1.3, max_relative = 1e-12);
        assert_relative_eq!(told.dynamic_upstream[10], 0.8, max_relative = 1e-12);
        assert_relative_eq!(told.dynamic_mean[10], 0.2, max_relative = 1e-12);
        assert_relative_eq!(told.force_dead[10], first, max_relative = 1e-12);
    }

    fn whole(input: &GuidelineInput, change: impl Fn(&mut Histories)) -> Coefficients {
        let count = 8;
        let mut histories = Histories {
            time: (0..count).map(|sample| sample as f64).collect(),
            force: vec![Vec3::new(90e3, 0.0, 0.0); count],
            pushes_by_state: vec![[20e3, 10e3]; count],
            dead_depth: vec![1.5; count],
            barrier_depth: vec![2.0; count],
            incoming: vec![Gauge { velocity: 4.0, ..Gauge::default() }; count],
            velocity: vec![[2.0, 0.0]; count],
            ..Histories::default()
        };
        change(&mut histories);
        coefficients(&histories, input, &Across { section: &Section::Rectangle { width: 3.0 }, width: 3.0 }, 1, 0.1)
    }

    /// In a groove of 45°, a metre of flow over a metre of deposit: γ z³/3 of both is 8/3, of the flow 1/3 + 1, and its area is 3 m².
    #[test]
    fn what_deposit_and_flow_book_is_integrated_over_a_section() {
        let section = Section::Surveyed(crate::section::Survey::new(&[[-4.0, 4.0], [0.0, 0.0], [4.0, 4.0]], 0.1));
        let across = Across { section: &section, width: 2.0 };
        for (found, by_hand) in across.of(30.0, 1.0, 1.0).into_iter().zip([20.0, 20.0, 1.5]) {
            assert_relative_eq!(found, by_hand, max_relative = 1e-12);
        }
    }

    /// 30 kN/m, two thirds of them by grains at rest, 1.5 m deep under 0.5 m of moving ones: K ρ g' 1.5 · 1.25 and
    /// ½ K ρ g' 0.25 + λ ρ 2² · 0.5 by the guideline.
    #[test]
    fn forces_are_split_by_who_pushes_and_set_beside_the_guideline_s() {
        let input =
            GuidelineInput { earth_pressure: 1.3, dynamic_pressure: 0.8, ..crate::loads::cases::tests::input() };
        let told = whole(&input, |_| ());
        assert!(told.is_whole());
        let unit = 1.3 * input.density * input.gravity_normal;
        for (found, by_hand) in [
            (told.force_dead[3], 20e3),
            (told.force_moving[3], 10e3),
            (told.guideline_dead[3], unit * 1.5 * 1.25),
            (told.guideline_moving[3], unit * 0.125 + 0.8 * input.density * 2.0),
            (told.deposit[3], 1.5),
            (told.moving[3], 0.5),
            (told.velocity_upstream[3], 4.0),
            (told.velocity_mean[3], 2.0),
        ] {
            assert_relative_eq!(found, by_hand, max_relative = 1e-12);
        }
        // Nothing touches: all of it is the moving flow's.
        let untouched = whole(&input, |histories| histories.pushes_by_state.fill([0.0; 2]));
        assert_eq!((untouched.force_dead[3], untouched.force_moving[3]), (0.0, 30e3));
        assert!(!Coefficients { deposit: Vec::new(), ..told }.is_whole());
    }

    #[test]
    fn what_is_thin_slow_or_stands_tells_no_coefficient() {
        let input = crate::loads::cases::tests::input();
        let lambda = |change: &dyn Fn(&mut Histories)| {
            let told = whole(&input, change);
            [told.dynamic_upstream[3], told.dynamic_mean[3], told.earth_pressure[3]].map(f64::is_finite)
        };
        assert_eq!(lambda(&|_| ()), [true, true, true]);
        assert_eq!(lambda(&|histories| histories.barrier_depth.fill(1.55)), [false, false, true]);
        assert_eq!(lambda(&|histories| histories.dead_depth.fill(0.05)), [true, true, false]);
        // A fifth of the highest velocity is slow: 2 of 12 m/s, and 2.3 of 12 m/s just upstream.
        let slow = |upstream: f64| {
            move |histories: &mut Histories| {
                histories.velocity[0] = [12.0, 0.0];
                histories.incoming[3].velocity = upstream;
            }
        };
        assert_eq!(lambda(&slow(2.5)), [true, false, true]);
        assert_eq!(lambda(&slow(2.3)), [false, false, true]);
        assert_eq!(lambda(&|histories| histories.incoming[3].at_rest = 0.02), [false, true, true]);
        assert_eq!(lambda(&|histories| histories.incoming[3].at_rest = 0.01), [true, true, true]);
    }

    #[test]
    fn a_coefficient_is_read_where_the_force_is_largest() {
        let force = [1.0, 5.0, 9.0, 2.0];
        assert_eq!(Coefficients::peak_of(&force), 2);
        assert_eq!(Coefficients::at_peak_of(&[0.1, 0.2, 0.3, 0.4], &force), Some(0.3));
        assert_eq!(Coefficients::at_peak_of(&[0.1, 0.2, f64::NAN, 0.4], &force), None);
    }
}
