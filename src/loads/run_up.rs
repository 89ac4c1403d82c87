//! How high a flow runs up a barrier that stops it, h_u, by two balances. Heights and depths normal to the bed (m).
//!
//! Energy: what is not lost lifts the flow, h_u = h + v²/(2 g cos α). Momentum: a jump (bore) that fills the space behind the
//! barrier moves upstream through the flow, h_u = r h with the largest root of r³ − r² − (2 Fr²/κ + 1) r + 1 = 0, κ = 1 for a
//! pressure as in a fluid (Iverson, George & Logan 2016). In fast flows the energy balance is far above what is measured, in slow
//! ones the jump is above it; the larger of both bounds what a deposit may be heaped up to.

use crate::larger::larger_or_nan;
use crate::loads::input::GuidelineInput;
use crate::section::Section;

/// h + v²/(2 g cos α) (m).
pub fn by_energy(input: &GuidelineInput) -> f64 {
    input.depth + input.velocity.powi(2) / (2.0 * input.gravity_normal)
}

/// Height of the flow behind a momentum jump (m).
pub fn by_jump(input: &GuidelineInput, section: &Section) -> f64 {
    match section {
        Section::Rectangle { .. } => in_a_rectangle(input),
        Section::Surveyed(_) => in_a_section(input, section),
    }
}

/// With areas A and their moments S before and behind the jump, v² A₁ A₂/(A₂ − A₁) = g' (S₂ − S₁).
fn in_a_section(input: &GuidelineInput, section: &Section) -> f64 {
    let (area, moment) = (section.area(input.depth), section.moment(input.depth));
    let wanting = |height: f64| {
        let [behind, pressed] = [section.area(height), section.moment(height)];
        let stops = input.velocity.powi(2) * area * behind / (behind - area);
        stops > input.gravity_normal * (pressed - moment)
    };
    let (mut low, mut high) = (input.depth, 2.0 * input.depth);
    while wanting(high) && high < 1e6 {
        high *= 2.0;
    }
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if wanting(middle) { low = middle } else { high = middle }
    }
    high
}

fn in_a_rectangle(input: &GuidelineInput) -> f64 {
    let froude = input.froude();
    let slope = 2.0 * froude * froude + 1.0;
    // Above r = 1 the cubic first falls below zero and then rises for good: its largest root lies between 1 and 1 + √slope.
    let cubic = |r: f64| r * r * r - r * r - slope * r + 1.0;
    let (mut low, mut high) = (1.0, 1.0 + slope.sqrt());
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if cubic(middle) < 0.0 { low = middle } else { high = middle }
    }
    high * input.depth
}

/// The larger of both (m).
pub fn bound(input: &GuidelineInput, section: &Section) -> f64 {
    larger_or_nan(by_energy(input), by_jump(input, section))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const EVEN: Section = Section::Rectangle { width: 2.0 };

    /// A section with vertical walls is a rectangle. In a groove, v² A₁ A₂/(A₂ − A₁) = g' (S₂ − S₁) with A = z², S = z³/3: r = 2 at
    /// v² · 4/3 = g' h · 7/3.
    #[test]
    fn a_jump_in_a_section_balances_area_and_moment() {
        let surveyed = |points: &[[f64; 2]]| Section::Surveyed(crate::section::Survey::new(points, 0.1));
        let walls = surveyed(&[[0.0, 9.0], [0.0, 0.0], [2.0, 0.0], [2.0, 9.0]]);
        for (velocity, depth) in [(10.0, 0.1), (3.0, 1.0), (0.5, 0.5)] {
            let input = flow(velocity, depth);
            assert_relative_eq!(by_jump(&input, &walls), by_jump(&input, &EVEN), max_relative = 1e-9);
        }
        let groove = surveyed(&[[-9.0, 9.0], [0.0, 0.0], [9.0, 9.0]]);
        let velocity = (9.81_f64 * 7.0 / 4.0).sqrt();
        assert_relative_eq!(by_jump(&flow(velocity, 1.0), &groove), 2.0, max_relative = 1e-9);
    }

    /// A flow on a level bed.
    fn flow(velocity: f64, depth: f64) -> GuidelineInput {
        GuidelineInput { gravity_normal: 9.81, velocity, depth, ..crate::loads::cases::tests::input() }
    }

    #[test]
    fn the_jump_is_that_of_the_flume_tests() {
        // Worked out for four moments of the USGS tests of 1994, measured run-up 1.2 to 2.05 m.
        for (velocity, depth, expected) in
            [(10.0, 0.10, 1.48), (10.0, 0.15, 1.83), (9.7, 0.20, 2.07), (10.0, 0.23, 2.29)]
        {
            assert_relative_eq!(by_jump(&flow(velocity, depth), &EVEN), expected, max_relative = 5e-3);
        }
    }

    #[test]
    fn a_flow_that_stands_runs_up_nowhere_and_a_fast_one_less_far_by_the_jump_than_by_energy() {
        assert_relative_eq!(by_jump(&flow(1e-9, 1.0), &EVEN), 1.0, max_relative = 1e-6);
        assert_relative_eq!(by_energy(&flow(10.0, 0.1)), 0.1 + 100.0 / 19.62, max_relative = 1e-12);
        assert!(by_jump(&flow(10.0, 0.1), &EVEN) < by_energy(&flow(10.0, 0.1)));
        assert!(by_jump(&flow(2.0, 1.0), &EVEN) > by_energy(&flow(2.0, 1.0)));
    }
}
