//! From checked entries to the design, in SI.

use crate::design::entries::Entries;
use crate::design::rules::{flow_volume, rope_heights, size_curve};
use crate::design::{
    Arrival, BarrierDesign, BarrierModel, Bottom, Channel, DamBreak, Design, DissipatorDesign, Factors, FidelityWish,
    FlexibleNet, Flow, LateralTo, Limits, MainRopes, OtherLoads, Project, RigidWall, Rope, SideExtension,
    SimulationWishes, Stability,
};

/// Builds the design. `None` only if a required entry is missing, which reading has then reported.
pub fn resolve(e: &Entries) -> Option<Design> {
    Some(Design {
        project: project(e),
        channel: channel(e)?,
        flow: flow(e)?,
        barrier: barrier(e)?,
        limits: limits(e)?,
        factors: factors(e)?,
        loads: loads(e)?,
        simulation: simulation(e)?,
    })
}

fn project(e: &Entries) -> Project {
    let text = |key: &str| e.text(&format!("project.{key}")).unwrap_or_default().to_string();
    Project {
        name: text("name"),
        barrier: text("barrier"),
        revision: text("revision"),
        author: text("author"),
        checker: text("checker"),
        date: text("date"),
        notes: text("notes"),
    }
}

fn channel(e: &Entries) -> Option<Channel> {
    let value = |key: &str| e.number(&format!("channel.{key}"));
    Some(Channel {
        width: value("width")?,
        slope: value("slope")?,
        wall_height: value("wall_height")?,
        base_friction: value("base_friction")?.tan(),
        side_friction: value("side_friction")?.tan(),
        barrier_friction: value("barrier_friction")?.tan(),
    })
}

fn flow(e: &Entries) -> Option<Flow> {
    let value = |key: &str| e.number(&format!("flow.{key}"));
    let bulk_density = value("bulk_density")?;
    Some(Flow {
        mass: flow_volume(e)? * bulk_density,
        bulk_density,
        solid_density: value("solid_density")?,
        sizes: size_curve(e)?,
        aspect: value("grain_aspect")?,
        grain_friction: value("grain_friction")?.tan(),
        restitution: value("restitution")?,
        modulus: value("contact_modulus")?,
        arrival: arrival(e)?,
    })
}

fn arrival(e: &Entries) -> Option<Arrival> {
    let value = |key: &str| e.number(&format!("flow.arrival.{key}"));
    let area = |length: f64| Some(flow_volume(e)? / (length * e.number("channel.width")?));
    if e.has_section("flow.arrival.dam_break") {
        let length = value("dam_break.length")?;
        return Some(Arrival::DamBreak(DamBreak {
            length,
            height: area(length)?,
            distance: value("dam_break.distance")?,
            depth_at_barrier: value("dam_break.depth_at_barrier"),
            velocity_at_barrier: value("dam_break.velocity_at_barrier"),
        }));
    }
    let depth = value("surge.depth")?;
    Some(Arrival::Surge { length: area(depth)?, depth, velocity: value("surge.velocity")? })
}

fn barrier(e: &Entries) -> Option<BarrierDesign> {
    if e.has_section("barrier.rigid_wall") {
        return Some(BarrierDesign::RigidWall(rigid_wall(e)?));
    }
    Some(BarrierDesign::FlexibleNet(Box::new(flexible_net(e)?)))
}

/// Parts of a rigid wall when the design names none.
const DEFAULT_SEGMENTS: usize = 6;

fn rigid_wall(e: &Entries) -> Option<RigidWall> {
    let height = e.number("barrier.rigid_wall.height")?;
    let even = vec![height / DEFAULT_SEGMENTS as f64; DEFAULT_SEGMENTS];
    let parts = e.numbers("barrier.rigid_wall.segments").map_or(even, <[f64]>::to_vec);
    let segment_tops = parts.iter().scan(0.0, |top, part| {
        *top += part;
        Some(*top)
    });
    let stability = e.has_section("barrier.rigid_wall.stability").then(|| {
        let value = |key: &str| e.number(&format!("barrier.rigid_wall.stability.{key}"));
        let thickness = value("thickness")?;
        Some(Stability {
            thickness,
            density: value("density")?,
            base_width: value("base_width").unwrap_or(thickness),
            base_slope: value("base_slope")?,
            base_friction: value("base_friction")?.tan(),
            sliding_factor: value("sliding_factor")?,
            overturning_factor: value("overturning_factor")?,
        })
    });
    Some(RigidWall {
        height,
        segment_tops: segment_tops.collect(),
        resistance: e.number("barrier.rigid_wall.resistance"),
        stability: match stability {
            Some(stability) => Some(stability?),
            None => None,
        },
    })
}

