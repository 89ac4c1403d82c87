//! A base stands in the ground over its whole width, and the ground goes on downstream of it: what stands in the air bears nothing, and what
//! stands on the brink of a slope may slide down with it.
//!
//! Where the bed is steeper than the base, or breaks off, the base comes out of the ground downstream unless it is founded deep enough below the
//! face. Downstream of its edge the ground must stay above a line that falls from there at 30°, or as the bed if that is steeper, over two
//! widths of the base; below that line the stability of the slope decides, which no check asks about. The angle is a rule of practice for footings
//! near slopes, not verified.

use super::context::CheckContext;
use crate::checks::outcome::{OpenReason, Outcome};
use crate::design::{BarrierDesign, Channel};

/// How far the edge of a base may stand above the ground, over its width.
const LEVELLED: f64 = 0.01;
/// Slope of the line above which the ground downstream of a base must stay (tan): 30 degrees.
const BRINK: f64 = 0.577;
/// How far downstream that is asked, over the width of the base.
const WIDTHS_DOWNSTREAM: f64 = 2.0;

pub fn leave_open(CheckContext { design, .. }: CheckContext, outcomes: &mut [Outcome]) {
    let BarrierDesign::RigidWall(wall) = &design.barrier else { return };
    let Some((stability, base_slope)) = wall.stability.and_then(|stability| Some((stability, stability.base_slope?)))
    else {
        return;
    };
    let (sine, cosine) = libm::sincos(base_slope);
    let width = stability.base_width;
    let edge = [width * cosine, -stability.founding_depth - width * sine];
    let Some(reason) = out_of_the_ground(&design.channel, stability.founding_depth, edge, width)
        .or_else(|| on_a_brink(&design.channel, edge, width))
    else {
        return;
    };
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        if matches!(outcome.id.as_str(), "wall_sliding" | "wall_overturning" | "wall_bearing" | "wall_eccentricity") {
            outcome.leave_open(OpenReason::NotGiven(reason.clone()));
        }
    }
}

/// Why a base between the face, founded to a depth there, and its downstream edge does not stand in the ground.
fn out_of_the_ground(channel: &Channel, depth: f64, [edge_x, edge_z]: [f64; 2], width: f64) -> Option<String> {
    let base = |x: f64| -depth + (edge_z + depth) * x / edge_x;
    let above = channel.breaks([0.0, edge_x]).into_iter().map(|x| (x, base(x) - channel.elevation(x)));
    let (x, stands_out) = above.fold((0.0, f64::NEG_INFINITY), |worst, here| {
        // Asked so that what is not a number is kept.
        if here.1 <= worst.1 { worst } else { here }
    });
    // Asked as "in the ground", so that what is not a number is not.
    let in_the_ground = stands_out <= LEVELLED * width;
    (!in_the_ground).then(|| {
        let place = if x < edge_x { format!("the base {x:.1} m downstream of the face") } else { "the base's downstream edge".into() };
        format!(
            "{place} would stand {stands_out:.2} m above the ground (give barrier.rigid_wall.stability.founding_depth, {:.2} m or more, a narrower base, or one as steep as the bed)",
            depth + stands_out
        )
    })
}

/// Why the ground downstream of a base is too steep to be left unjudged.
fn on_a_brink(channel: &Channel, [edge_x, edge_z]: [f64; 2], width: f64) -> Option<String> {
    let falls = BRINK.max(libm::tan(channel.slope));
    let line = |x: f64| edge_z - falls * (x - edge_x);
    let end = edge_x + WIDTHS_DOWNSTREAM * width;
    let below = channel.breaks([edge_x, end]).into_iter().find(|&x| {
        let stays = channel.elevation(x) >= line(x) - LEVELLED * width;
        !stays
    })?;
    Some(format!(
        "downstream of the base the ground falls away: {:.1} m from its edge it lies {:.1} m below it, and the stability of that slope under the wall is not checked (found the wall deeper or further upstream, so that a line from the edge of the base at {:.0} deg downwards stays in the ground)",
        below - edge_x,
        edge_z - channel.elevation(below),
        libm::atan(falls).to_degrees()
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::check_all;
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::Demands;
    use crate::design::read::read_design;
    use crate::guideline::guideline;

    /// What becomes of the check of sliding of the gravity wall, with `change` made to its file.
    fn verdict(depth: f64, change: impl Fn(&str) -> String) -> (CheckVerdict, String) {
        let text = change(include_str!("../../../designs/gravity_wall.yaml"));
        let mut design = read_design("x", text.as_bytes()).unwrap().design;
        let BarrierDesign::RigidWall(wall) = &mut design.barrier else { panic!("a wall") };
        wall.stability.as_mut().expect("stability").founding_depth = depth;
        let guideline = guideline(&design);
        let mut outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
        let outcome = outcomes.iter_mut().find(|outcome| outcome.id == "wall_sliding").expect("a check");
        (outcome.verdict, outcome.open) = (CheckVerdict::Pass, None);
        leave_open(CheckContext { design: &design, guideline: &guideline, seen: None }, &mut outcomes);
        let outcome = outcomes.into_iter().find(|outcome| outcome.id == "wall_sliding").expect("it");
        (outcome.verdict, format!("{:?}", outcome.open))
    }

    /// The bed falls at an angle from a distance downstream of the wall on.
    fn drops(from: &str, angle: &str) -> impl Fn(&str) -> String {
        move |text| {
            text.replacen(
                "  slope: 14 deg",
                &format!("  profile: {{downstream: [[{from}, {angle}]]}}\n  slope: 14 deg"),
                1,
            )
        }
    }

    /// 7 m of a level base on a bed of 14°: 1.745 m, of which 7 cm may be missing.
    #[test]
    fn a_level_base_on_a_slope_is_founded_below_the_bed() {
        let as_it_is = |text: &str| text.to_string();
        let [deep, shallow, unknown] = [1.68, 1.67, f64::NAN].map(|depth| verdict(depth, as_it_is).0);
        assert_eq!([deep, shallow, unknown], [CheckVerdict::Pass, CheckVerdict::Open, CheckVerdict::Open]);
    }

    /// The bed breaks off at 45° a metre from the face: at 7 m it is 0.25 + 6 = 6.25 m down, and the base, 1.8 m down, stands 4.45 m above it.
    #[test]
    fn a_base_does_not_stand_out_of_a_bed_that_breaks_off() {
        let (verdict_there, why) = verdict(1.8, drops("1 m", "45 deg"));
        assert_eq!(verdict_there, CheckVerdict::Open);
        assert!(why.contains("4.45 m above"), "{why}");
    }

    /// A drop of 80° half a metre beyond the edge of the base is on the wrong side of the line at 30°; one of 25° is not.
    #[test]
    fn a_base_does_not_stand_on_a_brink() {
        let (brink, why) = verdict(1.8, drops("7.5 m", "80 deg"));
        assert_eq!(brink, CheckVerdict::Open);
        assert!(why.contains("falls away"), "{why}");
        assert_eq!(verdict(1.8, drops("7.5 m", "25 deg")).0, CheckVerdict::Pass);
    }
}
