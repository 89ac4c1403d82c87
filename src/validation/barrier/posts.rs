//! D30: a post on its hinged foot: held by two ropes under a load, swinging freely, and thrown against its ropes.

use crate::validation::barrier::stand::Stand;
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::{ball, free_model};
use dem::Vec3;
use dem::elements::post::{MASS_AT_HEAD, Post, WEIGHT_AT_HEAD};
use dem::elements::segment::{Segment, SegmentKind};
use dem::elements::strength::Strength;
use dem::model::Model;
use dem::simulation::Simulation;
use dem::tables::barrier::Barrier;
use dem::tables::grains::GrainShape;
use dem::tables::nodes::Node;

pub const CASE: Case = Case {
    id: "D30",
    suite: Suite::Rope,
    title: "A post of 3 m on a hinged foot: held by two ropes, swinging freely, thrown against its ropes",
    source: "Equilibrium of its head with anchors 4 m upstream and 2 m to either side: T = R √29/8, N = ¾ R; period of a uniform rod, 2π √(2 L/(3 g)); energy",
    tier: Tier::ClosedForm,
    weakness: "buckling and bending are checked by formula, not simulated",
    cost: Cost::Quick,
    run: posts,
};

const LENGTH: f64 = 3.0;
/// Pipe of 168.3 × 8 mm.
const AREA: f64 = 40.3e-4;
const MODULUS: f64 = 210e9;
const DENSITY: f64 = 7850.0;
const GRAVITY: f64 = 9.81;
const LOAD: f64 = 80e3;
const STEP: f64 = 1e-5;

/// A post from the origin to its head, `up` or hanging; its head has the given stiffness EA of ropes (N) to the two anchors, if any.
pub fn post(head: Vec3, gravity: Vec3, axial: Option<f64>) -> Barrier {
    let node =
        |position: Vec3, mass: f64, fixed: bool| Node { position, velocity: Vec3::zeros(), mass, fixed, radius: 0.0 };
    let mass = DENSITY * AREA * LENGTH;
    let mut barrier = Barrier { friction: 0.3, contact_modulus: 1e10, ..Barrier::default() };
    barrier.nodes = vec![node(Vec3::zeros(), mass, true), node(head, MASS_AT_HEAD * mass, false)];
    barrier.posts.push(Post {
        nodes: [0, 1],
        number: 0,
        rest_length: LENGTH,
        stiffness: MODULUS * AREA / LENGTH,
        damping: 0.0,
        radius: 0.084,
        weight: gravity * (WEIGHT_AT_HEAD * mass),
    });
    for (side, axial) in [2.0, -2.0].into_iter().zip(axial.into_iter().chain(axial)) {
        let anchor = Vec3::new(-4.0, side, 0.0);
        let rest_length = (anchor - head).norm();
        barrier.nodes.push(node(anchor, 1.0, true));
        barrier.segments.push(Segment {
            nodes: [1, barrier.nodes.len() as u32 - 1],
            kind: SegmentKind::Retaining(0),
            rest_length,
            stiffness: axial / rest_length,
            damping: 0.0,
            radius: 0.01,
            strength: Strength::default(),
        });
    }
    barrier.connect();
    barrier
}

/// Tension of a rope, compression of the post and thrust on its foot along the load (N) under the load at rest.
fn held() -> [f64; 3] {
    // So stiff that the head hardly moves.
    let mut stand = Stand::new(post(Vec3::z() * LENGTH, Vec3::zeros(), Some(1e9)), 0.2 * STEP);
    stand.loads.push((1, Vec3::x() * LOAD, Vec3::zeros()));
    stand.relax(300.0);
    [stand.net.tensions[0], -stand.net.posts[0], stand.net.forces[0].z]
}

/// Period of a post that hangs from its foot (s).
fn swing() -> Result<f64, Broken> {
    let (sine, cosine) = libm::sincos(0.02);
    let gravity = -Vec3::z() * GRAVITY;
    let mut stand = Stand::new(post(Vec3::new(sine, 0.0, -cosine) * LENGTH, gravity, None), 4.0 * STEP);
    stand.gravity = gravity;
    stand.period(60.0, |barrier| barrier.nodes[1].position.x)
}

/// Energy that is not accounted for, over that put in, of a head that is thrown downstream and falls back upstream.
fn thrown() -> Result<f64, Broken> {
    let gravity = -Vec3::z() * GRAVITY;
    let mut barrier = post(Vec3::z() * LENGTH, gravity, Some(3e7));
    barrier.nodes[1].velocity = Vec3::new(2.0, 0.3, 0.0);
    let grain = ball(0, Vec3::repeat(1e3), 0.1, DENSITY);
    let model = Model { barrier: Some(barrier), gravity, ..free_model(vec![grain], GrainShape::Sphere) };
    let mut simulation = Simulation::new(model, STEP, 0.05, 1e6);
    simulation.start_account();
    simulation.step_and_account()?;
    let start = simulation.ledger;
    while simulation.time < 1.0 {
        simulation.step_and_account()?;
    }
    Ok(simulation.ledger.relative_error(&start))
}

fn posts() -> Result<Vec<Finding>, Broken> {
    let [tension, compression, on_foot] = held();
    let period = 2.0 * std::f64::consts::PI * (2.0 * LENGTH / (3.0 * GRAVITY)).sqrt();
    Ok(vec![
        Finding::near("tension of a rope over R √29/8", tension / (LOAD * 29_f64.sqrt() / 8.0), 1.0, 2e-3),
        Finding::near("compression of the post over ¾ R", compression / (0.75 * LOAD), 1.0, 2e-3),
        Finding::near("force on its foot, downwards, over ¾ R", -on_foot / (0.75 * LOAD), 1.0, 2e-3),
        Finding::near("period of free swing over 2π √(2 L/(3 g))", swing()? / period, 1.0, 1e-3),
        Finding::close("energy not accounted for, over that put in", thrown()?, 0.0, 1e-4),
    ])
}
