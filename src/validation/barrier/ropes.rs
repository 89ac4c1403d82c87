//! D1, D9, D10, D13, D14, D15: tension-only ropes against closed forms.

use crate::validation::barrier::stand::{Stand, line, line_mass, rope, section};
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::GRAVITY;
use dem::Vec3;
use dem::elements::dissipator::Dissipator;
use dem::elements::segment::SegmentKind;
use dem::elements::yield_curve::YieldCurve;
use dem::tables::barrier::Barrier;

pub const BAR: Case = Case {
    id: "D1",
    suite: Suite::Rope,
    title: "A rope pulled along itself: stretch and speed of sound",
    source: "u = F L/EA; first frequency √(EA/ρA)/4L of a bar held at one end",
    tier: Tier::ClosedForm,
    weakness: "pulled all the time: a rope does not push",
    cost: Cost::Quick,
    run: bar,
};

pub const HANGING: Case = Case {
    id: "D9",
    suite: Suite::Rope,
    title: "A rope hanging between two points at one height",
    source: "Inextensible catenary",
    tier: Tier::ClosedForm,
    weakness: "the rope stretches a little",
    cost: Cost::Quick,
    run: hanging,
};

pub const SWINGING: Case = Case {
    id: "D10",
    suite: Suite::Rope,
    title: "A rope hung from one end swings",
    source: "ω = 1.2024 √(g/L) and 2.7600 √(g/L) (zeros of the Bessel function J₀)",
    tier: Tier::ClosedForm,
    weakness: "small swings only",
    cost: Cost::Quick,
    run: swinging,
};

pub const POINT_LOAD: Case = Case {
    id: "D13",
    suite: Suite::Rope,
    title: "A straight rope pulled sideways in its middle",
    source: "F = 2 EA (√(a²+δ²)/a − 1) δ/√(a²+δ²)",
    tier: Tier::ClosedForm,
    weakness: "no weight",
    cost: Cost::Quick,
    run: point_load,
};

pub const BRAKED: Case = Case {
    id: "D14",
    suite: Suite::Rope,
    title: "A rope under a load along its length, with dissipators at both ends",
    source: "Elastic catenary under a load by its rest length, whose end tension is the plateau",
    tier: Tier::ClosedForm,
    weakness: "loaded slowly enough that the dissipators do not overshoot",
    cost: Cost::Quick,
    run: braked,
};

pub const BLOCK: Case = Case {
    id: "D15",
    suite: Suite::Rope,
    title: "A block of 5000 kg at 2 m/s is caught by a rope in its middle",
    source: "½ M v² = stretch energy of the two halves",
    tier: Tier::ClosedForm,
    weakness: "the rope's own mass is two parts in a hundred of the block's",
    cost: Cost::Quick,
    run: block,
};

const SPAN: f64 = 15.2;

/// Share of the critical step 2/ω of two neighbouring parts at which ropes are stepped.
const STEP_SHARE: f64 = 0.4;

fn step(part: f64) -> f64 {
    STEP_SHARE * part / (section().axial / line_mass()).sqrt()
}

fn bar() -> Result<Vec<Finding>, Broken> {
    let (parts, load) = (20, 1e4);
    let pulled = |load: f64| {
        let points = line(Vec3::zeros(), Vec3::x(), parts);
        let mut stand = Stand::new(rope(&points, [true, false], 1.0), step(1.0 / parts as f64));
        stand.loads = vec![(parts, Vec3::x() * load, Vec3::zeros())];
        stand
    };
    let mut stand = pulled(load);
    stand.relax(1000.0);
    let stretch = stand.barrier.nodes[parts].position.x - 1.0;
    // Pulled a little harder, it swings about the new length without going slack.
    stand.loads[0].1 *= 1.1;
    let rest = 1.0 + 1.1 * load / section().axial;
    let period = stand.period(1.0, |barrier| barrier.nodes[parts].position.x - rest)?;
    let speed = 4.0 * rest / period;
    Ok(vec![
        Finding::near("stretch under 10 kN (m)", stretch, load / section().axial, 1e-3),
        Finding::near("speed of sound (m/s)", speed, (section().axial / line_mass()).sqrt() * rest, 0.01),
    ])
}

