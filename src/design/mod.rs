//! What is asked: a barrier, a flow, limits. SI units, checked. Imports nothing above it.

pub mod attached;
pub(crate) mod channel_entries;
pub(crate) mod channel_rules;
pub(crate) mod document;
pub mod entries;
pub(crate) mod factor_sets;
pub(crate) mod flow_entries;
pub(crate) mod grain_lengths;
pub(crate) mod grain_multiple;
pub(crate) mod key;
pub(crate) mod net_rules;
pub mod read;
pub(crate) mod resolve;
pub(crate) mod rope_rules;
pub(crate) mod rules;
pub(crate) mod schema;
pub(crate) mod section_file;
pub(crate) mod show;
pub(crate) mod size_rules;
pub(crate) mod sizes;
pub(crate) mod surge_entries;
pub(crate) mod surge_rules;
pub(crate) mod terrain_file;
pub(crate) mod wall_rules;
pub(crate) mod yaml_faults;

use self::sizes::SizeCurve;
use std::sync::Arc;

use crate::profile::Profile;
use crate::relief::Relief;
use crate::section::{Section, Survey};

/// A checked design. Lengths in m, masses in kg, forces in N, angles in rad, friction as tan φ.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    pub project: Project,
    pub channel: Channel,
    pub flow: Flow,
    pub barrier: BarrierDesign,
    pub limits: Limits,
    pub factors: Factors,
    pub loads: OtherLoads,
    pub simulation: SimulationWishes,
}

/// Who and what the report is about.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Project {
    pub name: String,
    pub barrier: String,
    pub revision: String,
    pub author: String,
    pub checker: String,
    pub date: String,
    pub notes: String,
}

/// A straight channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Between vertical side walls, or the mean width of a surveyed section up to the barrier's top (m).
    pub width: f64,
    /// The section where it is no rectangle.
    pub survey: Option<Survey>,
    /// The bed where it has several reaches; its slope at the barrier is `slope`.
    pub profile: Option<Profile>,
    /// The ground itself, where a raster tells it; section and profile are then those at the barrier and along the lowest line.
    pub relief: Option<Arc<Relief>>,
    /// The same in cells of the raster, as it is simulated.
    pub mesh: Option<Arc<Relief>>,
    /// Slope of the bed against the horizontal (rad).
    pub slope: f64,
    /// Of the side walls, or of the lower end of a surveyed section, normal to the bed (m).
    pub wall_height: f64,
    /// Friction of grains on the bed and on the side walls, tan φ.
    pub base_friction: f64,
    pub side_friction: f64,
    /// Friction of grains on the barrier, wall or rope, tan φ.
    pub barrier_friction: f64,
}

impl Channel {
    /// What lies across the channel, normal to its bed.
    pub fn section(&self) -> Section {
        self.survey.clone().map_or(Section::Rectangle { width: self.width }, Section::Surveyed)
    }

    /// The section where the ground is no three planes: surveyed, or between side walls on a bed of several reaches.
    pub fn ground(&self) -> Option<Survey> {
        let walls = || Survey::between_walls(self.width, self.wall_height);
        self.survey.clone().or_else(|| self.profile.is_some().then(walls))
    }

    /// What is beside its bed, in words.
    pub fn sides(&self) -> &'static str {
        if self.survey.is_some() { "bank" } else { "side wall" }
    }

    /// (y, z) of the ground across the channel, side walls included (m).
    pub fn ground_line(&self) -> Vec<[f64; 2]> {
        let (width, high) = (self.width, self.wall_height);
        let walls = || vec![[0.0, high], [0.0, 0.0], [width, 0.0], [width, high]];
        self.survey.as_ref().map_or_else(walls, |survey| survey.points().to_vec())
    }
}

