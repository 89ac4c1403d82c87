//! The ropes and ring nets of `nets.json` in this engine; prints a row of JSON for each scene, as `nets.py` does for Kratos.
//!
//!     benches/peers/nets.sh                                    both, and a table of them
//!     cargo bench --bench nets -- benches/peers/nets.json      this engine alone
//!
//! A net under a load is brought to rest by viscous slowing, the load coming on slowly; one that is hit is stepped as in a run. The nodes
//! are moved by the engine's own forces and integrator. Sources of the laws: [`dem::elements::rope`], [`dem::elements::sliding`],
//! [`dem::elements::net_ring`].

#![allow(clippy::print_stdout, reason = "a bench prints what it finds")]

use std::collections::BTreeMap;
use std::time::Instant;

use dem::Vec3;
use dem::contact::law::LawConstants;
use dem::contact::material::Material;
use dem::elements::net_ring::{NetRing, RingStrength};
use dem::elements::segment::{Segment, SegmentKind};
use dem::elements::sliding::Chain;
use dem::elements::strength::Strength;
use dem::net::{NetForces, slide_and_pull};
use dem::tables::barrier::Barrier;
use dem::tables::nodes::Node;
use dem::time::integrate::move_nodes;
use serde::Deserialize;

/// The load comes on over this many times of slowing, and rest is looked for that many times as long at the most.
const RAMP: f64 = 100.0;
const PATIENCE: f64 = 30.0;
/// Largest force left on a free node at rest, over the largest one on an anchor.
const REST: f64 = 1e-7;
/// Steps between two readings of all tensions and reactions of a net that is hit.
const READ_EVERY: usize = 10;

#[derive(Deserialize)]
struct Scenes {
    scenes: Vec<Scene>,
}

#[derive(Deserialize)]
struct Scene {
    name: String,
    #[serde(flatten)]
    net: Net,
    /// s
    step: f64,
    /// Viscous slowing on the way to rest (1/s).
    slowing: Option<f64>,
    hit: Option<Hit>,
}

#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum Net {
    Sliding(SlidingRope),
    Ropes(RopeNet),
    Rings(RingNet),
}

/// A mass (kg) in the middle of a net that has a speed (m/s) across it, and how long that is followed (s).
#[derive(Deserialize)]
struct Hit {
    mass: f64,
    speed: f64,
    time: f64,
}

/// A rope between two anchors that slides through rings, each of which moves along one axis; or a ring through the same points.
#[derive(Deserialize)]
struct SlidingRope {
    /// Whether it is a ring.
    #[serde(default)]
    closed: bool,
    /// Anchors and rings in order, where the rope lies without tension (m).
    points: Vec<[f64; 3]>,
    /// Axis along which the rings move: 0, 1 or 2.
    guide: usize,
    /// Force on each ring along it (N).
    loads: Vec<f64>,
    friction: f64,
    /// EA (N), and mass per length (kg/m).
    axial: f64,
    line_mass: f64,
}

/// A net of ropes in squares along its edges, which are held.
#[derive(Deserialize)]
struct RopeNet {
    /// Squares along an edge, and the side of one (m).
    across: i32,
    side: f64,
    /// EA (N), and mass per length (kg/m).
    axial: f64,
    line_mass: f64,
    /// On each free knot, across the net (N).
    load: f64,
}

/// A net of rings with four contacts each, of which those on its edges are held.
#[derive(Deserialize)]
struct RingNet {
    /// Rings along an edge.
    across: i32,
    /// Half a ring's width where its way is just taut, and as it hangs (m).
    taut_half: f64,
    half: f64,
    /// By how much the contacts on the right edge are drawn further (m).
    right: [f64; 2],
    /// k and b of the ring (N/m), its diameter (m) and mass (kg).
    stiffness: f64,
    bending: f64,
    diameter: f64,
    ring_mass: f64,
    /// On each free contact, across the net (N).
    load: f64,
}

/// A barrier with loads on its nodes.
#[derive(Default)]
struct Stand {
    barrier: Barrier,
    /// Nodes with the force on each (N), and with the axis along which each moves.
    loads: Vec<(usize, Vec3)>,
    guides: Vec<(usize, usize)>,
    /// Where it is hit; what moves most is told of the first.
    middle: Vec<usize>,
}