fn hanging() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    for (length, sag, pull) in [(1.05, 0.139_304, 0.919_64), (1.2, 0.292_344, 0.469_54)] {
        let parts = 40;
        let points = line(Vec3::zeros(), Vec3::x() * SPAN, parts);
        let mut stand = Stand::new(rope(&points, [true; 2], length), step(SPAN / parts as f64));
        stand.gravity = Vec3::z() * -GRAVITY;
        stand.relax(1.5);
        let name = |what: &str| format!("length over span {length}: {what}");
        let middle = stand.barrier.nodes[parts / 2].position.z;
        findings.push(Finding::near(name("sag over span"), -middle / SPAN, sag, 0.01));
        let weight = line_mass() * GRAVITY;
        // The first part pulls at its end with the whole tension; its horizontal share is the same all along.
        let first = stand.barrier.nodes[1].position - stand.barrier.nodes[0].position;
        let horizontal = stand.net.tensions[0] * first.x / first.norm();
        findings.push(Finding::near(
            name("horizontal pull over w times span"),
            horizontal / (weight * SPAN),
            pull,
            0.01,
        ));
    }
    Ok(findings)
}

fn swinging() -> Result<Vec<Finding>, Broken> {
    let (parts, length) = (40, 1.0);
    let mut findings = Vec::new();
    for (mode, root) in [(1, 1.202_413), (2, 2.760_039)] {
        let mut stand = Stand::new(
            rope(&line(Vec3::z() * length, Vec3::zeros(), parts), [true, false], 1.0),
            step(length / parts as f64),
        );
        stand.gravity = Vec3::z() * -GRAVITY;
        let shape = |z: f64| bessel(2.0 * root * (z.max(0.0) / length).sqrt());
        for node in stand.barrier.nodes.iter_mut().filter(|node| !node.fixed) {
            node.velocity.x = 0.01 * shape(node.position.z);
        }
        // Free of the stretch under its own weight, which would ring.
        let hung = line_mass() * GRAVITY;
        let heights: Vec<f64> = stand.barrier.nodes.iter().map(|node| node.position.z).collect();
        for (node, z) in stand.barrier.nodes.iter_mut().zip(&heights) {
            node.position.z -= hung * (length * length - z * z) / (2.0 * section().axial);
        }
        let share = |barrier: &Barrier| {
            barrier.nodes.iter().zip(&heights).map(|(node, z)| node.mass * shape(*z) * node.position.x).sum()
        };
        let expected = root * (GRAVITY / length).sqrt();
        let period = stand.period(80.0 / expected, share)?;
        findings.push(Finding::near(format!("mode {mode}: ω (rad/s)"), std::f64::consts::TAU / period, expected, 0.01));
    }
    Ok(findings)
}

/// J₀ by its series.
fn bessel(x: f64) -> f64 {
    let (mut term, mut sum) = (1.0, 1.0);
    for number in 1..30 {
        term *= -(0.25 * x * x) / f64::from(number * number);
        sum += term;
    }
    sum
}

fn point_load() -> Result<Vec<Finding>, Broken> {
    let parts = 20;
    let mut findings = Vec::new();
    for deflection in [0.5, 1.0, 2.0, 3.0_f64] {
        let mut barrier = rope(&line(Vec3::zeros(), Vec3::x() * SPAN, parts), [true; 2], 1.0);
        let middle = parts / 2;
        for (number, node) in barrier.nodes.iter_mut().enumerate() {
            // Off the straight lines at first, so that there is something to find.
            let towards = 1.0 - (number as f64 - middle as f64).abs() / middle as f64;
            node.position.z = -deflection * towards.powi(2);
        }
        barrier.nodes[middle].fixed = true;
        let mut stand = Stand::new(barrier, step(SPAN / parts as f64));
        stand.relax(13.0);
        stand.step();
        let half = 0.5 * SPAN;
        let side = (half * half + deflection * deflection).sqrt();
        let expected = 2.0 * section().axial * (side / half - 1.0) * deflection / side;
        findings.push(Finding::near(format!("{deflection} m: force (N)"), stand.net.forces[middle].z, expected, 0.005));
    }
    Ok(findings)
}

