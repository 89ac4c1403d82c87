//! What a barrier is made of, and what that costs.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::design::{BarrierDesign, BarrierModel, Design, DissipatorDesign, FlexibleNet};
use crate::scene::net::build::{ROPE_DENSITY, build};

/// Mass of a wire rope over that of a steel rod of its diameter: 0.409 d² kg/m against 0.6165 d² (d in cm), 6x36-IWRC by EN 12385-4. Simulated ropes have
/// the full circle.
const FILLED: f64 = 0.663;

/// A quantity that a price may stand on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// Of ropes, net and posts.
    SteelMass,
    NetArea,
    Anchors,
    /// Sum of the characteristic resistances of all anchors.
    AnchorResistance,
    Bolts,
    /// Sum of the characteristic resistances of all bolts.
    BoltResistance,
    /// Each device, those in series and side by side counted one by one.
    Dissipators,
    /// Sum over all dissipators of what they take up along their whole stroke.
    DissipatorEnergy,
    Posts,
    /// Of a gravity wall above the ground.
    WallVolume,
    /// What a gravity wall takes below the ground, excavated and filled: as wide as its base, down to its founding depth.
    FoundationVolume,
    WallArea,
}

impl Measure {
    /// What it is called, and the unit in which it is counted.
    pub fn words(self) -> [&'static str; 2] {
        match self {
            Self::SteelMass => ["Steel of ropes, net and posts", "kg"],
            Self::NetArea => ["Area of the net", "m²"],
            Self::Anchors => ["Anchors", ""],
            Self::AnchorResistance => ["Resistance of all anchors", "kN"],
            Self::Bolts => ["Bolts of the lowest rope", ""],
            Self::BoltResistance => ["Resistance of all bolts", "kN"],
            Self::Dissipators => ["Dissipators", ""],
            Self::DissipatorEnergy => ["Energy of all dissipators", "kJ"],
            Self::Posts => ["Posts", ""],
            Self::WallVolume => ["Volume of the wall above the ground", "m³"],
            Self::FoundationVolume => ["Volume of the foundation", "m³"],
            Self::WallArea => ["Face of the wall", "m²"],
        }
    }

    /// How much of it a design has, in its unit.
    pub fn of(self, design: &Design) -> f64 {
        match &design.barrier {
            BarrierDesign::FlexibleNet(net) => self.of_a_net(net, design),
            BarrierDesign::RigidWall(wall) => {
                let area = wall.height * design.channel.section().mean_width(wall.height);
                match self {
                    Self::WallArea => area,
                    Self::WallVolume => area * wall.stability.map_or(0.0, |stability| stability.thickness),
                    Self::FoundationVolume => wall
                        .stability
                        .map_or(0.0, |stability| stability.base_width * stability.founding_depth * area / wall.height),
                    _ => 0.0,
                }
            }
        }
    }

    fn of_a_net(self, net: &FlexibleNet, design: &Design) -> f64 {
        let ropes = |net: &FlexibleNet| -> Vec<(usize, f64)> {
            let free = net.ropes_held_by_bed()..net.main_ropes.levels.len();
            free.map(|level| (level, f64::from(net.main_ropes.levels[level].ropes))).collect()
        };
        let posts = net.posts.as_ref();
        let retaining = posts.map_or(0.0, |posts| (posts.at.len() * posts.retaining.sides().len()) as f64);
        let section = design.channel.section();
        match self {
            Self::SteelMass => {
                let barrier = build(net, &design.channel, BarrierModel::PinnedRopes, 1).barrier;
                let all: f64 = barrier.nodes.iter().map(|node| node.mass).sum();
                let circle = |radius: f64| std::f64::consts::PI * radius * radius;
                let of_ropes = barrier.segments.iter().map(|segment| {
                    barrier.sharing(segment.kind) * circle(segment.radius) * segment.rest_length * ROPE_DENSITY
                });
                all - (1.0 - FILLED) * of_ropes.sum::<f64>()
            }
            Self::NetArea => net.height * section.mean_width(net.height),
            Self::Anchors => ropes(net).iter().map(|(_, ropes)| 2.0 * ropes).sum::<f64>() + retaining,
            Self::AnchorResistance => {
                let banks = [crate::design::Bank::Right, crate::design::Bank::Left];
                let of_ropes = ropes(net).into_iter().flat_map(|(level, ropes)| {
                    banks.map(|bank| ropes * net.anchor_designs.of(level, bank).resistance.value())
                });
                let of_posts = posts.map_or(0.0, |posts| posts.retaining.anchor_resistance);
                (of_ropes.sum::<f64>() + retaining * of_posts) / 1e3
            }
            Self::Bolts => net.bed_bolts.map_or(0.0, |bolts| (bolts.spaces(section.bed_length()) + 1) as f64),
            Self::BoltResistance => {
                let one = net.bed_bolts.and_then(|bolts| bolts.resistance).unwrap_or(0.0);
                Self::Bolts.of_a_net(net, design) * one / 1e3
            }
            Self::Dissipators => dissipators(net).iter().map(|(count, design)| count * design.devices).sum(),
            Self::DissipatorEnergy => {
                dissipators(net).iter().map(|(count, design)| count * energy(design)).sum::<f64>() / 1e3
            }
            Self::Posts => posts.map_or(0.0, |posts| posts.at.len() as f64),
            Self::WallVolume | Self::FoundationVolume | Self::WallArea => 0.0,
        }
    }
}