/// The design flow.
#[derive(Clone, Debug, PartialEq)]
pub struct Flow {
    pub mass: f64,
    /// With pores, of the whole event; the flow is one surge of it, or all (m³).
    pub event_volume: f64,
    /// kg/m³, grains with pores.
    pub bulk_density: f64,
    /// kg/m³, grains alone.
    pub solid_density: f64,
    /// As simulated.
    pub sizes: SizeCurve,
    /// Share of the mass below which nothing is given of the curve: it is continued from there.
    pub known_from: f64,
    /// What of the design's curve was made coarser, if anything was.
    pub cut: Option<CurveCut>,
    /// Length over width of a grain, 1 (sphere) to 2.
    pub aspect: f64,
    pub grain_friction: f64,
    pub restitution: f64,
    /// Contact modulus of the grains (Pa).
    pub modulus: f64,
    /// What is in its pores; nothing in a dry flow.
    pub pore_fluid: Option<PoreFluid>,
    /// How it comes; where it comes in several surges, the first of them, whose mass is `mass`.
    pub arrival: Arrival,
    /// The surges that come after the first, in their order.
    pub later: Vec<LaterSurge>,
}

/// Water, or mud with the finest of the flow, in the pores: it moves with the grains and carries a part of the pressure between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoreFluid {
    /// kg/m³
    pub density: f64,
    /// r_u, pore pressure over the total pressure, as the flow arrives.
    pub pressure_ratio: f64,
    /// Time in which the pressure of the fluid falls to 37 % where the flow rests (s).
    pub drains_in: f64,
}

/// A surge that comes onto what those before it have left.
#[derive(Clone, Debug, PartialEq)]
pub struct LaterSurge {
    /// With pores (m³).
    pub volume: f64,
    pub surge: Surge,
    /// Its grains, where they are others than the flow's.
    pub sizes: Option<SizeCurve>,
    /// Time from the release of the surge before it to its own (s); nothing where it waits until that has come to rest.
    pub after: Option<f64>,
}

/// The fine end of a grain-size curve that is not simulated as it is.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveCut {
    /// Share of the mass below the cut.
    pub share: f64,
    /// The whole curve.
    pub whole: SizeCurve,
}

impl Flow {
    /// Whether its event is more than the first surge: more than rounding lies between their volumes.
    pub fn is_one_of_several(&self) -> bool {
        self.event_volume > 1.001 * self.volume()
    }

    /// Whether its event is more than all surges that are given.
    pub fn is_part_of_its_event(&self) -> bool {
        self.event_volume > 1.001 * self.volume_of_all()
    }

    /// Volume of the flow with its pores, of the first surge where there are several (m³).
    pub fn volume(&self) -> f64 {
        self.mass / self.bulk_density
    }

    /// Volume of all surges with their pores (m³).
    pub fn volume_of_all(&self) -> f64 {
        self.volume() + self.later.iter().map(|later| later.volume).sum::<f64>()
    }

    /// Mass of all surges (kg).
    pub fn mass_of_all(&self) -> f64 {
        self.mass + self.later.iter().map(|later| later.volume * self.bulk_density).sum::<f64>()
    }

    /// How many surges there are.
    pub fn surges(&self) -> usize {
        1 + self.later.len()
    }

    /// Share of the volume that is grains: of a dry flow ρ/ρ_s, with a fluid in all pores (ρ − ρ_f)/(ρ_s − ρ_f).
    pub fn solid_share(&self) -> f64 {
        match self.pore_fluid {
            None => self.bulk_density / self.solid_density,
            Some(fluid) => (self.bulk_density - fluid.density) / (self.solid_density - fluid.density),
        }
    }

    /// Density of the grains as they are simulated, with the fluid that moves with them (kg/m³).
    pub fn grain_density(&self) -> f64 {
        if self.pore_fluid.is_some() { self.bulk_density / self.solid_share() } else { self.solid_density }
    }

    /// Friction (tan φ) as it acts on the flow as it comes, (1 − r_u) tan φ.
    pub fn effective(&self, friction: f64) -> f64 {
        self.pore_fluid.map_or(friction, |fluid| (1.0 - fluid.pressure_ratio) * friction)
    }