impl Stand {
    fn add_node(&mut self, position: Vec3, fixed: bool) -> usize {
        let velocity = Vec3::zeros();
        self.barrier.nodes.push(Node { position, velocity, mass: 0.0, fixed, radius: 0.0 });
        self.barrier.nodes.len() - 1
    }

    /// A piece of rope of a stiffness EA (N) and a mass per length (kg/m) that is straight and without tension.
    fn add_piece(&mut self, ends: [usize; 2], axial: f64, line_mass: f64) {
        let [a, b] = ends.map(|end| self.barrier.nodes[end].position);
        let rest_length = (b - a).norm();
        ends.iter().for_each(|&end| self.barrier.nodes[end].mass += 0.5 * line_mass * rest_length);
        self.barrier.segments.push(Segment {
            nodes: ends.map(|end| end as u32),
            kind: SegmentKind::Net,
            rest_length,
            stiffness: axial / rest_length,
            damping: 0.0,
            radius: 0.0,
            strength: Strength::default(),
        });
    }

    /// A ring through all nodes that is just taut.
    fn add_ring(&mut self, scene: &SlidingRope) {
        let nodes = &mut self.barrier.nodes;
        let count = nodes.len();
        let way =
            (0..count).map(|node| (nodes[(node + 1) % count].position - nodes[node].position).norm()).sum::<f64>();
        nodes.iter_mut().for_each(|node| node.mass = scene.line_mass * way / count as f64);
        self.barrier.net_rings.push(ring_without_bending((0..count as u32).collect(), way, scene.axial / way));
    }

    /// One step of length `step` (s), with a share of the loads.
    fn step(&mut self, step: f64, share: f64) -> NetForces {
        let mut segments = std::mem::take(&mut self.barrier.segments);
        let mut net =
            slide_and_pull(&self.barrier, &mut segments, &LawConstants::of(&Material::new(1.0, 1.0, 0.0), step));
        self.barrier.segments = segments;
        for (node, load) in &self.loads {
            net.forces[*node] += load * share;
        }
        for &(node, guide) in &self.guides {
            let along = net.forces[node][guide];
            net.forces[node] = Vec3::zeros();
            net.forces[node][guide] = along;
        }
        net.take_over(&mut self.barrier);
        move_nodes(&mut self.barrier.nodes, &net.forces, &Vec3::zeros(), step);
        net
    }

    /// Forces on the anchors (N).
    fn reactions<'a>(&'a self, net: &'a NetForces) -> impl Iterator<Item = Vec3> + 'a {
        let nodes = self.barrier.nodes.iter().zip(&net.forces);
        nodes.filter(|(node, _)| node.fixed).map(|(_, force)| -force)
    }

    /// Tension of every piece of rope and all round every ring (N).
    fn tensions(&self, net: &NetForces) -> Vec<f64> {
        let mut unused = vec![Vec3::zeros(); self.barrier.nodes.len()];
        let rings = self.barrier.net_rings.iter().map(|ring| ring.pull(&self.barrier.nodes, &mut unused, 0.0).tension);
        net.tensions.iter().copied().chain(rings).collect()
    }
}

fn sliding_rope(scene: &SlidingRope) -> Stand {
    let mut stand = Stand::default();
    let last = scene.points.len() - 1;
    for (number, point) in scene.points.iter().enumerate() {
        stand.add_node(Vec3::from(*point), number == 0 || number == last);
    }
    for (number, &load) in scene.loads.iter().enumerate() {
        let mut force = Vec3::zeros();
        force[scene.guide] = load;
        stand.loads.push((number + 1, force));
        stand.guides.push((number + 1, scene.guide));
    }
    if scene.closed {
        stand.add_ring(scene);
        return stand;
    }
    for number in 0..last {
        stand.add_piece([number, number + 1], scene.axial, scene.line_mass);
    }
    let segments: Vec<u32> = (0..last as u32).collect();
    stand.barrier.chains =
        vec![Chain { frictions: vec![scene.friction; segments.len() - 1], segments, shortest: 1e-3 }];
    stand
}

