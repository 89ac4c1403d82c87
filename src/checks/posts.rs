//! Posts: compression with bending, the foundations of their feet, the ropes that retain them with their dissipators and anchors.

use crate::checks::anchors::open_without_overstrength;
use crate::checks::dissipators::{growth_of, open_without_least_force};
use crate::checks::outcome::{CheckName, Kind, LoadScaling, OpenReason, Outcome, PostInteraction, Resistance};
use crate::checks::ropes;
use crate::demand::{Demand, Demands};
use crate::design::{BarrierDesign, Design, PostStrength, Posts};
use crate::guideline::height_over_bed;
use crate::guideline::posts::input;
use crate::loads::posts::{Column, Strut};
use crate::quantities::posts;
use crate::quantities::quantity::Unit;
use crate::sources::{ANCHOR_FACTOR, POST_STRENGTH, ROPE_FACTOR, STROKE_DATA};
use crate::text::Text;
use crate::units::GRAVITY;

pub(crate) const TEXTS: &[Text] = &[
    Text {
        id: "post_N_compression",
        meaning: "The compression of a post, counted in the order of posts.at, together with its bending by what presses on it.",
        formula: "N + N_b M/(M_R (1 − N/N_cr)) ≤ N_b = χ A f_y/γ",
        source: POST_STRENGTH,
    },
    Text {
        id: "post_N_uplift",
        meaning: "The pull on the foundation of a post, where its ropes lift it.",
        formula: "T ≤ anchor_utilisation · R_k/γ_M",
        source: ANCHOR_FACTOR,
    },
    Text {
        id: "post_N_foot",
        meaning: "The force of a post on its foundation, all directions taken together.",
        formula: "F ≤ anchor_utilisation · R_k/γ_M",
        source: ANCHOR_FACTOR,
    },
    Text {
        id: "post_N_retaining_tension",
        meaning: "The tension of the ropes that retain a post.",
        formula: "T ≤ rope_utilisation · F_br · rope_end/γ_M",
        source: ROPE_FACTOR,
    },
    Text {
        id: "post_N_retaining_stroke",
        meaning: "The stroke of the dissipators of the ropes that retain a post. Where they would yield, nothing else holds the head of the post, and by the equations their strokes count as used up.",
        formula: "s ≤ dissipator_utilisation · s_max",
        source: STROKE_DATA,
    },
    Text {
        id: "post_N_anchor_load",
        meaning: "The load of the anchors of the ropes that retain a post.",
        formula: "T ≤ anchor_utilisation · R_k/γ_M",
        source: ANCHOR_FACTOR,
    },
    Text {
        id: "retaining_plateau",
        meaning: "A rule of design, whatever the event: a retaining rope must hold the force of its yielding dissipators, with their overstrength.",
        formula: "overstrength · F_plateau ≤ rope_utilisation · F_br · rope_end/γ_M",
        source: ROPE_FACTOR,
    },
    Text {
        id: "retaining_anchor_plateau",
        meaning: "A rule of design, whatever the event: the anchor of a retaining rope must hold the force of its yielding dissipators, with their overstrength.",
        formula: "overstrength · F_plateau ≤ anchor_utilisation · R_k/γ_M",
        source: ANCHOR_FACTOR,
    },
];

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let Some(given) = design.posts() else { return Vec::new() };
    let uppermost = match &design.barrier {
        BarrierDesign::FlexibleNet(net) => net.main_ropes.levels.len() - 1,
        BarrierDesign::RigidWall(_) => 0,
    };
    (0..given.at.len())
        .flat_map(|number| {
            let compression = compressed(design, given, number, demands);
            [compression, foot(design, given, number, demands), rope(design, given, number, demands)]
                .into_iter()
                .chain(uplift(design, given, number, demands))
                .chain(stroke(design, given, number, demands))
                .chain([anchor(design, given, number, demands)])
                .map(|outcome| Outcome {
                    kind: if outcome.kind == Kind::Stroke { Kind::Stroke } else { Kind::Posts },
                    ..outcome.of_rope(uppermost)
                })
        })
        .chain(against_plateau(design, given))
        .collect()
}

