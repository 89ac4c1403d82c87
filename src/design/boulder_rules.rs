//! Contradictions between boulders and the flow that brings them.

use crate::design::channel_entries::section;
use crate::design::entries::Entries;
use crate::design::flow::Boulders;
use crate::design::flow::RUN_IN;
use crate::design::flow_entries::{boulders, flow_volume};
use crate::design::hydrograph_entries::HYDROGRAPH;
use crate::design::show::length;
use crate::design::surge_entries::of_the_first;
use crate::problem::Problem;

/// Share of the flow's mass that boulders may be.
const MOST_MASS: f64 = 0.5;
/// Largest boulder within a flow over its depth.
const WITHIN: f64 = 0.9;

fn each(e: &Entries, rule: impl Fn(&str, &Boulders) -> Option<Problem>) -> Option<Problem> {
    boulders(e)?.iter().enumerate().find_map(|(number, boulders)| rule(&format!("flow.boulders.{number}"), boulders))
}

pub fn boulders_come_with_a_surge(e: &Entries) -> Option<Problem> {
    let other = [(HYDROGRAPH, "a hydrograph"), ("flow.arrival.dam_break", "a dam break")];
    let (_, other) = other.into_iter().find(|(path, _)| e.has_list("flow.boulders") && e.has_section(path))?;
    Some(
        Problem::new(
            "flow.boulders",
            format!("boulders in {other}"),
            "boulders in a surge, or in the first of several",
        )
        .hint("give the flow that brings them as a surge"),
    )
}

/// What they weigh is known, for the equations as well.
pub fn boulders_have_a_density(e: &Entries) -> Option<Problem> {
    let number = boulders(e)?.iter().position(|boulders| boulders.density.is_nan())?;
    let path = format!("flow.boulders.{number}");
    Some(
        Problem::new(path, "boulders without a density", "a density of the boulders, or flow.solid_density")
            .hint("stone has some 2650 kg/m3"),
    )
}

pub fn boulders_are_a_part_of_the_flow(e: &Entries) -> Option<Problem> {
    let all: f64 = boulders(e)?.iter().map(Boulders::mass).sum();
    let flow = flow_volume(e)? * e.number("flow.bulk_density")?;
    (all > MOST_MASS * flow).then(|| {
        let found = format!("boulders of {:.3} t in all in a flow of {:.3} t", all * 1e-3, flow * 1e-3);
        Problem::new("flow.boulders", found, "boulders of at most half the mass of the flow, of which they are a part")
    })
}

pub fn boulders_fit_across(e: &Entries) -> Option<Problem> {
    let (section, aspect) = (section(e)?, e.number("flow.grain_aspect")?);
    let (_, depth) = of_the_first(e, "depth")?;
    let width = section.width(depth);
    each(e, |path, boulders| {
        let across = boulders.extent(aspect)[0];
        (1.1 * across > width).then(|| {
            let found = format!("boulders {} long in a flow {} wide", length(across), length(width));
            Problem::new(format!("{path}.diameter"), found, "boulders shorter than the flow is wide")
        })
    })
}

pub fn spread_boulders_lie_within_the_flow(e: &Entries) -> Option<Problem> {
    let (_, depth) = of_the_first(e, "depth")?;
    each(e, |path, boulders| {
        (!boulders.at_front && boulders.diameter > WITHIN * depth).then(|| {
            let found = format!("a boulder of {} within a flow {} deep", length(boulders.diameter), length(depth));
            Problem::new(format!("{path}.diameter"), found, format!("at most {}", length(WITHIN * depth)))
                .hint("larger ones come at the front: `where: front`")
        })
    })
}

pub fn front_boulders_have_room(e: &Entries) -> Option<Problem> {
    let (section, aspect) = (section(e)?, e.number("flow.grain_aspect")?);
    let (_, depth) = of_the_first(e, "depth")?;
    let run_in = of_the_first(e, "run_in").map_or(RUN_IN * depth, |(_, run_in)| run_in);
    let width = section.width(depth);
    let rows = boulders(e)?
        .iter()
        .filter(|boulders| boulders.at_front)
        .map(|boulders| boulders.rows(width, boulders.extent(aspect)).1)
        .sum::<f64>();
    (rows > run_in).then(|| {
        let found = format!(
            "rows of boulders {} long before a front that starts {} upstream of the barrier",
            length(rows),
            length(run_in)
        );
        Problem::new("flow.boulders", found, "rows no longer than the run_in of the surge")
            .hint("a longer run_in, or `where: spread`")
    })
}
