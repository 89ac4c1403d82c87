//! The scenes of the stability map: one for every kind of contact and element.

use nalgebra::UnitQuaternion;

use crate::lattice::Lattice;
use crate::ring_law::{RingLaw, Wires, chain_of, mass};
use crate::validation::barrier::posts::post;
use crate::validation::barrier::punching::Panel;
use crate::validation::barrier::ring_panel::ring_panel;
use crate::validation::scenes::{MODULUS, ball, closed_box, free_model, material, plane};
use dem::Vec3;
use dem::contact::law::contact_stiffness;
use dem::elements::cylinder::Cylinder;
use dem::elements::dissipator::Dissipator;
use dem::elements::segment::{Segment, SegmentKind};
use dem::elements::strength::Strength;
use dem::elements::yield_curve::YieldCurve;
use dem::model::Model;
use dem::tables::barrier::Barrier;
use dem::tables::grains::{Grain, GrainBody, GrainShape};
use dem::tables::nodes::{Frame, Node};
use dem::tables::surfaces::SurfaceRole;

/// What a scene is, and how to build it.
pub struct Scene {
    pub name: &'static str,
    pub what: &'static str,
    /// Whether the limit is that of the scene as it is built; else things meet later.
    pub linear: bool,
    pub build: fn() -> Model,
}

pub const SCENES: [Scene; 22] = [
    Scene {
        name: "row of balls", what: "eight balls pressed together between walls, ε = 1", linear: true, build: row
    },
    Scene {
        name: "block of balls",
        what: "64 balls pressed together in a box, friction, ε = 0.3",
        linear: true,
        build: || block(GrainShape::Sphere, 0.3),
    },
    Scene {
        name: "block of clumps",
        what: "64 clumps pressed together in a box, friction, ε = 0.3",
        linear: true,
        build: || block(GrainShape::Clump, 0.3),
    },
    Scene {
        name: "strong dashpots",
        what: "64 balls in a box, ε = 0.1",
        linear: true,
        build: || block(GrainShape::Sphere, 0.1),
    },
    Scene {
        name: "wedged grain",
        what: "a ball pressed between two planes at 40° and a third",
        linear: true,
        build: wedge,
    },
    Scene { name: "rope", what: "taut rope of 70 mm segments", linear: true, build: || rope(0.07, 1.0, 1) },
    Scene { name: "short elements", what: "taut rope of 10 mm segments", linear: true, build: || rope(0.01, 1.0, 1) },
    Scene {
        name: "stiff rope",
        what: "taut rope of 70 mm segments, 100 times as stiff",
        linear: true,
        build: || rope(0.07, 100.0, 1),
    },
    Scene {
        name: "parallel ropes",
        what: "three ropes between the same nodes",
        linear: true,
        build: || rope(0.07, 1.0, 3),
    },
    Scene {
        name: "bending rope",
        what: "cylinders of 70 mm, clamped at one end",
        linear: true,
        build: || cylinders(0.07),
    },
    Scene {
        name: "grain on a rope",
        what: "a grain of 0.45 m pressed on a taut rope of 16 mm",
        linear: true,
        build: || grain_on_rope(0.0),
    },
    Scene {
        name: "taut rings",
        what: "16 rings of 300 mm with 12 windings of 3 mm in a frame, stretched by a hundredth",
        linear: true,
        build: || rings(four, 1.01),
    },
    Scene {
        name: "bent rings",
        what: "the same, drawn from circles to where they are nearly taut",
        linear: true,
        build: || rings(four, 0.99),
    },
    Scene {
        name: "taut rings of six contacts",
        what: "16 and more such rings that meet six others, stretched by a hundredth",
        linear: true,
        build: || rings(six, 1.01),
    },
    Scene {
        name: "hexagons",
        what: "a panel of 3 m of ropes of 8 mm in hexagons of 300 mm, stretched by a hundredth",
        linear: true,
        build: hexagons,
    },
    Scene {
        name: "rings from slack to taut",
        what: "the same, nearly taut, with contacts at 5 m/s",
        linear: false,
        build: swinging_rings,
    },
    Scene {
        name: "post on ropes",
        what: "a steel post of 3 m pressed by two taut ropes of 30 MN",
        linear: true,
        build: post_on_ropes,
    },
    Scene {
        name: "used-up dissipator",
        what: "a dissipator of 46 MN/m beyond its stop, held by a rope",
        linear: true,
        build: stop,
    },
    Scene {
        name: "slack to taut",
        what: "a knot on a slack rope that snaps taut at 10 m/s, again and again",
        linear: false,
        build: snap,
    },
    Scene {
        name: "rope that breaks",
        what: "a taut rope of 70 mm segments, one of which breaks",
        linear: false,
        build: breaking,
    },
    Scene {
        name: "squeezed grain",
        what: "a grain of 0.45 m squeezed between a taut rope of 16 mm and the bed",
        linear: true,
        build: squeezed,
    },
    Scene {
        name: "fast grain, thin rope",
        what: "a grain of 0.1 m at 30 m/s against a taut rope of 10 mm",
        linear: false,
        build: || grain_on_rope(30.0),
    },
];

