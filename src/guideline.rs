//! Guideline loads on the design's barrier: load cases, the governing one of each main rope, what the barrier holds.

pub(crate) mod face;
pub(crate) mod posts;
pub(crate) mod rope_load;
pub(crate) mod ropes;

pub use self::face::height_over_bed;
pub use self::face::lean;
pub use self::posts::PostLoad;
pub use self::rope_load::RopeLoad;
use self::ropes::Cases;
use crate::design::{AnchorOf, Arrival, BarrierDesign, Bottom, Channel, DamBreak, Design, LateralTo, RunUp, Stability};
use crate::larger::larger_or_nan;
use crate::loads::cases::load_case::{AdditionalActions, BaseActions, Hit, LoadCase};
use crate::loads::cases::{all, envelope, later_surge};
pub use crate::loads::fill::Surface;
use crate::loads::fill::{Reservoir, Retention};
use crate::loads::impact::hertz;
use crate::loads::input::GuidelineInput;
use crate::loads::ring_net::{RingLoad, RingNet};
use crate::loads::rope::Yielding;
use crate::loads::run_up;
use crate::loads::wall::{Ground, WallInput};
use crate::section::Section;
use crate::units::GRAVITY;

/// Guideline loads and what follows for the ropes.
#[derive(Clone, Debug, PartialEq)]
pub struct Guideline {
    pub input: GuidelineInput,
    /// Width of the channel, or the mean width of its section up to the barrier's top (m).
    pub width: f64,
    pub section: Section,
    pub cases: Vec<LoadCase>,
    /// Lean of the barrier's face upstream from the bed's normal θ (rad).
    pub lean: f64,
    /// Largest total force along the bed over the envelope, point loads included (N).
    pub largest_force: f64,
    /// Largest force normal to the face over the envelope (N), and its largest moment about the foot of the face, per width (N m/m).
    pub face_force: f64,
    pub face_moment: f64,
    /// Largest force along the bed, and moment about that foot, that any metre of a wall takes (N/m, N m/m).
    pub metre_force: f64,
    pub foot_moment: f64,
    /// The same of a wall that stands by its weight.
    pub on_the_base: BaseActions,
    /// Each main rope under its governing case, from the bottom; rope 1 has a load and no tension where the bed holds it.
    pub ropes: Vec<RopeLoad>,
    /// On what holds the lowest rope to the bed, in all, with the partial factor on loads (N); nothing where it is free.
    pub bed_force: Option<f64>,
    /// Of it on one bolt, spread evenly, where the distance of the bolts is known (N).
    pub bolt_force: Option<f64>,
    /// The bay of a ring net whose rings bear most, with the partial factor.
    pub rings: Option<RingLoad>,
    /// Each post of a net, from the left to the right looking downstream.
    pub posts: Vec<PostLoad>,
    /// What its anchors hold.
    pub anchors: Vec<AnchorOf>,
    /// The dissipators of the main ropes, and of the ropes that retain posts, if there are any.
    pub dissipator: Option<Yielding>,
    pub retaining: Option<Yielding>,
    /// Least force of each of them over its curve.
    pub least_shares: [f64; 2],
    /// Whether a dissipator caps the load of its anchor: not where lateral ropes are tied to the anchors, past it.
    pub anchors_capped: bool,
    /// Level that the event reaches in front of the barrier, run-up and deposit, normal to the bed (m), and whether it is known; where it is
    /// not, as far as it is.
    pub level: f64,
    pub level_is_known: bool,
    /// What the barrier holds; nothing on a level bed.
    pub retention: Option<Retention>,
}

impl Guideline {
    /// The same with dissipators that pull with the least force of their tests, as far as that caps what is simulated.
    pub fn with_weakest_dissipators(&self) -> Self {
        let least = |given: &Option<Yielding>, share: f64| {
            given.clone().map(|given| Yielding { largest: share * given.largest, ..given })
        };
        let [own, of_posts] = self.least_shares;
        Self { dissipator: least(&self.dissipator, own), retaining: least(&self.retaining, of_posts), ..self.clone() }
    }

    /// Force of the first surge on the empty barrier, without partial factors and wood (N): what a simulation of one surge is to be compared
    /// with.
    pub fn first_surge(&self) -> f64 {
        later_surge::case(&self.input.without_wood(), 0.0).total_force(&self.section)
    }
}

/// Depth of the wave at the gate over the height behind it, and speed of its front over √(g' h) (Ritter 1892).
const RITTER_DEPTH: f64 = 4.0 / 9.0;
const RITTER_FRONT: f64 = 2.0;

