//! `Design` + `Fidelity` → a simulation ready to be released, and what its recorder must know.

use std::sync::atomic::{AtomicBool, Ordering};

use serde::{Deserialize, Serialize};

use crate::design::{Arrival, BarrierDesign, DamBreak, Design, Flow, Surge};
use crate::fidelity::{Fidelity, net_pieces};
use crate::scene::flow::packing::{Attempts, PackingError};
use crate::scene::flow::release::{Block, count_of_boulders, packed_block, shape};
use crate::scene::ground::{self, bed_at, gravity};
use crate::scene::inlet::{Feed, block_behind, inlet};
use crate::scene::interrupt_grace::Patience;
use crate::scene::net::build::{BuiltNet, build as build_net};
use crate::scene::surges::farthest_upstream;
use crate::section::{Section, Survey};
use crate::units::GRAVITY;
use dem::Vec3;
use dem::contact::material::Material;
use dem::elements::ground::{Ground, Plane};
use dem::model::Model;
use dem::recorders::gauge::GaugeWindow;
use dem::recorders::passage::WallFace;
use dem::recorders::setup::RecorderSetup;
use dem::simulation::Simulation;
use dem::tables::barrier::Barrier;
use dem::tables::grains::Grain;
use dem::tables::pores::Pores;
use dem::tables::surfaces::{Span, Surface, SurfaceRole};
use dem::tables::terrain::Terrain;
use dem::tables::wall::WallShape;

/// A simulation at the moment of release.
pub struct Scene {
    pub simulation: Simulation,
    pub recorder: RecorderSetup,
    /// Time over which forces are averaged to find peaks (s).
    pub smoothing: f64,
    /// Stretch over which steadiness is judged and residuals are averaged (s).
    pub rest: f64,
    /// What is still to come in through an inlet.
    pub feed: Option<Feed>,
    /// Bulk density of the block as packed, over the one asked for.
    pub packed_share: f64,
    /// Rough time the event takes (s), for telling progress.
    pub expected_time: f64,
    /// How far upstream of its foot the barrier reaches, with room for the largest grain (m).
    pub reach: f64,
}

impl Scene {
    /// Samples in the stretch over which residuals are averaged.
    pub fn samples_of_rest(&self) -> usize {
        (self.rest / self.recorder.interval).ceil() as usize
    }
}

/// The time a grain of mean size takes to fall about half its diameter, √(D50/g): the unit in which sampling,
/// smoothing and settling are measured, so that scenes of different size are treated alike.
pub fn time_scale(design: &Design) -> f64 {
    (design.flow.sizes.quantile(0.5) / GRAVITY).sqrt()
}

/// Longest smoothing window (s), and the longest over [`time_scale`], which binds in small scenes only.
const SMOOTHING: f64 = 0.05;
const SMOOTHING_SHARE: f64 = 1.3;
/// Samples in one smoothing window.
pub const SAMPLES_PER_WINDOW: f64 = 11.0;
/// Stretch over which steadiness is judged and residuals are averaged, over [`time_scale`].
const REST: f64 = 2.5;
/// Time between two looks at which grains have passed, over [`time_scale`].
const PASSAGE: f64 = 0.2;

/// Time over which forces are averaged before a peak is read off (s).
fn smoothing(design: &Design) -> f64 {
    SMOOTHING.min(SMOOTHING_SHARE * time_scale(design))
}
/// Speed below which grains rest, as far as the fluid between them drains, over √(g D50).
const RESTS_BELOW: f64 = 0.1;
/// The same over the velocity of the slowest surge.
const RESTS_BELOW_OF_VELOCITY: f64 = 0.05;
/// Settling time over √(block height/g), and its drag times that time.
const SETTLING: f64 = 1.2;
const SETTLING_DRAG: f64 = 2.5;

