//! Load cases, one file each: what presses on the barrier at one stage of its life.
//!
//! Forces are per metre of width and along the channel; stages after Wendeler 2008 and Volkwein 2014.

pub mod drained;
pub mod first_surge;
pub mod full;
pub mod later_surge;
pub mod overtopped;
pub mod point_load;
pub mod snow;

use crate::loads::input::GuidelineInput;
use crate::loads::pressure::Diagram;

/// How sure we are of a formula or a value; only what is certain may decide a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Certainty {
    /// Read in the source itself or in a thesis that cites it.
    Read,
    /// Given by the designer.
    Given,
    /// Derived from first principles here.
    Derived,
    /// From memory: shown, never decisive.
    Memory,
}

impl Certainty {
    pub fn word(self) -> &'static str {
        match self {
            Self::Read => "read in the source or second hand",
            Self::Given => "given in the design",
            Self::Derived => "derived",
            Self::Memory => "from memory, to be verified",
        }
    }

    pub fn decides(self) -> bool {
        self != Self::Memory
    }
}

/// A force at one place of the barrier (N), at a height above the bed (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLoad {
    pub force: f64,
    pub height: f64,
}

/// One stage: its pressures, and what acts beside them.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadCase {
    pub id: &'static str,
    pub title: &'static str,
    /// Height of the deposit at rest H_d (m).
    pub deposit: f64,
    /// Depth of the flow that moves against the barrier h, or over it h_o (m); 0 when nothing moves.
    pub moving: f64,
    pub diagram: Diagram,
    /// Drag of the overtopping flow on the barrier's top, along the channel (N/m).
    pub shear: f64,
    /// Whether the drag may decide a check.
    pub shear_certainty: Certainty,
    pub point: Option<PointLoad>,
    /// The resultant in symbols.
    pub formula: &'static str,
    pub certainty: Certainty,
    pub source: &'static str,
}

impl LoadCase {
    /// Static pressure at the bed (Pa).
    pub fn pressure_static(&self) -> f64 {
        self.diagram.unit * self.diagram.surface
    }

    /// Force per width R, without point loads (N/m).
    pub fn force_per_width(&self) -> f64 {
        self.diagram.force(0.0, f64::INFINITY) + self.decisive_shear()
    }

    /// Moment per width about the bed, without point loads (N m/m).
    pub fn moment_per_width(&self) -> f64 {
        self.diagram.moment(0.0, f64::INFINITY) + self.decisive_shear() * self.diagram.top
    }

    /// Force on a barrier of this width, its point load included (N).
    pub fn total_force(&self, width: f64) -> f64 {
        self.force_per_width() * width + self.point.map_or(0.0, |point| point.force)
    }

    /// Moment about the bed, per width, of all that acts on a barrier of this width (N m/m).
    pub fn mean_moment(&self, width: f64) -> f64 {
        self.moment_per_width() + self.point.map_or(0.0, |point| point.force * point.height / width)
    }

    /// Force normal to a face that leans by θ from the bed's normal, on a barrier of this width (N): what presses on it has R along the bed
    /// and R tan θ off it, R/cos θ in all. Drag and point load are taken likewise, which is on the safe side.
    pub fn face_force(&self, width: f64, lean: f64) -> f64 {
        self.total_force(width) / libm::cos(lean)
    }

    /// Moment of that force about the foot of the face, per width (N m/m): the pressures act at z/cos θ along it, so that theirs is the
    /// moment of R by 1 + tan² θ; drag and point load act along the bed.
    pub fn face_moment(&self, width: f64, lean: f64) -> f64 {
        self.mean_moment(width) + self.diagram.moment(0.0, f64::INFINITY) * libm::tan(lean).powi(2)
    }

    /// The largest force along the bed that any metre of a wall takes (N/m): a point load at the end of the wall, its worst place, spreads
    /// at 45° to one side, over its height, over half the height of the wall at the least, and over the whole width at the most.
    pub fn metre_force(&self, width: f64, height: f64) -> f64 {
        let spread = |point: PointLoad| point.force / width.min(point.height.max(0.5 * height));
        self.force_per_width() + self.point.map_or(0.0, spread)
    }

