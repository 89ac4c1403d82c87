//! What the barrier holds, how high the flow comes up in front of it, and what a flow of this volume is like by rules of thumb.

use crate::checks::height::left_by_sag;
use crate::design::{BarrierDesign, RunUp};
use crate::guideline::event_fill;
use crate::loads::estimates::{manning_strickler, peak_discharge, velocity_and_depth};
use crate::loads::run_up;
use crate::pipeline::Run;
use crate::report::numbers::{figures, with_unit};
use crate::report::row::{Row, row};

/// The rows of the table, in its order.
pub fn rows(run: &Run) -> Vec<Row> {
    let design = &run.file.design;
    let mut rows = Vec::new();
    if let Some(held) = run.guideline.retention {
        let formula = match (&design.channel.survey, &design.channel.profile) {
            (None, None) => format!("V = ½ b H² (cot(α − α') + tan ε), b = {} the width", with_unit(design.channel.width, "m")),
            (Some(_), None) => format!(
                "V = S (cot(α − α') + tan ε), S = {} the first moment of the section's area up to H about its surface",
                with_unit(run.guideline.section.moment(held.deposit.height), "m³")
            ),
            (_, Some(_)) => "summed along the bed, the area of the section under the deposit's surface at every place, reach by reach".to_string(),
        };
        rows.push(row(
            "Volume held behind the barrier",
            with_unit(held.volume, "m³"),
            format!(
                "{formula}, H = {} the height of {}, α = {:.1}° the slope of the bed, α' = {:.1}° that of the deposit's surface (loads.deposit_slope), ε = {:.1}° the lean of the barrier from the bed's normal; over {} of channel. Defaults are from practice, not verified",
                with_unit(held.deposit.height, "m"),
                match run.file.design.barrier {
                    BarrierDesign::RigidWall(_) => "the wall over the bed",
                    BarrierDesign::FlexibleNet(_) => "the sagged net when full (loads.filled_height)",
                },
                held.deposit.slope.to_degrees(),
                held.deposit.surface.to_degrees(),
                held.deposit.lean.to_degrees(),
                with_unit(held.length, "m")
            ),
        ));
        rows.push(row(
            "Number of design surges that the barrier stores",
            figures(held.surges),
            format!(
                "of {} each{}; the event has {}",
                with_unit(design.flow.volume(), "m³"),
                if design.flow.later.is_empty() { ", the design flow" } else { ", the first" },
                with_unit(design.flow.event_volume, "m³")
            ),
        ));
    }
    let input = &run.guideline.input;
    let event = event_fill(design, input);
    rows.push(row(
        "Run-up on the barrier",
        format!("{} / {}", with_unit(run_up::by_jump(input, &run.guideline.section), "m"), with_unit(run_up::by_energy(input), "m")),
        format!(
            "by a momentum jump (Iverson et al. 2016, κ = 1) / by energy h + v²/(2 g cos α), normal to the bed; friction is left out. Froude number {}: {}",
            figures(input.froude()),
            if run_up::by_energy(input) < run_up::by_jump(input, &run.guideline.section) {
                "the energy balance gives less than the jump here, so that it is no upper bound"
            } else {
                "the energy balance is no lower than the jump here; on a wall in the USGS flume, at Froude numbers of 6 to 10, it was several times what was measured, and the jump at or above it (1.0 to 1.5 times)"
            }
        ),
    ));
    rows.push(height_needed(run));
    rows.extend(overflow_width(run));
    let or_unknown =
        |height: f64| if height.is_finite() { with_unit(height, "m") } else { "a height that is not known".into() };
    rows.push(row(
        "Height of the barrier above the deposit of one event",
        if event.height().is_finite() { with_unit(input.barrier_height - event.height(), "m") } else { "not known".into() },
        format!(
            "barrier height {} − highest deposit {}, normal to the bed. Upper bound: the event comes to rest heaped against the barrier, its surface falling upstream at {:.1}° (flow.grain_friction), to {}, but no higher than the larger run-up; with a level surface {}. No guideline value was found",
            with_unit(input.barrier_height, "m"),
            or_unknown(event.height()),
            libm::atan(design.flow.grain_friction).to_degrees(),
            if event.heap.is_finite() { with_unit(event.heap, "m") } else { "no limit".into() },
            or_unknown(event.level),
        ),
    ));
    rows.extend(estimates(run));
    rows
}