    /// Makes all grains so many times as large.
    pub fn coarsen(&mut self, factor: f64) {
        self.sizes = self.sizes.scaled(factor);
        for sizes in self.later.iter_mut().filter_map(|later| later.sizes.as_mut()) {
            *sizes = sizes.scaled(factor);
        }
    }

    /// Makes all surges so many times as long.
    pub fn lengthen(&mut self, factor: f64) {
        self.mass *= factor;
        match &mut self.arrival {
            Arrival::DamBreak(block) => block.length *= factor,
            Arrival::Surge(surge) => surge.length *= factor,
        }
        for later in &mut self.later {
            later.volume *= factor;
            later.surge.length *= factor;
        }
    }

    /// One surge alone, counted from 0.
    pub fn alone(&self, number: usize) -> Self {
        let alone = Self { later: Vec::new(), ..self.clone() };
        match number.checked_sub(1).and_then(|number| self.later.get(number)) {
            None => alone,
            Some(later) => Self {
                mass: later.volume * self.bulk_density,
                sizes: later.sizes.clone().unwrap_or_else(|| self.sizes.clone()),
                arrival: Arrival::Surge(later.surge),
                ..alone
            },
        }
    }
}

/// How the flow comes to the barrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Arrival {
    DamBreak(DamBreak),
    Surge(Surge),
}

/// A body of grains upstream of the barrier, already moving down the channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surge {
    /// Of the even flow with its volume (m); with a sloping front it is longer at the bed and shorter at the surface.
    pub length: f64,
    pub depth: f64,
    pub velocity: f64,
    /// Angle between the front face and the bed (rad).
    pub front_angle: f64,
    /// From the foot of the front to the most upstream point of the barrier at the release (m).
    pub run_in: f64,
}

/// A block at rest behind a gate that opens at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DamBreak {
    pub length: f64,
    pub height: f64,
    /// From the gate to the barrier's foot.
    pub distance: f64,
    /// Depth and velocity on arrival, for the guideline loads, where the designer knows them.
    pub depth_at_barrier: Option<f64>,
    pub velocity_at_barrier: Option<f64>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum BarrierDesign {
    RigidWall(RigidWall),
    FlexibleNet(Box<FlexibleNet>),
}

/// A wall across the channel.
#[derive(Clone, Debug, PartialEq)]
pub struct RigidWall {
    /// Along its face (m).
    pub height: f64,
    /// By which its face leans upstream from the bed's normal (rad).
    pub lean: f64,
    /// Tops of the segments whose force is reported, from the bottom up.
    pub segment_tops: Vec<f64>,
    /// Resistance of the whole wall to the total force (N), if known, and the partial factor on it.
    pub resistance: Option<f64>,
    pub resistance_factor: f64,
    /// Resistance to bending at its foot, per width (N m/m), over the same factor.
    pub moment_resistance: Option<f64>,
    pub stability: Option<Stability>,
}

/// A wall that stands by its weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stability {
    /// m
    pub thickness: f64,
    /// kg/m³
    pub density: f64,
    /// Of the base, which reaches downstream of the wall (m).
    pub base_width: f64,
    /// Of the base against the horizontal (rad), where it is told.
    pub base_slope: Option<f64>,
    /// Of the base below the bed at the face (m).
    pub founding_depth: f64,
    /// tan φ between base and ground.
    pub base_friction: f64,
    /// Partial factors on the resistance to sliding and on the moment that holds the wall.
    pub sliding_factor: f64,
    pub overturning_factor: f64,
    /// Of the ground under the base (Pa), if known, and the partial factor on it.
    pub bearing_resistance: Option<f64>,
    pub bearing_factor: f64,
    /// Head of the water under the upstream edge of the base (m), where it is told.
    pub water_head: Option<f64>,
}