fn rope_net(scene: &RopeNet) -> Stand {
    let (mut stand, across) = (Stand::default(), scene.across);
    let mut nodes = BTreeMap::new();
    for place in (0..=across).flat_map(|column| (0..=across).map(move |row| [column, row])) {
        let held = place.iter().any(|&at| at == 0 || at == across);
        let [x, y] = place.map(|at| (f64::from(at) - 0.5 * f64::from(across)) * scene.side);
        let node = stand.add_node(Vec3::new(x, y, 0.0), held);
        nodes.insert(place, node);
        if !held {
            stand.loads.push((node, Vec3::z() * scene.load));
        }
    }
    for (&[column, row], &node) in &nodes {
        let beside = [[column + 1, row], [column, row + 1]].into_iter().filter_map(|place| nodes.get(&place));
        for &other in beside {
            if !(stand.barrier.nodes[node].fixed && stand.barrier.nodes[other].fixed) {
                stand.add_piece([node, other], scene.axial, scene.line_mass);
            }
        }
    }
    stand.middle = vec![nodes[&[across / 2; 2]]];
    stand
}

fn ring_net(scene: &RingNet) -> Stand {
    let (mut stand, across) = (Stand::default(), scene.across);
    let mut nodes = BTreeMap::new();
    // Contacts by twice their place in rings from the middle: right, above, left and below of each ring's centre.
    let odd = || (1 - across..across).step_by(2);
    for (x, y) in odd().flat_map(|x| odd().map(move |y| (x, y))) {
        let contacts = [[x + 1, y], [x, y + 1], [x - 1, y], [x, y - 1]].map(|place| {
            *nodes.entry(place).or_insert_with(|| {
                let more = if place[0] == across { scene.right } else { [0.0; 2] };
                let [x, y] = [0, 1].map(|axis| f64::from(place[axis]) * scene.half + more[axis]);
                let held = place.iter().any(|at| at.abs() == across);
                let node = stand.add_node(Vec3::new(x, y, 0.0), held);
                if !held {
                    stand.loads.push((node, Vec3::z() * scene.load));
                }
                node
            })
        });
        contacts.iter().for_each(|&node| stand.barrier.nodes[node].mass += 0.25 * scene.ring_mass);
        stand.barrier.net_rings.push(scene.ring(contacts));
    }
    let beside = [[0, 1], [0, -1], [1, 0], [-1, 0]];
    stand.middle = beside.iter().filter_map(|place| nodes.get(place).copied()).collect();
    stand
}

impl RingNet {
    fn ring(&self, contacts: [usize; 4]) -> NetRing {
        let taut_from = 4.0 * std::f64::consts::SQRT_2 * self.taut_half;
        let nodes = contacts.map(|node| node as u32).to_vec();
        NetRing {
            bending: self.bending,
            diameter: self.diameter,
            ..ring_without_bending(nodes, taut_from, self.stiffness)
        }
    }
}

/// A ring without bending that holds whatever comes: k (N/m) against a way beyond the one from which it is taut (m).
fn ring_without_bending(nodes: Vec<u32>, taut_from: f64, stiffness: f64) -> NetRing {
    NetRing {
        nodes,
        taut_from,
        stiffness,
        damping: 0.0,
        bending: 0.0,
        diameter: 0.0,
        radius: 0.0,
        touched: Vec::new(),
        strength: RingStrength { in_chain: f64::INFINITY, in_net: f64::INFINITY, breaks: false, broken: false },
    }
}