/// All that the equations say of a design: its load cases, the ropes under them, what the barrier holds.
///
/// ```
/// use barrier_check::design::read::read_design;
/// use barrier_check::guideline::guideline;
///
/// let text = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/designs/small_net.yaml"));
/// let file = read_design("small_net.yaml", text).unwrap();
/// let loads = guideline(&file.design);
/// // The first surge pushes with R = (½ K ρ g' h² + λ ρ v² h) b: K = 1, λ = 2.2, 0.6 m deep with 4.6 m/s, 3 m wide.
/// let unit = 1400.0 * 9.81 * 25_f64.to_radians().cos();
/// let by_hand = (0.5 * unit * 0.36 + 2.2 * 1400.0 * 4.6_f64.powi(2) * 0.6) * 3.0;
/// assert!((loads.first_surge() / by_hand - 1.0).abs() < 1e-9);
/// ```
pub fn guideline(design: &Design) -> Guideline {
    let event = EventFill::of(design);
    with_event(design, &event, input_with(design, &event))
}

/// The same for another flow or other coefficients than the design's.
pub fn guideline_for(design: &Design, input: GuidelineInput) -> Guideline {
    with_event(design, &EventFill::of(design), input)
}

fn with_event(design: &Design, event: &EventFill, input: GuidelineInput) -> Guideline {
    let extras_of = |flow: &GuidelineInput| extras(design, flow);
    let (width, section) = (design.channel.width, design.channel.section());
    let flows = flows_with(design, event, input);
    let stages: Vec<LoadCase> = flows.iter().flat_map(|flow| envelope(flow, &extras_of(flow))).collect();
    let level = flows.iter().map(|flow| level_reached(design, event, flow)).reduce(higher).unwrap_or(Ok(0.0));
    // A point load spreads along no more of a wall than there is at its height.
    let heights = stages.iter().filter_map(|case| Some(case.point?.height));
    let hit = heights.map(|height| section.width(height)).fold(width, f64::min);
    let ropes = match &design.barrier {
        BarrierDesign::RigidWall(_) => Vec::new(),
        BarrierDesign::FlexibleNet(net) => {
            ropes::loads(net, design, &Cases { flows: &flows, stages: &stages, extras: &extras_of })
        }
    };
    let bed_force = match &design.barrier {
        BarrierDesign::FlexibleNet(net) if net.bottom == Bottom::Fixed => {
            // The even load with the moment of a point load P at midspan is 2 P in all.
            ropes.first().map(|rope| rope.load * rope.span - rope.point)
        }
        _ => None,
    };
    Guideline {
        input,
        width,
        bed_force,
        bolt_force: bed_force.zip(bolt_spaces(design)).map(|(force, spaces)| {
            // A boulder hits one bolt, not all of them.
            let point = ropes.first().map_or(0.0, |rope| rope.point);
            (force - point) / spaces + point
        }),
        rings: ring_load(design, &stages),
        cases: all(&input, &extras_of(&input)),
        largest_force: stages.iter().map(|case| case.total_force(&section)).fold(0.0, larger_or_nan),
        lean: lean(design),
        face_force: stages.iter().map(|case| case.face_force(&section, lean(design))).fold(0.0, larger_or_nan),
        face_moment: stages.iter().map(|case| case.face_moment(hit, lean(design))).fold(0.0, larger_or_nan),
        metre_force: stages.iter().map(|case| case.metre_force(hit, input.barrier_height)).fold(0.0, larger_or_nan),
        foot_moment: stages.iter().map(|case| case.foot_moment(hit, lean(design))).fold(0.0, larger_or_nan),
        on_the_base: on_the_base(design, &stages, hit, input.barrier_height),
        posts: posts::loads(design, ropes.last(), &stages, height_over_bed(design)),
        ropes,
        anchors: match &design.barrier {
            BarrierDesign::FlexibleNet(net) => net.anchors(),
            BarrierDesign::RigidWall(_) => Vec::new(),
        },
        dissipator: ropes::dissipator(design),
        retaining: posts::retaining(design),
        least_shares: least_shares(design),
        anchors_capped: matches!(&design.barrier, BarrierDesign::FlexibleNet(net) if net.lateral_to == LateralTo::RopeEnds),
        level: level.unwrap_or_else(|least| least),
        level_is_known: level.is_ok(),
        retention: held(design),
        section,
    }
}

/// The most of each over these cases, for a point load that spreads over no more than this width of a wall of this height.
fn on_the_base(design: &Design, stages: &[LoadCase], width: f64, height: f64) -> BaseActions {
    let BarrierDesign::RigidWall(wall) = &design.barrier else { return BaseActions::default() };
    let block = wall.stability.and_then(|stability| stability.block_length);
    let each = stages.iter().map(|case| case.on_the_base(block, width, height, wall.lean));
    each.fold(BaseActions::default(), |most, case| BaseActions {
        slides: larger_or_nan(most.slides, case.slides),
        pushes: larger_or_nan(most.pushes, case.pushes),
        tips: larger_or_nan(most.tips, case.tips),
    })
}

