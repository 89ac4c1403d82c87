//! The anchors of a net, one by one: where they are, what they bear and in which direction, and how much of them is used.

use dem::Vec3;

use crate::checks::outcome::Outcome;
use crate::design::{AnchorDesign, AnchorOf, AnchorResistance, Bank, BarrierDesign, FlexibleNet};
use crate::guideline::height_over_bed;
use crate::guideline::posts::input;
use crate::pipeline::Run;
use crate::quantities::anchor_load::{ACROSS, ALONG, EACH, UP};
use crate::quantities::observed::Observed;
use crate::report::numbers::with_unit;
use crate::report::row::used;
use crate::report::table::Table;

/// Nothing where the barrier is no net.
pub fn table(run: &Run) -> Option<Table> {
    let BarrierDesign::FlexibleNet(net) = &run.file.design.barrier else { return None };
    let seen = run.simulated.as_ref().map(|simulated| simulated.first());
    let anchors = net.anchors();
    let row = |(number, anchor): (usize, &AnchorOf)| {
        let load = seen.map(|seen| vector(seen, number));
        vec![
            (number + 1).to_string(),
            name(net, anchor),
            resistance(net, anchor),
            by_equations(check(run, anchor)),
            load.map_or("–".into(), |load| parts(&load)),
            seen.map_or("–".into(), |seen| with_unit(seen.nth(&EACH, number), "N")),
            load.map_or("–".into(), |load| angle(run, net, anchor, &load)),
            utilisation(net, anchor, check(run, anchor)),
        ]
    };
    let bundled = net.main_ropes.levels.iter().any(|level| level.ropes > 1);
    Some(Table {
        columns: vec![
            "Anchor",
            "Location",
            "Resistance",
            "Load by the equations",
            "Load in the simulation: downstream, left, up",
            "Magnitude",
            "Angle to its axis",
            "Utilisation",
        ],
        rows: anchors.iter().enumerate().map(row).collect(),
        note: format!(
            "Ground anchors, looking downstream. Loads by the equations are those of the checks, with partial factors and overstrength. The vector is that of the first run of the flow without partial factors, at the moment when the load of that anchor is largest, in horizontal and vertical components; with a minus it acts upstream, to the right or downwards. The angle is between that load and the axis of the anchor, which is the line of its unloaded rope where no plunge is given; it is shown for information, and a check stays open only where the axis is more than 30° off the line of the rope.{}",
            if bundled { " Where ropes run side by side each has such an anchor at either end." } else { "" }
        ),
    })
}

/// Down the valley, to the left, up (N).
fn vector(seen: &Observed, number: usize) -> Vec3 {
    Vec3::new(seen.nth(&ALONG, number), seen.nth(&ACROSS, number), seen.nth(&UP, number))
}

/// Three parts of a force, in kN.
pub fn parts(load: &Vec3) -> String {
    format!("{:.1}, {:.1}, {:.1} kN", load.x / 1e3, load.y / 1e3, load.z / 1e3)
}

fn name(net: &FlexibleNet, anchor: &AnchorOf) -> String {
    match anchor {
        AnchorOf::Main { rope, bank } => {
            let ropes = net.main_ropes.levels[*rope].ropes;
            let each = if ropes > 1 { format!(", each of {ropes}") } else { String::new() };
            let AnchorDesign { set_back, .. } = net.anchor_designs.of(*rope, *bank);
            let behind =
                if set_back > 0.0 { format!(", {set_back:.2} m behind the edge of the net") } else { String::new() };
            format!("main rope {}, {} bank{each}{behind}", rope + 1, bank.word())
        }
        AnchorOf::Retaining { post, side } => match *side {
            side if side > 0.0 => format!("post {}, {side:.2} m to its right", post + 1),
            side if side < 0.0 => format!("post {}, {:.2} m to its left", post + 1, -side),
            _ => format!("post {}", post + 1),
        },
    }
}

fn resistance(net: &FlexibleNet, anchor: &AnchorOf) -> String {
    let (value, how) = match anchor {
        AnchorOf::Main { rope, bank } => match net.anchor_designs.of(*rope, *bank).resistance {
            AnchorResistance::Characteristic(value) => (value, "characteristic"),
            AnchorResistance::ProofLoad(value) => (value, "proof load"),
            AnchorResistance::Design(value) => (value, "design"),
        },
        AnchorOf::Retaining { .. } => {
            (net.posts.as_ref().map_or(f64::NAN, |posts| posts.retaining.anchor_resistance), "characteristic")
        }
    };
    format!("{}, {how}", with_unit(value, "N"))
}

fn by_equations(outcome: Option<&Outcome>) -> String {
    outcome.and_then(|outcome| outcome.demand.guideline).map_or("–".into(), |load| with_unit(load, "N"))
}

/// From the ground outwards, by the level.
fn axis(run: &Run, net: &FlexibleNet, anchor: &AnchorOf) -> Vec3 {
    let design = &run.file.design;
    match anchor {
        AnchorOf::Main { rope, bank } => {
            let inwards = if *bank == Bank::Right { 1.0 } else { -1.0 };
            let [plunge, bearing] = net.anchor_designs.of(*rope, *bank).axis.unwrap_or_default();
            let level = libm::cos(plunge);
            Vec3::new(libm::sin(bearing) * level, inwards * libm::cos(bearing) * level, libm::sin(plunge))
        }
        AnchorOf::Retaining { post, side } => {
            let Some(posts) = &net.posts else { return Vec3::zeros() };
            let held = input(design, posts, posts.at[*post], height_over_bed(design));
            let number = posts.retaining.sides().iter().position(|of| of == side).unwrap_or(0);
            let (sine, cosine) = libm::sincos(held.lean);
            let head = Vec3::new(-sine, 0.0, cosine) * held.length;
            let towards = (head - Vec3::from(held.anchors[number])).normalize();
            let (sine, cosine) = libm::sincos(design.channel.slope);
            Vec3::new(towards.x * cosine + towards.z * sine, towards.y, towards.z * cosine - towards.x * sine)
        }
    }
}

fn angle(run: &Run, net: &FlexibleNet, anchor: &AnchorOf, load: &Vec3) -> String {
    let size = load.norm();
    // Asked so that what is not a number has no angle.
    let loaded = size > 0.0;
    if !loaded {
        return "–".into();
    }
    let cosine = (load.dot(&axis(run, net, anchor)) / size).clamp(-1.0, 1.0);
    format!("{:.0}°", libm::acos(cosine).to_degrees())
}

/// The check of an anchor.
fn check<'a>(run: &'a Run, anchor: &AnchorOf) -> Option<&'a Outcome> {
    let ids = match anchor {
        AnchorOf::Main { rope, bank } => {
            vec![format!("anchor_{}_load", rope + 1), format!("anchor_{}_{}_load", rope + 1, bank.word())]
        }
        AnchorOf::Retaining { post, .. } => vec![format!("post_{}_anchor_load", post + 1)],
    };
    run.outcomes.iter().find(|outcome| ids.contains(&outcome.id))
}

fn utilisation(net: &FlexibleNet, anchor: &AnchorOf, outcome: Option<&Outcome>) -> String {
    let lateral = net.dissipators.is_none() && matches!(anchor, AnchorOf::Main { .. });
    let beside = if lateral { ", with a lateral rope" } else { "" };
    outcome.map_or("–".into(), |outcome| format!("{} ({}){beside}", used(outcome), outcome.verdict.word()))
}
