//! A wall that stands by its weight: sliding along its base, overturning about the downstream edge, pressure under the base. Per metre of
//! width.

use crate::checks::outcome::{BasePressure, CheckName, Kind, LoadScaling, OpenReason, Outcome, Resistance, Route};
use crate::demand::{Demand, Demands};
use crate::design::{BarrierDesign, Design, Stability};
use crate::guideline::{input, point_load, wall_of};
use crate::larger::larger_or_nan;
use crate::loads::wall::WallInput;
use crate::quantities::quantity::Unit;
use crate::quantities::wall as quantity;
use crate::sources::WALL_BALANCE;
use crate::text::Text;

pub(crate) const TEXTS: &[Text] = &[
    Text {
        id: "wall_sliding",
        meaning: "A wall that stands by its weight slides along its base: what pushes along the base, uplift and the thrust of water and ground on its buried face included, against friction. A point load counts on 0.41 of the block that it hits, because at the end of a block it turns it as well.",
        formula: "γ_F R (cos δ + tan θ sin δ + tan φ · lift) + W sin β + U tan φ + E ≤ W cos β tan φ/γ_R",
        source: WALL_BALANCE,
    },
    Text {
        id: "wall_overturning",
        meaning: "A wall that stands by its weight tips about the downstream edge of its base.",
        formula: "γ_F M + lift · b + W sin β H/2 + 2 U b/3 + M_E ≤ W cos β (b − a)/γ_R",
        source: WALL_BALANCE,
    },
    Text {
        id: "wall_eccentricity",
        meaning: "How far the resultant stands off the middle of the base. Beyond a third of the base special precautions are needed (EN 1997-1, 6.5.4, not checked against the original).",
        formula: "e ≤ b/3",
        source: WALL_BALANCE,
    },
    Text {
        id: "wall_bearing",
        meaning: "The mean pressure on the effective area of the base, which is centred under the resultant, against the bearing resistance of the ground.",
        formula: "N/(b − 2 e) ≤ q_k/γ_R",
        source: "EN 1997-1, annex D, not checked against the original",
    },
];

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let (Some(wall), Some(stability)) = (wall_of(design), stability_of(design)) else { return Vec::new() };
    let (force, moment) = (demands.one(&quantity::SLIDING), demands.one(&quantity::OVERTURNING));
    // The load on a block by the equations; against sliding a point load counts more, because it may hit the end of the block.
    let pushes = demands.one(&quantity::PRESS).guideline;
    // Moments are told about the foot of the face; the base lies deeper.
    let deeper = stability.founding_depth * libm::cos(wall.base_slope);
    let lowered = |moment: Option<f64>, force: Option<f64>| {
        if deeper > 0.0 { moment.zip(force).map(|(moment, force)| moment + force * deeper) } else { moment }
    };
    let moment = Demand {
        guideline: lowered(moment.guideline, pushes.map(|load| load * wall.along_share())),
        simulation: lowered(moment.simulation, force.simulation),
        characteristic: lowered(moment.characteristic, force.characteristic),
        ..moment
    };
    let base = Base {
        wall,
        stability,
        force,
        tips: Demand {
            guideline: (moment.guideline.zip(pushes))
                .map(|(moment, load)| moment + load * wall.lift_share() * wall.base_width),
            ..moment
        },
        press: demands.one(&quantity::PRESS),
        load_factor: design.factors.load,
    };
    let off_centre = base.off_centre();
    let mut outcomes = vec![base.pressure(), base.eccentricity(off_centre), base.sliding(), base.overturning()];
    leave_open_untold(&stability, &mut outcomes);
    leave_open_where_joints_are_unknown(design, &stability, &mut outcomes);
    leave_open_where_the_base_gapes(&wall, off_centre, &mut outcomes);
    leave_open_below_water(design, &stability, &mut outcomes);
    outcomes
}

/// A wall on its base, and what the flow does to it, per width.
struct Base {
    wall: WallInput,
    stability: Stability,
    /// By the equations the load along the bed, by the simulation what slides the wall along its base (N/m).
    force: Demand,
    /// Moment about the upstream end of the base, lift included (N m/m).
    tips: Demand,
    /// By the equations the load along the bed, by the simulation what presses on the base (N/m).
    press: Demand,
    load_factor: f64,
}