/// A net of wire ropes on horizontal main ropes.
#[derive(Clone, Debug, PartialEq)]
pub struct FlexibleNet {
    /// Length of the barrier along its own plane (m).
    pub height: f64,
    /// Angle against plumb (rad), positive towards the flow.
    pub tilt: f64,
    /// Side of the square mesh, which stands on its corner (m).
    pub mesh_opening: f64,
    pub net_rope: Rope,
    /// How much longer the net's ropes are than the straight sides of the mesh, as a share.
    pub net_slack: f64,
    /// Straight pieces of which a side of the mesh is made in the simulation, if the design says so.
    pub net_pieces: Option<u32>,
    pub main_ropes: MainRopes,
    pub lateral_rope: Rope,
    pub lateral_to: LateralTo,
    pub dissipators: Option<DissipatorDesign>,
    /// Characteristic resistance of each anchor (N).
    pub anchor_resistance: f64,
    /// What holds the lowest rope to the bed, where the bed does, if known.
    pub bed_bolts: Option<BedBolts>,
    pub bottom: Bottom,
    pub side_extension: Option<SideExtension>,
}

/// Bolts at even distances along the lowest rope, the first and the last at its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BedBolts {
    /// How far apart they are at most (m).
    pub spacing: f64,
    /// Characteristic resistance of one (N), if known.
    pub resistance: Option<f64>,
}

impl BedBolts {
    /// Spaces between the bolts of a rope of this length.
    pub fn spaces(&self, length: f64) -> usize {
        // A length of so many spacings but for rounding has as many spaces.
        (length / self.spacing - 1e-9).ceil().max(1.0) as usize
    }
}

/// Strips of net along the side walls, downstream of the barrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SideExtension {
    /// m
    pub length: f64,
    /// Force that holds each of its knots (N).
    pub holding_force: f64,
    /// Whether the design gives that force; else it is a default that nobody vouches for.
    pub holding_force_given: bool,
}

/// Widest gap between the net and a side wall (m), that of the published barriers (Albaba 2015), and what it is of the mesh at the most.
const WIDEST_GAP: f64 = 0.07;
const GAP_OF_MESH: f64 = 0.5;

impl FlexibleNet {
    /// Gap between the net and each side wall, in which the main ropes go on to their anchors (m): no wider than half a mesh, so that
    /// what the net holds does not pass beside it.
    pub fn side_gap(&self) -> f64 {
        WIDEST_GAP.min(GAP_OF_MESH * self.mesh_opening)
    }

    /// Number of main ropes, from the bottom, that the bed holds along their length.
    pub fn ropes_held_by_bed(&self) -> usize {
        usize::from(self.bottom == Bottom::Fixed)
    }
}

/// A wire rope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rope {
    pub diameter: f64,
    /// Modulus that, with the full circle of the diameter, gives the rope's EA (Pa).
    pub modulus: f64,
    /// N
    pub breaking_load: f64,
    /// Tension beyond which the simulated rope draws out and stays longer (N), if it does.
    pub elastic_limit: Option<f64>,
    /// Whether the simulated rope breaks at its breaking load.
    pub breaks: bool,
}

impl Rope {
    /// EA with the full circle of the diameter (N).
    pub fn axial_stiffness(&self) -> f64 {
        self.modulus * std::f64::consts::FRAC_PI_4 * self.diameter.powi(2)
    }
}

/// The horizontal ropes that carry the net.
#[derive(Clone, Debug, PartialEq)]
pub struct MainRopes {
    /// Heights along the barrier, from the bottom (m).
    pub heights: Vec<f64>,
    pub rope: Rope,
    /// Spacing of the rings along the rope (m).
    pub ring_spacing: f64,
    /// Friction between ring and rope.
    pub ring_friction: f64,
    /// Thickness of a ring's rod (m) and its modulus (Pa).
    pub ring_diameter: f64,
    pub ring_modulus: f64,
    /// Length of the rope's cylinders, about (m).
    pub element_length: f64,
}

/// Where the ropes along the sides of the net end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LateralTo {
    /// At the rope ends, so that their load passes through the dissipators, if there are any.
    RopeEnds,
    /// At the anchors, past the dissipators.
    Anchors,
}

/// Energy dissipators, one at each end of every main rope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DissipatorDesign {
    pub plateau: f64,
    pub stroke: f64,
    /// Elastic stiffness before the plateau (N/m).
    pub stiffness: f64,
}

