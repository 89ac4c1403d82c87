//! D26: a net panel pushed through at and beside its knots, with sides of one piece and of several.

use crate::fidelity::pieces_for;
use crate::validation::barrier::punching::{Panel, push};
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::side_by_side;

pub const CASE: Case = Case {
    id: "D26",
    suite: Suite::Net,
    title: "A net panel pushed through at a knot and beside it, with sides divided as the grains need",
    source: "the same panel with sides of eight pieces",
    tier: Tier::ClosedForm,
    weakness: "one displacement; eight pieces differ from four by up to 5 % still",
    cost: Cost::Long,
    run,
};

/// Displacement (m) at which the forces are compared, and speed of the push (m/s).
const DISPLACEMENT: f64 = 0.225;
const SPEED: f64 = 2.0;
/// EA of the net's ropes (N).
const AXIAL: f64 = 1e6;
const FINEST: u32 = 8;
/// Sides of the mesh and radii of the body (m).
const SCENES: [[f64; 2]; 3] = [[0.15, 0.34], [0.15, 0.15], [0.3, 0.34]];
const PLACES: [&str; 3] = ["on a knot", "on the middle of a side", "in the middle of a mesh"];

fn run() -> Result<Vec<Finding>, Broken> {
    let places = 0..PLACES.len();
    let scenes: Vec<([f64; 2], usize)> =
        SCENES.into_iter().flat_map(|scene| places.clone().map(move |place| (scene, place))).collect();
    let pieces_of = |[mesh, radius]: [f64; 2]| [1, pieces_for(mesh, radius), FINEST];
    let forces = side_by_side(3 * scenes.len(), |job| {
        let (scene, place) = scenes[job / 3];
        let panel = Panel { axial: AXIAL, slack: 0.0, mesh: scene[0], pieces: pieces_of(scene)[job % 3] };
        // Half a side of the mesh along it, and half its diagonal.
        let half_side = 0.5 * panel.side() * std::f64::consts::FRAC_1_SQRT_2;
        let at = [[0.0, 0.0], [half_side, half_side], [2.0 * half_side, 0.0]][place];
        push(&panel, scene[1], at, SPEED, &[DISPLACEMENT]).map(|forces| forces[0])
    });
    let forces = forces.into_iter().collect::<Result<Vec<f64>, _>>()?;
    let mut findings = Vec::new();
    for ((scene, place), forces) in scenes.iter().zip(forces.chunks(3)) {
        let [mesh, radius] = scene.map(|length| 1e3 * length);
        let what = format!("mesh {mesh:.0} mm, body of radius {radius:.0} mm, {}", PLACES[*place]);
        let [_, pieces, _] = pieces_of(*scene);
        findings
            .push(Finding::told(format!("{what}: force with one piece over that with eight"), forces[0] / forces[2]));
        findings.push(Finding::near(format!("{what}: with {pieces}"), forces[1] / forces[2], 1.0, 0.08));
    }
    Ok(findings)
}