impl Base {
    fn sliding(&self) -> Outcome {
        let [holds, pull] = self.wall.sliding();
        let name = CheckName::new("wall_sliding", "Sliding of the wall, per width", Unit::NewtonPerMetre, WALL_BALANCE);
        let slides = self.force.guideline.map(|load| load * self.wall.sliding_share());
        let demand = with_own(Demand { guideline: slides, ..self.force }, pull);
        but_for(pull, held(name, demand, holds, self.stability.sliding_factor))
    }

    fn overturning(&self) -> Outcome {
        let [holds, tilt] = self.wall.overturning();
        let name = CheckName::new(
            "wall_overturning",
            "Overturning of the wall, per width",
            Unit::NewtonMetrePerMetre,
            WALL_BALANCE,
        );
        but_for(tilt, held(name, with_own(self.tips, tilt), holds, self.stability.overturning_factor))
    }

    /// How far the resultant stands off the middle of the base, under a moment that tips the wall, its own included: it stands what holds less
    /// that moment over what bears from the downstream edge; the lift of the load, which makes that less, is left out on the safe side.
    fn eccentricity_under(&self, tips: f64) -> f64 {
        let [holds, _] = self.wall.overturning();
        0.5 * self.wall.base_width - (holds - tips) / self.wall.bears()
    }

    fn off_centre(&self) -> Demand {
        // Of the wall without the flow as much of a third of its thickness may be used.
        let at_rest = self.wall.eccentricity_at_rest() * self.wall.base_width / self.wall.thickness;
        let [_, tilt] = self.wall.overturning();
        let tipped = with_own(self.tips, tilt);
        let off = |tips: f64| larger_or_nan(self.eccentricity_under(tips), at_rest);
        Demand { guideline: tipped.guideline.map(off), simulation: tipped.simulation.map(off), ..Demand::default() }
    }

    fn eccentricity(&self, off_centre: Demand) -> Outcome {
        let name = CheckName::new(
            "wall_eccentricity",
            "Eccentricity of the pressure under the wall",
            Unit::Metre,
            "EN 1997-1, 6.5.4, not checked against the original: beyond a third of the base special precautions are needed",
        );
        let [_, tilt] = self.wall.overturning();
        let outcome = held(name, off_centre, self.wall.base_width / 3.0, 1.0);
        Outcome { kind: Kind::BaseActions, ..but_for(self.eccentricity_under(tilt), outcome) }
    }

    fn pressure(&self) -> Outcome {
        let under = BasePressure {
            wall: self.wall,
            // What presses on the ground is unfavourable there.
            weight_factor: self.load_factor,
            guideline: (self.tips.guideline.zip(self.press.guideline))
                .map(|(moment, load)| [moment, load * self.wall.press_share()]),
            simulation: self.tips.simulation.zip(self.press.simulation).map(|(moment, press)| [moment, press]),
        };
        let demand = Demand {
            guideline: under.pressure(Route::Guideline, 1.0),
            simulation: under.pressure(Route::Simulation, 1.0),
            ..Demand::default()
        };
        let name = CheckName::new(
            "wall_bearing",
            "Pressure under the wall",
            Unit::Pascal,
            "EN 1997-1, annex D, not checked against the original: the load on the effective area of the base, which is centred under the resultant",
        );
        let outcome = match self.stability.bearing_resistance {
            Some(characteristic) => held(name, demand, characteristic, self.stability.bearing_factor),
            None => Outcome::without_resistance(name, demand, "barrier.rigid_wall.stability.bearing_resistance"),
        };
        Outcome { kind: Kind::BaseActions, growth: LoadScaling::BasePressure(under), ..outcome }
    }
}

/// A demand with what is there without the flow.
fn with_own(demand: Demand, own: f64) -> Demand {
    demand.with_own(own, own)
}

fn held(name: CheckName, demand: Demand, characteristic: f64, factor: f64) -> Outcome {
    Outcome::at_most(name, demand, Resistance { characteristic, factor }, 1.0)
}

