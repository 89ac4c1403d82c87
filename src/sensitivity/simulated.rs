//! How far the simulation's own answer moves when an input does: every input alone, down and up, each with a run of its own.

use crate::design::{Arrival, Design};
use crate::sensitivity::{Point, Swing, scale_plateau};

type Change = fn(&mut Design, f64);

/// Name, share, how to change it by a factor.
const CHANGES: &[(&str, f64, Change)] = &[
    ("Mass of the flow", 0.2, |design, factor| {
        design.flow.mass *= factor;
        match &mut design.flow.arrival {
            Arrival::DamBreak(block) => block.length *= factor,
            Arrival::Surge(surge) => surge.length *= factor,
        }
    }),
    ("Velocity of the surge", 0.1, |design, factor| {
        if let Arrival::Surge(surge) = &mut design.flow.arrival {
            surge.velocity *= factor;
        }
    }),
    ("Density of grains and flow", 0.1, |design, factor| {
        design.flow.mass *= factor;
        design.flow.bulk_density *= factor;
        design.flow.solid_density *= factor;
    }),
    ("Friction on the bed", 0.2, |design, factor| design.channel.base_friction *= factor),
    ("Friction between grains", 0.2, |design, factor| design.flow.grain_friction *= factor),
    ("Plateau of the dissipators", 0.2, scale_plateau),
];

/// An input with the designs that it makes, taken down and up.
pub struct Variant {
    name: &'static str,
    share: f64,
    pub designs: [Design; 2],
}

/// The designs to run: two for each input that the design has.
pub fn variants(design: &Design) -> Vec<Variant> {
    let variant = |&(name, share, apply): &(&'static str, f64, Change)| {
        let designs = [1.0 - share, 1.0 + share].map(|factor| {
            let mut changed = design.clone();
            apply(&mut changed, factor);
            changed
        });
        Variant { name, share, designs }
    };
    CHANGES.iter().map(variant).filter(|variant| variant.designs[1] != *design).collect()
}

/// The tornado from what the runs of each variant said; the most telling first.
pub fn swings(variants: Vec<Variant>, points: Vec<[Point; 2]>) -> Vec<Swing> {
    let swing = |(Variant { name, share, .. }, [down, up]): (Variant, [Point; 2])| Swing {
        name: name.to_string(),
        share,
        down,
        up,
    };
    let mut swings: Vec<Swing> = variants.into_iter().zip(points).map(swing).collect();
    swings.sort_by(|a, b| b.width().total_cmp(&a.width()));
    swings
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::read::read_design;

    #[test]
    fn only_inputs_that_the_design_has_are_varied() {
        let names = |text: &str| -> Vec<&str> {
            let design = read_design("x", text.as_bytes()).unwrap().design;
            variants(&design).into_iter().map(|variant| variant.name).collect()
        };
        let surge_on_net = names(include_str!("../../designs/small_net.yaml"));
        let block_on_wall = names(include_str!("../../designs/rigid_wall.yaml"));
        assert_eq!(surge_on_net.len(), CHANGES.len());
        assert_eq!(surge_on_net.len() - block_on_wall.len(), 2, "{block_on_wall:?}");
    }
}
