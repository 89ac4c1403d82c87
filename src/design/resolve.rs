//! From checked entries to the design, in SI.

use std::sync::Arc;

use crate::design::RetainedOf;
use crate::design::anchors::anchors;
use crate::design::channel_entries::{height_of_barrier, height_of_sides, profile, section, survey};
use crate::design::dissipator_entries::{OF_MAIN_ROPES, dissipators};
use crate::design::entries::Entries;
use crate::design::flow::RUN_IN;
use crate::design::flow_entries::{
    SIZES, boulders, coarsened, curve_known_from, flow_volume, size_curve, size_curve_at,
};
use crate::design::hydrograph_entries::{HYDROGRAPH, as_of_a_surge, hydrograph};
use crate::design::net_rings::net_rings;
use crate::design::net_rules::rope_heights;
use crate::design::posts::posts;
use crate::design::rope_entries::{levels_at, rope};
use crate::design::sizes::SizeCurve;
use crate::design::surge_entries::{surges, volume_of, volume_of_all};
use crate::design::terrain_file::FINE;
use crate::design::{
    Arrival, BarrierDesign, BarrierModel, BedBolts, Bottom, Boulders, Channel, CurveCut, DamBreak, Design, Factors,
    FidelityWish, FlexibleNet, Flow, LaterSurge, LateralTo, Limits, MainRopes, MeshShape, OtherLoads, OutsideRange,
    OwnSizes, PoreFluid, Project, RigidWall, RunUp, SideExtension, SimulationWishes, Stability, Surge,
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
        width: section(e)?.mean_width(height_of_barrier(e)?),
        survey: if value("width").is_some() { None } else { Some(survey(e)?) },
        profile: profile(e),
        relief: e.relief.clone(),
        mesh: e.relief.as_ref().map(|relief| Arc::new(relief.every(FINE))),
        slope: value("slope")?,
        wall_height: height_of_sides(e)?,
        base_friction: value("base_friction").map_or(f64::NAN, libm::tan),
        side_friction: value("side_friction").map_or(f64::NAN, libm::tan),
        barrier_friction: value("barrier_friction").map_or(f64::NAN, libm::tan),
    })
}

fn flow(e: &Entries) -> Option<Flow> {
    let value = |key: &str| e.number(&format!("flow.{key}"));
    let bulk_density = value("bulk_density")?;
    // Without grains the design was read for the equations; nothing of them is used there.
    let whole = size_curve(e).unwrap_or(SizeCurve::Unknown);
    let cut = coarsened(e, &whole).map(|share| CurveCut { share, whole: whole.clone() });
    Some(Flow {
        mass: flow_volume(e)? * bulk_density,
        event_volume: value("event_volume").or_else(|| volume_of_all(e)).or_else(|| flow_volume(e))?,
        bulk_density,
        solid_density: value("solid_density").unwrap_or(f64::NAN),
        later: later_surges(e, cut.as_ref())?,
        sizes: cut.as_ref().map_or(whole, |cut| cut.whole.cut_below(cut.share)),
        known_from: curve_known_from(e, SIZES),
        cut,
        aspect: value("grain_aspect")?,
        grain_friction: value("grain_friction").map_or(f64::NAN, libm::tan),
        restitution: value("restitution")?,
        modulus: value("contact_modulus")?,
        pore_fluid: pore_fluid(e),
        arrival: arrival(e)?,
        hydrograph: hydrograph(e),
        boulders: largest_first(boulders(e)?),
    })
}

/// In whatever order they are listed they are the same boulders.
fn largest_first(mut boulders: Vec<Boulders>) -> Vec<Boulders> {
    boulders.sort_by(|a, b| b.diameter.total_cmp(&a.diameter).then(b.density.total_cmp(&a.density)));
    boulders
}

fn pore_fluid(e: &Entries) -> Option<PoreFluid> {
    let value = |key: &str| e.number(&format!("flow.pore_fluid.{key}"));
    Some(PoreFluid {
        density: value("density")?,
        pressure_ratio: value("pressure_ratio")?,
        drains_in: value("drains_in")?,
        drains_to: value("drains_to").unwrap_or(ratio_at_rest(e)?.min(value("pressure_ratio")?)),
    })
}