/// What stands at the ends of main and of retaining ropes, each made of one or more devices, and at how many ends.
fn dissipators(net: &FlexibleNet) -> Vec<(f64, &DissipatorDesign)> {
    let free = net.ropes_held_by_bed()..net.main_ropes.levels.len();
    let ends: f64 = free.map(|level| 2.0 * f64::from(net.main_ropes.levels[level].ropes)).sum();
    let of_posts = net.posts.as_ref().and_then(|posts| {
        let count = (posts.at.len() * posts.retaining.sides().len()) as f64;
        posts.retaining.dissipators.as_ref().map(|design| (count, design))
    });
    net.dissipators.iter().map(|design| (ends, design)).chain(of_posts).collect()
}

/// What a dissipator takes up along its whole stroke (J).
fn energy(design: &DissipatorDesign) -> f64 {
    const SLICES: usize = 200;
    let force = |number: usize| design.curve.force((number as f64 + 0.5) / SLICES as f64);
    design.plateau * design.stroke * (0..SLICES).map(force).sum::<f64>() / SLICES as f64
}

/// The price of a unit of a quantity.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Price {
    pub of: Measure,
    pub price: f64,
    /// Where the price comes from.
    #[serde(default)]
    pub origin: String,
}

/// Prices, and the money they are in.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Prices {
    #[serde(default)]
    pub currency: String,
    pub items: Vec<Price>,
}

impl Default for Prices {
    /// The mass of steel, in kilograms.
    fn default() -> Self {
        let steel =
            Price { of: Measure::SteelMass, price: 1.0, origin: "no prices are given: the mass of steel".into() };
        Self { currency: "kg of steel".into(), items: vec![steel] }
    }
}

impl Prices {
    /// What a design costs.
    pub fn of(&self, design: &Design) -> f64 {
        self.items.iter().map(|item| item.price * item.of.of(design)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::read::read_design;
    use approx::assert_relative_eq;

    /// By hand, of a net with three ropes alike: two free ropes with two anchors and two dissipators each, anchors of 150 kN or whatever the file gives.
    #[test]
    fn a_net_is_counted_as_by_hand() {
        let design = read_design("x", include_bytes!("../../tests/fixtures/even_net.yaml")).unwrap().design;
        let BarrierDesign::FlexibleNet(net) = &design.barrier else { panic!("a net") };
        assert_eq!([Measure::Anchors, Measure::Dissipators, Measure::Posts].map(|of| of.of(&design)), [4.0, 4.0, 0.0]);
        assert_relative_eq!(Measure::NetArea.of(&design), 1.8 * 3.0, max_relative = 1e-9);
        let one = net.anchor_designs.all.resistance.value();
        assert_relative_eq!(Measure::AnchorResistance.of(&design), 4.0 * one / 1e3, max_relative = 1e-12);
        let dissipator = net.dissipators.as_ref().expect("dissipators");
        let energy = 4.0 * dissipator.plateau * dissipator.stroke / 1e3;
        assert_relative_eq!(Measure::DissipatorEnergy.of(&design), energy, max_relative = 1e-9);
        // Two in series and three side by side are six devices, and take up six times as much.
        let text = include_str!("../../tests/fixtures/even_net.yaml");
        let several =
            text.replacen("      plateau_force:", "      in_series: 2\n      side_by_side: 3\n      plateau_force:", 1);
        assert_ne!(several, text);
        let several = read_design("x", several.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")).design;
        assert_eq!(Measure::Dissipators.of(&several), 24.0);
        assert_relative_eq!(Measure::DissipatorEnergy.of(&several), 6.0 * energy, max_relative = 1e-9);
        // Ropes of 0.663 times a rod of steel, 7850 kg/m³: three main ropes of 28 mm over 2.86 m, two lateral ropes of 24 mm over 1.8 m, and ten by six
        // meshes of 286 by 300 mm, with 240 sides of 207 mm of 20 mm: 0.663 (41.5 + 12.8 + 122.7) = 117.4 kg.
        let steel = Measure::SteelMass.of(&design);
        assert_relative_eq!(steel, 117.4, max_relative = 0.05);
        let prices = Prices {
            currency: String::new(),
            items: vec![
                Price { of: Measure::Anchors, price: 10.0, origin: String::new() },
                Price { of: Measure::SteelMass, price: 2.0, origin: String::new() },
            ],
        };
        assert_relative_eq!(prices.of(&design), 40.0 + 2.0 * steel, max_relative = 1e-12);
        assert_eq!(Prices::default().of(&design), steel);
    }

    #[test]
    fn a_wall_is_as_large_as_its_face_times_its_thickness() {
        let design = read_design("x", include_bytes!("../../designs/gravity_wall.yaml")).unwrap().design;
        let BarrierDesign::RigidWall(wall) = &design.barrier else { panic!("a wall") };
        let area = wall.height * design.channel.width;
        assert_relative_eq!(Measure::WallArea.of(&design), area, max_relative = 1e-9);
        let thickness = wall.stability.expect("stability").thickness;
        assert_relative_eq!(Measure::WallVolume.of(&design), area * thickness, max_relative = 1e-9);
        let stability = wall.stability.expect("stability");
        let below = stability.base_width * stability.founding_depth * area / wall.height;
        assert!(below > 0.0);
        assert_relative_eq!(Measure::FoundationVolume.of(&design), below, max_relative = 1e-9);
        assert_eq!(Measure::SteelMass.of(&design), 0.0);
    }
}
