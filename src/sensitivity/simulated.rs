//! How far the simulation's own answer moves when an input does: every input alone, down and up, each with a run of its own.

use crate::design::{Arrival, BarrierDesign, Design};
use crate::sensitivity::{Point, Swing};

type Change = fn(&mut Design, f64);

/// Name, share, how to change it by a factor.
const CHANGES: &[(&str, f64, Change)] = &[
    ("Mass of the flow", 0.2, |design, factor| {
        design.flow.mass *= factor;
        match &mut design.flow.arrival {
            Arrival::DamBreak(block) => block.length *= factor,
            Arrival::Surge { length, .. } => *length *= factor,
        }
    }),
    ("Velocity of the surge", 0.1, |design, factor| {
        if let Arrival::Surge { velocity, .. } = &mut design.flow.arrival {
            *velocity *= factor;
        }
    }),
    ("Density of grains and flow", 0.1, |design, factor| {
        design.flow.mass *= factor;
        design.flow.bulk_density *= factor;
        design.flow.solid_density *= factor;
    }),
    ("Friction on the bed", 0.2, |design, factor| design.channel.base_friction *= factor),
    ("Friction between grains", 0.2, |design, factor| design.flow.grain_friction *= factor),
    ("Plateau of the dissipators", 0.2, |design, factor| {
        if let BarrierDesign::FlexibleNet(net) = &mut design.barrier
            && let Some(dissipator) = &mut net.dissipators
        {
            dissipator.plateau *= factor;
        }
    }),
];

/// One changed design to run.
pub struct Variant {
    change: usize,
    pub design: Design,
}

/// The designs to run, two for each input that the design has.
pub fn variants(design: &Design) -> Vec<Variant> {
    let of = |change: usize| {
        let (_, share, apply) = CHANGES[change];
        [1.0 - share, 1.0 + share].map(|factor| {
            let mut changed = design.clone();
            apply(&mut changed, factor);
            Variant { change, design: changed }
        })
    };
    (0..CHANGES.len()).flat_map(of).filter(|variant| variant.design != *design).collect()
}

/// The tornado from what those runs said, in their order; the most telling first.
pub fn swings(variants: &[Variant], points: Vec<Point>) -> Vec<Swing> {
    let mut points = points.into_iter();
    let mut swings = Vec::new();
    for pair in variants.chunks(2) {
        let (Some(down), Some(up)) = (points.next(), points.next()) else { break };
        let (name, share, _) = CHANGES[pair[0].change];
        swings.push(Swing { name, share, down, up });
    }
    swings.sort_by(|a, b| b.width().total_cmp(&a.width()));
    swings
}