/// Overlap over radius with which things are pressed together.
const PRESSED: f64 = 0.01;
const RADIUS: f64 = 0.05;
const DENSITY: f64 = 2600.0;

/// A small push that differs from body to body (m/s).
fn nudge(number: usize) -> Vec3 {
    let turn = 2.4 * number as f64;
    Vec3::new(libm::cos(turn), libm::sin(turn), libm::cos(1.7 * turn)) * 1e-3
}

fn row() -> Model {
    let spacing = 2.0 * RADIUS * (1.0 - PRESSED);
    let count = 8;
    let ball_at = |number: usize| {
        let mut grain = ball(number as u32, Vec3::x() * (spacing * (number as f64 + 0.5)), RADIUS, DENSITY);
        grain.velocity = Vec3::x() * nudge(number).x;
        grain
    };
    let mut model = free_model((0..count).map(ball_at).collect(), GrainShape::Sphere);
    model.material = material(1.0, 0.0);
    let far = spacing * count as f64;
    model.surfaces = vec![
        plane(SurfaceRole::Side, Vec3::zeros(), Vec3::x(), 0.0),
        plane(SurfaceRole::Side, Vec3::x() * far, -Vec3::x(), 0.0),
    ];
    model
}

fn block(shape: GrainShape, restitution: f64) -> Model {
    let side = 4;
    let spacing = 2.0 * RADIUS * (1.0 - PRESSED);
    let grain = |number: usize| {
        let cell = [number % side, number / side % side, number / side / side].map(|index| index as f64 + 0.5);
        let place = Vec3::from(cell) * spacing;
        let body = match shape {
            GrainShape::Sphere => GrainBody::sphere(RADIUS, DENSITY),
            // As wide as the cell in its longest direction.
            GrainShape::Clump => GrainBody::clump(2.0 * RADIUS * 0.82, 1.5, DENSITY),
        };
        let axis = [Vec3::x(), Vec3::y(), Vec3::z()][number % 3];
        let mut grain = Grain::at(number as u32, place, axis, body);
        grain.velocity = nudge(number);
        grain
    };
    let mut model = free_model((0..side * side * side).map(grain).collect(), shape);
    model.material = material(restitution, 0.5);
    model.surfaces = closed_box(Vec3::repeat(spacing * side as f64));
    model
}

fn wedge() -> Model {
    let mut grain = ball(0, Vec3::zeros(), RADIUS, DENSITY);
    grain.velocity = nudge(1);
    let mut model = free_model(vec![grain], GrainShape::Sphere);
    model.material = material(1.0, 0.0);
    let half = 20_f64.to_radians();
    let near = RADIUS * (1.0 - PRESSED);
    let normals = [
        Vec3::new(libm::sin(half), 0.0, libm::cos(half)),
        Vec3::new(libm::sin(half), 0.0, -libm::cos(half)),
        -Vec3::x(),
    ];
    model.surfaces = normals.map(|normal| plane(SurfaceRole::Side, normal * -near, normal, 0.0)).to_vec();
    model
}