/// What holds the lowest main rope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bottom {
    /// Bolted to the bed along its length.
    Fixed,
    /// Free, this far above the bed (m).
    Opening(f64),
}

impl Bottom {
    /// Height of the gap under the net, normal to the bed (m).
    pub fn gap(self) -> f64 {
        match self {
            Self::Fixed => 0.0,
            Self::Opening(gap) => gap,
        }
    }
}

/// What a design must keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Least share of the mass that must be held.
    pub retained_mass: f64,
    /// Least height left over the initial height, both normal to the bed.
    pub residual_height: f64,
    /// By which the barrier must rise above the level of the event, normal to the bed (m), where that is asked for.
    pub freeboard: Option<f64>,
    /// How the run-up for that is worked out.
    pub run_up: RunUp,
    pub rope_utilisation: f64,
    pub anchor_utilisation: f64,
    /// Greatest share of the stroke that may be used.
    pub dissipator_utilisation: f64,
    pub outside_range: OutsideRange,
}

/// The balance by which a flow's run-up is worked out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunUp {
    /// The larger of both.
    Larger,
    MomentumJump,
    Energy,
}

/// What becomes of a check that a formula governs outside the range it is known for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutsideRange {
    /// The check stays open.
    Undecided,
    /// The report says so, and the check stands.
    Warn,
}

/// Coefficients of the guideline and partial factors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factors {
    /// Earth-pressure coefficient K.
    pub earth_pressure: f64,
    /// Hydrodynamic pressure coefficient λ.
    pub dynamic_pressure: f64,
    /// On loads, and whether the design or its set gives it; else it is a 1 that nobody vouches for.
    pub load: f64,
    pub load_given: bool,
    /// On rope resistance: breaking load over this is the design resistance.
    pub rope: f64,
    /// On anchor resistance.
    pub anchor: f64,
    /// Share of a rope's breaking load that its ends hold.
    pub rope_end: f64,
    /// Whether the design says so, or it was taken.
    pub rope_end_given: bool,
    /// Largest force of a dissipator that yields, over its plateau: what ropes and anchors must bear.
    pub overstrength: f64,
    /// Whether the overstrength is the designer's; else it is the factor on loads.
    pub overstrength_given: bool,
}

/// Loads beside those of the design flow; absent where the designer gives none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OtherLoads {
    /// Depth of a flow over the full barrier (m).
    pub overflow_depth: Option<f64>,
    /// tan φ of its drag on the barrier's top, and the length on which it rides there (m).
    pub overflow_drag: Option<(f64, f64)>,
    /// Whether surges come until the barrier is full.
    pub to_the_top: bool,
    /// K and density (kg/m³) of the drained deposit.
    pub drained: Option<(f64, f64)>,
    /// Force (N) and height above the bed (m) of a boulder or log.
    pub point_load: Option<(f64, f64)>,
    /// Pa
    pub snow_pressure: Option<f64>,
    /// On the dynamic pressure, for wood in the flow.
    pub wood_factor: Option<f64>,
    /// Weight of the net per area (N/m²).
    pub self_weight: Option<f64>,
    /// Height of the filled barrier over its first.
    pub filled_height: f64,
    /// Slope of the deposit over that of the bed.
    pub deposit_slope: f64,
}

/// How to simulate.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulationWishes {
    pub fidelity: FidelityWish,
    pub barrier_model: BarrierModel,
    pub seed: u64,
    /// Longest simulated time (s).
    pub longest: f64,
}

/// How fine the model shall be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FidelityWish {
    Fast,
    Standard,
    Fine,
    /// As fine as the verdict needs.
    Auto,
}

/// How the net hangs on its main ropes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BarrierModel {
    /// Rings are fixed to the rope.
    PinnedRopes,
    /// Ropes run through the rings with friction.
    SlidingRopes,
    /// Everything of cylinders that bend; rings are squares of four that slide on the ropes.
    Cylinders,
}
