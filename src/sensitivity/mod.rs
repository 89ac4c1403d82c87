//! How far the verdict of the equations moves when an input does, and how much the flow may grow.

pub(crate) mod simulated;

use serde::{Deserialize, Serialize};

use crate::checks::check_all;
use crate::checks::outcome::{Outcome, most_used};
use crate::checks::range::leave_open_outside_range;
use crate::demand::Demands;
use crate::design::{BarrierDesign, Design};
use crate::guideline::{Guideline, filled, guideline_for, input};
use crate::loads::input::GuidelineInput;

/// What one set of inputs comes to, by the equations or by a simulation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Largest total force (N).
    pub force: f64,
    /// Largest utilisation over the checks that are judged, and the check.
    pub utilisation: Option<f64>,
    pub governing: String,
}

/// The effect of one input, taken down and up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Swing {
    pub name: String,
    /// Share by which it is changed.
    pub share: f64,
    pub down: Point,
    pub up: Point,
}

/// How far one input may go until the first check by equations fails.
#[derive(Clone, Debug, PartialEq)]
pub enum Limit {
    /// No check is judged.
    Unjudged,
    /// Some check fails even at the smallest value tried.
    AlwaysFails,
    /// All hold even at the largest factor tried, which this is.
    NeverFails(f64),
    /// The factor on the input, above 1 where there is something to spare, and the check that fails beyond it.
    At(f64, String),
}

#[derive(Clone, Debug, PartialEq)]
pub struct Margin {
    pub velocity: Limit,
    pub depth: Limit,
}