    /// The largest moment about the foot of the face that any metre of a wall takes (N m/m): a point load at the end of the wall spreads at
    /// 45° to one side on its way down to the foot, over its height, if the wall is that wide.
    pub fn foot_moment(&self, width: f64, lean: f64) -> f64 {
        let spread = |point: PointLoad| point.force * (1.0 - point.height / width).max(0.0);
        self.face_moment(width, lean) + self.point.map_or(0.0, spread)
    }

    /// Force per width on the strip of a rope between two heights; the topmost strip takes the drag (N/m).
    pub fn strip_force(&self, low: f64, high: f64) -> f64 {
        let drag = if high >= self.diagram.top && low < self.diagram.top { self.decisive_shear() } else { 0.0 };
        self.diagram.force(low, high) + drag
    }

    fn decisive_shear(&self) -> f64 {
        if self.shear_certainty.decides() { self.shear } else { 0.0 }
    }
}

/// What the designer gives beside the flow; every part is left out unless it is given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extras {
    /// Depth of the flow over the full barrier h_o (m); that of the surge unless given.
    pub overflow_depth: Option<f64>,
    /// tan φ of the drag on the barrier's top, and the length on which it acts (m).
    pub overflow_drag: Option<[f64; 2]>,
    /// K and density (kg/m³) of the drained deposit.
    pub drained: Option<[f64; 2]>,
    pub point: Option<PointLoad>,
    /// Uniform pressure of snow (Pa).
    pub snow: Option<f64>,
}

/// Depths of deposit tried between the empty and the full barrier.
const STAGES: usize = 50;

/// The cases that the report tells: empty, last surge, full, and what else the design asks for.
pub fn all(input: &GuidelineInput, extras: &Extras) -> Vec<LoadCase> {
    let mut cases = vec![first_surge::case(input), later_surge::last(input), full::case(input)];
    cases.extend(overtopped::case(input, extras));
    cases.extend(drained::case(input, extras));
    cases.extend(extras.point.map(|point| point_load::case(input, point)));
    cases.extend(extras.snow.map(|snow| snow::case(input, snow)));
    cases
}

/// Those cases, and the surge over every depth of deposit between: the envelope that each component is held against. A point
/// load comes with every surge.
pub fn envelope(input: &GuidelineInput, extras: &Extras) -> Vec<LoadCase> {
    let room = input.fill_height - input.moving_depth();
    let stages = (1..STAGES).map(|stage| later_surge::case(input, room * stage as f64 / STAGES as f64));
    let cases = all(input, extras).into_iter().chain(stages).filter(|case| case.certainty.decides());
    cases.map(|case| LoadCase { point: extras.point.filter(|_| case.moving > 0.0), ..case }).collect()
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
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    /// ρ 2000, α 20°, a barrier 4 m high that fills, h 1 m, v 6 m/s, K = λ = 1.
    pub fn input() -> GuidelineInput {
        GuidelineInput {
            density: 2000.0,
            gravity_normal: 9.81 * libm::cos(20_f64.to_radians()),
            earth_pressure: 1.0,
            dynamic_pressure: 1.0,
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
            let stages = envelope(&input(), &Extras::default());
            stages.iter().map(|case| case.strip_force(low, high)).fold(0.0, f64::max)
        };
        assert!(largest(1.5, 2.5) > input().impact_pressure());
        for case in all(&input(), &Extras::default()) {
            assert!(largest(1.0, 2.0) >= case.strip_force(1.0, 2.0));
        }
    }

    #[test]
    fn what_is_known_from_memory_alone_never_enters_a_resultant() {
        let case = overtopped::case(&input(), &Extras::default()).unwrap();
        assert!(case.shear > 0.0);
        assert_relative_eq!(case.force_per_width(), case.diagram.force(0.0, 4.0));
        let given = Extras { overflow_drag: Some([0.5, 2.0]), ..Extras::default() };
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
        let point = PointLoad { force: 1e5, height: 2.0 };
        let extras = Extras { point: Some(point), ..Extras::default() };
        for case in envelope(&input(), &extras) {
            assert_eq!(case.point.is_some(), case.moving > 0.0, "{}", case.id);
        }
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
                envelope(input, &Extras::default()).iter().map(LoadCase::force_per_width).fold(0.0, f64::max)
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
        let given = Extras { overflow_drag: Some([0.5, 2.0]), ..Extras::default() };
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