/// r_u of a fluid at rest in all pores, ρ_f/ρ.
fn ratio_at_rest(e: &Entries) -> Option<f64> {
    Some(e.number("flow.pore_fluid.density")? / e.number("flow.bulk_density")?)
}

/// tan φ between grains as it acts on the flow as it comes; 0 where it is not given.
fn acting_friction(e: &Entries) -> f64 {
    let acts = pore_fluid(e).map_or(1.0, |fluid| 1.0 - fluid.pressure_ratio);
    acts * libm::tan(e.number("flow.grain_friction").unwrap_or(0.0))
}

/// Flattest front that is taken where the design says none (rad): 15 degrees.
const FLATTEST_FRONT: f64 = 0.261_799_387_799_149_4;

/// Angle to the bed of the front of a granular flow, tan = tan φ − tan α, with the friction tan φ of the grains and the slope α
/// (Pouliquen 1999, for the thin tip of a front on a rough bed).
pub fn granular_front(friction: f64, slope: f64) -> f64 {
    libm::atan(friction - libm::tan(slope)).max(FLATTEST_FRONT)
}

fn arrival(e: &Entries) -> Option<Arrival> {
    let value = |key: &str| e.number(&format!("flow.arrival.{key}"));
    let section = section(e)?;
    if e.has_section("flow.arrival.dam_break") {
        let length = value("dam_break.length")?;
        return Some(Arrival::DamBreak(DamBreak {
            length,
            height: section.depth_of(flow_volume(e)?, length),
            distance: value("dam_break.distance")?,
            depth_at_barrier: value("dam_break.depth_at_barrier"),
            velocity_at_barrier: value("dam_break.velocity_at_barrier"),
        }));
    }
    if e.has_section(HYDROGRAPH) {
        let [depth, velocity, run_in] = ["depth", "velocity", "run_in"].map(|name| as_of_a_surge(e, name));
        let surge = surge(e, HYDROGRAPH, flow_volume(e)?, depth?, velocity?)?;
        return Some(Arrival::Surge(Surge { run_in: run_in?, ..surge }));
    }
    let path = surges(e).into_iter().next()?;
    surge_at(e, &path, flow_volume(e)?).map(Arrival::Surge)
}

/// The surge of a volume (m³) that the entries at a path describe.
fn surge_at(e: &Entries, path: &str, volume: f64) -> Option<Surge> {
    let [depth, velocity] = ["depth", "velocity"].map(|name| e.number(&format!("{path}.{name}")));
    surge(e, path, volume, depth?, velocity?)
}

/// The same with its depth (m) and velocity (m/s).
fn surge(e: &Entries, path: &str, volume: f64, depth: f64, velocity: f64) -> Option<Surge> {
    let value = |key: &str| e.number(&format!("{path}.{key}"));
    Some(Surge {
        length: volume / section(e)?.area(depth),
        depth,
        velocity,
        front_angle: value("front_angle").unwrap_or(granular_front(acting_friction(e), e.number("channel.slope")?)),
        run_in: value("run_in").unwrap_or(RUN_IN * depth),
    })
}

fn later_surges(e: &Entries, cut: Option<&CurveCut>) -> Option<Vec<LaterSurge>> {
    let later = |path: &String| {
        let volume = volume_of(e, path)?;
        let sizes = format!("{path}.grain_sizes");
        let own = size_curve_at(e, &sizes).map(|whole| OwnSizes {
            known_from: curve_known_from(e, &sizes),
            cut: cut.map(|cut| CurveCut { share: cut.share, whole: whole.clone() }),
            sizes: cut.map_or(whole.clone(), |cut| whole.cut_below(cut.share)),
        });
        Some(LaterSurge { volume, surge: surge_at(e, path, volume)?, own, after: e.number(&format!("{path}.after")) })
    };
    surges(e).iter().skip(1).map(later).collect()
}

