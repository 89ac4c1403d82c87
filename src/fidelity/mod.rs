//! How finely to model, and why.

pub(crate) mod ladder;

use crate::design::{BarrierDesign, BarrierModel, Design, FidelityWish, FlexibleNet, Level, NetRings, Rope};
use crate::ring_law;
use crate::scene::flow::release::bodies;
use crate::scene::net::build::{ROPE_DAMPING_RATIO, ROPE_DENSITY};
use crate::scene::net::posts::piece_of_retaining_rope;
use dem::contact::law::contact_stiffness;
use dem::contact::restitution::{LONGEST_PHASE, damping_ratio_for};
use dem::time::multi_rate::substeps;
use dem::time::stable_step::critical_step_of_pair;

/// Choices that trade time against accuracy, each with its reason.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fidelity {
    pub name: &'static str,
    /// Time step (s).
    pub time_step: f64,
    /// Longest step of the barrier, and of the grains at it (s).
    pub barrier_step: f64,
    /// Reach of neighbour lists over the mean member radius.
    pub skin_share: f64,
    /// Why the time step is what it is, for the report.
    pub reason: String,
}

/// Name of each wish, and the share of the critical step of the lightest pair that it takes.
pub fn step_share(wish: FidelityWish) -> (&'static str, f64) {
    match wish {
        FidelityWish::Fast => ("fast", 0.6),
        // Who asks for none in particular is on a rung of the ladder, or wants no simulation.
        FidelityWish::Standard | FidelityWish::Auto => ("standard", 0.4),
        FidelityWish::Fine => ("fine", 0.2),
    }
}

impl Fidelity {
    /// Steps that the barrier, and the grains at it, take in one of the others.
    pub fn barrier_steps(&self) -> u32 {
        substeps(self.time_step, self.barrier_step)
    }
}

/// Chooses the time step from the stiffest of what can be connected, a pair of the smallest grains with their dashpot; and that of the barrier
/// from a knot of the net with its ropes and a grain pressed on it.
pub fn choose(design: &Design) -> Fidelity {
    let (name, share) = step_share(design.simulation.fidelity);
    let pairs = stiffest_pairs(design);
    let grains = pairs.critical_step;
    let net = match &design.barrier {
        BarrierDesign::RigidWall(_) => f64::INFINITY,
        BarrierDesign::FlexibleNet(net) => critical_step_of_net(net, design),
    };
    let bounce = LONGEST_PHASE / pairs.frequency;
    let stable = share * grains;
    let mut reason =
        format!("{share} of the estimated critical step of a pair of the smallest grains ({grains:.2e} s)");
    if bounce < stable {
        reason.push_str(", shortened so that restitution is kept on the mean of many impacts");
    }
    let barrier_step = if net.is_finite() { share * net } else { f64::MAX };
    let time_step = round_down(stable.min(bounce).min(MOST_BARRIER_STEPS * barrier_step));
    if MOST_BARRIER_STEPS * barrier_step < stable.min(bounce) {
        reason.push_str(&format!(", shortened to {MOST_BARRIER_STEPS} steps of the barrier"));
    }
    if substeps(time_step, barrier_step) > 1 {
        reason.push_str(&format!(
            "; the barrier and the grains at it take several steps in one, of {share} of that of a knot of the net with a grain pressed on it ({net:.2e} s)"
        ));
    }
    Fidelity { name, time_step, barrier_step, skin_share: 0.6, reason }
}

/// Steps of the barrier in one of the grains': up to so many the energy account closes about as well as with one, within 4e-4 of what was put in on nets
/// of a mesh and cylinders, and within 9e-4 with dissipators that yield softly (5e-4 to 11e-4 with one to four); with eight, within 6e-4 and 8e-4.
const MOST_BARRIER_STEPS: f64 = 6.0;

/// Straight pieces of which a side of the mesh is made: what the design says, or one, and on the finest rung what the grains need.
pub fn net_pieces(design: &Design, net: &FlexibleNet) -> u32 {
    // The sides of a ring are one closed line.
    let fine = design.simulation.fidelity == FidelityWish::Fine && net.rings.is_none();
    net.net_pieces.unwrap_or(if fine { needed_pieces(design, net) } else { 1 })
}

/// Pieces that grains of the median size need.
pub fn needed_pieces(design: &Design, net: &FlexibleNet) -> u32 {
    match net.rings {
        Some(_) => 1,
        None => pieces_for(net.lattice().side(), 0.5 * design.flow.sizes.quantile(0.5)),
    }
}

/// Pieces of a side of a mesh (m) with which a body of a radius (m) that pushes beside a knot meets, within 8 %, what it would with many:
/// a side of one piece cannot bend round it and is up to two fifths too stiff (validation case D26).
pub fn pieces_for(mesh: f64, radius: f64) -> u32 {
    ((PIECES_PER_RADIUS * mesh / radius).ceil() as u32).clamp(1, MOST_PIECES)
}