/// Steel over the full circle (kg/m³), and the ropes' modulus (Pa).
const STEEL: f64 = 7850.0;
const ROPE_MODULUS: f64 = 4e9;

fn node(position: Vec3, mass: f64, fixed: bool, number: usize) -> Node {
    let velocity = if fixed { Vec3::zeros() } else { nudge(number) };
    Node { position, velocity, mass, fixed, radius: 0.0 }
}

/// A rope of 2.1 m along y, stretched by a hundredth, `ropes` of them between the same nodes.
fn taut(element: f64, stiffer: f64, ropes: usize, radius: f64) -> Barrier {
    let parts = (2.1 / element).round() as usize;
    let part = 2.1 / parts as f64;
    let area = std::f64::consts::PI * radius * radius;
    let mass = STEEL * area * part * ropes as f64;
    let mut barrier = Barrier { friction: 0.4, contact_modulus: ROPE_MODULUS, ..Barrier::default() };
    for number in 0..=parts {
        let fixed = number == 0 || number == parts;
        barrier.nodes.push(node(Vec3::y() * (part * number as f64), mass, fixed, number));
    }
    let rest_length = part / 1.01;
    let stiffness = stiffer * ROPE_MODULUS * area / rest_length;
    for number in 0..parts as u32 {
        for _ in 0..ropes {
            barrier.segments.push(Segment {
                nodes: [number, number + 1],
                kind: SegmentKind::Main(0),
                rest_length,
                stiffness,
                damping: 0.1 * (stiffness * 0.5 * mass).sqrt(),
                radius,
                strength: Strength::default(),
            });
        }
    }
    barrier.connect();
    barrier
}

/// Rings in a frame; `stretch` is the way round each over the one from which it is taut.
fn rings(lattice: fn(f64) -> Lattice, stretch: f64) -> Model {
    const ACROSS: i32 = 4;
    let mut barrier = ring_panel(lattice(1.0), ACROSS);
    let law = RingLaw::of(&chain_of(&WIRES), 0.3);
    // Drawn from a way round each ring of one side for every contact.
    let unit = lattice(1.0);
    let drawn = stretch * law.taut_from / (unit.corners().len() as f64 * unit.side());
    for (number, node) in barrier.nodes.iter_mut().enumerate() {
        node.position *= drawn;
        node.velocity = if node.fixed { Vec3::zeros() } else { nudge(number) };
        node.radius = 0.0;
    }
    for ring in &mut barrier.net_rings {
        ring.damping = 0.1 * (law.stiffness * mass(&WIRES, 0.3, STEEL) / 32.0).sqrt();
        ring.touched.clear();
    }
    with_barrier(barrier, far_ball())
}

const WIRES: Wires = Wires { windings: 12, diameter: 3e-3, strength: 1.77e9 };

fn four(spacing: f64) -> Lattice {
    Lattice::FourContacts { spacing }
}

fn six(spacing: f64) -> Lattice {
    Lattice::SixContacts { spacing }
}

/// Ropes of 8 mm in hexagons of 300 mm in a frame, stretched by a hundredth.
fn hexagons() -> Model {
    let mut barrier = Panel { axial: 4e6, slack: 0.0, mesh: 0.3, pieces: 1 }.build_hexagons();
    for (number, node) in barrier.nodes.iter_mut().enumerate() {
        node.position *= 1.01;
        node.velocity = if node.fixed { Vec3::zeros() } else { nudge(number) };
    }
    with_barrier(barrier, far_ball())
}

fn swinging_rings() -> Model {
    let mut model = rings(four, 0.99);
    for (number, node) in model.barrier.iter_mut().flat_map(|barrier| &mut barrier.nodes).enumerate() {
        node.velocity = if node.fixed { Vec3::zeros() } else { nudge(number) * 5e3 };
    }
    model
}

/// A grain far away, which every model has one of.
fn far_ball() -> Grain {
    ball(0, Vec3::repeat(1e3), RADIUS, DENSITY)
}