/// Least force of the dissipators of main ropes, and of those of retaining ropes, over their curve.
fn least_shares(design: &Design) -> [f64; 2] {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return [1.0; 2] };
    let of_posts = net.posts.as_ref().and_then(|posts| posts.retaining.dissipators.as_ref());
    [net.dissipators.as_ref(), of_posts].map(|given| given.and_then(|given| given.lower_bound).unwrap_or(1.0))
}

/// The flow of each surge, or of each of the governing rows of a hydrograph: the first as given here, later ones with their own depth and velocity, scaled by the same
/// ratios to the design as the first; so is the height to which they fill the barrier.
pub fn flows(design: &Design, first: GuidelineInput) -> Vec<GuidelineInput> {
    flows_with(design, &EventFill::of(design), first)
}

fn flows_with(design: &Design, event: &EventFill, first: GuidelineInput) -> Vec<GuidelineInput> {
    let (depth, velocity) = incoming(design);
    let fills = first.fill_height / event.filled(design, first).fill_height;
    let surges = design.flow.later.iter().map(|later| [later.surge.depth, later.surge.velocity]);
    let rows = design.flow.hydrograph.iter().flat_map(|hydrograph| hydrograph.governing.iter().skip(1));
    let later = surges.chain(rows.map(|row| [row.moment.depth, row.moment.velocity])).map(|own| {
        let [depth, velocity] = [own[0] * first.depth / depth, own[1] * first.velocity / velocity];
        let flow = event.filled(design, GuidelineInput { depth, velocity, ..first });
        GuidelineInput { fill_height: (flow.fill_height * fills).min(flow.barrier_height), ..flow }
    });
    std::iter::once(first).chain(later).collect()
}

/// The higher of two levels, each known or at least so high.
fn higher(one: Result<f64, f64>, other: Result<f64, f64>) -> Result<f64, f64> {
    let least = |level: Result<f64, f64>| level.unwrap_or_else(|least| least);
    let highest = larger_or_nan(least(one), least(other));
    if one.is_ok() && other.is_ok() { Ok(highest) } else { Err(highest) }
}

pub fn input(design: &Design) -> GuidelineInput {
    input_with(design, &EventFill::of(design))
}

fn input_with(design: &Design, event: &EventFill) -> GuidelineInput {
    let (depth, velocity) = incoming(design);
    let slope = design.channel.slope;
    let barrier_height = height_over_bed(design);
    let empty = GuidelineInput {
        density: design.flow.bulk_density,
        gravity_normal: GRAVITY * libm::cos(slope),
        earth_pressure: design.factors.earth_pressure,
        dynamic_pressure: design.factors.dynamic_pressure,
        wood: design.loads.wood_factor.unwrap_or(1.0),
        depth,
        velocity,
        fill_height: barrier_height,
        barrier_height,
    };
    event.filled(design, empty)
}

/// The same flow with the height to which it fills the barrier: that of one event follows from its velocity and depth, because it heaps up no
/// higher than it runs up.
pub fn filled(design: &Design, flow: GuidelineInput) -> GuidelineInput {
    EventFill::of(design).filled(design, flow)
}

/// How high one event may fill behind the barrier, normal to the bed (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EventFill {
    /// With a level surface.
    pub level: f64,
    /// With a surface that falls upstream at the angle of repose.
    pub heap: f64,
    /// To which the flow runs up at the most.
    pub run_up: f64,
    /// Whether the event is more than the one flow.
    pub several: bool,
    /// With a level surface, of all but the last surge.
    pub before_last: f64,
}

impl EventFill {
    /// Of the event of a design, without what its flow runs up to.
    fn of(design: &Design) -> Self {
        let width = design.channel.width;
        let event = design.flow.event_volume / width;
        let repose = libm::atan(design.flow.grain_friction);
        let reservoir = reservoir(design);
        // The smaller the last surge is, the more lies there already.
        let later = design.flow.later.iter().map(|later| later.volume);
        let last = later.chain(design.flow.last_of_the_event()).fold(design.flow.volume(), f64::min);
        // Before the last of the governing moments of a hydrograph lies what has come until then, and more where the event is larger.
        let to_come = design.flow.hydrograph.as_ref().map_or(last, |hydrograph| {
            design.flow.volume() - hydrograph.governing.iter().map(|row| row.before).fold(0.0, larger_or_nan)
        });
        let before = (event - to_come / width).max(0.0);
        Self {
            level: reservoir.height(event, 0.0),
            heap: reservoir.height(event, repose),
            run_up: 0.0,
            several: design.flow.is_one_of_several() || design.flow.hydrograph.is_some(),
            before_last: reservoir.height(before, 0.0),
        }
    }