/// An input, the share by which it is changed, and how to change it by a factor.
type Change = (&'static str, f64, fn(&mut Design, &mut GuidelineInput, f64));

const VELOCITY: Change = ("Velocity v", 0.1, |_, input, factor| input.velocity *= factor);
const DEPTH: Change = ("Depth h", 0.2, |_, input, factor| input.depth *= factor);

/// Inputs of the tornado.
const CHANGES: &[Change] = &[
    VELOCITY,
    DEPTH,
    ("Density ρ", 0.2, |_, input, factor| input.density *= factor),
    ("λ", 0.2, |_, input, factor| input.dynamic_pressure *= factor),
    ("K", 0.2, |_, input, factor| input.earth_pressure *= factor),
    ("Height of filling", 0.2, |_, input, factor| {
        input.fill_height = (input.fill_height * factor).min(input.barrier_height);
    }),
    ("Force of the dissipators", 0.2, |design, _, factor| scale_plateau(design, factor)),
];

fn scale_plateau(design: &mut Design, factor: f64) {
    if let BarrierDesign::FlexibleNet(net) = &mut design.barrier
        && let Some(dissipator) = &mut net.dissipators
    {
        dissipator.plateau *= factor;
    }
}

/// What the equations say with one input changed.
fn changed(design: &Design, change: Change, factor: f64) -> Point {
    let (guideline, outcomes) = outcomes_with(design, change, factor);
    Point::of(guideline.face_force, &outcomes)
}

/// The check that fails first with one input changed, or that a formula governs which is no longer known to hold then; nothing inside where all
/// hold, nothing at all where none is judged.
fn first_to_go(design: &Design, change: Change, factor: f64) -> Option<Option<String>> {
    let (guideline, mut outcomes) = outcomes_with(design, change, factor);
    let point = Point::of(guideline.face_force, &outcomes);
    // Asked as "within", so that what is not a number is not.
    let within = point.utilisation? <= 1.0;
    if !within {
        return Some(Some(point.governing));
    }
    let held: Vec<String> =
        outcomes.iter().filter(|outcome| outcome.holds()).map(|outcome| outcome.id.clone()).collect();
    leave_open_outside_range(design, &guideline, &mut outcomes);
    let open = outcomes.iter().find(|outcome| !outcome.holds() && held.contains(&outcome.id));
    Some(open.map(|outcome| format!("{}, by a formula outside its range", outcome.title)))
}

fn outcomes_with(design: &Design, (_, _, change): Change, factor: f64) -> (Guideline, Vec<Outcome>) {
    let (mut design, mut flow) = (design.clone(), input(design));
    let before = flow.fill_height;
    change(&mut design, &mut flow, factor);
    if flow.fill_height == before {
        flow = filled(&design, flow);
    }
    flow.fill_height = flow.fill_height.max(flow.depth.min(flow.barrier_height));
    let guideline = guideline_for(&design, flow);
    let outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
    (guideline, outcomes)
}

impl Point {
    /// The largest total force (N), and the outcome with the largest utilisation.
    pub fn of(force: f64, outcomes: &[Outcome]) -> Self {
        let governing = most_used(outcomes);
        Self {
            force,
            utilisation: governing.and_then(|outcome| outcome.utilisation),
            governing: governing.map_or(String::new(), |outcome| outcome.title.clone()),
        }
    }

    /// The same where the run behind it cannot be relied on: it says nothing.
    pub fn unreliable(self) -> Self {
        Self { utilisation: None, governing: "cannot be relied on".to_string(), ..self }
    }
}

impl Swing {
    /// How much the utilisation moves, or the force where there is none.
    fn width(&self) -> f64 {
        match (self.down.utilisation, self.up.utilisation) {
            (Some(down), Some(up)) => (up - down).abs(),
            _ => (self.up.force - self.down.force).abs(),
        }
    }
}

/// The tornado: each input alone, the most telling first.
pub fn swings(design: &Design) -> Vec<Swing> {
    let swing = |&change: &Change| {
        let (name, share, _) = change;
        Swing {
            name: name.to_string(),
            share,
            down: changed(design, change, 1.0 - share),
            up: changed(design, change, 1.0 + share),
        }
    };
    let mut swings: Vec<Swing> = CHANGES.iter().map(swing).collect();
    swings.retain(|swing| swing.width() > 0.0);
    swings.sort_by(|a, b| b.width().total_cmp(&a.width()));
    swings
}

/// By how much the flow may grow, or must shrink, until the first check by equations just holds.
pub fn margin(design: &Design) -> Margin {
    // What is outside its range as it is says nothing of how far it may go.
    let outside = first_to_go(design, VELOCITY, 1.0).flatten().is_some();
    // Less than the design has leaves ranges as well, which is no margin.
    let gone = |change: Change, factor: f64| match outside || factor < 1.0 {
        true => {
            let point = changed(design, change, factor);
            point.utilisation.map(|used| if used <= 1.0 { None } else { Some(point.governing) })
        }
        false => first_to_go(design, change, factor),
    };
    let holds = |change: Change, factor: f64| gone(change, factor).map(|gone| gone.is_none());
    let limit = |change: Change, largest: f64| {
        match (holds(change, SMALLEST), holds(change, largest)) {
            (None, _) | (_, None) => return Limit::Unjudged,
            (Some(false), _) => return Limit::AlwaysFails,
            (_, Some(true)) => return Limit::NeverFails(largest),
            _ => {}
        }
        let (mut low, mut high) = (SMALLEST, largest);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if holds(change, middle) == Some(true) {
                low = middle;
            } else {
                high = middle;
            }
        }
        Limit::At(low, gone(change, high).flatten().unwrap_or_default())
    };
    // A flow deeper than the barrier goes over it: no case is of that.
    let flow = input(design);
    let deepest = (flow.barrier_height / flow.depth).clamp(1.0, LARGEST);
    Margin { velocity: limit(VELOCITY, LARGEST), depth: limit(DEPTH, deepest) }
}

/// What the equations say with the smallest velocity a margin is sought for; nothing where no check is judged.
pub fn least(design: &Design) -> Option<Point> {
    let point = changed(design, VELOCITY, SMALLEST);
    point.utilisation.is_some().then_some(point)
}