/// What is prepared of a scene so far, to be kept.
#[derive(Serialize, Deserialize)]
pub enum Prepared<Grains, Settling> {
    /// So many attempts at packing the flow have failed.
    Attempts(usize),
    Packed(Grains, Block),
    /// A flow that settles behind its gate, at a stop.
    Settling(Settling, Block),
}

/// How the preparation of a scene is watched from outside, and where it goes on.
pub struct Preparing<'a> {
    pub stop: &'a AtomicBool,
    pub from: Option<Prepared<Vec<Grain>, Simulation>>,
    /// Handed what is prepared, and told whether the preparation ends there because it was asked to.
    pub keep: Keep<'a>,
}

type Keep<'a> = &'a mut dyn FnMut(Prepared<&[Grain], &Simulation>, bool);

/// Builds the scene: packs the flow, lets it settle behind the gate, puts the barrier up.
pub fn build(design: &Design, fidelity: &Fidelity, seed: u64) -> Result<Scene, PackingError> {
    let watched = Preparing { stop: &AtomicBool::new(false), from: None, keep: &mut |_, _| () };
    build_watched(design, fidelity, seed, watched)
}

/// The same, given up when it is asked to stop while the flow is packed or settles, which takes long where grains are many.
pub fn build_watched(
    design: &Design,
    fidelity: &Fidelity,
    seed: u64,
    watched: Preparing,
) -> Result<Scene, PackingError> {
    let Preparing { stop, from, keep } = watched;
    let net = match &design.barrier {
        BarrierDesign::FlexibleNet(net) => {
            Some(build_net(net, &design.channel, design.simulation.barrier_model, net_pieces(design, net)))
        }
        BarrierDesign::RigidWall(_) => None,
    };
    let reach = upstream_reach(design, net.as_ref());
    let wanted = match &design.flow.hydrograph {
        Some(hydrograph) => block_behind(design, hydrograph, reach),
        None => Block::of(&design.flow, &design.channel, reach),
    };
    let mut feed = None;
    let (mut simulation, block) = match from {
        _ if let Some(hydrograph) = &design.flow.hydrograph => {
            let mut simulation = stand(design, fidelity, Vec::new(), &wanted);
            simulation.model.inlet = Some(inlet(design, hydrograph, reach)?);
            feed = Some(Feed::begin(design, hydrograph, seed, &mut simulation, stop)?);
            (simulation, wanted)
        }
        Some(Prepared::Settling(simulation, block)) => (simulation, block),
        Some(Prepared::Packed(grains, block)) => (stand(design, fidelity, grains, &block), block),
        failed => {
            let failed = if let Some(Prepared::Attempts(failed)) = failed { failed } else { 0 };
            let attempts = Attempts { stop, failed, next: &mut |failed| keep(Prepared::Attempts(failed), false) };
            let (grains, block) = packed_block(&design.flow, &design.channel, &wanted, seed, attempts)?;
            keep(Prepared::Packed(&grains, block), false);
            (stand(design, fidelity, grains, &block), block)
        }
    };
    if matches!(design.flow.arrival, Arrival::DamBreak(_)) {
        settle(&mut simulation, &block, stop, keep)?;
    }
    simulation.remove_surfaces(SurfaceRole::Gate);
    if let Some(net) = &net {
        simulation.put_up(Barrier { ground: Some(ground_of(design, &net.barrier)), ..net.barrier.clone() });
    }
    simulation.start_account();
    let mut recorder = recorder_setup(design, net);
    if let Some(feed) = &feed {
        recorder.to_come = design.flow.mass - feed.mass();
    }
    // They were packed last.
    let grains = simulation.grains.ids.iter().max().map_or(0, |last| last + 1);
    recorder.boulders = [grains - count_of_boulders(&design.flow).min(grains), grains];
    Ok(Scene {
        simulation,
        recorder,
        smoothing: smoothing(design),
        rest: REST * time_scale(design),
        packed_share: feed.as_ref().map_or(wanted.area() / block.area(), Feed::packed_share),
        feed,
        expected_time: expected_time(design),
        reach,
    })
}