fn barrier(e: &Entries) -> Option<BarrierDesign> {
    if e.has_section("barrier.rigid_wall") {
        return Some(BarrierDesign::RigidWall(Box::new(rigid_wall(e)?)));
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
            base_slope: value("base_slope"),
            founding_depth: value("founding_depth")?,
            base_friction: value("base_friction").map_or(f64::NAN, libm::tan),
            ground_density: value("ground_density")?,
            sliding_factor: value("sliding_factor")?,
            overturning_factor: value("overturning_factor")?,
            bearing_resistance: value("bearing_resistance"),
            bearing_factor: value("bearing_factor")?,
            block_length: value("block_length"),
            water_head: value("water_head"),
        })
    });
    let slope = e.number("channel.slope")?;
    Some(RigidWall {
        height,
        lean: match (e.number("barrier.rigid_wall.tilt"), stability) {
            (Some(tilt), _) => slope + tilt,
            // One that stands by its weight stands upright on its base.
            (None, Some(Some(stability))) => slope - stability.base_slope.unwrap_or(0.0),
            // In a terrain the section is taken plumb.
            (None, _) if e.mentions("channel.terrain") => slope,
            (None, _) => 0.0,
        },
        segment_tops: segment_tops.collect(),
        resistance: e.number("barrier.rigid_wall.resistance"),
        resistance_factor: e.number("barrier.rigid_wall.resistance_factor")?,
        moment_resistance: e.number("barrier.rigid_wall.moment_resistance"),
        stability: match stability {
            Some(stability) => Some(stability?),
            None => None,
        },
    })
}

fn flexible_net(e: &Entries) -> Option<FlexibleNet> {
    let value = |key: &str| e.number(&format!("barrier.flexible_net.{key}"));
    let dissipators = e.has_section(OF_MAIN_ROPES).then(|| dissipators(e, OF_MAIN_ROPES));
    let rings = match e.mentions("barrier.flexible_net.net") {
        true => Some(net_rings(e)?),
        false => None,
    };
    Some(FlexibleNet {
        height: value("height")?,
        tilt: value("tilt")?,
        mesh_opening: match &rings {
            Some(rings) => rings.mesh(),
            None => value("mesh_opening")?,
        },
        mesh: MeshShape::of(e),
        net_rope: match &rings {
            Some(rings) => rings.as_rope(),
            None => rope(e, &["net_rope"])?,
        },
        rings,
        net_slack: value("net_slack")?,
        net_pieces: value("net_pieces").map(|pieces| pieces as u32),
        main_ropes: MainRopes {
            levels: levels_at(e, &rope_heights(e)?)?,
            ring_spacing: value("main_ropes.rings.spacing")?,
            ring_friction: libm::tan(value("main_ropes.rings.friction")?),
            ring_diameter: value("main_ropes.rings.diameter")?,
            ring_modulus: value("main_ropes.rings.modulus")?,
            element_length: value("main_ropes.element_length")?,
        },
        lateral_rope: rope(e, &["lateral_ropes"])?,
        lateral_to: e.chosen(
            "barrier.flexible_net.lateral_ropes.tied_to",
            &[
                ("rope_ends", LateralTo::RopeEnds),
                ("dissipators", LateralTo::RopeEnds),
                ("anchors", LateralTo::Anchors),
            ],
        )?,
        dissipators: match dissipators {
            Some(dissipators) => Some(dissipators?),
            None => None,
        },
        anchor_designs: anchors(e)?,
        bed_bolts: bed_bolts(e),
        bottom: value("bottom.opening").map_or(Bottom::Fixed, Bottom::Opening),
        side_extension: value("side_extension.length").zip(value("side_extension.holding_force")).map(
            |(length, holding_force)| SideExtension {
                length,
                holding_force,
                holding_force_given: e.given("barrier.flexible_net.side_extension.holding_force"),
            },
        ),
        posts: match e.has_section("barrier.flexible_net.posts") {
            true => Some(posts(e)?),
            false => None,
        },
    })
}