fn with_barrier(barrier: Barrier, grain: Grain) -> Model {
    let mut model = free_model(vec![grain], GrainShape::Sphere);
    model.barrier = Some(barrier);
    model
}

fn rope(element: f64, stiffer: f64, ropes: usize) -> Model {
    with_barrier(taut(element, stiffer, ropes, 0.016), far_ball())
}

fn cylinders(element: f64) -> Model {
    let section = dem::elements::cylinder::Section::round(0.016, ROPE_MODULUS, 0.3);
    let parts = (0.7 / element).round() as usize;
    let mass = STEEL * std::f64::consts::PI * 0.016 * 0.016 * element;
    let mut barrier = Barrier { contact_modulus: ROPE_MODULUS, ..Barrier::default() };
    for number in 0..=parts {
        let fixed = number == 0;
        barrier.nodes.push(node(Vec3::x() * (element * number as f64), mass, fixed, number));
        barrier.frames.push(Frame {
            orientation: UnitQuaternion::identity(),
            spin: Vec3::zeros(),
            inertia: mass * (element * element / 12.0 + 0.016 * 0.016 / 4.0),
            held: fixed,
        });
    }
    for number in 0..parts {
        let ends = [number, number + 1];
        let places = ends.map(|end| &barrier.nodes[end].position);
        let frames = ends.map(|end| &barrier.frames[end]);
        barrier.cylinders.push(Cylinder::between(
            ends.map(|end| end as u32),
            SegmentKind::Main(0),
            section,
            places,
            frames,
        ));
    }
    barrier.connect();
    with_barrier(barrier, far_ball())
}

/// A grain on the middle of a taut rope: pressed on it, or on its way to it at `speed` (m/s).
fn grain_on_rope(speed: f64) -> Model {
    let (grain_radius, rope_radius) = if speed > 0.0 { (0.05, 0.005) } else { (0.225, 0.008) };
    let barrier = taut(0.07, 1.0, 1, rope_radius);
    let reach = grain_radius + rope_radius;
    let away = if speed > 0.0 { reach * 1.05 } else { reach - 0.2 * rope_radius };
    let mut grain = ball(0, Vec3::new(-away, 1.05, 0.0), grain_radius, DENSITY);
    grain.velocity = Vec3::x() * speed;
    let mut model = with_barrier(barrier, grain);
    model.material.modulus = MODULUS;
    model
}

/// A taut rope, and a light knot beside its middle on a rope of its own that is slack: once taut, that is the stiffest there is.
fn snap() -> Model {
    let mut barrier = taut(0.07, 1.0, 1, 0.016);
    let middle = barrier.nodes.len() / 2;
    let like = barrier.segments[0].clone();
    let beside = barrier.nodes[middle].position + Vec3::x() * 0.06;
    let mut knot = node(beside, 0.2 * barrier.nodes[middle].mass, false, 0);
    knot.velocity = Vec3::x() * 10.0;
    barrier.nodes.push(knot);
    barrier.segments.push(Segment { nodes: [middle as u32, barrier.nodes.len() as u32 - 1], ..like });
    barrier.connect();
    with_barrier(barrier, far_ball())
}

/// A taut rope that is pushed so that one of its segments breaks.
fn breaking() -> Model {
    let mut barrier = taut(0.07, 1.0, 1, 0.016);
    let middle = barrier.segments.len() / 2;
    let segment = &mut barrier.segments[middle];
    let tension = segment.stiffness * (0.07 - segment.rest_length);
    segment.strength.breaking = 1.02 * tension;
    let node = segment.nodes[0] as usize;
    barrier.nodes[node].velocity = Vec3::new(5.0, 5.0, 0.0);
    with_barrier(barrier, far_ball())
}