/// What a post of a design withstands: what it holds in compression (N) is less the more it is bent. Nothing where nobody says.
pub fn strut(design: &Design, given: &Posts, number: usize) -> Option<Strut> {
    let factor = design.factors.post;
    let length = input(design, given, given.at[number], height_over_bed(design)).length;
    match given.strength {
        PostStrength::Unknown => None,
        PostStrength::Given { compression, bending } => {
            // A post buckles under no less than it resists with: that bounds the load N_cr by which compression makes a moment larger.
            Some(Strut { compression: compression / factor, bending: bending / factor, critical: compression })
        }
        PostStrength::Section(section) => {
            let column = Column {
                length,
                area: given.area,
                modulus: given.modulus,
                radius_of_gyration: section.radius_of_gyration,
                section_modulus: section.lateral_torsional.unwrap_or(1.0) * section.section_modulus,
                yield_strength: section.yield_strength,
                imperfection: section.imperfection,
            };
            Some(column.strut(factor))
        }
    }
}

/// Compression of a post, with what takes up as much of it as its bending, against its resistance to buckling.
fn compressed(design: &Design, given: &Posts, number: usize, demands: &Demands) -> Outcome {
    let pressed = demand(demands.each(&posts::COMPRESSION), number);
    let bent = demand(demands.each(&posts::MOMENT), number);
    let id = format!("post_{}_compression", number + 1);
    let title = format!("Compression of post {}, with its bending", number + 1);
    let name = CheckName::new(id, title, posts::COMPRESSION.unit, POST_STRENGTH);
    let Some(strut) = strut(design, given, number) else {
        let give = "posts.radius_of_gyration, section_modulus and yield_strength, or resistance and bending_resistance";
        return Outcome::without_resistance(name, pressed, give);
    };
    // What comes at once bends a post by up to twice as much as what rests on it.
    let sudden = |moment: Option<f64>| moment.map(|moment| SUDDEN * moment);
    let parts = |compression: Option<f64>, moment: Option<f64>| compression.map(|it| [it, moment.unwrap_or(f64::NAN)]);
    let of_guideline = parts(pressed.guideline, bent.guideline);
    let of_simulation = parts(pressed.simulation, sudden(bent.simulation));
    let both = |parts: Option<[f64; 2]>| parts.map(|[compression, moment]| strut.with_moment(compression, moment));
    let with_moment = Demand {
        guideline: both(of_guideline),
        simulation: both(of_simulation),
        characteristic: both(parts(pressed.characteristic, sudden(bent.characteristic))),
        cap: None,
    };
    let factor = design.factors.post;
    let resistance = Resistance { characteristic: factor * strut.compression, factor };
    let mut outcome = Outcome::at_most(name, with_moment, resistance, 1.0).only_by_simulation(NOT_BY_EQUATIONS);
    if given.retaining.count() == 1 && outcome.holds() {
        outcome.leave_open(OpenReason::NotGiven(
            "nothing but friction of the rope holds the head of a post with a single retaining rope across the channel (give posts.retaining_ropes.spread)".into(),
        ));
    }
    let of_an_open_section =
        matches!(given.strength, PostStrength::Section(section) if section.lateral_torsional.is_none());
    if of_an_open_section && outcome.holds() {
        outcome.leave_open(OpenReason::NotGiven(
            "a post of an open section may buckle sideways under bending before it yields (give posts.lateral_torsional_factor, 1 for a hollow section)".into(),
        ));
    }
    let growth =
        LoadScaling::PostInteraction(PostInteraction { strut, guideline: of_guideline, simulation: of_simulation });
    Outcome { growth, ..outcome }
}

/// By which a load that comes at once bends more than the same load at rest, at the most.
const SUDDEN: f64 = 2.0;