/// Speed below which grains rest (m/s): in no surge that still flows.
fn rests_below(flow: &Flow) -> f64 {
    let velocity = |number: usize| match flow.alone(number).arrival {
        Arrival::Surge(surge) => surge.velocity,
        Arrival::DamBreak(_) => f64::INFINITY,
    };
    let slowest = (0..flow.surges()).map(velocity).fold(f64::INFINITY, f64::min);
    (RESTS_BELOW * (GRAVITY * flow.sizes.quantile(0.5)).sqrt()).min(RESTS_BELOW_OF_VELOCITY * slowest)
}

/// The packed flow in its channel, without the barrier.
fn stand(design: &Design, fidelity: &Fidelity, grains: Vec<Grain>, block: &Block) -> Simulation {
    let flow = &design.flow;
    let model = Model {
        shape: shape(flow),
        grains,
        surfaces: surfaces(design, block),
        terrain: design.channel.ground().map(|survey| terrain_of(design, &survey, block)),
        barrier: None,
        material: Material::new(flow.modulus, flow.restitution, flow.grain_friction),
        pores: flow.pore_fluid.map(|fluid| Pores {
            ratio: fluid.pressure_ratio,
            drains_in: fluid.drains_in,
            drains_to: fluid.drains_to,
            rests_below: rests_below(flow),
        }),
        inlet: None,
        gravity: gravity(design.channel.slope),
        wall: wall_shape(design),
        outlet: outlet(design),
    };
    let mean_radius = 0.42 * flow.sizes.quantile(0.5);
    let mut simulation =
        Simulation::new(model, fidelity.time_step, fidelity.skin_share * mean_radius, speed_limit(design, block));
    simulation.barrier_step = fidelity.barrier_step;
    simulation
}

/// Time in which all surges have come to rest.
pub fn expected_time(design: &Design) -> f64 {
    let one = |number: usize| expected_time_of(design, design.flow.alone(number).arrival);
    match &design.flow.hydrograph {
        Some(hydrograph) => hydrograph.duration() + expected_time_of(design, after_an_inlet(design.flow.arrival)),
        None => (0..design.flow.surges()).map(one).sum(),
    }
}

/// What comes last through an inlet, as a surge of no length.
fn after_an_inlet(arrival: Arrival) -> Arrival {
    match arrival {
        Arrival::Surge(surge) => Arrival::Surge(Surge { length: 0.0, ..surge }),
        other => other,
    }
}

/// Time of the last grain's arrival, and some falls from the barrier's height to come to rest.
fn expected_time_of(design: &Design, arrival: Arrival) -> f64 {
    let rest = 4.0 * (barrier_height(design) / GRAVITY).sqrt();
    rest + match arrival {
        Arrival::Surge(surge) => {
            let channel = &design.channel;
            let friction = design.flow.effective(channel.base_friction);
            let slowed = GRAVITY * (friction * libm::cos(channel.slope) - libm::sin(channel.slope));
            tail_time(surge.length + surge.run_in, surge.velocity, slowed)
        }
        Arrival::DamBreak(DamBreak { length, distance, .. }) => {
            let slope = design.channel.slope;
            let friction = design.flow.effective(design.channel.base_friction);
            let acceleration = GRAVITY * (libm::sin(slope) - friction * libm::cos(slope));
            (2.0 * (distance + length) / acceleration.max(0.1)).sqrt()
        }
    }
}

/// Time in which a tail comes over its way `s` (m) from a velocity v (m/s) that falls by `slowed` (m/s²), or comes to rest on it:
/// (v − √(v² − 2 a s))/a, or v/a. A tail that speeds up is taken as even, so that the time is rather too long.
fn tail_time(s: f64, v: f64, slowed: f64) -> f64 {
    if slowed <= 0.0 {
        return s / v;
    }
    let left = v * v - 2.0 * slowed * s;
    if left > 0.0 { 2.0 * s / (v + left.sqrt()) } else { v / slowed }
}