/// An outcome whose demand grows in proportion to the load, but for what is there without it.
fn but_for(fixed: f64, outcome: Outcome) -> Outcome {
    Outcome { growth: LoadScaling::InProportion { fixed }, ..outcome }
}

/// Where the resultant leaves the middle third of the base, the joint under the upstream edge opens, and water fills it with its full head:
/// more uplift than falls evenly from one edge to the other.
fn leave_open_where_the_base_gapes(wall: &WallInput, off_centre: Demand, outcomes: &mut [Outcome]) {
    let gapes = off_centre.largest().is_some_and(|eccentricity| eccentricity > wall.base_width / 6.0);
    if !gapes || wall.water_head <= 0.0 {
        return;
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        outcome.leave_open(OpenReason::NotGiven(
            "the joint under the wall opens at its upstream edge (the resultant lies outside the middle third of the base), and water stands in it with its full head, not with one that falls evenly (drain the base, or widen it)".into(),
        ));
    }
}

/// Water that stands higher than what fills the barrier pushes the wall above it as well, and no load case has that.
fn leave_open_below_water(design: &Design, stability: &Stability, outcomes: &mut [Outcome]) {
    let (head, filled) = (stability.water_head.unwrap_or(0.0), input(design).fill_height);
    if head <= filled {
        return;
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        outcome.leave_open(OpenReason::NotGiven(format!(
            "water with a head of {head:.2} m under the base may stand as high behind the wall, above the {filled:.2} m of the deposit, and its thrust there is in no load case (lower barrier.rigid_wall.stability.water_head by drains, or loads.filling: to_the_top)"
        )));
    }
}

/// A level and dry base is the mildest there is: what holds on one that nobody described stays open.
fn leave_open_untold(stability: &Stability, outcomes: &mut [Outcome]) {
    let untold: Vec<&str> = [
        stability.base_slope.is_none().then_some("barrier.rigid_wall.stability.base_slope, 0 deg for a level base"),
        stability.water_head.is_none().then_some("barrier.rigid_wall.stability.water_head, 0 m for a drained base"),
    ]
    .into_iter()
    .flatten()
    .collect();
    if untold.is_empty() {
        return;
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        outcome.leave_open(OpenReason::NotGiven(format!(
            "it holds on the mildest base, and the design does not describe its own (give {})",
            untold.join(", and ")
        )));
    }
}

/// A point load spreads no further than to the next joint of the wall, and a short block slides and turns under it where a long one stands.
fn leave_open_where_joints_are_unknown(design: &Design, stability: &Stability, outcomes: &mut [Outcome]) {
    if stability.block_length.is_some() || point_load(design, &input(design)).is_none_or(|hit| hit.hardest() == 0.0) {
        return;
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        outcome.leave_open(OpenReason::NotGiven(
            "it holds where the point load spreads at 45° to one side, and whether joints of the wall stop it is not said (give barrier.rigid_wall.stability.block_length, the length of the wall if it has no joints)".into(),
        ));
    }
}

