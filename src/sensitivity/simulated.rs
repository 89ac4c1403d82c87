//! How far the simulation's own answer moves when an input does: every input alone, down and up, each with a run of its own.

use crate::design::{Arrival, Design};
use crate::sensitivity::{Point, Swing, scale_plateau};

type Change = fn(&mut Design, f64);

/// Name, share, how to change it by a factor.
const CHANGES: &[(&str, f64, Change)] = &[
    ("Mass of the flow", 0.2, |design, factor| design.flow.lengthen(factor)),
    ("Velocity of the surge", 0.1, |design, factor| {
        if let Arrival::Surge(surge) = &mut design.flow.arrival {
            surge.velocity *= factor;
        }
        design.flow.later.iter_mut().for_each(|later| later.surge.velocity *= factor);
        design.flow.hydrograph = design.flow.hydrograph.as_ref().map(|hydrograph| hydrograph.faster(factor));
    }),
    ("Density of grains and flow", 0.1, |design, factor| {
        design.flow.make_heavier(factor);
    }),
    ("Friction on the bed", 0.2, |design, factor| design.channel.base_friction *= factor),
    ("Friction between grains", 0.2, |design, factor| design.flow.grain_friction *= factor),
    ("Force of the dissipators", 0.2, scale_plateau),
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

    #[test]
    fn each_variant_changes_its_input_down_and_up_by_its_share() {
        let design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        let variants = variants(&design);
        let of = |name: &str| variants.iter().find(|variant| variant.name == name).expect("a variant");
        let ratio = |name: &str, value: fn(&Design) -> f64| {
            of(name).designs.each_ref().map(|changed| (1e6 * value(changed) / value(&design)).round() / 1e6)
        };
        let surge = |design: &Design| match design.flow.arrival {
            Arrival::Surge(surge) => surge,
            Arrival::DamBreak(_) => panic!("a surge"),
        };
        assert_eq!(ratio("Mass of the flow", |design| design.flow.mass), [0.8, 1.2]);
        let length =
            of("Mass of the flow").designs.each_ref().map(|changed| surge(changed).length / surge(&design).length);
        assert!((length[0] - 0.8).abs() < 1e-9 && (length[1] - 1.2).abs() < 1e-9);
        let velocity = of("Velocity of the surge").designs.each_ref().map(|changed| surge(changed).velocity / 4.6);
        assert!((velocity[0] - 0.9).abs() < 1e-9 && (velocity[1] - 1.1).abs() < 1e-9);
        for value in [
            (|design| design.flow.mass) as fn(&Design) -> f64,
            |design| design.flow.bulk_density,
            |design| design.flow.solid_density,
        ] {
            assert_eq!(ratio("Density of grains and flow", value), [0.9, 1.1]);
        }
        assert_eq!(ratio("Friction on the bed", |design| design.channel.base_friction), [0.8, 1.2]);
        assert_eq!(ratio("Friction between grains", |design| design.flow.grain_friction), [0.8, 1.2]);
        let block = read_design("x", include_bytes!("../../designs/rigid_wall.yaml")).unwrap().design;
        let Arrival::DamBreak(before) = block.flow.arrival else { panic!("a block") };
        let longer = |changed: &Design| match changed.flow.arrival {
            Arrival::DamBreak(block) => block.length / before.length,
            Arrival::Surge(_) => panic!("a block"),
        };
        let mass = super::variants(&block).into_iter().find(|variant| variant.name == "Mass of the flow").expect("it");
        assert!((longer(&mass.designs[1]) - 1.2).abs() < 1e-9);
    }

    #[test]
    fn the_most_telling_input_comes_first() {
        let design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        let variants: Vec<Variant> = variants(&design).into_iter().take(2).collect();
        let [first, second] = [variants[0].name, variants[1].name];
        let point = |used: f64| Point { force: 1.0, utilisation: Some(used), governing: "rope".into() };
        let told = swings(variants, vec![[point(0.4), point(0.5)], [point(0.7), point(0.2)]]);
        assert_eq!([told[0].name.as_str(), told[1].name.as_str()], [second, first]);
        assert_eq!((told[0].share, told[0].down.utilisation, told[0].up.utilisation), (0.1, Some(0.7), Some(0.2)));
    }
}
