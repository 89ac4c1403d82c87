//! What is asked: a barrier, a flow, limits. SI units, checked. Imports nothing above it.

pub(crate) mod anchor_rules;
pub mod anchors;
pub mod attached;
pub(crate) mod boulder_rules;
pub mod changes;
pub(crate) mod channel_entries;
pub(crate) mod channel_rules;
pub(crate) mod curve_file;
pub mod dissipator;
pub(crate) mod dissipator_entries;
pub(crate) mod dissipator_rules;
pub(crate) mod document;
pub mod entries;
pub(crate) mod factor_sets;
pub mod flow;
pub(crate) mod flow_entries;
pub(crate) mod grain_lengths;
pub(crate) mod grain_multiple;
pub mod hydrograph;
pub(crate) mod hydrograph_entries;
pub(crate) mod hydrograph_file;
pub(crate) mod hydrograph_rules;
pub(crate) mod key;
pub(crate) mod kit;
pub(crate) mod mesh_shape;
mod net_ring_rules;
pub(crate) mod net_rings;
pub(crate) mod net_rules;
pub(crate) mod post_rules;
pub mod posts;
pub mod read;
pub(crate) mod resolve;
pub(crate) mod rope;
pub(crate) mod rope_entries;
pub(crate) mod rope_rules;
pub(crate) mod rope_table;
pub(crate) mod rules;
pub(crate) mod schema;
pub(crate) mod section_file;
pub(crate) mod show;
pub(crate) mod size_rules;
pub(crate) mod sizes;
pub(crate) mod surge_entries;
pub(crate) mod surge_rules;
pub(crate) mod table_file;
pub(crate) mod terrain_file;
pub(crate) mod wall_rules;
pub(crate) mod yaml_faults;

use std::sync::Arc;

pub use self::anchors::{AnchorDesign, AnchorDesigns, AnchorOf, AnchorResistance, Bank};
pub use self::dissipator::DissipatorDesign;
pub use self::flow::{Arrival, Boulders, CurveCut, DamBreak, Flow, LaterSurge, OwnSizes, PoreFluid, Surge};
pub use self::mesh_shape::MeshShape;
pub use self::net_rings::{Contacts, NetRings};
pub use self::posts::{PostStrength, Posts, RetainingRopes, SteelSection};
pub use self::rope::{Level, Rope};

use crate::lattice::Lattice;
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

impl Design {
    /// The posts of its net, if it has any.
    pub fn posts(&self) -> Option<&Posts> {
        match &self.barrier {
            BarrierDesign::FlexibleNet(net) => net.posts.as_ref(),
            BarrierDesign::RigidWall(_) => None,
        }
    }

    /// The same event with another of its surges first, and the others after it: what is asked of the first is asked of that one.
    pub fn led_by(&self, number: usize) -> Self {
        Self { flow: self.flow.led_by(number), ..self.clone() }
    }
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

    /// Place in the channel's frame, from its right bank or side wall, of one that is told to the right looking downstream (m): in the
    /// coordinates of a surveyed section, or from the middle between side walls.
    pub fn across(&self, right: f64) -> f64 {
        let datum = self.survey.as_ref().map_or(0.5 * self.width, |survey| survey.surveyed(0.0));
        datum - right
    }

    /// Height of the bed over the foot of the barrier, plumb, at a level distance downstream of it (m).
    pub fn elevation(&self, downstream: f64) -> f64 {
        self.profile.as_ref().map_or(-downstream * libm::tan(self.slope), |profile| profile.elevation(downstream))
    }

    /// Level distances at which the bed breaks within a stretch downstream of the barrier, with both ends of it (m).
    pub fn breaks(&self, [from, to]: [f64; 2]) -> Vec<f64> {
        let corners = self.profile.iter().flat_map(Profile::corners).map(|corner| corner[0]);
        std::iter::once(from).chain(corners.filter(|&x| from < x && x < to)).chain([to]).collect()
    }

    /// Place of the bed at a distance along it from the barrier, downstream positive: down the bed at the barrier, and out of it (m).
    pub fn bed(&self, along: f64) -> [f64; 2] {
        let Some(profile) = &self.profile else { return [along, 0.0] };
        let there = profile.at(along);
        let (sine, cosine) = libm::sincos(self.slope);
        [there.x * cosine - there.z * sine, there.x * sine + there.z * cosine]
    }

