//! FS3 to FS6: the full-scale barrier with one thing changed, as in the thesis's chapters 4.6 and 5.

use crate::design::{BarrierDesign, Bottom, Design, FlexibleNet, LateralTo};
use crate::pipeline::Simulated;
use crate::validation::barrier::full_scale::run_changed;
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};

pub const SLOPE: Case = Case {
    id: "FS3",
    suite: Suite::FullScale,
    title: "The full-scale barrier without dissipators on a slope of 30°",
    source: "Albaba 2015, section 4.6.1: 5.4 m/s, 1645 kN and 1550 kN; the force sets in at 3.05 s",
    tier: Tier::SecondHand,
    weakness: "the release was chosen by the velocity and the time here and at 40°; the forces are predictions",
    cost: Cost::Long,
    run: slope,
};

pub const OPENINGS: Case = Case {
    id: "FS4",
    suite: Suite::FullScale,
    title: "What gets under a free lowest rope, and through a mesh of D90",
    source: "Albaba 2015, section 5.4: all goes under with a gap of D30; a mesh of D90 holds 97 % (barrier of 11 m, no dissipators)",
    tier: Tier::SecondHand,
    weakness: "one start; D30 and D90 of a curve that is not printed",
    cost: Cost::Long,
    run: openings,
};

pub const ORIENTATION: Case = Case {
    id: "FS5",
    suite: Suite::FullScale,
    title: "Plumb net (fbG), net normal to the bed (fbN), rigid wall (rigW)",
    source: "Albaba 2015, sections 5.3 and 5.5: fbN holds much less under a like force; rigW is loaded most, and soonest",
    tier: Tier::SecondHand,
    weakness: "the thesis's figures for fbN and rigW are not at hand: only their order is judged",
    cost: Cost::Long,
    run: orientation,
};

pub const LATERAL: Case = Case {
    id: "FS6",
    suite: Suite::FullScale,
    title: "Lateral ropes to the anchors (des_2) instead of to the dissipators (des_1)",
    source: "Albaba 2015, section 5.5.2: all is held, the dissipators hardly move, force and anchor loads are higher",
    tier: Tier::SecondHand,
    weakness: "the thesis's figures for des_2 are not at hand: only what it says in words is judged",
    cost: Cost::Long,
    run: lateral,
};

const BRAKED: &str = include_str!("../../../designs/site_a.yaml");
const UNBRAKED: &str = include_str!("../../../designs/site_a_no_brakes.yaml");
const WALL: &str = include_str!("../../../designs/rigid_wall.yaml");

fn net(design: &mut Design, change: impl FnOnce(&mut FlexibleNet)) {
    if let BarrierDesign::FlexibleNet(net) = &mut design.barrier {
        change(net);
    }
}

/// When the force first exceeds a hundredth of its peak (s).
fn onset(run: &Simulated) -> f64 {
    let limit = 0.01 * run.first().force_peak;
    let at = run.histories.force.iter().position(|force| force.norm() > limit).unwrap_or(0);
    run.histories.time.get(at).copied().unwrap_or(0.0)
}

fn slope() -> Result<Vec<Finding>, Broken> {
    let run = run_changed(UNBRAKED, |design| design.channel.slope = 30_f64.to_radians())?;
    let seen = run.first();
    Ok(vec![
        Finding::near("highest mean velocity (m/s)", seen.velocity_peak, 5.4, 0.05),
        Finding::near("onset of the force (s)", onset(&run), 3.05, 0.05),
        Finding::near("largest force (kN)", seen.force_peak * 1e-3, 1645.0, 0.15),
        Finding::near("force at rest (kN)", seen.force_residual * 1e-3, 1550.0, 0.15),
        Finding::near("mass held", seen.retained, 1.0, 0.01),
    ])
}

fn openings() -> Result<Vec<Finding>, Broken> {
    let gap = run_changed(UNBRAKED, |design| {
        let fine = design.flow.sizes.quantile(0.3);
        net(design, |net| net.bottom = Bottom::Opening(fine));
    })?;
    let mesh = run_changed(UNBRAKED, |design| {
        let coarse = design.flow.sizes.quantile(0.9);
        design.channel.wall_height = 15.0;
        net(design, |net| {
            let wider = coarse / net.mesh_opening;
            net.mesh_opening = coarse;
            net.main_ropes.ring_spacing *= wider;
            net.height *= 2.0;
            net.main_ropes.heights.iter_mut().for_each(|height| *height *= 2.0);
        });
    })?;
    Ok(vec![
        Finding::between("lost under a free rope, gap D30", gap.first().lost[1], 0.95, 1.0),
        Finding::near("held by a mesh of D90", mesh.first().retained, 0.97, 0.05),
    ])
}

fn orientation() -> Result<Vec<Finding>, Broken> {
    // Strokes of 3.5 m, as there, so that no dissipator is used up.
    let longer = |design: &mut Design| {
        net(design, |net| net.dissipators.iter_mut().for_each(|dissipator| dissipator.stroke = 3.5));
    };
    let plumb = run_changed(BRAKED, longer)?;
    let normal = run_changed(BRAKED, |design| {
        let slope = design.channel.slope;
        longer(design);
        net(design, |net| net.tilt = -slope);
    })?;
    let free = run_changed(UNBRAKED, |_| ())?;
    let wall = run_changed(WALL, |_| ())?;
    let [plumb, normal, free, wall_seen] = [&plumb, &normal, &free, &wall].map(Simulated::first);
    let until_peak = wall_seen.force_peak_time - wall_seen.velocity_peak_time;
    Ok(vec![
        Finding::told("fbG: largest force (kN)", plumb.force_peak * 1e-3),
        Finding::told("fbG: mass held", plumb.retained),
        Finding::told("fbN: mass held", normal.retained),
        Finding::between("fbN: mass held over that of fbG", normal.retained / plumb.retained, 0.0, 0.8),
        Finding::near("fbN: largest force over that of fbG", normal.force_peak / plumb.force_peak, 1.0, 0.1),
        Finding::told("rigW: largest force (kN)", wall_seen.force_peak * 1e-3),
        Finding::between(
            "rigW: largest force over that without dissipators",
            wall_seen.force_peak / free.force_peak,
            1.0,
            2.0,
        ),
        Finding::between("without dissipators over fbG with them", free.force_peak / plumb.force_peak, 1.0, 2.0),
        Finding::close("rigW: from highest velocity to largest force (s)", until_peak, 1.0, 0.3),
    ])
}

fn lateral() -> Result<Vec<Finding>, Broken> {
    let to_dissipators = run_changed(BRAKED, |_| ())?;
    let to_anchors = run_changed(BRAKED, |design| net(design, |net| net.lateral_to = LateralTo::Anchors))?;
    let [first, second] = [&to_dissipators, &to_anchors].map(Simulated::first);
    let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let strokes = [first, second].map(|seen| largest(&seen.brake_stroke_mean));
    let anchors = [first, second].map(|seen| largest(&seen.anchor_force_peak));
    Ok(vec![
        Finding::near("des_2: mass held", second.retained, 1.0, 0.01),
        Finding::between("des_2: largest stroke over that of des_1", strokes[1] / strokes[0], 0.0, 0.25),
        Finding::between("des_2: largest force over that of des_1", second.force_peak / first.force_peak, 1.0, 1.5),
        Finding::between("des_2: largest anchor load over that of des_1", anchors[1] / anchors[0], 1.0, 4.0),
        Finding::told("des_2: largest anchor load (kN)", anchors[1] * 1e-3),
    ])
}