/// Pieces in a length of the net's rope as long as the body's radius.
const PIECES_PER_RADIUS: f64 = 3.5;
const MOST_PIECES: u32 = 8;

/// What the pairs of grains ask of the step.
struct Pairs {
    /// Shortest critical step (s).
    critical_step: f64,
    /// Highest angular frequency √(k/m_r) (rad/s).
    frequency: f64,
}

fn stiffest_pairs(design: &Design) -> Pairs {
    let flow = &design.flow;
    let zeta = damping_ratio_for(flow.restitution);
    let mut pairs = Pairs { critical_step: f64::INFINITY, frequency: 0.0 };
    for body in (0..flow.surges()).flat_map(|number| bodies(&flow.alone(number))) {
        let (stiffness, reduced) = (flow.modulus * body.radius, 0.5 * body.mass);
        pairs.critical_step = pairs.critical_step.min(critical_step_of_pair(stiffness, reduced, zeta));
        pairs.frequency = pairs.frequency.max((stiffness / reduced).sqrt());
    }
    pairs
}

/// So many sides meet in a knot, at even angles; along any direction in their plane their stiffness adds up to half of their sum, and to as
/// much again where the neighbours move against it. A grain of the mean size presses on it as well.
fn critical_step_of_net(net: &FlexibleNet, design: &Design) -> f64 {
    let area = |rope: &Rope| std::f64::consts::FRAC_PI_4 * rope.diameter.powi(2);
    let lattice = net.lattice();
    let knot = |rope: &Rope, length: f64, substeps: f64, sides: f64| {
        let mass = 0.5 * substeps * ROPE_DENSITY * area(rope) * length;
        let stiffness = rope.modulus * area(rope) / length;
        (mass, sides * stiffness)
    };
    let pieces = net_pieces(design, net);
    // A node between two pieces of a side is lighter than a knot of four, and as stiff along the side.
    let (meeting, sides) = if pieces > 1 { (2.0, 4.0) } else { (lattice.meeting(), lattice.meeting()) };
    let (net_mass, net_stiffness) = match &net.rings {
        Some(rings) => contact_of_rings(rings),
        None => knot(&net.net_rope, lattice.side() / f64::from(pieces), meeting, sides),
    };
    let radius = 0.42 * design.flow.sizes.quantile(0.5);
    let grain = design.flow.modulus * radius;
    let rope = net.net_rope.modulus * 0.5 * net.net_rope.diameter;
    let contact = contact_stiffness(grain, rope);
    if design.simulation.barrier_model == BarrierModel::Cylinders {
        // What holds the barrier together has steps of its own; a grain presses on a piece of the rope.
        let piece = |level: &Level| knot(&level.rope, net.main_ropes.element_length, 2.0, 4.0).0;
        let lightest = net.main_ropes.levels.iter().map(piece).fold(net_mass, f64::min);
        return critical_step_of_pair(contact, lightest, ROPE_DAMPING_RATIO);
    }
    let on_net = net_mass / (net_stiffness + contact);
    let on_rope = |level: &Level| {
        let (mass, stiffness) = knot(&level.rope, lattice.along_a_rope(), 2.0, 4.0);
        let ropes = f64::from(level.ropes);
        (ropes * mass + net_mass) / (ropes * stiffness + net_stiffness + contact)
    };
    // A node between two pieces of a retaining rope, on which a grain presses.
    let on_retaining = net.posts.as_ref().map_or(f64::INFINITY, |posts| {
        let [mass, stiffness] = piece_of_retaining_rope(posts, net.main_ropes.ring_spacing);
        mass / (4.0 * stiffness + contact)
    });
    let least = net.main_ropes.levels.iter().map(on_rope).fold(on_net.min(on_retaining), f64::min);
    critical_step_of_pair(1.0, least, ROPE_DAMPING_RATIO)
}

/// Mass of a contact of two rings (kg), and their stiffness there (N/m) when neighbours breathe against each other: with all n contacts of a
/// ring out by u its way grows by 2 n s u, s = sin(π/n), and each pulls its contact by 2 s k 2 n s u; opposite contacts bend it by 2 u.
fn contact_of_rings(rings: &NetRings) -> (f64, f64) {
    let (law, contacts) = (rings.law(), rings.contacts.number() as f64);
    let mass = 2.0 * ring_law::mass(&rings.wires, rings.diameter, ROPE_DENSITY) / contacts;
    let sine = libm::sin(std::f64::consts::PI / contacts);
    let taut = 4.0 * contacts * sine * sine * law.stiffness;
    (mass, 2.0 * (taut + 2.0 * law.bending))
}

/// Two significant digits, downwards: a step a person can read.
fn round_down(step: f64) -> f64 {
    let magnitude = libm::exp10(libm::log10(step).floor() - 1.0);
    (step / magnitude).floor() * magnitude
}