fn stability_of(design: &Design) -> Option<Stability> {
    match &design.barrier {
        BarrierDesign::RigidWall(wall) => wall.stability,
        BarrierDesign::FlexibleNet(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::check_all;
    use crate::checks::outcome::CheckVerdict;
    use crate::design::read::read_design;
    use crate::guideline::guideline;
    use crate::quantities::wall;
    use approx::assert_relative_eq;

    fn design() -> Design {
        read_design("x", include_bytes!("../../designs/rigid_wall.yaml")).unwrap().design
    }

    /// Water above what fills the barrier is in no load case.
    #[test]
    fn water_above_the_deposit_is_open() {
        let verdict = |above: f64| {
            let mut design = with_stability();
            let filled = crate::guideline::input(&design).fill_height;
            let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
            let stability = wall.stability.as_mut().expect("stability");
            (stability.thickness, stability.base_width, stability.bearing_resistance) = (40.0, 40.0, Some(1e6));
            stability.water_head = Some(above * filled);
            let demands = Demands::by_equations(&guideline(&design), &design.factors);
            check(&design, &demands).into_iter().map(|outcome| outcome.verdict).collect::<Vec<_>>()
        };
        assert_eq!(verdict(0.99), [CheckVerdict::Pass; 4]);
        assert_eq!(verdict(1.01), [CheckVerdict::Open; 4]);
    }

    fn with_stability() -> Design {
        let mut design = design();
        let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
        wall.resistance = None;
        wall.stability = Some(Stability {
            thickness: 2.0,
            density: 2400.0,
            base_width: 2.0,
            base_slope: Some(0.0),
            founding_depth: 0.0,
            base_friction: 0.7,
            ground_density: 2200.0,
            sliding_factor: 1.1,
            overturning_factor: 1.5,
            bearing_resistance: None,
            bearing_factor: 1.4,
            block_length: None,
            water_head: Some(0.0),
        });
        design
    }

    #[test]
    fn a_wall_without_resistance_and_stability_is_open_and_one_with_either_is_not() {
        let open = |design: &Design| {
            let outcomes = check_all(design, &Demands::by_equations(&guideline(design), &design.factors));
            outcomes.iter().any(|outcome| outcome.id == "total_force" && outcome.verdict == CheckVerdict::Open)
        };
        assert!(!open(&design()) && !open(&with_stability()));
        let mut bare = design();
        if let BarrierDesign::RigidWall(wall) = &mut bare.barrier {
            wall.resistance = None;
        }
        assert!(open(&bare));
    }

    /// Plumb, 5.5 m high, on a level base below a bed of 40°: it weighs what it is high, and the flow pushes it level.
    #[test]
    fn a_plumb_wall_is_held_against_its_own_weight_and_a_level_push() {
        let design = with_stability();
        let demands = Demands::by_equations(&guideline(&design), &design.factors);
        let sliding = check(&design, &demands).into_iter().find(|outcome| outcome.id == "wall_sliding").unwrap();
        let weight = 2400.0 * crate::units::GRAVITY * 2.0 * 5.5;
        assert_relative_eq!(sliding.capacity.unwrap(), 0.7 * weight / 1.1, max_relative = 1e-9);
        let along = guideline(&design).largest_force / design.channel.width;
        let level = along / libm::cos(40_f64.to_radians());
        assert_relative_eq!(sliding.demand.guideline.unwrap(), level, max_relative = 1e-9);
    }

    /// What is simulated is held against the same weight, its own pull and tilt added, as what the equations say.
    #[test]
    fn a_simulated_push_comes_beside_the_wall_s_own() {
        let mut design = with_stability();
        let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
        let stability = wall.stability.as_mut().expect("stability");
        (stability.base_slope, stability.bearing_resistance) = (Some(0.1), Some(1e6));
        let input = wall_of(&design).expect("a wall");
        let simulated =
            |value: f64| Demand { simulation: Some(value), characteristic: Some(0.5 * value), ..Demand::default() };
        let demands = Demands::default()
            .with(&wall::SLIDING, &[simulated(40e3)])
            .with(&wall::OVERTURNING, &[simulated(60e3)])
            .with(&wall::PRESS, &[simulated(10e3)]);
        let outcomes = check(&design, &demands);
        let of = |id: &str| outcomes.iter().find(|outcome| outcome.id == id).expect("a check").demand;
        let ([_, pull], [holds, tilt]) = (input.sliding(), input.overturning());
        assert!(pull > 1e3 && tilt > 1e3);
        assert_eq!(of("wall_sliding").simulation, Some(40e3 + pull));
        assert_eq!(of("wall_sliding").characteristic, Some(20e3 + pull));
        assert_eq!(of("wall_overturning").simulation, Some(60e3 + tilt));
        let normal = input.weight() * libm::cos(0.1_f64);
        let off = 1.0 - (holds - 60e3 - tilt) / normal;
        assert_relative_eq!(of("wall_eccentricity").simulation.unwrap(), off, max_relative = 1e-12);
        assert_relative_eq!(
            of("wall_bearing").simulation.unwrap(),
            (normal + 10e3) / (2.0 - 2.0 * off),
            max_relative = 1e-12
        );
    }

    /// A block thick enough to hold, on a base that is described, or not in full.
    #[test]
    fn a_base_that_nobody_described_is_open() {
        let verdicts = |base_slope: Option<f64>, water_head: Option<f64>| {
            let mut design = with_stability();
            let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
            let stability = wall.stability.as_mut().expect("stability");
            (stability.thickness, stability.base_width, stability.bearing_resistance) = (40.0, 40.0, Some(1e6));
            (stability.base_slope, stability.water_head) = (base_slope, water_head);
            let demands = Demands::by_equations(&guideline(&design), &design.factors);
            check(&design, &demands).into_iter().map(|outcome| outcome.verdict).collect::<Vec<_>>()
        };
        assert_eq!(verdicts(Some(0.0), Some(0.0)), [CheckVerdict::Pass; 4]);
        assert_eq!(verdicts(None, Some(0.0)), [CheckVerdict::Open; 4]);
        assert_eq!(verdicts(Some(0.0), None), [CheckVerdict::Open; 4]);
    }

    /// 1.35 · 100 kN at 1.5 m on a block of 8 m: 16.9 kN/m push it and tip it with 25.3 kN m/m, and 40.7 kN/m slide it where it is hit at its end.
    #[test]
    fn a_block_carries_a_point_load_as_one() {
        let demands = |force: f64| {
            let mut design = read_design("x", include_bytes!("../../designs/gravity_wall.yaml")).unwrap().design;
            design.loads.point_load = Some((force, Some(1.5)));
            let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
            wall.stability.as_mut().expect("stability").block_length = Some(8.0);
            let demands = Demands::by_equations(&guideline(&design), &design.factors);
            let of = |what| demands.one(what).guideline.expect("a demand");
            [of(&quantity::SLIDING), of(&quantity::PRESS), of(&quantity::OVERTURNING)]
        };
        let (with, without) = (demands(100e3), demands(0.0));
        for (index, more) in [40.74e3, 16.875e3, 25.3125e3].into_iter().enumerate() {
            assert_relative_eq!(with[index] - without[index], more, max_relative = 1e-3);
        }
    }

    #[test]
    fn a_point_load_on_a_wall_of_unknown_joints_is_open() {
        let verdicts = |block_length: Option<f64>, force: f64| {
            let mut design = with_stability();
            design.loads.point_load = Some((force, Some(1.0)));
            let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
            let stability = wall.stability.as_mut().expect("stability");
            (stability.thickness, stability.base_width, stability.bearing_resistance) = (40.0, 40.0, Some(1e6));
            stability.block_length = block_length;
            let demands = Demands::by_equations(&guideline(&design), &design.factors);
            check(&design, &demands).into_iter().map(|outcome| outcome.verdict).collect::<Vec<_>>()
        };
        assert_eq!(verdicts(None, 1e3), [CheckVerdict::Open; 4]);
        assert_eq!(verdicts(None, 0.0), [CheckVerdict::Pass; 4]);
        assert_eq!(verdicts(Some(5.0), 1e3), [CheckVerdict::Pass; 4]);
    }

    /// 50 kN/m along a bed of 14° press on a plumb face with 50/cos 14° = 51.53 kN/m along a level base: 1.8 m deeper they tip with 92.76 kN m/m
    /// more, and the ground on the buried face with its own moment.
    #[test]
    fn a_wall_tips_about_the_base_that_it_is_founded_on() {
        let overturning = |depth: f64| {
            let mut design = read_design("x", include_bytes!("../../designs/gravity_wall.yaml")).unwrap().design;
            let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
            wall.stability.as_mut().expect("stability").founding_depth = depth;
            let of = |value: f64| Demand { guideline: Some(value), ..Demand::default() };
            let demands =
                Demands::default().with(&quantity::PRESS, &[of(50e3)]).with(&quantity::OVERTURNING, &[of(100e3)]);
            let outcomes = check(&design, &demands);
            let outcome = outcomes.iter().find(|outcome| outcome.id == "wall_overturning").expect("a check");
            [outcome.demand.guideline.expect("a moment"), wall_of(&design).expect("a wall").earth_thrust()[1]]
        };
        let [[deep, ground], [shallow, none]] = [1.8, 0.0].map(overturning);
        assert!(ground > 1e3 && none == 0.0);
        let more = deep - ground - shallow;
        assert!((more / 92.756e3 - 1.0).abs() < 1e-3, "{more}");
    }
}