/// A post that is pulled: its own weight holds it, and more of it what is given; nothing where it is pressed all the time.
fn uplift(design: &Design, given: &Posts, number: usize, demands: &Demands) -> Option<Outcome> {
    let demand = demand(demands.each(&posts::UPLIFT), number);
    // Asked so that what is not a number is told.
    let pressed = demand.largest().is_some_and(|largest| largest <= 0.0);
    if pressed {
        return None;
    }
    let length = input(design, given, given.at[number], height_over_bed(design)).length;
    let weight = GRAVITY * given.mass(length);
    let held_by_weight = demand.largest().is_some_and(|largest| largest <= weight);
    let name = CheckName::of(&posts::UPLIFT, number, format!("post_{}_uplift", number + 1), ANCHOR_FACTOR);
    let resistance = match given.uplift_resistance {
        Some(characteristic) => Resistance { characteristic, factor: design.factors.anchor },
        None if held_by_weight => Resistance { characteristic: weight, factor: 1.0 },
        None => return Some(Outcome::without_resistance(name, demand, "posts.uplift_resistance")),
    };
    let limit = design.limits.anchor_utilisation;
    Some(Outcome::at_most(name, demand, resistance, limit).only_by_simulation(NOT_BY_EQUATIONS))
}

/// Why the equations alone let no post and no foundation pass.
const NOT_BY_EQUATIONS: &str = "the net hands load to the heads of posts, grains jam at the posts and press on their ropes, and the equations do not know by how much";

fn demand(all: &[Demand], number: usize) -> Demand {
    // What nobody tells is not a number, so that nothing is judged by it.
    let unknown = Demand { guideline: Some(f64::NAN), ..Demand::default() };
    all.get(number).copied().unwrap_or(unknown)
}

/// The foundation of a post, with the factor of anchors.
fn foot(design: &Design, given: &Posts, number: usize, demands: &Demands) -> Outcome {
    let demand = demand(demands.each(&posts::FOOT), number);
    let name = CheckName::of(&posts::FOOT, number, format!("post_{}_foot", number + 1), ANCHOR_FACTOR);
    match given.foot_resistance {
        Some(characteristic) => {
            let resistance = Resistance { characteristic, factor: design.factors.anchor };
            Outcome::at_most(name, demand, resistance, design.limits.anchor_utilisation)
                .only_by_simulation(NOT_BY_EQUATIONS)
        }
        None => Outcome::without_resistance(name, demand, "posts.foot_resistance"),
    }
}

fn rope(design: &Design, given: &Posts, number: usize, demands: &Demands) -> Outcome {
    let (demand, rope) = (demand(demands.each(&posts::RETAINING), number), &given.retaining.rope);
    let id = format!("post_{}_retaining_tension", number + 1);
    let name = CheckName::of(&posts::RETAINING, number, id, ROPE_FACTOR);
    ropes::check(design, rope, name, demand).only_by_simulation(NOT_BY_EQUATIONS)
}

fn stroke(design: &Design, given: &Posts, number: usize, demands: &Demands) -> Option<Outcome> {
    let dissipators = given.retaining.dissipators.as_ref()?;
    let tension = demand(demands.each(&posts::RETAINING), number);
    let demand = demand(demands.each(&posts::STROKE), number);
    let id = format!("post_{}_retaining_stroke", number + 1);
    let name = CheckName::of(&posts::STROKE, number, id, STROKE_DATA);
    let stroke = Resistance { characteristic: dissipators.stroke, factor: 1.0 };
    let outcome = Outcome::at_most(name, demand, stroke, design.limits.dissipator_utilisation);
    let outcome = outcome.only_by_simulation(NOT_BY_EQUATIONS);
    let growth = growth_of(dissipators, &demand, &tension).unwrap_or(outcome.growth);
    let outcome = Outcome { kind: Kind::Stroke, growth, ..outcome };
    Some(open_without_least_force(dissipators, outcome, "posts.retaining_ropes.dissipators.lower_bound"))
}

/// An anchor bears its one rope.
fn anchor(design: &Design, given: &Posts, number: usize, demands: &Demands) -> Outcome {
    let demand = demand(demands.each(&posts::RETAINING), number);
    let title = format!("Load of the anchors of post {}", number + 1);
    let id = format!("post_{}_anchor_load", number + 1);
    let name = CheckName::new(id, title, Unit::Newton, ANCHOR_FACTOR);
    let resistance = Resistance { characteristic: given.retaining.anchor_resistance, factor: design.factors.anchor };
    Outcome::at_most(name, demand, resistance, design.limits.anchor_utilisation).only_by_simulation(NOT_BY_EQUATIONS)
}

