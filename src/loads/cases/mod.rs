//! Load cases, one file each: what presses on the barrier at one stage of its life.
//!
//! Forces are per metre of width and along the channel; stages after Wendeler 2008 and Volkwein 2014.

pub(crate) mod drained;
pub(crate) mod first_surge;
pub(crate) mod full;
pub(crate) mod later_surge;
pub(crate) mod load_case;
pub(crate) mod overtopped;
pub(crate) mod point_load;
pub(crate) mod snow;
pub(crate) mod working;

use self::load_case::{AdditionalActions, LoadCase};
use crate::loads::input::GuidelineInput;
use crate::text::Text;

/// Depths of deposit tried between the empty and the full barrier.
const STAGES: usize = 50;

/// What is told of each, in the order of the report.
pub fn texts() -> impl Iterator<Item = &'static Text> {
    let all = [
        first_surge::TEXTS,
        later_surge::TEXTS,
        full::TEXTS,
        drained::TEXTS,
        overtopped::TEXTS,
        point_load::TEXTS,
        snow::TEXTS,
    ];
    all.into_iter().flatten()
}

/// The cases that the report tells: empty, last surge, full, and what else the design asks for.
pub fn all(input: &GuidelineInput, extras: &AdditionalActions) -> Vec<LoadCase> {
    let mut cases = vec![first_surge::case(input), later_surge::last(input), full::case(input)];
    cases.extend(overtopped::case(input, extras));
    cases.extend(drained::case(input, extras));
    cases.extend(extras.point.map(|hit| point_load::case(input, hit)));
    cases.extend(extras.snow.map(|snow| snow::case(input, snow)));
    cases
}

/// Those cases, and the surge over every depth of deposit between: the envelope that each component is held against. A point
/// load comes with every surge, where its flow carries it unless its height is given.
pub fn envelope(input: &GuidelineInput, extras: &AdditionalActions) -> Vec<LoadCase> {
    let room = input.fill_height - input.moving_depth();
    let stages = (1..STAGES).map(|stage| later_surge::case(input, room * stage as f64 / STAGES as f64));
    let cases = all(input, extras).into_iter().chain(stages).filter(|case| case.certainty.decides());
    let hit = |case: &LoadCase| {
        extras.point.filter(|_| case.moving > 0.0).map(|hit| hit.over(case.deposit, input.barrier_height))
    };
    cases.map(|case| LoadCase { point: hit(&case), ..case }).collect()
}

