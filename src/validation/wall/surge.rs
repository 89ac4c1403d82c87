//! W1: a surge on a rigid wall hits as hard with soft grains as with hard ones.
//!
//! A surge that starts as a packed block with a vertical face hits everywhere at once, and while it moves as one body the contact
//! modulus decides how hard: 549, 983 and 1374 kN/m with 0.01, 0.05 and 0.2 GPa in one such scene. With a front and a run-in the grains
//! have room, and what is left is the flow's own momentum.

use crate::quantities::total_force;
use crate::validation::barrier::full_scale::run_changed;
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};

pub const MODULUS: Case = Case {
    id: "W1",
    suite: Suite::Wall,
    title: "A surge on a rigid wall with grains of 0.02, 0.1 and 0.5 GPa",
    source: "independence of a numerical parameter: means of six packings within two standard deviations of their difference",
    tier: Tier::ClosedForm,
    weakness: "where grains overlap by more than the limit (fast flows of soft grains) forces are 20 to 30 % low; such runs are undecided",
    cost: Cost::Long,
    run,
};

const PACKINGS: u32 = 6;
/// Pa
const MODULI: [f64; 3] = [0.02e9, 0.1e9, 0.5e9];

const SURGE: &str = "
project: {name: Surge on a wall, barrier: Wall}
channel: {width: 8 m, slope: 12 deg, wall_height: 8 m, base_friction: 12 deg, side_friction: 5 deg, barrier_friction: 20 deg}
flow:
  volume: 100 m3
  bulk_density: 1500 kg/m3
  solid_density: 2700 kg/m3
  grain_sizes: {uniform: {min: 300 mm, max: 400 mm}}
  grain_friction: 35 deg
  arrival: {surge: {depth: 1 m, velocity: 2 m/s}}
barrier:
  rigid_wall: {height: 4 m, resistance: 1 MN}
";

fn run() -> Result<Vec<Finding>, Broken> {
    let mut findings = Vec::new();
    let mut spreads = Vec::new();
    for modulus in MODULI {
        let run = run_changed(SURGE, PACKINGS, |design| design.flow.modulus = modulus)?;
        let spread = run.spread(|seen| seen.one(&total_force::PEAK));
        let name = format!("{} GPa", modulus / 1e9);
        findings.push(Finding::told(format!("{name}: largest force (kN)"), spread.mean / 1e3));
        findings.push(Finding::told(format!("{name}: its standard deviation (kN)"), spread.deviation / 1e3));
        findings.push(Finding::told(
            format!("{name}: force at rest (kN)"),
            run.spread(|seen| seen.one(&total_force::RESIDUAL)).mean / 1e3,
        ));
        findings.push(Finding::between(format!("{name}: largest overlap over radius"), run.numerics.overlap, 0.0, 0.2));
        let stored = run.numerics.stored_at_release;
        findings.push(Finding::between(
            format!("{name}: energy stored at the release, of that of motion"),
            stored,
            0.0,
            0.01,
        ));
        spreads.push(spread);
    }
    let middle = spreads[1];
    for (modulus, spread) in MODULI.into_iter().zip(&spreads) {
        // Of one packing, as a designer meets it.
        let scatter = libm::hypot(spread.deviation, middle.deviation).max(1e-9);
        let apart = (spread.mean - middle.mean) / scatter;
        let what = format!(
            "largest force of {} GPa less that of 0.1 GPa, over the scatter of their difference",
            modulus / 1e9
        );
        findings.push(Finding::close(what, apart, 0.0, 2.0));
    }
    Ok(findings)
}