    /// The same with what a flow runs up to at the most.
    fn run_up_by(self, design: &Design, flow: &GuidelineInput) -> Self {
        Self { run_up: run_up::bound(flow, &design.channel.section()), ..self }
    }

    /// A flow with the height to which it fills the barrier.
    fn filled(&self, design: &Design, flow: GuidelineInput) -> GuidelineInput {
        if design.loads.to_the_top || design.loads.overflow_depth.is_some() {
            return flow;
        }
        let height = self.run_up_by(design, &flow).height();
        GuidelineInput { fill_height: flow.barrier_height.min(height.max(flow.depth)), ..flow }
    }

    /// To where the last of several surges may go up from what lies there, which says whether it goes over.
    pub fn reach(&self) -> f64 {
        larger_or_nan(self.level, self.before_last + self.run_up)
    }

    /// What the loads are worked out with: a heap, no higher than the flow runs up, and no lower than a level deposit. Where the event
    /// comes in several surges, the later ones run up from what lies there.
    pub fn height(&self) -> f64 {
        let from = if self.several { self.level } else { 0.0 };
        self.level.max(self.heap.min(from + self.run_up))
    }
}

/// Level that the event reaches in front of the barrier, normal to the bed (m): that of its deposit with a level surface, or what its last
/// surge runs up to from what the others left, whichever is higher.
///
/// # Errors
/// A lower bound of it, where its deposit reaches beyond what is known of the channel.
pub fn level_reached(design: &Design, event: &EventFill, input: &GuidelineInput) -> Result<f64, f64> {
    let section = design.channel.section();
    let run_up = match design.limits.run_up {
        RunUp::Larger => run_up::bound(input, &section),
        RunUp::MomentumJump => run_up::by_jump(input, &section),
        RunUp::Energy => run_up::by_energy(input),
    };
    let reached = EventFill { run_up, ..*event }.reach();
    if reached.is_infinite() { Err(larger_or_nan(run_up, reservoir(design).higher_than())) } else { Ok(reached) }
}

/// How high the event of a design fills, with what a flow of it runs up to.
pub fn event_fill(design: &Design, input: &GuidelineInput) -> EventFill {
    EventFill::of(design).run_up_by(design, input)
}

/// Spaces between the bolts of the lowest rope, where their distance is known.
fn bolt_spaces(design: &Design) -> Option<f64> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return None };
    Some(net.bed_bolts?.spaces(design.channel.section().bed_length()) as f64)
}

/// What hits the barrier at one place: as the design gives it, and on a wall the largest of the boulders that a flow brings, at its surface.
pub fn point_load(design: &Design, flow: &GuidelineInput) -> Option<Hit> {
    let over_deposit = larger_or_nan(flow.depth, 0.5 * design.flow.largest()[0]);
    let boulders = matches!(design.barrier, BarrierDesign::RigidWall(_)) && !design.flow.boulders.is_empty();
    let of_boulder = if boulders {
        design.loads.impact_reduction.unwrap_or(USUAL_IMPACT_REDUCTION) * elastic_hit(design, flow.velocity)
    } else {
        0.0
    };
    let given = design.loads.point_load;
    let (force, height) = given.unwrap_or((0.0, None));
    (boulders || given.is_some()).then_some(Hit { force, height, over_deposit, of_boulder })
}

/// Share of the elastic force of a boulder where the design gives none: a tenth in the practice of Hong Kong (from memory, so that no check
/// passes by it).
const USUAL_IMPACT_REDUCTION: f64 = 0.1;

/// Elastic force (Hertz) with which the largest grain or boulder of the flow hits a wall (N); NaN where the grains are not given.
pub fn elastic_hit(design: &Design, velocity: f64) -> f64 {
    let [diameter, mass] = design.flow.largest();
    hertz(0.5 * diameter, mass, velocity)
}

fn extras(design: &Design, flow: &GuidelineInput) -> AdditionalActions {
    let loads = &design.loads;
    AdditionalActions {
        overflow_depth: loads.overflow_depth,
        overflow_drag: loads.overflow_drag.map(|(friction, length)| [friction, length]),
        drained: loads.drained.map(|(earth_pressure, density)| [earth_pressure, density]),
        point: point_load(design, flow),
        snow: loads.snow_pressure,
    }
}