/// The height that a barrier needs for the level of the event, with the freeboard that is asked for.
fn height_needed(run: &Run) -> Row {
    let (design, input) = (&run.file.design, &run.guideline.input);
    let level = run.guideline.level;
    let freeboard = design.limits.freeboard;
    // A net that keeps a share of its height must be that much higher.
    let kept = left_by_sag(design, &run.guideline).unwrap_or(1.0);
    let needed = (level + freeboard.unwrap_or(0.0)) / kept;
    row(
        "Height of the barrier that is needed",
        with_unit(needed, "m"),
        format!(
            "normal to the bed, {} vertically; the barrier has {}. Level of the event {}, by {}{}{}; {}",
            with_unit(needed / libm::cos(design.channel.slope), "m"),
            with_unit(input.barrier_height, "m"),
            if run.guideline.level_is_known {
                with_unit(level, "m")
            } else {
                format!("more than {}", with_unit(level, "m"))
            },
            match design.limits.run_up {
                RunUp::Larger => "the larger run-up",
                RunUp::MomentumJump => "the momentum jump",
                RunUp::Energy => "energy",
            },
            freeboard.map_or(String::new(), |freeboard| format!(", and a freeboard of {}", with_unit(freeboard, "m"))),
            if kept < 0.995 {
                format!(", over the {:.0} % of its height that the net keeps under the load", 100.0 * kept)
            } else {
                String::new()
            },
            match freeboard {
                Some(_) => "held against the height of the barrier as a check",
                None => "not checked, because limits.freeboard is not given",
            }
        ),
    )
}

/// How wide the flow is where it goes over the barrier, in a section that widens.
fn overflow_width(run: &Run) -> Option<Row> {
    let (section, height) = (&run.guideline.section, run.guideline.input.barrier_height);
    run.file.design.channel.survey.as_ref()?;
    let over = run.guideline.level > height;
    let level = if over {
        format!("; {} at the level of the event", with_unit(section.width(run.guideline.level), "m"))
    } else {
        "; the level of the event stays below it".to_string()
    };
    Some(row(
        "Width of an overflow",
        with_unit(section.width(height), "m"),
        format!(
            "of the section at the barrier's top{level}: what lies below the barrier over that width is to be protected against scour"
        ),
    ))
}

/// Velocity and depth by other ways, for comparison.
fn estimates(run: &Run) -> Vec<Row> {
    let design = &run.file.design;
    let mut rows = Vec::new();
    let slope = design.channel.slope;
    if slope > 0.0 {
        for estimate in peak_discharge(design.flow.event_volume) {
            let [velocity, depth] = velocity_and_depth(estimate.value, slope, &run.guideline.section);
            rows.push(row(
                format!("Estimate from the volume alone: {}", estimate.name),
                with_unit(estimate.value, "m³/s"),
                format!(
                    "{}; with v = 2.1 Q^0.33 S^0.33: {} and {} deep; not checked against the original, and not used in any check",
                    estimate.formula,
                    with_unit(velocity, "m/s"),
                    with_unit(depth, "m")
                ),
            ));
        }
        let depth = run.guideline.input.depth;
        let [rough, smooth] = [0.18, 0.05].map(|n| manning_strickler(depth, slope, n));
        rows.push(row(
            "Estimate from the depth: Manning-Strickler",
            format!("{} to {}", with_unit(rough, "m/s"), with_unit(smooth, "m/s")),
            "v = h^⅔ S^½/n, n 0.18 to 0.05; not checked against the original, and not used in any check",
        ));
    }
    rows
}
