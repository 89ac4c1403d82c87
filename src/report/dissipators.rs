//! Pictures of the dissipators: the curve along which they yield, and the strokes over time.

use dem::recorders::of_dissipators;

use crate::design::{BarrierDesign, DissipatorDesign};
use crate::pipeline::Run;
use crate::report::chart::Chart;
use crate::report::plots::line_chart::{Level, LineChart, Series, TIME, rope_series};
use crate::simulated::Simulated;

pub fn charts(run: &Run, seen: &Simulated) -> Vec<Chart> {
    let used = seen.histories.barrier.rows(&of_dissipators::STROKE).iter().flatten().any(|stroke| *stroke > 0.0);
    curve_chart(run).into_iter().chain(used.then(|| stroke_chart(run, seen))).collect()
}

fn given(run: &Run) -> Option<&DissipatorDesign> {
    match &run.file.design.barrier {
        BarrierDesign::FlexibleNet(net) => net.dissipators.as_ref(),
        BarrierDesign::RigidWall(_) => None,
    }
}

/// The yield force against the stroke; nothing for a plateau, which its number tells.
fn curve_chart(run: &Run) -> Option<Chart> {
    let given = given(run).filter(|given| !given.curve.is_plateau())?;
    let points = given.curve.points();
    let strokes: Vec<f64> = points.iter().map(|[stroke, _]| stroke * given.stroke).collect();
    let times = |factor: f64| points.iter().map(|[_, force]| factor * force * given.plateau).collect::<Vec<f64>>();
    let overstrength = run.file.design.factors.overstrength;
    let drawn = [("as given", times(1.0)), ("with overstrength", times(overstrength))];
    let shown = if overstrength == 1.0 { 1 } else { 2 };
    let series = drawn.iter().take(shown).enumerate();
    let chart = LineChart {
        title: "yield force",
        unit: "kN",
        factor: 1e-3,
        along: "stroke (m)",
        time: &strokes,
        series: series.map(|(colour, (label, values))| Series { label: (*label).into(), values, colour }).collect(),
        levels: Vec::new(),
        band: None,
    };
    let note = "Of all dissipators at one end of a rope together. Strokes are by the curve as given; what ropes and anchors must bear is the largest force with overstrength.";
    Some(Chart::of("Force of the dissipators", chart.svg(), note))
}

fn stroke_chart(run: &Run, seen: &Simulated) -> Chart {
    let limit = given(run).map(|given| given.stroke);
    let chart = LineChart {
        title: "stroke used",
        unit: "m",
        factor: 1.0,
        along: TIME,
        time: &seen.histories.time,
        series: rope_series(seen.histories.barrier.rows(&of_dissipators::STROKE)),
        levels: limit.map(|value| Level { label: "available".into(), value }).into_iter().collect(),
        band: None,
    };
    Chart::of("Dissipators", chart.svg(), "The longer of the two strokes of each main rope.")
}
