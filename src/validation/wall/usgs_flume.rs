//! C15: the run-up tests of the USGS flume, as a dry flow with a smaller and smaller friction of the bed.

use crate::design::{Arrival, Design};
use crate::quantities::{incoming, run_up};
use crate::simulated::Simulated;
use crate::units::GRAVITY;
use crate::validation::barrier::full_scale::run_changed;
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::side_by_side;
use dem::recorders::of_level;

pub const CASE: Case = Case {
    id: "C15",
    suite: Suite::Wall,
    title: "A dry flow in the USGS flume, from 66 m on: which friction of the bed meets arrival and run-up on the wall",
    source: "Iverson, George & Logan 2016, two tests of June 1994: 15 m/s at 66 m, 5.5 to 10 m/s at the wall, run-up 1.62 and 2.05 m with pulses between 1.2 and 2.4 m, deposit 0.70 m",
    tier: Tier::Published,
    weakness: "grains of 75 mm for sand and gravel, in a flow two to three grains deep; one even surge for pulses; the open side of the last 3.6 m is closed; no water: what is stopped stays heaped up, where the saturated flow fell back to less than half",
    cost: Cost::Long,
    run,
};

const DESIGN: &str = include_str!("../../../designs/usgs_flume.yaml");
/// Friction angles of the bed (deg): the one told with the tests, and less, as with pressure in the pores.
const FRICTIONS: [f64; 3] = [28.0, 24.0, 20.0];
/// Velocity at 66 m (m/s).
const RELEASED: f64 = 15.0;
/// Time until the flow is stopped (s).
const LONGEST: f64 = 4.5;

/// The flume with another friction of its bed, its flow let go with the velocity told at 66 m.
fn with_friction(design: &mut Design, friction: f64) {
    design.channel.base_friction = libm::tan(friction.to_radians());
    design.simulation.longest = LONGEST;
    let profile = design.channel.profile.clone();
    if let (Arrival::Surge(surge), Some(profile)) = (&mut design.flow.arrival, profile) {
        // The velocity of a design is that of a body that slides to the wall.
        let gain = profile.gain(surge.run_in, design.channel.base_friction);
        surge.velocity = (RELEASED * RELEASED + 2.0 * GRAVITY * gain).sqrt();
    }
}

fn run() -> Result<Vec<Finding>, Broken> {
    let runs =
        side_by_side(FRICTIONS.len(), |index| run_changed(DESIGN, 1, |design| with_friction(design, FRICTIONS[index])));
    let mut findings = Vec::new();
    for (friction, run) in FRICTIONS.into_iter().zip(runs) {
        let run = run?;
        let seen = run.first();
        let front = seen.known(&incoming::FRONT).unwrap_or(f64::NAN);
        let [highest, left] = [seen.one(&run_up::LEVEL), level_at_the_end(&run)];
        let at = |what: &str| format!("{friction}°: {what}");
        if friction == FRICTIONS[0] {
            findings.push(Finding::between(
                at("velocity of the front at the wall (m/s), measured 10"),
                front,
                7.5,
                12.5,
            ));
            findings.push(Finding::between(at("highest level at the wall (m)"), highest, 1.2, 2.4));
        } else {
            findings.push(Finding::told(at("velocity of the front at the wall (m/s), measured 10"), front));
            findings.push(Finding::told(at("highest level at the wall (m), measured 1.2 to 2.4"), highest));
        }
        findings.push(Finding::told(at("arrival after 66 m (s)"), arrival(&run)));
        findings.push(Finding::told(at("level left at the wall (m), measured 0.70"), left));
    }
    Ok(findings)
}

fn level_at_the_end(run: &Simulated) -> f64 {
    run.histories.barrier.series(&of_level::LEVEL).last().copied().unwrap_or(f64::NAN)
}

/// When the front is at the wall (s).
fn arrival(run: &Simulated) -> f64 {
    let levels = run.histories.barrier.series(&of_level::LEVEL);
    let arrived = levels.iter().position(|level| *level > 0.0);
    arrived.and_then(|sample| run.histories.time.get(sample).copied()).unwrap_or(f64::NAN)
}