/// The part of a stage's resultant that the guideline books to the deposit, F₁ = K ρ g' H_d (H_d/2 + h), and to the
/// moving flow, F₂ = ½ K ρ g' h² + λ ρ v² h (the thesis's Eq. 5.4 with the depth it lacks). They add up to R.
pub fn split(input: &GuidelineInput, case: &LoadCase) -> (f64, f64) {
    let unit = input.unit_pressure();
    let deposit = unit * case.deposit * (0.5 * case.deposit + case.moving);
    (deposit, 0.5 * unit * case.moving.powi(2) + case.diagram.block * case.moving)
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use crate::loads::cases::load_case::{Hit, PointLoad};
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    /// ρ 2000, α 20°, a barrier 4 m high that fills, h 1 m, v 6 m/s, K = λ = 1.
    pub fn input() -> GuidelineInput {
        GuidelineInput {
            density: 2000.0,
            gravity_normal: 9.81 * libm::cos(20_f64.to_radians()),
            earth_pressure: 1.0,
            dynamic_pressure: 1.0,
            wood: 1.0,
            depth: 1.0,
            velocity: 6.0,
            fill_height: 4.0,
            barrier_height: 4.0,
        }
    }

    #[test]
    fn matches_the_worked_example() {
        // H_d 3 m: F1 138.28, F2 81.22, R 219.49 kN/m.
        let case = later_surge::last(&input());
        let (first, second) = split(&input(), &case);
        assert_relative_eq!(first, 138.28e3, max_relative = 1e-4);
        assert_relative_eq!(second, 81.22e3, max_relative = 1e-4);
        assert_relative_eq!(case.force_per_width(), 219.49e3, max_relative = 1e-4);
    }

    #[test]
    fn the_envelope_reaches_every_strip_with_the_moving_flow() {
        // In the middle of a barrier 4 m high a flow 1 m deep gives at least λρv² over a strip of 1 m.
        let largest = |low, high| {
            let stages = envelope(&input(), &AdditionalActions::default());
            stages.iter().map(|case| case.strip_force(low, high)).fold(0.0, f64::max)
        };
        assert!(largest(1.5, 2.5) > input().impact_pressure());
        for case in all(&input(), &AdditionalActions::default()) {
            assert!(largest(1.0, 2.0) >= case.strip_force(1.0, 2.0));
        }
    }

    #[test]
    fn what_is_known_from_memory_alone_never_enters_a_resultant() {
        let case = overtopped::case(&input(), &AdditionalActions::default()).unwrap();
        assert!(case.shear > 0.0);
        assert_relative_eq!(case.force_per_width(), case.diagram.force(0.0, 4.0));
        let given = AdditionalActions { overflow_drag: Some([0.5, 2.0]), ..AdditionalActions::default() };
        let case = overtopped::case(&input(), &given).unwrap();
        assert_relative_eq!(case.force_per_width(), case.diagram.force(0.0, 4.0) + case.shear);
    }

    #[test]
    fn a_flow_deeper_than_the_barrier_loads_it_with_its_whole_depth() {
        let (height, depth) = (1.5, 2.5);
        let input = GuidelineInput { depth, fill_height: height, barrier_height: height, ..input() };
        let fixed = input.unit_pressure() * (depth * height - 0.5 * height * height);
        let expected = fixed + input.impact_pressure() * height;
        assert_relative_eq!(first_surge::case(&input).force_per_width(), expected, max_relative = 1e-12);
    }

    #[test]
    fn a_boulder_comes_with_every_surge() {
        let point = Hit { force: 1e5, height: Some(2.0), over_deposit: 1.0, of_boulder: 0.0 };
        let extras = AdditionalActions { point: Some(point), ..AdditionalActions::default() };
        for case in envelope(&input(), &extras) {
            assert_eq!(case.point.is_some(), case.moving > 0.0, "{}", case.id);
        }
    }

    /// Without a height of its own it hits at the surface of the flow: 1 m up on the empty barrier, at the top of 4 m over a deposit of 3 m.
    #[test]
    fn a_boulder_rides_on_the_flow() {
        let point = Hit { force: 1e5, height: None, over_deposit: 1.0, of_boulder: 0.0 };
        let extras = AdditionalActions { point: Some(point), ..AdditionalActions::default() };
        let stages = envelope(&input(), &extras);
        let hits: Vec<f64> = stages.iter().filter_map(|case| Some(case.point?.height - case.deposit)).collect();
        assert!(hits.len() > 50 && hits.iter().all(|&over| (over - 1.0).abs() < 1e-12 || over < 1.0), "{hits:?}");
        let highest = stages.iter().filter_map(|case| Some(case.point?.height)).fold(0.0, f64::max);
        assert_eq!((stages[0].point, highest), (Some(PointLoad { force: 1e5, height: 1.0 }), 4.0));
    }

    proptest! {
        #[test]
        fn parts_and_strips_add_up(depth in 0.1..3.0_f64, velocity in 0.0..12.0_f64, fill in 0.2..8.0_f64, cut in 0.01..0.99_f64) {
            let depth = depth.min(fill);
            let input = GuidelineInput { depth, velocity, fill_height: fill, barrier_height: fill, ..input() };
            for case in [first_surge::case(&input), later_surge::last(&input), full::case(&input)] {
                let (first, second) = split(&input, &case);
                let total = case.force_per_width();
                prop_assert!((first + second - total).abs() <= 1e-12 * total.max(1.0));
                let strips = case.strip_force(0.0, cut * fill) + case.strip_force(cut * fill, f64::INFINITY);
                prop_assert!((strips - total).abs() <= 1e-9 * total.max(1.0));
                prop_assert!(case.moment_per_width() <= total * fill + 1e-9);
            }
        }

        #[test]
        fn more_flow_never_loads_less(depth in 0.1..3.0_f64, velocity in 0.1..12.0_f64, density in 1000.0..2400.0_f64, more in 1.0..1.5_f64) {
            let small = GuidelineInput { depth, velocity, density, ..input() };
            let largest = |input: &GuidelineInput| {
                envelope(input, &AdditionalActions::default()).iter().map(LoadCase::force_per_width).fold(0.0, f64::max)
            };
            for grown in [
                GuidelineInput { velocity: velocity * more, ..small },
                GuidelineInput { density: density * more, ..small },
                GuidelineInput { depth: depth * more, ..small },
            ] {
                prop_assert!(largest(&grown) >= largest(&small) * (1.0 - 1e-12));
            }
        }
    }

    /// h 1 m on a deposit of 3 m, ρ g' = 18.4368 kPa/m: 73.747 kPa at the bed, and what drags on the top has the barrier's height as lever.
    #[test]
    fn a_case_tells_its_pressure_at_the_bed_and_the_moment_of_its_drag() {
        assert_relative_eq!(later_surge::last(&input()).pressure_static(), 73.747e3, max_relative = 1e-4);
        let given = AdditionalActions { overflow_drag: Some([0.5, 2.0]), ..AdditionalActions::default() };
        let case = overtopped::case(&input(), &given).unwrap();
        assert!(case.shear > 0.0);
        let moment = case.diagram.moment(0.0, 4.0) + 4.0 * case.shear;
        assert_relative_eq!(case.moment_per_width(), moment, max_relative = 1e-12);
        // The strip that ends at the top has the drag, one that begins there has none.
        assert_relative_eq!(
            case.strip_force(3.0, 4.0),
            case.diagram.force(3.0, 4.0) + case.shear,
            max_relative = 1e-12
        );
        assert_eq!(case.strip_force(4.0, 5.0), case.diagram.force(4.0, 5.0));
    }

    /// 90 kN at 2 m on a wall of 12 m: 15 kN m/m over all of it, 90 kN m/m over the 2 m at its end to which it spreads; on 1 m of wall it is
    /// all over it.
    #[test]
    fn a_boulder_bends_the_metres_it_spreads_to() {
        let point = PointLoad { force: 90e3, height: 2.0 };
        let case = LoadCase { point: Some(point), ..full::case(&input()) };
        let flow = full::case(&input()).face_moment(12.0, 0.0);
        assert_relative_eq!(case.face_moment(12.0, 0.0) - flow, 15e3, max_relative = 1e-9);
        assert_relative_eq!(case.foot_moment(12.0, 0.0) - flow, 90e3, max_relative = 1e-9);
        assert_relative_eq!(case.foot_moment(1.0, 0.0) - flow, 180e3, max_relative = 1e-9);
        let flow = case.force_per_width();
        assert_relative_eq!(case.metre_force(12.0, 3.0) - flow, 45e3, max_relative = 1e-9);
        assert_relative_eq!(case.metre_force(12.0, 5.0) - flow, 36e3, max_relative = 1e-9);
        assert_relative_eq!(case.metre_force(1.0, 5.0) - flow, 90e3, max_relative = 1e-9);
    }
}
