//! One stage of a barrier's life: its pressures, and what acts beside them.

use crate::larger::larger_or_nan;
use crate::loads::cases::working::Working;
use crate::loads::pressure::Diagram;
use crate::section::Section;

/// How sure we are of a formula or a value; only what is certain may decide a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Certainty {
    /// Read in the source itself, or in an excerpt of it.
    Read,
    /// As Albaba 2015 cites it.
    Cited,
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
            Self::Read => "read in the source",
            Self::Cited => "as cited by Albaba 2015",
            Self::Given => "given in the design",
            Self::Derived => "derived",
            Self::Memory => "not checked against the original; for information only",
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

/// What hits the barrier at one place: a force (N), and where.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Hit {
    /// Nothing where none is given.
    pub force: f64,
    /// Above the bed (m), where it is given; else at the surface of the flow that brings it.
    pub height: Option<f64>,
    /// Of that surface over the deposit that the flow comes over, or of the boulder's centre if that is higher (m).
    pub over_deposit: f64,
    /// Force of the largest boulder that the flow brings, at that surface (N); nothing without one.
    pub of_boulder: f64,
}

impl Hit {
    /// Where it hits a barrier of a height over a deposit (m). What is given stands for the boulder if it has no less force and moment; else both act
    /// as one load that has no less than either.
    pub fn over(self, deposit: f64, barrier_height: f64) -> PointLoad {
        let surface = (deposit + self.over_deposit).min(barrier_height);
        let given =
            PointLoad { force: self.force, height: self.height.map_or(surface, |height| height.min(barrier_height)) };
        // Asked so that what is not a number does not stand for a boulder.
        if self.of_boulder == 0.0
            || given.force >= self.of_boulder && given.force * given.height >= self.of_boulder * surface
        {
            return given;
        }
        let height = if given.force > 0.0 { larger_or_nan(given.height, surface) } else { surface };
        PointLoad { force: self.hardest(), height }
    }

    /// Force of what hits hardest (N).
    pub fn hardest(self) -> f64 {
        larger_or_nan(self.force, self.of_boulder)
    }
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
    /// Whether it is one of several that differ in the depth of their deposit alone.
    pub one_of_the_stages: bool,
    /// What of it the simulation of one surge on the empty barrier does not hold, as a sentence names it.
    pub not_simulated: Option<&'static str>,
    /// The resultant in symbols, and with its numbers put in.
    pub formula: &'static str,
    pub working: Working,
    pub certainty: Certainty,
    pub source: &'static str,
}

/// What a wall that stands by its weight takes, per width: the load along the bed that it must not slide under and the one that pushes and
/// presses it (N/m), and the moment about the foot of its face (N m/m).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BaseActions {
    pub slides: f64,
    pub pushes: f64,
    pub tips: f64,
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

    /// Force on a barrier across this section, its point load included (N).
    pub fn total_force(&self, section: &Section) -> f64 {
        self.spread_force(section) + self.point.map_or(0.0, |point| point.force)
    }

    /// Force of pressures and drag on a barrier across this section (N).
    pub fn spread_force(&self, section: &Section) -> f64 {
        match section {
            Section::Rectangle { width } => self.force_per_width() * width,
            Section::Surveyed(_) => {
                let drag = self.decisive_shear() * section.width(self.diagram.top);
                self.diagram.force_over(section, 0.0, f64::INFINITY) + drag
            }
        }
    }

    /// Moment about the bed, per width, of all that acts on a barrier of this width (N m/m).
    pub fn mean_moment(&self, width: f64) -> f64 {
        self.moment_per_width() + self.point.map_or(0.0, |point| point.force * point.height / width)
    }

    /// Force normal to a face that leans by θ from the bed's normal, on a barrier across this section (N): what presses on it has R along the bed
    /// and R tan θ off it, R/cos θ in all. Drag and point load are taken likewise, which is on the safe side.
    pub fn face_force(&self, section: &Section, lean: f64) -> f64 {
        self.total_force(section) / libm::cos(lean)
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

    /// What a wall that stands by its weight takes, per width: any metre of it, or where blocks of this length move as one a metre of a block.
    ///
    /// A block tips about its whole edge wherever it is hit. A point load P at its end pushes it there and turns it about a point x from that
    /// end: with the resistance r of each metre and what else pushes it, q, upper-bound analysis gives
    /// P x = (r − q) x²/2 + (r + q) (L − x)²/2, which is no less than (r − q) (x² + (L − x)²)/2. That is least for P at x = L/√2, where
    /// r = q + P/((√2 − 1) L).
    pub fn on_the_base(&self, block: Option<f64>, width: f64, height: f64, lean: f64) -> BaseActions {
        let Some(block) = block else {
            let force = self.metre_force(width, height);
            return BaseActions { slides: force, pushes: force, tips: self.foot_moment(width, lean) };
        };
        let length = block.min(width);
        let shared = |length: f64| self.force_per_width() + self.point.map_or(0.0, |point| point.force / length);
        BaseActions {
            slides: shared((std::f64::consts::SQRT_2 - 1.0) * length),
            pushes: shared(length),
            tips: self.face_moment(length, lean),
        }
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
pub struct AdditionalActions {
    /// Depth of the flow over the full barrier h_o (m); that of the surge unless given.
    pub overflow_depth: Option<f64>,
    /// tan φ of the drag on the barrier's top, and the length on which it acts (m).
    pub overflow_drag: Option<[f64; 2]>,
    /// K and density (kg/m³) of the drained deposit.
    pub drained: Option<[f64; 2]>,
    pub point: Option<Hit>,
    /// Uniform pressure of snow (Pa).
    pub snow: Option<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A boulder of 100 kN comes at 2 m. 200 kN at 1 m stand for it; 10 kN at 3 m, or 150 kN at 1 m, do not, whatever they spare.
    #[test]
    fn what_is_given_stands_for_a_boulder_or_both_act() {
        let over = |force: f64, height: f64| {
            let hit = Hit { force, height: Some(height), over_deposit: 1.0, of_boulder: 100.0 };
            hit.over(1.0, 4.0)
        };
        assert_eq!(over(200.0, 1.0), PointLoad { force: 200.0, height: 1.0 });
        assert_eq!(over(10.0, 3.0), PointLoad { force: 100.0, height: 3.0 });
        assert_eq!(over(150.0, 1.0), PointLoad { force: 150.0, height: 2.0 });
        let boulder = Hit { over_deposit: 1.0, of_boulder: 100.0, ..Hit::default() };
        assert_eq!(boulder.over(1.0, 4.0), PointLoad { force: 100.0, height: 2.0 });
        assert_eq!(boulder.over(5.0, 4.0), PointLoad { force: 100.0, height: 4.0 });
        let given = Hit { force: 50.0, height: Some(1.5), over_deposit: 1.0, of_boulder: 0.0 };
        assert_eq!(given.over(1.0, 4.0), PointLoad { force: 50.0, height: 1.5 });
        assert!(Hit { of_boulder: f64::NAN, ..given }.over(1.0, 4.0).force.is_nan());
    }
}