/// The channel upstream of the barrier.
pub fn reservoir(design: &Design) -> Reservoir {
    let channel = &design.channel;
    Reservoir {
        section: channel.section(),
        width: channel.width,
        slope: channel.slope,
        lean: lean(design),
        profile: channel.profile.clone(),
        relief: channel.relief.clone(),
    }
}

/// The height that the filled barrier keeps, and the volume behind it, with the design's slope of the deposit.
pub fn held(design: &Design) -> Option<Retention> {
    held_below(design, Surface::OfTheBed(design.loads.deposit_slope))
}

/// The same below another surface; nothing where that does not meet the bed.
pub fn held_below(design: &Design, surface: Surface) -> Option<Retention> {
    reservoir(design).retention(filled_height(design), surface, design.flow.volume())
}

/// Height at the barrier of the deposit that it keeps when it is full, normal to the bed (m).
fn filled_height(design: &Design) -> f64 {
    // A wall does not sag.
    let share = match &design.barrier {
        BarrierDesign::RigidWall(_) => 1.0,
        BarrierDesign::FlexibleNet(_) => design.loads.filled_height,
    };
    share * height_over_bed(design)
}

/// K of a deposit that fills the barrier and is held by it and by the friction of the bed alone: with its weight W, along the bed
/// W (sin α − tan φ cos α) = K ρ g cos α S(H), S = ½ b H² in a rectangle. Nothing on a bed that the deposit does not rest on by a slope of its own.
pub fn earth_pressure_by_weight(design: &Design, guideline: &Guideline) -> Option<f64> {
    // As it comes: what has drained presses less.
    let (slope, friction) = (design.channel.slope, design.flow.effective(design.channel.base_friction));
    let reservoir = reservoir(design);
    if reservoir.profile.is_some() {
        let height = filled_height(design);
        let pull = reservoir.pull(height, Surface::OfTheBed(design.loads.deposit_slope), friction);
        return Some(pull / guideline.section.moment(height));
    }
    let held = guideline.retention?;
    let pulls = (libm::tan(slope) - friction).max(0.0);
    Some(match &guideline.section {
        Section::Rectangle { width } => 2.0 * (held.volume / width * pulls) / held.deposit.height.powi(2),
        section @ Section::Surveyed(_) => held.volume * pulls / section.moment(held.deposit.height),
    })
}

/// Vertical depth of the ground over the downstream edge of a base (m). Where the ground falls more steeply than at the barrier within that depth
/// of the edge, it counts as if it did so with the slope of the bed from there on.
fn in_front(channel: &Channel, stability: &Stability, base_slope: f64) -> f64 {
    let (sine, cosine) = libm::sincos(base_slope);
    let [x, z] = [stability.base_width * cosine, -stability.founding_depth - stability.base_width * sine];
    let falls = libm::tan(channel.slope);
    let depth = (channel.elevation(x) - z).max(0.0);
    let counted = channel.breaks([x, x + depth]).into_iter().map(|at| channel.elevation(at) + (at - x) * falls - z);
    counted.fold(depth, f64::min).max(0.0)
}

/// What water and ground press with on the buried part of a wall's face, per width (N/m), and its moment about the base (N m/m), with the partial
/// factor on loads or without. Nothing on a wall that does not go on below the bed.
pub fn buried_thrust(design: &Design, factored: bool) -> [f64; 2] {
    let Some(mut wall) = wall_of(design) else { return [0.0; 2] };
    if !factored {
        wall.ground.factor = 1.0;
    }
    let (water, ground) = (wall.water_thrust(), wall.earth_thrust());
    [0, 1].map(|index| water[index] + ground[index])
}

/// The wall of the design, if it stands by its weight.
pub fn wall_of(design: &Design) -> Option<WallInput> {
    let BarrierDesign::RigidWall(wall) = &design.barrier else { return None };
    let stability = wall.stability?;
    let (base_slope, bed_slope) = (stability.base_slope.unwrap_or(0.0), design.channel.slope);
    let cosine = libm::cos(base_slope);
    // Of whichever surge lies deepest there, with what flows over the full barrier.
    let lies = |flow: GuidelineInput| {
        let height = match (flow.fills(), design.loads.overflow_depth) {
            (true, given) => flow.barrier_height + given.unwrap_or(0.0).max(flow.depth),
            (false, Some(given)) => flow.barrier_height + given,
            (false, None) => flow.fill_height,
        };
        flow.density * GRAVITY * height / libm::cos(bed_slope)
    };
    let surcharge = flows(design, input(design)).into_iter().map(lies).fold(0.0, larger_or_nan);
    let ground = Ground {
        density: stability.ground_density,
        surcharge,
        in_front: in_front(&design.channel, &stability, base_slope) * cosine,
        factor: design.factors.load,
    };
    Some(WallInput {
        height: wall.height * libm::cos(wall.lean - bed_slope + base_slope) + stability.founding_depth * cosine,
        thickness: stability.thickness,
        base_width: stability.base_width,
        density: stability.density,
        base_friction: stability.base_friction,
        base_slope,
        bed_slope,
        face_lean: wall.lean,
        water_head: stability.water_head.unwrap_or(0.0),
        buried: stability.founding_depth * cosine,
        ground,
    })
}

