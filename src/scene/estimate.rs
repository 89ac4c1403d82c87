//! What a run will take, before it is made: grains, steps, time, memory.

use crate::design::hydrograph::Hydrograph;
use crate::design::{BarrierDesign, BarrierModel, Design, Flow};
use crate::fidelity::{Fidelity, net_pieces};
use crate::scene::build::expected_time;
use crate::scene::flow::packing::{PackingRoom, pack};
use crate::scene::net::build::build as build_net;
use dem::Vec3;
use dem::recorders::film::bytes_of;
use dem::tables::grains::{GrainBody, GrainShape};

/// Estimate of one start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    pub grains: f64,
    pub spheres: f64,
    /// Segments, cylinders and dissipators of the barrier.
    pub elements: f64,
    /// Of the event (s).
    pub simulated: f64,
    pub steps: f64,
    /// On one core (s).
    pub seconds: f64,
    /// Of memory.
    pub bytes: f64,
}

/// Times on one core of a machine that packs the box of [`slowness`] in its time (s), of whole runs of the examples: of a sphere in a step,
/// 29 (flume) to 54 ns (wall_section_5_2), with lists and recorders; of an element in a step of the barrier, 50 to 90 ns, with the grains
/// that touch it.
const SPHERE: f64 = 40e-9;
const SEGMENT: f64 = 60e-9;
const CYLINDER: f64 = 80e-9;
/// Of a sphere while the flow is packed, in all (s); where the flow is nearly as dense as grains can be, attempt after attempt fails.
const PACKED: f64 = 0.1e-3;
const PACKED_DENSE: f64 = 2e-3;
/// Solid share of the flow from which that happens.
const NEARLY_JAMMED: f64 = 0.58;
/// Steps of the barrier in one of the grains' with cylinders: 4 in `site_a`.
const PARTS: f64 = 4.0;
/// Memory of a sphere with its lists (bench: 441 to 660), and of an element with its places in the film (bytes).
const PER_SPHERE: f64 = 700.0;
const PER_ELEMENT: f64 = 128.0 * 10.0 + 600.0;
/// What the program takes anyway.
const BASE: f64 = 40e6;

/// Longest estimate that is run, on one core (s), and most memory (bytes).
pub const MOST_SECONDS: f64 = 48.0 * 3600.0;
pub const MOST_BYTES: f64 = 16e9;

/// How much slower this machine is now than the one that the constants above are of: from the time in which a box of grains is packed,
/// a tenth of a second.
pub fn slowness() -> f64 {
    const GRAINS: usize = 600;
    let bodies = vec![GrainBody::clump(0.1, 1.5, 2650.0); GRAINS];
    let solid = bodies.iter().map(|body| body.mass / 2650.0).sum::<f64>();
    let room = PackingRoom::level(Vec3::repeat(libm::cbrt(solid / 0.6)), true);
    let once = || {
        let started = std::time::Instant::now();
        let packed = pack(&bodies, GrainShape::Clump, room, 1);
        packed.map_or(f64::NAN, |_| started.elapsed().as_secs_f64())
    };
    let taken = once().min(once());
    if taken.is_finite() { taken / BOX } else { 1.0 }
}

/// Time in which that box is packed on the machine that the constants are of (s).
const BOX: f64 = 0.0215;

/// Estimates a start of `design`, modelled as finely as `fidelity` says. To a factor of two: how dense the flow gets is not known.
pub fn estimate(design: &Design, fidelity: &Fidelity) -> Estimate {
    let flow = &design.flow;
    let count = |flow: Flow| flow.sizes.count(flow.mass / flow.grain_density());
    let grains: f64 = (0..flow.surges()).map(|number| count(flow.alone(number))).sum();
    let spheres = grains * if flow.aspect > 1.0 { 2.0 } else { 1.0 };
    let bends = design.simulation.barrier_model == BarrierModel::Cylinders;
    let elements = match &design.barrier {
        BarrierDesign::RigidWall(_) => 0.0,
        BarrierDesign::FlexibleNet(net) => {
            let barrier =
                build_net(net, &design.channel, design.simulation.barrier_model, net_pieces(design, net)).barrier;
            let sides: usize = barrier.net_rings.iter().map(|ring| ring.nodes.len()).sum();
            (barrier.segments.len() + sides + barrier.cylinders.len() + barrier.dissipators.len()) as f64
        }
    };
    // The longest time is counted from where the last of a hydrograph has come in.
    let comes_for = flow.hydrograph.as_ref().map_or(0.0, Hydrograph::duration);
    let simulated = expected_time(design).min(comes_for + design.simulation.longest * flow.surges() as f64);
    let steps = simulated / fidelity.time_step;
    let of_elements = elements * f64::from(fidelity.barrier_steps()) * if bends { PARTS * CYLINDER } else { SEGMENT };
    let packed = if flow.bulk_density / flow.grain_density() > NEARLY_JAMMED { PACKED_DENSE } else { PACKED };
    Estimate {
        grains,
        spheres,
        elements,
        simulated,
        steps,
        seconds: steps * (spheres * SPHERE + of_elements) + spheres * packed,
        bytes: BASE + spheres * PER_SPHERE + bytes_of(grains as usize) as f64 + elements * PER_ELEMENT,
    }
}

impl Estimate {
    /// Why the design should not be run as it is, if so, with what to change.
    pub fn too_much(&self) -> Option<String> {
        let change = "to reduce it, use larger grains (flow.grain_sizes), less flow (flow.mass or flow.volume), a softer flow.contact_modulus or simulation.fidelity: fast";
        if self.seconds > MOST_SECONDS {
            let limit = MOST_SECONDS / 3600.0;
            return Some(format!(
                "it would take about {:.0} hours on one core, and the limit is {limit:.0}; {change}",
                self.seconds / 3600.0
            ));
        }
        (self.bytes > MOST_BYTES).then(|| {
            format!(
                "it would take about {:.0} GB of memory, and the limit is {:.0}; {change}",
                self.bytes / 1e9,
                MOST_BYTES / 1e9
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::read::read_design;
    use crate::fidelity::choose;

    #[test]
    fn the_estimate_knows_the_grains_and_refuses_what_is_too_much() {
        let mut design = read_design("x", include_bytes!("../../designs/site_a.yaml")).unwrap().design;
        let first = estimate(&design, &choose(&design));
        assert!((first.grains - 2646.0).abs() < 10.0 && first.spheres == 2.0 * first.grains, "{first:?}");
        assert_eq!(first.too_much(), None);
        design.flow.sizes = design.flow.sizes.scaled(0.05);
        assert!(estimate(&design, &choose(&design)).too_much().is_some());
    }
}