/// Factors between which a margin is sought.
const SMALLEST: f64 = 0.05;
const LARGEST: f64 = 10.0;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::read::read_design;

    fn design() -> Design {
        read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design
    }

    #[test]
    fn at_the_margin_the_first_check_just_holds() {
        let design = design();
        let Limit::At(factor, first) = margin(&design).velocity else { panic!("no margin") };
        let at = |factor: f64| changed(&design, VELOCITY, factor).utilisation.unwrap();
        // Here the sag of rope 2 leaves the range of its parabola before a check fails.
        assert!(at(factor * 1.001) <= 1.0 && first.ends_with("by a formula outside its range"), "{factor}: {first}");
        assert_eq!(first_to_go(&design, VELOCITY, factor * 1.001), Some(Some(first)));
        assert_eq!(first_to_go(&design, VELOCITY, factor), Some(None));
        // A wall has no such formula.
        let design = read_design("x", include_bytes!("../../designs/gravity_wall.yaml")).unwrap().design;
        let Limit::At(factor, first) = margin(&design).velocity else { panic!("no margin") };
        let at = |factor: f64| changed(&design, VELOCITY, factor).utilisation.unwrap();
        assert!(at(factor) <= 1.0 && at(factor * 1.001) > 1.0, "{factor}");
        assert_eq!(first, changed(&design, VELOCITY, factor * 1.001).governing);
    }

    #[test]
    fn more_of_the_flow_never_uses_less() {
        for swing in swings(&design()) {
            if swing.name != "Force of the dissipators" {
                assert!(swing.up.utilisation >= swing.down.utilisation, "{swing:?}");
                assert!(swing.up.force >= swing.down.force, "{swing:?}");
            }
        }
    }

    /// On a wall every force is proportional to the density of the flow.
    #[test]
    fn a_swing_goes_down_and_up_by_its_share() {
        let design = read_design("x", include_bytes!("../../designs/rigid_wall.yaml")).unwrap().design;
        let swings = swings(&design);
        let density = swings.iter().find(|swing| swing.name == "Density ρ").expect("a swing");
        assert_eq!(density.share, 0.2);
        assert!((density.up.force / density.down.force - 1.2 / 0.8).abs() < 1e-12);
        // A wall has no dissipators, and what moves most comes first.
        assert!(swings.iter().all(|swing| swing.name != "Force of the dissipators"));
        assert!(swings.len() >= 4 && swings.windows(2).all(|pair| pair[0].width() >= pair[1].width()));
    }

    #[test]
    fn the_plateau_is_taken_down_and_up() {
        let mut design = design();
        scale_plateau(&mut design, 0.8);
        let crate::design::BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
        assert!((net.dissipators.as_ref().expect("dissipators").plateau - 120e3).abs() < 1e-6);
    }

    #[test]
    fn a_swing_is_as_wide_as_its_utilisation_moves_or_its_force_where_there_is_none() {
        let point = |force: f64, utilisation: Option<f64>| Point { force, utilisation, governing: "rope".into() };
        let swing = |down: Point, up: Point| Swing { name: "x".into(), share: 0.1, down, up };
        let judged = swing(point(10.0, Some(0.75)), point(30.0, Some(0.25)));
        assert_eq!(judged.width(), 0.5);
        let unjudged = swing(point(30.0, Some(0.75)), point(10.0, None));
        assert_eq!(unjudged.width(), 20.0);
        let silent = point(10.0, Some(0.5)).unreliable();
        assert_eq!((silent.force, silent.utilisation, silent.governing.as_str()), (10.0, None, "cannot be relied on"));
    }

    #[test]
    fn a_margin_is_told_where_there_is_one() {
        let mut design = design();
        assert!(least(&design).is_some_and(|point| point.utilisation.is_some()));
        let everything = |design: &mut Design, factor: f64| {
            let crate::design::BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
            net.main_ropes.levels.iter_mut().for_each(|level| level.rope.breaking_load *= factor);
            net.anchor_designs = net.anchor_designs.times(factor);
            let bolts = net.bed_bolts.as_mut().expect("bolts");
            bolts.resistance = bolts.resistance.map(|it| factor * it);
            let dissipator = net.dissipators.as_mut().expect("dissipators");
            (dissipator.plateau, dissipator.stroke) = (1e9, 1e9);
            design.factors.overstrength = 1e-9;
        };
        design.limits.outside_range = crate::design::OutsideRange::Warn;
        let mut strong = design.clone();
        everything(&mut strong, 1e9);
        assert_eq!(margin(&strong).velocity, Limit::NeverFails(LARGEST));
        // No deeper than the barrier is high.
        let deepest = input(&strong).barrier_height / input(&strong).depth;
        assert_eq!(margin(&strong).depth, Limit::NeverFails(deepest));
        everything(&mut design, 1e-9);
        assert_eq!(margin(&design).velocity, Limit::AlwaysFails);
        // With no resistance nothing is judged.
        let mut wall = read_design("x", include_bytes!("../../designs/rigid_wall.yaml")).unwrap().design;
        let crate::design::BarrierDesign::RigidWall(bare) = &mut wall.barrier else { panic!("a wall") };
        (bare.resistance, bare.moment_resistance) = (None, None);
        assert_eq!((margin(&wall).depth, least(&wall)), (Limit::Unjudged, None));
    }
}
