//! Inputs that are allowed but outside what such barriers usually have: mostly a wrong unit or a slip of the decimal point. They are
//! told to the reviewer and change no verdict.

use crate::design::{Arrival, BarrierDesign, Design, FlexibleNet, NetRings, PostStrength, Posts, RigidWall, Rope};

/// An input and the range in which it usually lies, both in `unit`.
#[derive(Clone, Debug, PartialEq)]
pub struct Usual {
    /// Path of its key in the design file, or what follows from several.
    pub what: String,
    pub found: f64,
    pub unit: &'static str,
    pub range: [f64; 2],
}

impl Usual {
    fn holds(&self) -> bool {
        self.found >= self.range[0] && self.found <= self.range[1]
    }
}

fn usual(what: impl Into<String>, found: f64, unit: &'static str, range: [f64; 2]) -> Usual {
    Usual { what: what.into(), found, unit, range }
}

/// The inputs of a design that lie outside their usual range.
pub fn implausible(design: &Design) -> Vec<Usual> {
    let mut all = of_flow_and_channel(design);
    all.extend(of_limits_and_factors(design));
    match &design.barrier {
        BarrierDesign::RigidWall(wall) => all.extend(of_wall(wall, design.channel.width)),
        BarrierDesign::FlexibleNet(net) => all.extend(of_net(net)),
    }
    // The equations alone need not be told of the grains.
    all.into_iter().filter(|input| !input.found.is_nan() && !input.holds()).collect()
}

fn of_flow_and_channel(design: &Design) -> Vec<Usual> {
    let (channel, flow) = (&design.channel, &design.flow);
    let angle = |friction: f64| libm::atan(friction).to_degrees();
    let mut all = vec![
        usual("channel.slope", channel.slope.to_degrees(), "deg", [1.0, 50.0]),
        usual("channel.base_friction", angle(channel.base_friction), "deg", [5.0, 50.0]),
        usual("flow.grain_friction", angle(flow.grain_friction), "deg", [15.0, 55.0]),
        usual("flow.solid_density", flow.solid_density, "kg/m³", [2200.0, 3200.0]),
        usual("flow.bulk_density", flow.bulk_density, "kg/m³", [1200.0, 2500.0]),
    ];
    let velocity = match flow.arrival {
        Arrival::Surge(surge) => Some((
            if flow.hydrograph.is_some() { "flow.arrival.hydrograph" } else { "flow.arrival.surge.velocity" },
            surge.velocity,
        )),
        Arrival::DamBreak(block) => {
            block.velocity_at_barrier.map(|velocity| ("flow.arrival.dam_break.velocity_at_barrier", velocity))
        }
    };
    all.extend(velocity.map(|(what, velocity)| usual(what, velocity, "m/s", [0.5, 20.0])));
    all
}

/// A barrier that may lose most of the flow, or of its height, stops none; resistances without a factor are seldom design values.
fn of_limits_and_factors(design: &Design) -> Vec<Usual> {
    let (limits, factors, loads) = (&design.limits, &design.factors, &design.loads);
    let mut all = vec![
        usual("limits.retained_mass", limits.retained_mass, "-", [0.5, 1.0]),
        usual("factors.earth_pressure_k", factors.earth_pressure, "", [0.5, 10.0]),
        usual("factors.dynamic_lambda", factors.dynamic_pressure, "", [0.5, 6.0]),
    ];
    all.extend(loads.impact_reduction.map(|it| usual("loads.impact_reduction", it, "", [0.1, 1.0])));
    if matches!(design.barrier, BarrierDesign::FlexibleNet(_)) {
        all.push(usual("limits.residual_height", limits.residual_height, "-", [0.3, 1.0]));
        all.push(usual("factors.rope", factors.rope, "", [1.2, 5.0]));
    }
    all
}

/// A wall that holds more than about 1 MPa over its face is thicker than it is high.
fn of_wall(wall: &RigidWall, width: f64) -> Vec<Usual> {
    let mean = |resistance: f64| resistance / (width * wall.height) * 1e-6;
    let resistance =
        wall.resistance.map(|it| usual("barrier.rigid_wall.resistance over its face", mean(it), "MPa", [0.0, 1.0]));
    let stability = wall.stability.into_iter().flat_map(|stability| {
        [
            usual("barrier.rigid_wall.stability.density", stability.density, "kg/m³", [1600.0, 2800.0]),
            usual(
                "barrier.rigid_wall.stability.base_friction",
                libm::atan(stability.base_friction).to_degrees(),
                "deg",
                [10.0, 45.0],
            ),
        ]
        .into_iter()
        // From soft ground to sound rock.
        .chain(
            stability
                .bearing_resistance
                .map(|it| usual("barrier.rigid_wall.stability.bearing_resistance", 1e-6 * it, "MPa", [0.05, 10.0])),
        )
    });
    resistance.into_iter().chain(stability).collect()
}

/// Of posts in use, from pipes of some centimetres to the heaviest rolled sections.
fn of_posts(posts: &Posts) -> Vec<Usual> {
    let path = |name: &str| format!("barrier.flexible_net.posts.{name}");
    let retaining = &posts.retaining;
    let mut all = vec![
        usual(path("width"), posts.width, "m", [0.05, 0.5]),
        usual(path("retaining_ropes.anchor_resistance"), retaining.anchor_resistance, "N", [0.0, 3e6]),
        usual(path("area"), 1e4 * posts.area, "cm²", [5.0, 500.0]),
    ];
    let of_the_ground = [("foot_resistance", posts.foot_resistance), ("uplift_resistance", posts.uplift_resistance)];
    all.extend(of_the_ground.into_iter().filter_map(|(name, given)| Some(usual(path(name), given?, "N", [0.0, 3e6]))));
    if let Some(dissipator) = &retaining.dissipators {
        all.push(usual(path("retaining_ropes.dissipators: the stroke"), dissipator.stroke, "m", [0.0, 6.0]));
    }
    if let PostStrength::Section(section) = posts.strength {
        all.push(usual(path("radius_of_gyration"), section.radius_of_gyration, "m", [0.01, posts.width]));
        all.push(usual(path("yield_strength"), section.yield_strength, "Pa", [2e8, 7e8]));
    }
    all.extend(of_rope("posts.retaining_ropes", &retaining.rope));
    all
}