/// Depth and velocity with which the flow reaches the barrier. A surge has them; for a dam break the designer
/// may give them, else the depth is Ritter's at the gate and the velocity the larger of two: that of a block that slides on the bed
/// with its friction, and that of the front of a collapse.
fn incoming(design: &Design) -> (f64, f64) {
    match design.flow.arrival {
        Arrival::Surge(surge) => (surge.depth, surge.velocity),
        Arrival::DamBreak(block) => (
            block.depth_at_barrier.unwrap_or_else(|| depth_as_released(design)),
            block.velocity_at_barrier.unwrap_or_else(|| front_velocity(design, &block)),
        ),
    }
}

/// Depth of the flow where it is let go (m): of a dam break at the gate, of a surge as given.
pub fn depth_as_released(design: &Design) -> f64 {
    match design.flow.arrival {
        Arrival::DamBreak(block) => RITTER_DEPTH * block.height,
        Arrival::Surge(surge) => surge.depth,
    }
}

/// Velocity that the slope of the bed less its friction gives the flow on its way to the barrier (m/s): of a dam break that of the block or of
/// its front, of a surge from its release on.
pub fn velocity_on_its_way(design: &Design) -> f64 {
    match design.flow.arrival {
        Arrival::DamBreak(block) => front_velocity(design, &block),
        Arrival::Surge(surge) => {
            let gain = gain_of(design, surge.run_in);
            (surge.velocity.powi(2) + gain).sqrt()
        }
    }
}

/// With a = g (sin α − tan φ cos α): the block's centre, at √(2 a s) after its way s to the barrier; and the front of a wave without
/// friction inside, which starts at 2 √(g cos α h) (Ritter 1892) and speeds up on its way d from the gate, √(4 g cos α h + 2 a d)
/// (Mangeney, Heinrich & Roche 2000). No granular front is faster, so this is an upper bound.
fn front_velocity(design: &Design, block: &DamBreak) -> f64 {
    let slope = design.channel.slope;
    let sliding = gain_of(design, block.distance + 0.5 * block.length);
    // Of the flattest bed on its way: there a wave is fastest.
    let slope =
        design.channel.profile.as_ref().map_or(slope, |profile| profile.flattest(block.distance + block.length));
    let start = RITTER_FRONT.powi(2) * GRAVITY * libm::cos(slope) * block.height;
    sliding.max(start + gain_of(design, block.distance)).sqrt()
}

/// 2 a s of a body that comes to the barrier from a distance s along the bed, where the slope gives more than friction takes; over reaches of
/// several slopes 2 g (ΔZ − tan φ ΔX) (m²/s²).
fn gain_of(design: &Design, distance: f64) -> f64 {
    let (slope, friction) = (design.channel.slope, design.flow.effective(design.channel.base_friction));
    match &design.channel.profile {
        None => 2.0 * (GRAVITY * (libm::sin(slope) - friction * libm::cos(slope))).max(0.0) * distance,
        // From wherever on its way it gains most: what comes to rest before that moves again from there.
        Some(profile) => 2.0 * GRAVITY * profile.largest_gain(distance, friction),
    }
}