/// Heights at which the width of a wall in a surveyed section is told.
const WALL_WIDTHS: usize = 64;

/// The wall of the design, with its width at each height where it closes a section that is no rectangle.
fn wall_shape(design: &Design) -> WallShape {
    let BarrierDesign::RigidWall(wall) = &design.barrier else { return WallShape::default() };
    let section = design.channel.section();
    let width = |index: usize| {
        section
            .width(wall.height * libm::cos(wall.lean) * index as f64 / WALL_WIDTHS as f64)
            // In a groove no narrower than a grain, which touches it higher up.
            .max(design.flow.sizes.quantile(0.5))
    };
    let widths = match &section {
        Section::Rectangle { .. } => Vec::new(),
        Section::Surveyed(_) => (0..=WALL_WIDTHS).map(width).collect(),
    };
    WallShape { segment_tops: wall.segment_tops.clone(), widths }
}

/// How far upstream of its foot the barrier reaches (m).
fn reach(design: &Design, net: Option<&BuiltNet>) -> f64 {
    match &design.barrier {
        BarrierDesign::RigidWall(wall) => (wall.height * libm::sin(wall.lean)).max(0.0),
        BarrierDesign::FlexibleNet(_) => net.map_or(0.0, |net| net.barrier.face()),
    }
}

/// The same with all that holds the barrier, and with room for the largest grain.
fn upstream_reach(design: &Design, net: Option<&BuiltNet>) -> f64 {
    let largest = |number: usize| design.flow.alone(number).sizes.quantile(1.0);
    let all = net.map_or(0.0, BuiltNet::reach).max(reach(design, net));
    all + 0.5 * (0..design.flow.surges()).map(largest).fold(0.0, f64::max)
}

/// Lets the block settle behind the gate under gravity, slowed by drag; handed to `keep` at its stops.
fn settle(simulation: &mut Simulation, block: &Block, stop: &AtomicBool, keep: Keep) -> Result<(), PackingError> {
    let fall = (block.height / GRAVITY).sqrt();
    simulation.drag = SETTLING_DRAG / fall;
    let mut interrupt_grace = Patience::default();
    while simulation.time < SETTLING * fall {
        let asked = stop.load(Ordering::Relaxed);
        if simulation.at_stop() {
            keep(Prepared::Settling(simulation, *block), asked);
        }
        if asked && (simulation.at_stop() || interrupt_grace.is_over()) {
            return Err(PackingError::Interrupted);
        }
        simulation.step()?;
    }
    simulation.drag = 0.0;
    Ok(())
}

/// Beyond this, grains are gone for good: three barrier heights downstream.
fn outlet(design: &Design) -> f64 {
    3.0 * barrier_height(design)
}

/// Height of the barrier along its face or plane (m).
fn barrier_height(design: &Design) -> f64 {
    match &design.barrier {
        BarrierDesign::RigidWall(wall) => wall.height,
        BarrierDesign::FlexibleNet(net) => net.height,
    }
}

/// Ten times the speed of falling from the top of the scene to its outlet, plus the speed it came with.
fn speed_limit(design: &Design, block: &Block) -> f64 {
    let start = farthest_upstream(design, 0.0).max(block.length - block.front);
    let drop = start + outlet(design) + block.height;
    10.0 * ((2.0 * GRAVITY * drop).sqrt() + block.velocity)
}

/// How far the ground goes on upstream of the block and beyond the outlet (m).
const MARGIN: f64 = 20.0;

/// The ground of a surveyed section along the whole of the scene.
fn terrain_of(design: &Design, survey: &Survey, block: &Block) -> Terrain {
    let channel = &design.channel;
    let start = match design.flow.later.is_empty() {
        true => block.length - block.front,
        false => farthest_upstream(design, -block.front).max(block.length - block.front),
    };
    let along = [-start - MARGIN, outlet(design) + MARGIN];
    let friction = |is_bed: bool| if is_bed { channel.base_friction } else { channel.side_friction };
    ground::ground_of(channel, survey, along, friction)
}