/// A dissipator at work pulls its rope and its anchor with its plateau, overstrength included, whatever the design flow shows.
fn against_plateau(design: &Design, given: &Posts) -> Vec<Outcome> {
    let Some(dissipators) = &given.retaining.dissipators else { return Vec::new() };
    let own = Demand { guideline: Some(design.factors.overstrength * dissipators.plateau), ..Demand::default() };
    let name = |id: &str, title: &str, source| CheckName::new(id, title, Unit::Newton, source);
    let title = "Retaining ropes against the force of a yielding dissipator";
    let rope = ropes::check(design, &given.retaining.rope, name("retaining_plateau", title, ROPE_FACTOR), own);
    let title = "Anchors of retaining ropes against the force of a yielding dissipator";
    let resistance = Resistance { characteristic: given.retaining.anchor_resistance, factor: design.factors.anchor };
    let name = name("retaining_anchor_plateau", title, ANCHOR_FACTOR);
    let anchor = Outcome::at_most(name, own, resistance, design.limits.anchor_utilisation);
    [rope, anchor].map(|outcome| open_without_overstrength(design, outcome.between_parts())).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::outcome::{CheckVerdict, Route};
    use crate::design::read::read_design;

    const TEXT: &str = include_str!("../../designs/net_with_posts.yaml");

    /// N_b of 1 MN and M_R of 100 kN m are given, and N_cr is no less than N_b: 300 kN with 10 kN m are 300 + 100/(1 − 0.3) = 442.9 kN of it.
    #[test]
    fn where_resistances_are_given_the_compression_still_makes_the_moment_larger() {
        let mut design = read_design("x", TEXT.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")).design;
        design.factors.post = 1.0;
        let mut given = design.posts().expect("posts").clone();
        given.strength = PostStrength::Given { compression: 1e6, bending: 1e5 };
        let used = strut(&design, &given, 0).expect("a strut").with_moment(3e5, 1e4);
        assert!((used - 442.857e3).abs() < 1.0, "{used}");
    }

    /// A section of which lateral-torsional buckling leaves what nobody says is open.
    #[test]
    fn a_section_that_may_buckle_sideways_is_open() {
        let verdict = |key: &str| {
            let told = judged(|text| text.replace("lateral_torsional_factor: 1 ", key), 1e3);
            told.into_iter().find(|outcome| outcome.id == "post_1_compression").expect("a check").verdict
        };
        assert_eq!(verdict("lateral_torsional_factor: 1 "), CheckVerdict::Pass);
        assert_eq!(verdict("# "), CheckVerdict::Open);
    }

    fn judged(change: impl Fn(String) -> String, compression: f64) -> Vec<Outcome> {
        let text = change(TEXT.to_string());
        let design = read_design("x", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")).design;
        let demand = Demand { simulation: Some(compression), ..Demand::default() };
        let zero = Demand { simulation: Some(0.0), ..Demand::default() };
        let uplift = Demand { simulation: Some((-compression).max(0.0)), ..Demand::default() };
        let demands = Demands::default()
            .with(&posts::COMPRESSION, &[demand; 2])
            .with(&posts::MOMENT, &[zero; 2])
            .with(&posts::UPLIFT, &[uplift; 2])
            .with(&posts::FOOT, &[demand; 2])
            .with(&posts::RETAINING, &[demand; 2])
            .with(&posts::STROKE, &[zero; 2]);
        check(&design, &demands)
    }

    fn verdict(outcomes: &[Outcome], id: &str) -> CheckVerdict {
        outcomes.iter().find(|outcome| outcome.id == id).expect("a check").verdict
    }

    #[test]
    fn posts_hold_what_their_section_does() {
        let outcomes = judged(|text| text, 1e3);
        assert_eq!(verdict(&outcomes, "post_1_compression"), CheckVerdict::Pass);
        let capacity = outcomes[0].capacity.expect("a capacity");
        assert_eq!(verdict(&judged(|text| text, 1.01 * capacity), "post_2_compression"), CheckVerdict::Fail);
        assert_eq!(verdict(&judged(|text| text, f64::NAN), "post_1_compression"), CheckVerdict::Fail);
        // 1.8 m of 61.2 cm² weigh 0.85 kN: more pull is open until a resistance to it is given.
        assert!(judged(|text| text, 500.0).iter().all(|outcome| outcome.id != "post_1_uplift"));
        assert_eq!(verdict(&judged(|text| text, -500.0), "post_1_uplift"), CheckVerdict::Pass);
        assert_eq!(verdict(&judged(|text| text, -2e3), "post_1_uplift"), CheckVerdict::Open);
        let given = |text: String| {
            text.replace("foot_resistance: 400 kN", "foot_resistance: 400 kN\n      uplift_resistance: 10 kN")
        };
        assert_eq!(verdict(&judged(given, -2e3), "post_1_uplift"), CheckVerdict::Pass);
        // A longer post buckles earlier.
        let longer = judged(
            |text| text.replace("height: 2 m", "height: 3.2 m").replace("wall_height: 3 m", "wall_height: 4 m"),
            1e3,
        );
        assert!(longer[0].capacity.expect("a capacity") < capacity);
    }

    /// 235 kN / 1.5 of a rope, 150 kN / 1.1 of an anchor, and what a dissipator of 80 kN with its overstrength of 1.15 pulls with.
    #[test]
    fn ropes_and_anchors_hold_what_they_bear_and_their_dissipators() {
        let of = |tension: f64| {
            let outcomes = judged(|text| text, tension);
            ["post_2_retaining_tension", "post_2_anchor_load"].map(|id| verdict(&outcomes, id))
        };
        assert_eq!(of(100e3), [CheckVerdict::Pass, CheckVerdict::Pass]);
        assert_eq!(of(140e3), [CheckVerdict::Pass, CheckVerdict::Fail]);
        assert_eq!(of(160e3), [CheckVerdict::Fail, CheckVerdict::Fail]);
        let plateau = |text: String| text.replace("anchor_resistance: 150 kN", "anchor_resistance: 90 kN");
        assert_eq!(verdict(&judged(|text| text, 1e3), "retaining_anchor_plateau"), CheckVerdict::Pass);
        assert_eq!(verdict(&judged(plateau, 1e3), "retaining_anchor_plateau"), CheckVerdict::Fail);
        // Below its force a dissipator does not yield; with three times the load of 30 kN it does, and all of its stroke goes.
        let outcomes = judged(|text| text, 30e3);
        let stroke = outcomes.iter().find(|outcome| outcome.id == "post_1_retaining_stroke").expect("a check");
        assert_eq!((stroke.verdict, stroke.demand_under(Route::Simulation, 2.0)), (CheckVerdict::Pass, Some(0.0)));
        assert_eq!(stroke.demand_under(Route::Simulation, 3.0), Some(0.6));
        // One that has begun to yield is used up by more load just the same.
        let given = Demand { simulation: Some(0.01), ..Demand::default() };
        let begun = Demand { simulation: Some(85e3), ..Demand::default() };
        let design = read_design("x", TEXT.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")).design;
        let dissipators = design.posts().and_then(|posts| posts.retaining.dissipators.as_ref()).expect("dissipators");
        let growth = growth_of(dissipators, &given, &begun).expect("a growth");
        let stroke = Outcome { growth, demand: given, ..stroke.clone() };
        assert_eq!(stroke.demand_under(Route::Simulation, 1.0), Some(0.01));
        assert_eq!(stroke.demand_under(Route::Simulation, 1.5), Some(0.6));
    }

    #[test]
    fn what_nobody_gives_a_resistance_for_is_open() {
        let without = |text: String| {
            let keys = ["radius_of_gyration", "section_modulus", "yield_strength", "foot_resistance"];
            text.lines().filter(|line| !keys.iter().any(|key| line.contains(key))).collect::<Vec<_>>().join("\n")
        };
        let outcomes = judged(without, 1e3);
        for id in ["post_1_compression", "post_2_compression", "post_1_foot", "post_2_foot"] {
            assert_eq!(verdict(&outcomes, id), CheckVerdict::Open, "{id}");
        }
    }
}