    /// Height of the ground at the barrier, normal to the bed (m).
    pub fn ground_at(&self, across: f64) -> f64 {
        self.survey.as_ref().map_or(0.0, |survey| survey.ground(across))
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

#[derive(Clone, Debug, PartialEq)]
pub enum BarrierDesign {
    RigidWall(Box<RigidWall>),
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
    /// Of the ground, with what is in its pores (kg/m³).
    pub ground_density: f64,
    /// Partial factors on the resistance to sliding and on the moment that holds the wall.
    pub sliding_factor: f64,
    pub overturning_factor: f64,
    /// Of the ground under the base (Pa), if known, and the partial factor on it.
    pub bearing_resistance: Option<f64>,
    pub bearing_factor: f64,
    /// Along the barrier, of a block of it that moves as one (m), where it is told.
    pub block_length: Option<f64>,
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
    /// Distance between opposite sides of a mesh (m), for diamonds the length of a side; in a ring net that of a square on four contacts.
    pub mesh_opening: f64,
    pub mesh: MeshShape,
    /// Rope of the net; in a ring net the one that is like a leg of a ring.
    pub net_rope: Rope,
    /// The rings of a ring net.
    pub rings: Option<NetRings>,
    /// How much longer the net's ropes are than the straight sides of the mesh, as a share.
    pub net_slack: f64,
    /// Straight pieces of which a side of the mesh is made in the simulation, if the design says so.
    pub net_pieces: Option<u32>,
    pub main_ropes: MainRopes,
    pub lateral_rope: Rope,
    pub lateral_to: LateralTo,
    pub dissipators: Option<DissipatorDesign>,
    pub anchor_designs: AnchorDesigns,
    /// What holds the lowest rope to the bed, where the bed does, if known.
    pub bed_bolts: Option<BedBolts>,
    pub bottom: Bottom,
    pub side_extension: Option<SideExtension>,
    pub posts: Option<Posts>,
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

    /// All kinds of rope of the net.
    pub fn ropes(&self) -> impl Iterator<Item = &Rope> {
        let of_posts = self.posts.iter().map(|posts| &posts.retaining.rope);
        let main = self.main_ropes.levels.iter().map(|level| &level.rope);
        [&self.net_rope, &self.lateral_rope].into_iter().chain(main).chain(of_posts)
    }

    /// How the knots of the net lie, or the contacts of its rings.
    pub fn lattice(&self) -> Lattice {
        self.rings.map_or_else(|| self.mesh.lattice(self.mesh_opening), |rings| rings.lattice())
    }

    /// Diameter of the largest stone that passes the net by itself (m): the side of the mesh, which may be drawn into a square, or a whole ring.
    pub fn opening(&self) -> f64 {
        self.rings.map_or(self.mesh_opening, |rings| rings.diameter)
    }

    /// All anchors of ropes: of each free main rope from the bottom at the right bank and at the left, then those of the ropes that retain posts.
    pub fn anchors(&self) -> Vec<AnchorOf> {
        let banks = [Bank::Right, Bank::Left];
        let free = self.ropes_held_by_bed()..self.main_ropes.levels.len();
        let main = free.flat_map(|rope| banks.map(|bank| AnchorOf::Main { rope, bank }));
        let posts = self.posts.iter().flat_map(|posts| {
            let sides = posts.retaining.sides();
            (0..posts.at.len()).flat_map(move |post| sides.clone().into_iter().map(move |side| (post, side)))
        });
        main.chain(posts.map(|(post, side)| AnchorOf::Retaining { post, side })).collect()
    }

    /// The same with the least forces of its dissipators; nothing where none are known that are less.
    pub fn with_weakest_dissipators(&self) -> Option<Self> {
        let mut net = self.clone();
        let own = self.dissipators.as_ref().and_then(DissipatorDesign::weakest);
        let retaining = |posts: &Posts| posts.retaining.dissipators.as_ref().and_then(DissipatorDesign::weakest);
        let of_posts = self.posts.as_ref().and_then(retaining);
        if own.is_none() && of_posts.is_none() {
            return None;
        }
        net.dissipators = own.or(net.dissipators);
        if let (Some(posts), Some(weak)) = (&mut net.posts, of_posts) {
            posts.retaining.dissipators = Some(weak);
        }
        Some(net)
    }

    /// Whether a main rope, counted from 0 at the bottom, runs over the heads of posts.
    pub fn runs_over_posts(&self, rope: usize) -> bool {
        self.posts.is_some() && rope + 1 == self.main_ropes.levels.len()
    }

    /// Number of main ropes, from the bottom, that the bed holds along their length.
    pub fn ropes_held_by_bed(&self) -> usize {
        usize::from(self.bottom == Bottom::Fixed)
    }
}

/// The horizontal ropes that carry the net.
#[derive(Clone, Debug, PartialEq)]
pub struct MainRopes {
    /// From the bottom.
    pub levels: Vec<Level>,
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

impl MainRopes {
    /// Heights along the barrier, from the bottom (m).
    pub fn heights(&self) -> Vec<f64> {
        self.levels.iter().map(|level| level.height).collect()
    }

    /// The kinds of rope, each with the levels that it is of, from the bottom.
    pub fn kinds(&self) -> Vec<(Vec<usize>, &Rope)> {
        let mut kinds: Vec<(Vec<usize>, &Rope)> = Vec::new();
        for (number, level) in self.levels.iter().enumerate() {
            match kinds.iter_mut().find(|(_, rope)| **rope == level.rope) {
                Some((levels, _)) => levels.push(number),
                None => kinds.push((vec![number], &level.rope)),
            }
        }
        kinds
    }

    /// Ropes of each level.
    pub fn bundles(&self) -> Vec<u16> {
        self.levels.iter().map(|level| level.ropes).collect()
    }
}

/// Where the ropes along the sides of the net end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LateralTo {
    /// At the rope ends, so that their load passes through the dissipators, if there are any.
    RopeEnds,
    /// At the anchors, past the dissipators.
    Anchors,
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
    /// What that is a share of.
    pub retained_of: RetainedOf,
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

/// What the share that must be held counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RetainedOf {
    /// Grains and the fluid in their pores.
    Mixture,
    Grains,
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
    /// On anchor resistance, and on that of the foundations of posts.
    pub anchor: f64,
    /// On the resistance of posts.
    pub post: f64,
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
    /// Force (N) and height above the bed (m) of a boulder or log; without a height it comes at the surface of the flow.
    pub point_load: Option<(f64, Option<f64>)>,
    /// Pa
    pub snow_pressure: Option<f64>,
    /// On the dynamic pressure, for wood in the flow.
    pub wood_factor: Option<f64>,
    /// Share of the elastic force with which a boulder hits a rigid wall.
    pub impact_reduction: Option<f64>,
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