/// How far a wall goes on into its banks (m).
const INTO_THE_BANK: f64 = 0.05;

/// Base, side walls, back wall and gate, and the rigid wall if that is the barrier.
fn surfaces(design: &Design, block: &Block) -> Vec<Surface> {
    let channel = &design.channel;
    let (x, y, z) = (Vec3::x(), Vec3::y(), Vec3::z());
    let up_to = |height: f64| Span::bounded(z, f64::NEG_INFINITY, height);
    let across = Span::unbounded(y);
    let along = Span::unbounded(x);
    let walls = up_to(channel.wall_height);
    let mut all = match channel.ground() {
        Some(_) => Vec::new(),
        None => vec![
            Surface::new(SurfaceRole::Base, Vec3::zeros(), z, [along, across], channel.base_friction),
            Surface::new(SurfaceRole::Side, Vec3::zeros(), y, [along, walls], channel.side_friction),
            Surface::new(SurfaceRole::Side, y * channel.width, -y, [along, walls], channel.side_friction),
        ],
    };
    if matches!(design.flow.arrival, Arrival::DamBreak(_)) {
        // Across the bed where they stand.
        let ends = [(SurfaceRole::Side, block.front - block.length, 1.0), (SurfaceRole::Gate, block.front, -1.0)];
        for (role, place, inwards) in ends {
            let (origin, [downstream, up]) = bed_at(channel, place);
            let spans = [Span::unbounded(up), across];
            all.push(Surface::new(role, origin, downstream * inwards, spans, channel.side_friction));
        }
    }
    if let BarrierDesign::RigidWall(wall) = &design.barrier {
        let (sine, cosine) = libm::sincos(wall.lean);
        let (up, upstream) = (z * cosine - x * sine, -x * cosine - z * sine);
        // Into the ground at either end, and no further: what lies beyond a crest is none of the wall's.
        let width = match channel.section() {
            Section::Rectangle { .. } => across,
            section @ Section::Surveyed(_) => {
                let [right, left] = section.banks(wall.height * cosine);
                Span::bounded(y, right - INTO_THE_BANK, left + INTO_THE_BANK)
            }
        };
        let spans = [Span::bounded(up, 0.0, wall.height), width];
        all.push(Surface::new(SurfaceRole::Wall, Vec3::zeros(), upstream, spans, channel.barrier_friction));
    }
    all
}

/// How far upstream of its foot a barrier reaches (m).
fn reach_of(barrier: &Barrier) -> f64 {
    barrier.nodes.iter().map(|node| -node.position.x).fold(0.0, f64::max)
}

/// Bed and side walls, as the net lies on them: with the smaller friction of grains on them and on ropes.
fn ground_of(design: &Design, barrier: &Barrier) -> Ground {
    let channel = &design.channel;
    let plane = |origin, normal, top, friction: f64| Plane {
        origin,
        normal,
        top,
        friction: friction.min(channel.barrier_friction),
    };
    let moduli = [design.flow.modulus, barrier.contact_modulus];
    if let Some(survey) = &channel.ground() {
        let along = [-MARGIN - reach_of(barrier), outlet(design) + MARGIN];
        let friction = |is_bed: bool| if is_bed { channel.base_friction } else { channel.side_friction };
        let terrain =
            ground::ground_of(channel, survey, along, |is_bed| friction(is_bed).min(channel.barrier_friction));
        return Ground::over(&barrier.nodes, terrain, moduli);
    }
    let (y, walls) = (Vec3::y(), channel.wall_height);
    let planes = [
        plane(Vec3::zeros(), Vec3::z(), f64::INFINITY, channel.base_friction),
        plane(Vec3::zeros(), y, walls, channel.side_friction),
        plane(y * channel.width, -y, walls, channel.side_friction),
    ];
    Ground::under(&barrier.nodes, planes, moduli)
}