fn flexible_net(e: &Entries) -> Option<FlexibleNet> {
    let value = |key: &str| e.number(&format!("barrier.flexible_net.{key}"));
    let dissipators = e.has_section("barrier.flexible_net.dissipators").then(|| {
        Some(DissipatorDesign {
            plateau: value("dissipators.plateau_force")?,
            stroke: value("dissipators.stroke")?,
            stiffness: value("dissipators.stiffness")?,
        })
    });
    let tied_to = e.text("barrier.flexible_net.lateral_ropes.tied_to")?;
    Some(FlexibleNet {
        height: value("height")?,
        tilt: value("tilt")?,
        mesh_opening: value("mesh_opening")?,
        net_rope: rope(e, "net_rope")?,
        net_slack: value("net_slack")?,
        main_ropes: MainRopes {
            heights: rope_heights(e)?,
            rope: rope(e, "main_ropes")?,
            ring_spacing: value("main_ropes.rings.spacing")?,
            ring_friction: value("main_ropes.rings.friction")?.tan(),
            ring_diameter: value("main_ropes.rings.diameter")?,
            ring_modulus: value("main_ropes.rings.modulus")?,
            element_length: value("main_ropes.element_length")?,
        },
        lateral_rope: rope(e, "lateral_ropes")?,
        lateral_to: if tied_to == "anchors" { LateralTo::Anchors } else { LateralTo::RopeEnds },
        dissipators: match dissipators {
            Some(dissipators) => Some(dissipators?),
            None => None,
        },
        anchor_resistance: value("anchors.resistance")?,
        bed_resistance: value("anchors.bed_resistance"),
        bottom: value("bottom.opening").map_or(Bottom::Fixed, Bottom::Opening),
        side_extension: value("side_extension.length")
            .zip(value("side_extension.holding_force"))
            .map(|(length, holding_force)| SideExtension { length, holding_force }),
    })
}

fn rope(e: &Entries, part: &str) -> Option<Rope> {
    let value = |key: &str| e.number(&format!("barrier.flexible_net.{part}.{key}"));
    let beyond = e.text(&format!("barrier.flexible_net.{part}.at_breaking_load"))?;
    Some(Rope {
        diameter: value("diameter")?,
        modulus: value("modulus")?,
        breaking_load: value("breaking_load")?,
        elastic_limit: value("elastic_limit"),
        breaks: beyond == "breaks",
    })
}

fn limits(e: &Entries) -> Option<Limits> {
    let value = |key: &str| e.number(&format!("limits.{key}"));
    Some(Limits {
        retained_mass: value("retained_mass")?,
        residual_height: value("residual_height")?,
        rope_utilisation: value("rope_utilisation")?,
        anchor_utilisation: value("anchor_utilisation")?,
        brake_utilisation: value("brake_utilisation")?,
    })
}

fn factors(e: &Entries) -> Option<Factors> {
    let value = |key: &str| e.number(&format!("factors.{key}"));
    Some(Factors {
        earth_pressure: value("earth_pressure_k")?,
        dynamic_pressure: value("dynamic_lambda")?,
        load: value("load")?,
        rope: value("rope")?,
        anchor: value("anchor")?,
        rope_end: value("rope_end")?,
    })
}

fn loads(e: &Entries) -> Option<OtherLoads> {
    let value = |key: &str| e.number(&format!("loads.{key}"));
    let pair = |first: &str, second: &str| value(first).zip(value(second));
    Some(OtherLoads {
        overflow_depth: value("overflow_depth"),
        overflow_drag: value("overflow_friction").map(f64::tan).zip(value("overflow_length")),
        to_the_top: e.text("loads.filling")? == "to_the_top",
        drained: pair("drained.earth_pressure_k", "drained.density"),
        point_load: pair("point_load.force", "point_load.height"),
        snow_pressure: value("snow_pressure"),
        self_weight: value("self_weight"),
        filled_height: value("filled_height")?,
        deposit_slope: value("deposit_slope")?,
    })
}

fn simulation(e: &Entries) -> Option<SimulationWishes> {
    let fidelity = match e.text("simulation.fidelity")? {
        "fast" => FidelityWish::Fast,
        "standard" => FidelityWish::Standard,
        "fine" => FidelityWish::Fine,
        "auto" => FidelityWish::Auto,
        _ => return None,
    };
    let barrier_model = match e.text("simulation.barrier_model")? {
        "pinned_ropes" => BarrierModel::PinnedRopes,
        "sliding_ropes" => BarrierModel::SlidingRopes,
        "cylinders" => BarrierModel::Cylinders,
        _ => return None,
    };
    let seed = e.number("simulation.seed")? as u64;
    Some(SimulationWishes { fidelity, barrier_model, seed, longest: e.number("simulation.longest")? })
}