/// What was found, by its name with the unit, and the time it took (s).
type Found = (BTreeMap<&'static str, f64>, f64);

/// Brings the loaded net to rest; finds nothing where that takes too long.
fn at_rest(mut stand: Stand, step: f64, slowing: f64) -> Found {
    let start: Vec<Vec3> = stand.barrier.nodes.iter().map(|node| node.position).collect();
    let (began, steps) = (Instant::now(), (RAMP / slowing / step) as usize);
    let mut net = NetForces::default();
    for number in 0..(PATIENCE * steps as f64) as usize {
        net = stand.step(step, (number as f64 / steps as f64).min(1.0));
        stand.barrier.nodes.iter_mut().for_each(|node| node.velocity *= 1.0 - slowing * step);
        if number > steps && number % 100 == 0 && is_at_rest(&stand.barrier, &net) {
            break;
        }
    }
    let spent = began.elapsed().as_secs_f64();
    if !is_at_rest(&stand.barrier, &net) {
        return (BTreeMap::new(), spent);
    }
    let moved = stand.barrier.nodes.iter().zip(&start).filter(|(node, _)| !node.fixed);
    let tensions = stand.tensions(&net);
    let reactions: Vec<f64> = stand.reactions(&net).map(|force| force.norm()).collect();
    let found = BTreeMap::from([
        ("largest displacement (m)", largest(moved.map(|(node, start)| (node.position - start).norm()))),
        ("largest tension (kN)", largest(tensions.iter().copied()) * 1e-3),
        ("least tension (kN)", least(&tensions) * 1e-3),
        ("largest reaction of an anchor (kN)", largest(reactions.iter().copied()) * 1e-3),
        ("reactions, sum of their sizes (kN)", reactions.iter().sum::<f64>() * 1e-3),
    ]);
    (found, spent)
}

fn is_at_rest(barrier: &Barrier, net: &NetForces) -> bool {
    let on = |held: bool| {
        let nodes = barrier.nodes.iter().zip(&net.forces).filter(move |(node, _)| node.fixed == held);
        largest(nodes.map(|(_, force)| force.norm()))
    };
    on(false) <= REST * on(true)
}

/// Follows a net whose middle has a mass and a speed across it.
fn struck(mut stand: Stand, step: f64, hit: &Hit) -> Found {
    let share = hit.mass / stand.middle.len() as f64;
    for &node in &stand.middle {
        stand.barrier.nodes[node].mass += share;
        stand.barrier.nodes[node].velocity.z = -hit.speed;
    }
    let (mut sag, mut tension, mut slackest, mut reaction, mut spent) = (0.0_f64, 0.0_f64, f64::INFINITY, 0.0_f64, 0.0);
    for number in 0..(hit.time / step).round() as usize {
        let began = Instant::now();
        let net = stand.step(step, 1.0);
        spent += began.elapsed().as_secs_f64();
        sag = sag.max(-stand.barrier.nodes[stand.middle[0]].position.z);
        if number % READ_EVERY == 0 {
            let tensions = stand.tensions(&net);
            tension = tension.max(largest(tensions.iter().copied()));
            slackest = slackest.min(least(&tensions));
            reaction = reaction.max(stand.reactions(&net).map(|force| force.z).sum());
        }
    }
    let found = BTreeMap::from([
        ("largest displacement (m)", sag),
        ("largest tension (kN)", tension * 1e-3),
        ("least tension (kN)", slackest * 1e-3),
        ("largest reaction across the net (kN)", reaction * 1e-3),
    ]);
    (found, spent)
}

fn largest(of: impl Iterator<Item = f64>) -> f64 {
    of.fold(0.0, dem::larger_or_nan)
}

fn least(of: &[f64]) -> f64 {
    -of.iter().map(|value| -value).fold(f64::NEG_INFINITY, dem::larger_or_nan)
}

fn main() {
    // Without a file of scenes, as when all benches are run, there is nothing to do.
    let Some(path) = std::env::args().find(|argument| argument.ends_with(".json")) else { return };
    let text = std::fs::read_to_string(path).expect("the scenes");
    let Scenes { scenes } = serde_json::from_str(&text).expect("scenes as JSON");
    for scene in scenes {
        let stand = match &scene.net {
            Net::Sliding(rope) => sliding_rope(rope),
            Net::Ropes(net) => rope_net(net),
            Net::Rings(net) => ring_net(net),
        };
        let (found, time) = match &scene.hit {
            Some(hit) => struck(stand, scene.step, hit),
            None => at_rest(stand, scene.step, scene.slowing.expect("slowing of a net that comes to rest")),
        };
        println!("{}", serde_json::json!({ "scene": scene.name, "time": time, "found": found }));
    }
}
