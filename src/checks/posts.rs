//! Posts: compression with bending, the foundations of their feet, the ropes that retain them with their dissipators and anchors.

use crate::checks::outcome::{CheckName, Kind, Opening, Outcome, Resistance};
use crate::checks::ropes;
use crate::demand::{Demand, Demands};
use crate::design::{BarrierDesign, Design, PostStrength, Posts};
use crate::guideline::height_over_bed;
use crate::guideline::posts::input;
use crate::loads::posts::{Column, Strut};
use crate::quantities::posts;
use crate::sources::{ANCHOR_FACTOR, POST_STRENGTH, ROPE_FACTOR, STROKE_DATA};

fn of(design: &Design) -> Option<&Posts> {
    match &design.barrier {
        BarrierDesign::FlexibleNet(net) => net.posts.as_ref(),
        BarrierDesign::RigidWall(_) => None,
    }
}

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let Some(given) = of(design) else { return Vec::new() };
    (0..given.at.len())
        .flat_map(|number| {
            let compression = compressed(design, given, number, demands);
            [compression, foot(design, given, number, demands), rope(design, given, number, demands)]
                .into_iter()
                .chain(stroke(design, given, number, demands))
                .chain([anchor(design, given, number, demands)])
        })
        .collect()
}

/// What a post of a design withstands: what it holds in compression (N) is less the more it is bent. Nothing where nobody says.
pub fn strut(design: &Design, given: &Posts, number: usize) -> Option<Strut> {
    let factor = design.factors.post;
    let length = input(design, given, given.at[number], height_over_bed(design)).length;
    match given.strength {
        PostStrength::Unknown => None,
        PostStrength::Given { compression, bending } => {
            Some(Strut { compression: compression / factor, bending: bending / factor, critical: f64::INFINITY })
        }
        PostStrength::Section(section) => {
            let column = Column {
                length,
                area: given.area,
                modulus: given.modulus,
                radius_of_gyration: section.radius_of_gyration,
                section_modulus: section.section_modulus,
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
    let both = |compression: Option<f64>, moment: Option<f64>| {
        compression.map(|compression| strut.with_moment(compression, moment.unwrap_or(f64::NAN)))
    };
    let with_moment = Demand {
        guideline: both(pressed.guideline, bent.guideline),
        simulation: both(pressed.simulation, bent.simulation),
        characteristic: both(pressed.characteristic, bent.characteristic),
        cap: None,
    };
    let factor = design.factors.post;
    let resistance = Resistance { characteristic: factor * strut.compression, factor };
    let mut outcome = Outcome::at_most(name, with_moment, resistance, 1.0).only_by_simulation(NOT_BY_EQUATIONS);
    let pull = [pressed.guideline, pressed.simulation].into_iter().flatten().find(|compression| *compression < 0.0);
    if let Some(pull) = pull.filter(|_| outcome.holds()) {
        outcome.leave_open(Opening::NotGiven(format!(
            "the post is pulled with {:.1} kN, and what holds it down is not given",
            -pull / 1e3
        )));
    }
    outcome
}

/// Why the equations alone let no post and no foundation pass.
const NOT_BY_EQUATIONS: &str =
    "the net pulls the head of a post down and grains jam at a post, and the equations do not know by how much";

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
    ropes::check(design, rope, name, demand)
}

fn stroke(design: &Design, given: &Posts, number: usize, demands: &Demands) -> Option<Outcome> {
    let stroke = given.retaining.dissipators.as_ref()?.stroke;
    let demand = demand(demands.each(&posts::STROKE), number);
    let id = format!("post_{}_retaining_stroke", number + 1);
    let name = CheckName::of(&posts::STROKE, number, id, STROKE_DATA);
    let stroke = Resistance { characteristic: stroke, factor: 1.0 };
    let outcome = Outcome::at_most(name, demand, stroke, design.limits.dissipator_utilisation);
    Some(Outcome { kind: Kind::Stroke, ..outcome })
}

/// An anchor bears its one rope.
fn anchor(design: &Design, given: &Posts, number: usize, demands: &Demands) -> Outcome {
    let demand = demand(demands.each(&posts::RETAINING), number);
    let title = format!("Load of the anchors of post {}", number + 1);
    let id = format!("post_{}_anchor_load", number + 1);
    let name = CheckName::new(id, title, crate::quantities::quantity::Unit::Newton, ANCHOR_FACTOR);
    let resistance = Resistance { characteristic: given.retaining.anchor_resistance, factor: design.factors.anchor };
    Outcome::at_most(name, demand, resistance, design.limits.anchor_utilisation)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::outcome::CheckVerdict;
    use crate::design::read::read_design;

    const TEXT: &str = include_str!("../../designs/net_with_posts.yaml");

    fn judged(change: impl Fn(String) -> String, compression: f64) -> Vec<Outcome> {
        let text = change(TEXT.to_string());
        let design = read_design("x", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")).design;
        let demand = Demand { simulation: Some(compression), ..Demand::default() };
        let zero = Demand { simulation: Some(0.0), ..Demand::default() };
        let demands = Demands::default()
            .with(&posts::COMPRESSION, &[demand; 2])
            .with(&posts::MOMENT, &[zero; 2])
            .with(&posts::FOOT, &[demand; 2])
            .with(&posts::RETAINING, &[zero; 2])
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
        assert_eq!(verdict(&judged(|text| text, -1e3), "post_1_compression"), CheckVerdict::Open);
        // A longer post buckles earlier.
        let longer = judged(
            |text| text.replace("height: 2 m", "height: 3.2 m").replace("wall_height: 3 m", "wall_height: 4 m"),
            1e3,
        );
        assert!(longer[0].capacity.expect("a capacity") < capacity);
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