fn bed_bolts(e: &Entries) -> Option<BedBolts> {
    let value = |key: &str| e.number(&format!("barrier.flexible_net.anchors.{key}"));
    let bolts = BedBolts { spacing: value("bed_bolt_spacing")?, resistance: value("bed_bolt_resistance") };
    let number = bolts.spaces(section(e)?.bed_length()) + 1;
    let share = value("bed_resistance").map(|of_all| of_all / number as f64);
    Some(BedBolts { resistance: bolts.resistance.or(share), ..bolts })
}

fn limits(e: &Entries) -> Option<Limits> {
    let value = |key: &str| e.number(&format!("limits.{key}"));
    Some(Limits {
        retained_mass: value("retained_mass")?,
        retained_of: e
            .chosen("limits.retained_of", &[("mixture", RetainedOf::Mixture), ("grains", RetainedOf::Grains)])?,
        residual_height: value("residual_height")?,
        freeboard: value("freeboard"),
        run_up: e.chosen(
            "limits.run_up",
            &[("larger", RunUp::Larger), ("momentum_jump", RunUp::MomentumJump), ("energy", RunUp::Energy)],
        )?,
        rope_utilisation: value("rope_utilisation")?,
        anchor_utilisation: value("anchor_utilisation")?,
        dissipator_utilisation: value("dissipator_utilisation")?,
        outside_range: e
            .chosen("limits.outside_range", &[("undecided", OutsideRange::Undecided), ("warn", OutsideRange::Warn)])?,
    })
}

fn factors(e: &Entries) -> Option<Factors> {
    let value = |key: &str| e.number(&format!("factors.{key}"));
    let (load, overstrength) = (value("load")?, value("dissipator_overstrength"));
    Some(Factors {
        earth_pressure: value("earth_pressure_k")?,
        dynamic_pressure: value("dynamic_lambda")?,
        load,
        load_given: e.given("factors.load"),
        rope: value("rope")?,
        anchor: value("anchor")?,
        post: value("post")?,
        rope_end: value("rope_end")?,
        rope_end_given: e.given("factors.rope_end"),
        overstrength: overstrength.unwrap_or(load),
        overstrength_given: overstrength.is_some(),
    })
}

fn loads(e: &Entries) -> Option<OtherLoads> {
    let value = |key: &str| e.number(&format!("loads.{key}"));
    let pair = |first: &str, second: &str| value(first).zip(value(second));
    Some(OtherLoads {
        overflow_depth: value("overflow_depth"),
        overflow_drag: value("overflow_friction").map(libm::tan).zip(value("overflow_length")),
        to_the_top: e.chosen("loads.filling", &[("to_the_top", true), ("one_event", false)])?,
        drained: pair("drained.earth_pressure_k", "drained.density"),
        point_load: pair("point_load.force", "point_load.height").map(|(force, height)| (force, Some(height))),
        snow_pressure: value("snow_pressure"),
        wood_factor: value("wood_factor"),
        impact_reduction: value("impact_reduction"),
        self_weight: value("self_weight"),
        filled_height: value("filled_height")?,
        deposit_slope: value("deposit_slope")?,
    })
}

fn simulation(e: &Entries) -> Option<SimulationWishes> {
    let fidelity = e.chosen(
        "simulation.fidelity",
        &[
            ("fast", FidelityWish::Fast),
            ("standard", FidelityWish::Standard),
            ("fine", FidelityWish::Fine),
            ("auto", FidelityWish::Auto),
        ],
    )?;
    let barrier_model = e.chosen(
        "simulation.barrier_model",
        &[
            ("pinned_ropes", BarrierModel::PinnedRopes),
            ("sliding_ropes", BarrierModel::SlidingRopes),
            ("cylinders", BarrierModel::Cylinders),
        ],
    )?;
    let seed = e.number("simulation.seed")? as u64;
    Some(SimulationWishes { fidelity, barrier_model, seed, longest: e.number("simulation.longest")? })
}