/// The bay between two main ropes in which the rings of a ring net bear most; nothing for other barriers.
fn ring_load(design: &Design, stages: &[LoadCase]) -> Option<RingLoad> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return None };
    let rings = net.rings.as_ref()?;
    let of = RingNet { lattice: rings.lattice(), taut_from: rings.law().taut_from };
    let (top, leans) = (height_over_bed(design), libm::cos(lean(design)));
    let bays = net.main_ropes.levels.windows(2).map(|pair| [pair[0].height, pair[1].height]);
    let load = |[low, high]: [f64; 2]| {
        let [from, to] = [low, high].map(|along| top - (net.height - along) * leans);
        let most = stages.iter().map(|case| case.diagram.force(from, to) / leans).fold(0.0, larger_or_nan);
        of.under(high - low, design.factors.load * most)
    };
    bays.map(load).max_by(|a, b| a.leg.total_cmp(&b.leg))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::read::read_design;
    use crate::loads::rope::RopeInput;
    use approx::assert_relative_eq;

    /// On the level nothing speeds up, so the front keeps Ritter's 2 √(g h) whatever the way; on a slope without friction it gains
    /// 2 g sin α d; on friction steeper than the slope it gains nothing.
    #[test]
    fn a_collapse_is_never_slower_than_its_front_at_the_gate() {
        let bytes = include_bytes!("../designs/flume_l44_h15_a40.yaml");
        let mut design = read_design("x", bytes).unwrap().design;
        let block = |distance| DamBreak {
            length: 0.5,
            height: 2.0,
            distance,
            depth_at_barrier: None,
            velocity_at_barrier: None,
        };
        design.channel.slope = 0.0;
        assert_relative_eq!(front_velocity(&design, &block(1.0)), 8.858_893, max_relative = 1e-3);
        assert_relative_eq!(front_velocity(&design, &block(9.0)), 8.858_893, max_relative = 1e-3);
        design.channel.slope = std::f64::consts::FRAC_PI_6;
        design.channel.base_friction = 0.0;
        let expected = (4.0 * 9.81 * 0.866_025 * 2.0 + 2.0 * 9.81 * 0.5 * 9.0_f64).sqrt();
        assert_relative_eq!(front_velocity(&design, &block(9.0)), expected, max_relative = 1e-3);
        design.channel.base_friction = 1.0;
        assert_relative_eq!(front_velocity(&design, &block(9.0)), 8.244_1, max_relative = 1e-3);
        // a = 9.81 (½ − 0.3 · 0.8660): √(67.97 + 2 · 2.3563 · 9).
        design.channel.base_friction = 0.3;
        assert_relative_eq!(front_velocity(&design, &block(9.0)), 10.506, max_relative = 1e-3);
    }

    /// The ground behind a founded wall carries what lies deepest on it, in whatever order the surges come, and what flows over the full wall.
    #[test]
    fn the_ground_behind_a_wall_carries_the_deepest_surge_and_what_flows_over() {
        let design = read_design("x", include_bytes!("../designs/gravity_wall.yaml")).unwrap().design;
        let surcharge = |change: &dyn Fn(&mut Design)| {
            let mut design = design.clone();
            change(&mut design);
            wall_of(&design).expect("a wall").ground.surcharge
        };
        let full = |depth: f64| {
            surcharge(&|design| {
                design.loads.to_the_top = true;
                design.loads.overflow_depth = Some(depth);
            })
        };
        let deepest = {
            let mut design = design.clone();
            design.loads.to_the_top = true;
            flows(&design, input(&design)).into_iter().map(|flow| flow.depth).fold(0.0, f64::max)
        };
        let unit = design.flow.bulk_density * GRAVITY / libm::cos(design.channel.slope);
        assert_relative_eq!(full(1e-3), unit * (height_over_bed(&design) + deepest), max_relative = 1e-9);
        assert_relative_eq!(full(3.0), unit * (height_over_bed(&design) + 3.0), max_relative = 1e-9);
    }

    /// On a bed of 45° with a friction of 20° a deposit of V presses with K = 2 V (tan 45° − tan 20°)/(b H²).
    #[test]
    fn the_weight_of_a_deposit_tells_k_where_it_is_not_seen() {
        let bytes = include_bytes!("../designs/small_net.yaml");
        let mut design = crate::design::read::read_design("x", bytes).unwrap().design;
        design.channel.slope = 45_f64.to_radians();
        design.channel.base_friction = libm::tan(20_f64.to_radians());
        let guideline = guideline(&design);
        let held = guideline.retention.expect("a deposit").volume / guideline.width;
        // Of the height that the filled net keeps.
        let by_hand = 2.0 * held * (1.0 - 0.363_970) / (0.75 * guideline.input.barrier_height).powi(2);
        let found = earth_pressure_by_weight(&design, &guideline).expect("K");
        assert!((found / by_hand - 1.0).abs() < 1e-5, "{found} {by_hand}");
        design.channel.base_friction = 2.0;
        assert_eq!(earth_pressure_by_weight(&design, &guideline), Some(0.0));
    }

    /// The first surge alone, on 3 m: (½ K ρ g' h² + λ ρ v² h) b. Its bolts are no load of a free rope, and a boulder is on one bolt alone.
    #[test]
    fn the_lowest_rope_hands_its_load_to_the_bed_where_the_bed_holds_it() {
        let mut design = read_design("x", include_bytes!("../designs/small_net.yaml")).unwrap().design;
        let held = guideline(&design);
        let input = held.input;
        let first = 0.5 * input.unit_pressure() * 0.36 + input.impact_pressure() * 0.6;
        assert_relative_eq!(held.first_surge(), 3.0 * first, max_relative = 1e-9);
        let spaces = bolt_spaces(&design).expect("bolts");
        assert_relative_eq!(held.bolt_force.unwrap(), held.bed_force.unwrap() / spaces, max_relative = 1e-12);
        assert_relative_eq!(held.bed_force.unwrap(), 3.0 * held.ropes[0].load, max_relative = 1e-12);
        // 9 kN at 0.2 m, between the ropes at 0 and 0.816 m above the bed: 75.5 % of it on the lowest, pressed normal to the leaning net.
        design.loads.point_load = Some((9e3, Some(0.2)));
        let hit = guideline(&design);
        let second = held.ropes[1].strip[0] * 2.0;
        let point = 9e3 * (1.0 - 0.2 / second) / libm::cos(design.channel.slope) * design.factors.load;
        assert_relative_eq!(hit.ropes[0].point, point, max_relative = 1e-9);
        assert_relative_eq!(hit.bed_force.unwrap() - held.bed_force.unwrap(), point, max_relative = 1e-6);
        assert_relative_eq!(hit.bolt_force.unwrap() - held.bolt_force.unwrap(), point, max_relative = 1e-6);
        let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        net.bottom = Bottom::Opening(0.1);
        let free = guideline(&design);
        assert_eq!((free.bed_force, free.bolt_force), (None, None));
        assert!(held.ropes[0].state.tension == 0.0 && free.ropes[0].state.tension > 1e3);
    }

    #[test]
    fn one_event_fills_as_high_as_it_can_and_no_higher_than_the_barrier() {
        let mut design = read_design("x", include_bytes!("../designs/small_net.yaml")).unwrap().design;
        design.loads.to_the_top = false;
        let one = input(&design);
        let fill = event_fill(&design, &one);
        assert!(!fill.several);
        assert_eq!(one.fill_height, one.barrier_height.min(fill.height().max(one.depth)));
        design.flow.event_volume = 1.0005 * design.flow.volume();
        assert!(!event_fill(&design, &one).several);
        design.flow.event_volume = 1.002 * design.flow.volume();
        assert!(event_fill(&design, &one).several);
        // A small event in a wide gully stays below the top.
        design.flow.event_volume = 0.01;
        let little = input(&design);
        assert!(little.fill_height < little.barrier_height);
        assert_eq!(little.fill_height, event_fill(&design, &little).height().max(little.depth));
    }

    /// A long, low block slides further than its front runs: 2 · 9.81 sin 40° · (5 + 10); its depth is 4/9 of its height unless given.
    #[test]
    fn a_long_block_arrives_as_it_slides() {
        let mut design = read_design("x", include_bytes!("../designs/rigid_wall.yaml")).unwrap().design;
        (design.channel.slope, design.channel.base_friction) = (40_f64.to_radians(), 0.0);
        let block =
            DamBreak { length: 20.0, height: 0.1, distance: 5.0, depth_at_barrier: None, velocity_at_barrier: None };
        assert_relative_eq!(front_velocity(&design, &block), 13.753_996, max_relative = 1e-4);
        design.flow.arrival = Arrival::DamBreak(block);
        let (depth, velocity) = incoming(&design);
        assert_relative_eq!(depth, 0.4 / 9.0, max_relative = 1e-12);
        assert_relative_eq!(velocity, 13.753_996, max_relative = 1e-4);
    }

    /// Two ropes at a level bear half of its load each, and are one rope under half of it; levels of single ropes are heights.
    #[test]
    fn ropes_side_by_side_share_their_load() {
        let text = include_str!("../tests/fixtures/even_net.yaml");
        let with = |top: &str| {
            let levels = format!("levels: [{{height: 0 m}}, {{height: 0.9 m}}, {{height: 1.8 m{top}}}]");
            let text = text.replace("count: 3 ", &format!("{levels} "));
            read_design("x", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")).design
        };
        let [counted, single, double] =
            [read_design("x", text.as_bytes()).unwrap().design, with(""), with(", ropes: 2")];
        assert_eq!(counted.barrier, single.barrier);
        let [one, two] = [guideline(&single), guideline(&double)].map(|guideline| guideline.ropes[2].clone());
        assert_relative_eq!(one.load, two.load, max_relative = 1e-12);
        let BarrierDesign::FlexibleNet(net) = &single.barrier else { panic!("a net") };
        let rope = RopeInput {
            span: two.span,
            other_spans: Vec::new(),
            to_anchors: 0.0,
            axial_stiffness: net.main_ropes.levels[2].rope.axial_stiffness(),
            dissipator: ropes::dissipator(&single),
        };
        assert_eq!(two.state, rope.under(0.5 * two.load));
        assert!(two.state.sag < one.state.sag && two.state.stroke < one.state.stroke);
        assert_relative_eq!(two.anchor[1], 0.5 * one.anchor[1], max_relative = 1e-12);
    }
}