fn braked() -> Result<Vec<Finding>, Broken> {
    let (parts, plateau, load) = (40, 250e3, 25e3);
    let mut barrier = rope(&line(Vec3::zeros(), Vec3::x() * SPAN, parts), [false; 2], 1.0);
    for (end, anchor) in [(0, Vec3::zeros()), (parts, Vec3::x() * SPAN)] {
        let mut node = barrier.nodes[end].clone();
        (node.position, node.fixed) = (anchor, true);
        barrier.nodes.push(node);
        barrier.dissipators.push(Dissipator {
            nodes: [barrier.nodes.len() as u32 - 1, end as u32],
            kind: SegmentKind::Main(0),
            rest_length: 0.0,
            radius: 0.016,
            stiffness: 46e6,
            plateau,
            curve: YieldCurve::default(),
            stroke: 2.5,
            used: 0.0,
        });
    }
    // The load comes on slowly, with the weight of the rope multiplied: it goes by length, as on the catenary.
    let mut stand = Stand::new(barrier, 0.5 * step(SPAN / parts as f64));
    let (rise, factor) = (12.0, load / line_mass());
    let steps = (rise / stand.step) as usize;
    let damping = 1.0 - 20.0 * stand.step;
    for number in 0..2 * steps {
        stand.gravity = Vec3::z() * (-factor * (number as f64 / steps as f64).min(1.0));
        stand.step();
        stand.barrier.nodes.iter_mut().for_each(|node| node.velocity *= damping);
    }
    // Ends pull with the plateau; half the load hangs on each. What the rope's own span lacks the dissipators bridge, along
    // the tangent.
    let weight = load * SPAN;
    let (vertical, stretch) = (0.5 * weight, section().axial);
    let horizontal = (plateau * plateau - vertical * vertical).sqrt();
    let own_span = horizontal * SPAN / stretch + 2.0 * horizontal / load * libm::asinh(vertical / horizontal);
    let stroke = 0.5 * (SPAN - own_span) * plateau / horizontal;
    let own_sag = weight * SPAN / (8.0 * stretch) + (plateau - horizontal) / load;
    let sag = own_sag + stroke * vertical / plateau;
    let used = stand.barrier.dissipators.iter().map(|dissipator| dissipator.used).sum::<f64>() / 2.0;
    Ok(vec![
        Finding::near("sag (m)", -stand.barrier.nodes[parts / 2].position.z, sag, 0.03),
        Finding::near("stroke of each dissipator (m)", used, stroke, 0.03),
        Finding::near("tension at the ends (N)", stand.net.dissipators[0], plateau, 0.03),
    ])
}

fn block() -> Result<Vec<Finding>, Broken> {
    let (parts, mass, speed) = (20, 5000.0, 2.0);
    let mut barrier = rope(&line(Vec3::zeros(), Vec3::x() * SPAN, parts), [true; 2], 1.0);
    let middle = parts / 2;
    barrier.nodes[middle].mass += mass;
    barrier.nodes[middle].velocity.z = -speed;
    let mut stand = Stand::new(barrier, 0.5 * step(SPAN / parts as f64));
    let mut deepest = 0.0_f64;
    while stand.barrier.nodes[middle].velocity.z <= 0.0 {
        stand.step();
        deepest = deepest.max(-stand.barrier.nodes[middle].position.z);
    }
    // Energy of both halves at δ: EA a (√(1+δ²/a²) − 1)².
    let (a, energy) = (0.5 * SPAN, 0.5 * mass * speed * speed);
    let stretch = (energy / (section().axial * a)).sqrt();
    let expected = a * ((1.0 + stretch).powi(2) - 1.0).sqrt();
    Ok(vec![
        Finding::near("deepest point (m)", deepest, expected, 0.03),
        Finding::near("the same, closed form against the tabulated 1.536 m", expected, 1.536, 0.001),
    ])
}