/// A grain that a taut rope, drawn aside by it, presses on the bed; nearly in balance.
fn squeezed() -> Model {
    const ASIDE: f64 = 0.05;
    let (radius, rope_radius, half) = (0.225, 0.008, 1.05);
    let mut barrier = taut(0.07, 1.0, 1, rope_radius);
    for node in &mut barrier.nodes {
        node.position.x = ASIDE * (1.0 - (node.position.y - half).abs() / half);
    }
    let segment = &barrier.segments[0];
    let [a, b] = segment.nodes.map(|node| barrier.nodes[node as usize].position);
    let tension = segment.stiffness * ((b - a).norm() - segment.rest_length);
    let push = 2.0 * tension * ASIDE / half;
    let grain_stiffness = MODULUS * radius;
    let on_rope = push / contact_stiffness(grain_stiffness, ROPE_MODULUS * rope_radius);
    let place = ASIDE - radius - rope_radius + on_rope;
    let mut grain = ball(0, Vec3::new(place, half, 0.0), radius, DENSITY);
    grain.velocity = nudge(3);
    let mut model = with_barrier(barrier, grain);
    model.material.modulus = MODULUS;
    let bed = Vec3::x() * (place - radius + push / grain_stiffness);
    model.surfaces = vec![plane(SurfaceRole::Base, bed, Vec3::x(), 0.4)];
    model
}

fn post_on_ropes() -> Model {
    let mut barrier = post(Vec3::z() * 3.0, Vec3::zeros(), Some(3e7));
    barrier.nodes[1].velocity = nudge(1);
    for rope in &mut barrier.segments {
        rope.set_rest_length(0.999 * rope.rest_length);
    }
    with_barrier(barrier, far_ball())
}

fn stop() -> Model {
    let mut barrier = Barrier { contact_modulus: ROPE_MODULUS, ..Barrier::default() };
    // Beyond its stop by 7 mm, held by a rope of a hundredth of its stiffness.
    let place = |y: f64, fixed: bool, number: usize| node(Vec3::y() * y, 0.5, fixed, number);
    barrier.nodes = vec![place(0.0, true, 0), place(2.567, false, 1), place(3.567, true, 2)];
    let (tension, stiffness) = (46e6 * 0.007, 46e4);
    barrier.segments.push(Segment {
        nodes: [1, 2],
        kind: SegmentKind::Main(0),
        rest_length: 1.0 - tension / stiffness,
        stiffness,
        damping: 0.0,
        radius: 0.016,
        strength: Strength::default(),
    });
    barrier.dissipators = vec![Dissipator {
        nodes: [0, 1],
        kind: SegmentKind::Main(0),
        rest_length: 0.06,
        radius: 0.016,
        stiffness: 46e6,
        plateau: 250e3,
        curve: YieldCurve::default(),
        stroke: 2.5,
        used: 2.5,
    }];
    barrier.connect();
    with_barrier(barrier, far_ball())
}

#[cfg(test)]
mod tests {
    use super::*;
    use dem::simulation::Simulation;

    /// The scenes do what they say, at a tenth of the limit.
    #[test]
    fn what_should_break_snap_or_stay_squeezed_does() {
        let run = |build: fn() -> Model, look: &mut dyn FnMut(&Simulation)| {
            let step = 0.1 * Simulation::new(build(), 1e-6, 0.01, 1e6).time_step.max(7e-5);
            let mut simulation = Simulation::new(build(), step, 0.01, 1e6);
            for _ in 0..20_000 {
                simulation.step().expect("stable");
                look(&simulation);
            }
            simulation
        };
        let broken = run(breaking, &mut |_| ());
        assert_eq!(broken.model.barrier.iter().flat_map(Barrier::strengths).filter(|piece| piece.broken).count(), 1);
        let (mut taut, mut slack) = (0, 0);
        run(snap, &mut |simulation| {
            let pulls = simulation.sums.net.tensions.last().is_some_and(|tension| *tension > 0.0);
            *(if pulls { &mut taut } else { &mut slack }) += 1;
        });
        assert!(taut > 20 && slack > 500, "{taut} {slack}");
        let mut both = 0;
        run(squeezed, &mut |simulation| {
            let block = &simulation.neighbours.blocks[0];
            both += usize::from(!block.surfaces.touching.is_empty() && !block.ropes.list.touching.is_empty());
        });
        assert!(both > 15_000, "{both}");
    }
}