/// Of anchors, bolts and dissipators in use; the resistance of the ground is seldom more.
fn of_net(net: &FlexibleNet) -> Vec<Usual> {
    let of_net = net.rings.is_none().then_some(("net_rope", &net.net_rope));
    let main = net.main_ropes.kinds().into_iter().map(|(_, rope)| ("main_ropes", rope));
    let ropes = of_net.into_iter().chain(main).chain([("lateral_ropes", &net.lateral_rope)]);
    let mut all: Vec<Usual> = ropes.flat_map(|(name, rope)| of_rope(name, rope)).collect();
    all.extend(net.rings.iter().flat_map(of_rings));
    let resistance = net.anchor_designs.all.resistance;
    let path = format!("barrier.flexible_net.anchors.{}", resistance.key());
    all.push(usual(path, resistance.value(), "N", [0.0, 3e6]));
    all.extend(net.posts.iter().flat_map(of_posts));
    let bolt = net.bed_bolts.and_then(|bolts| bolts.resistance);
    all.extend(bolt.map(|it| usual("barrier.flexible_net.anchors.bed_bolt_resistance", it, "N", [0.0, 1e6])));
    if let Some(dissipator) = &net.dissipators {
        let path = "barrier.flexible_net.dissipators";
        let [force, stroke] = match dissipator.curve.is_plateau() {
            true => ["plateau_force", "stroke"],
            false => ["curve: the largest force at one end of a rope", "curve: the stroke at one end of a rope"],
        };
        all.push(usual(format!("{path}.{force}"), dissipator.plateau, "N", [0.0, 1e6]));
        all.push(usual(format!("{path}.{stroke}"), dissipator.stroke, "m", [0.0, 6.0]));
    }
    all
}

/// Of ring nets in use: rings of 300 to 420 mm, wires of 3 to 4.6 mm.
fn of_rings(rings: &NetRings) -> [Usual; 3] {
    let path = "barrier.flexible_net.net.rings";
    [
        usual(format!("{path}.diameter"), rings.diameter, "m", [0.2, 0.5]),
        usual(format!("{path}.wire_diameter"), rings.wires.diameter, "m", [0.002, 0.005]),
        usual(format!("{path}.wire_strength"), rings.wires.strength * 1e-9, "GPa", [1.3, 2.2]),
    ]
}

/// Wire is drawn to 1570 to 2160 MPa and fills 45 to 60 % of the circle; with the full circle the modulus of the best strands is about
/// 120 GPa. What is soft has a warning of its own.
fn of_rope(name: &str, rope: &Rope) -> [Usual; 2] {
    let circle = std::f64::consts::FRAC_PI_4 * rope.diameter.powi(2);
    let path = format!("barrier.flexible_net.{name}");
    [
        usual(format!("{path}.modulus"), rope.modulus * 1e-9, "GPa", [0.0, 130.0]),
        usual(
            format!("{path}.breaking_load over the circle of its diameter"),
            rope.breaking_load / circle * 1e-9,
            "GPa",
            [0.2, 1.3],
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::read::read_design;

    /// What is told of `small_net` with one value replaced.
    fn told(from: &str, to: &str) -> Vec<String> {
        let text = include_str!("../../designs/small_net.yaml");
        assert!(text.contains(from), "{from}");
        let design = read_design("x", text.replacen(from, to, 1).as_bytes()).unwrap().design;
        implausible(&design).into_iter().map(|input| input.what).collect()
    }

    #[test]
    fn what_is_far_from_usual_is_told() {
        assert!(told("width: 3 m", "width: 3 m").is_empty());
        for (from, to, what) in [
            ("retained_mass: 85 %", "retained_mass: 0.85 %", "limits.retained_mass"),
            ("residual_height: 50 %", "residual_height: 5 %", "limits.residual_height"),
            ("resistance: 290 kN", "resistance: 290 MN", "barrier.flexible_net.anchors.resistance"),
            ("modulus: 10 GPa", "modulus: 200 GPa", "barrier.flexible_net.net_rope.modulus"),
            ("velocity: 4.6 m/s", "velocity: 26 m/s", "flow.arrival.surge.velocity"),
            ("solid_density: 2650", "solid_density: 5650", "flow.solid_density"),
            ("plateau_force: 150 kN", "plateau_force: 1.5 MN", "barrier.flexible_net.dissipators.plateau_force"),
        ] {
            assert_eq!(told(from, to), [what]);
        }
    }

    /// 150 MN over a face of 15.2 m by 5.5 m: 1.794 MPa.
    #[test]
    fn a_wall_stronger_than_walls_are_is_told() {
        let text = include_str!("../../designs/rigid_wall.yaml");
        let told = |text: String| implausible(&read_design("x", text.as_bytes()).unwrap().design);
        assert!(told(text.to_string()).is_empty());
        let strong = told(text.replace("resistance: 15 MN", "resistance: 150 MN"));
        assert_eq!(strong.len(), 1);
        assert!((strong[0].found - 1.794).abs() < 1e-3, "{strong:?}");
    }
}