/// Where the flow is gauged, upstream of the barrier's most upstream point, over its height: just before the barrier, for the velocity
/// with which it is hit; and where laboratories measure, 40 to 50 cm before a wall of 40 cm (Albaba 2015, section 3.4.2).
const INCOMING: [f64; 2] = [0.1, 0.3];
const APPROACHING: [f64; 2] = [1.0, 1.25];

/// How far downstream of the barrier's foot (a net bulges) and upstream of its most upstream point the depth of the
/// deposit is sought, over the barrier's height.
const DEPOSIT: [f64; 2] = [1.0, 0.5];

fn recorder_setup(design: &Design, net: Option<BuiltNet>) -> RecorderSetup {
    let height = barrier_height(design);
    let lean = reach(design, net.as_ref());
    let bulge = if net.is_some() { DEPOSIT[0] * height } else { 0.0 };
    let across = ground::across(&design.channel);
    let section = design.channel.section();
    let window = |[near, far]: [f64; 2]| GaugeWindow {
        near: lean + near * height,
        far: lean + far * height,
        across: across.clone(),
        bulk_density: design.flow.bulk_density,
        mean_diameter: design.flow.sizes.quantile(0.5),
    };
    RecorderSetup {
        interval: smoothing(design) / SAMPLES_PER_WINDOW,
        passage_interval: PASSAGE * time_scale(design),
        ropes: net.as_ref().map_or(0, |net| net.rope_rows.len()),
        rope_places: net.as_ref().map_or(Vec::new(), |net| {
            let first = |row: &usize| net.barrier.nodes[net.rows[*row][0] as usize].position.x;
            net.rope_rows.iter().map(first).collect()
        }),
        rope_rows: net.as_ref().map_or(Vec::new(), |net| net.rope_rows.clone()),
        screen_rows: net.as_ref().map_or(Vec::new(), |net| net.screen_rows.clone()),
        net_rows: net.map_or(Vec::new(), |net| net.rows),
        wall: match &design.barrier {
            BarrierDesign::RigidWall(wall) => {
                let width = if let Some(survey) = design.channel.ground() {
                    Section::Surveyed(survey).breadth()
                } else {
                    design.channel.width
                };
                Some(WallFace { height: wall.height, width, lean: wall.lean })
            }
            BarrierDesign::FlexibleNet(_) => None,
        },
        bolt_spaces: match &design.barrier {
            BarrierDesign::FlexibleNet(net) => net.bed_bolts.map_or(0, |bolts| bolts.spaces(section.bed_length())),
            BarrierDesign::RigidWall(_) => 0,
        },
        bolted: section.bed_ends(),
        incoming: window(INCOMING),
        approaching: window(APPROACHING),
        at_the_barrier: GaugeWindow { near: -bulge, far: lean + INCOMING[0] * height, ..window(INCOMING) },
        deposit: GaugeWindow { near: -bulge, far: lean + DEPOSIT[1] * height, ..window(INCOMING) },
        mass: design.flow.mass_of_all(),
        at_first: design.flow.mass,
        to_come: 0.0,
        boulders: [0, 0],
        mesh: match &design.barrier {
            BarrierDesign::FlexibleNet(net) => {
                let [across, along] = net.lattice().period();
                across.max(along)
            }
            BarrierDesign::RigidWall(_) => 0.0,
        },
        side_walls: design.channel.wall_height,
        near: height,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::FidelityWish;
    use crate::design::read::read_design;
    use crate::fidelity::choose;

    /// Settling is audited as the event is: the longest steps start too.
    #[test]
    fn a_block_settles_in_the_longest_steps() {
        let mut design = read_design("x", include_bytes!("../../designs/rigid_wall.yaml")).unwrap().design;
        design.simulation.fidelity = FidelityWish::Fast;
        design.flow.sizes = design.flow.sizes.scaled(1.5);
        assert!(build(&design, &choose(&design), 1).is_ok());
    }
}
