//! The pictures of the report: charts over time, the flow from the side, the barrier from upstream, pressure over height.

use crate::checks::outcome::{CheckVerdict, Outcome};
use crate::checks::{anchors, posts, ropes};
use crate::design::{BarrierDesign, Bottom, Channel, Design, FlexibleNet};
use crate::loads::pressure::Diagram;
use crate::pipeline::Run;
use crate::quantities::{mass, total_force, wall};
use crate::report::chart::{Chart, file_name, labelled};
use crate::report::dissipators;
use crate::report::numbers::{rope_numbers, with_unit};
use crate::report::plots::elevation::elevation;
use crate::report::plots::line_chart::{Level, LineChart, Series, TIME, resampled, rope_series};
use crate::report::plots::profile::profile;
use crate::report::plots::side_view::{Setting, side_view};
use crate::report::plots::utilisation::{Bar, utilisation};
use crate::report::replay::{Replay, Stage, pack};
use crate::report::row::{is_share, worst_first};
use crate::scene::ground::{frame_of, pieces};
use crate::simulated::Simulated;
use dem::elements::segment::SegmentKind;
use dem::ledger::Ledger;
use dem::recorders::histories::smoothed;
use dem::recorders::snapshots::{Moment, Snapshot};
use dem::recorders::{of_anchors, of_ropes, of_wall};

pub const REPLAY_SCRIPT: &str = include_str!("../../templates/replay.js");

pub fn charts(run: &Run, seen: &Simulated) -> Vec<Chart> {
    let mut charts = vec![force_chart(run, seen), mass_chart(run, seen)];
    charts.extend(dissipators::charts(run, seen));
    if !seen.histories.barrier.rows(&of_ropes::MEAN).is_empty() {
        charts.push(rope_chart(run, seen));
    }
    charts.extend(anchor_chart(run, seen));
    charts.extend(wall_charts(run, seen));
    charts.extend(inlet_chart(run, seen));
    charts.push(velocity_chart(seen));
    charts.push(split_chart(seen));
    charts.push(coefficient_chart(run, seen));
    charts.push(energy_chart(seen));
    charts
}

/// How much of each judged check is used.
pub fn utilisation_chart(run: &Run) -> Option<Chart> {
    let judged = worst_first(run).into_iter().filter(|outcome| outcome.verdict != CheckVerdict::Info);
    let bar = |outcome: &Outcome| {
        let used = outcome.utilisation?;
        let of = |demand: Option<f64>| Some(demand? / outcome.capacity.filter(|_| outcome.resistance.is_some())?);
        let by = [of(outcome.demand.guideline), of(outcome.demand.simulation)];
        let value = is_share(outcome).then(|| crate::report::row::used(outcome));
        Some(Bar { label: outcome.title.clone(), used, by, value, class: outcome.verdict.word() })
    };
    let bars: Vec<Bar> = judged.filter_map(bar).take(MOST_BARS).collect();
    let note = "Demand over capacity; of guideline (square) and simulation (circle) the larger. For retained mass and height the bar shows the loss as a share of the permitted loss; the number is what is retained. Bars beyond 200 % are cut off. Checks without a utilisation are listed in the table only.";
    (!bars.is_empty()).then(|| Chart::of("Utilisation of the checks", utilisation(&bars), note))
}

/// Bars in the picture of utilisations.
const MOST_BARS: usize = 40;

/// Least and largest force over all starts, at the times of the first.
fn force_band(seen: &Simulated) -> Option<[Vec<f64>; 2]> {
    if seen.starts.len() < 2 {
        return None;
    }
    let time = &seen.histories.time;
    let mut band = [vec![f64::INFINITY; time.len()], vec![f64::NEG_INFINITY; time.len()]];
    for start in &seen.starts {
        let force = resampled(&start.observed.coefficients.time, &start.observed.force, time);
        for (moment, force) in force.into_iter().enumerate() {
            band[0][moment] = band[0][moment].min(force);
            band[1][moment] = band[1][moment].max(force);
        }
    }
    Some(band)
}

/// Loads of the anchors of a net.
fn anchor_chart(run: &Run, seen: &Simulated) -> Option<Chart> {
    let BarrierDesign::FlexibleNet(net) = &run.file.design.barrier else { return None };
    let chart = LineChart {
        title: "load of an anchor",
        unit: "kN",
        factor: 1e-3,
        along: TIME,
        time: &seen.histories.time,
        series: rope_series(seen.histories.barrier.rows(&of_anchors::LOAD)),
        levels: vec![Level { label: "design resistance".into(), value: anchors::weakest(&run.file.design, net) }],
        band: None,
    };
    let note = "The higher loaded anchor of each main rope, without partial factors.";
    Some(Chart::of("Anchors", chart.svg(), note))
}

/// What the hydrograph says and what has come in, as shares of the whole.
fn inlet_chart(run: &Run, seen: &Simulated) -> Option<Chart> {
    let design = &run.file.design;
    let (hydrograph, section) = (design.flow.hydrograph.as_ref()?, design.channel.section());
    let time = &seen.histories.time;
    let last = hydrograph.duration();
    let share = |of: &dyn Fn(f64) -> f64| time.iter().map(|time| of(*time) / of(last)).collect::<Vec<f64>>();
    let density = design.flow.mass / hydrograph.volume(&section, last);
    let entered = |kind: usize, whole: f64| {
        seen.histories.entered.iter().map(|entered| entered[kind] / whole).collect::<Vec<f64>>()
    };
    let told = [share(&|time| hydrograph.volume(&section, time)), share(&|time| hydrograph.momentum(&section, time))];
    let came = [entered(0, design.flow.mass), entered(1, density * hydrograph.momentum(&section, last))];
    let labels = ["mass given", "momentum given", "mass passed", "momentum passed"];
    let series = told.iter().chain(&came).zip(labels).enumerate();
    let chart = LineChart {
        title: "passed the inlet",
        unit: "%",
        factor: 100.0,
        along: TIME,
        time,
        series: series.map(|(colour, (values, label))| Series { label: label.to_string(), values, colour }).collect(),
        levels: Vec::new(),
        band: None,
    };
    let note = "Shares of the whole mass and momentum: as the hydrograph gives them, and as grains have passed the inlet in the simulation.";
    Some(Chart::of("Hydrograph", chart.svg(), note))
}

/// Force on the segments of a rigid wall, and its moment.
fn wall_charts(run: &Run, seen: &Simulated) -> Vec<Chart> {
    let histories = &seen.histories;
    if histories.barrier.rows(&of_wall::SEGMENTS).is_empty() {
        return Vec::new();
    }
    let design = &run.file.design;
    let window = crate::scene::build::SAMPLES_PER_WINDOW as usize;
    let over = |row: &[f64], width: f64| smoothed(row, window).iter().map(|value| value / width).collect::<Vec<f64>>();
    let segments = histories.barrier.rows(&of_wall::SEGMENTS).iter().enumerate();
    let segments: Vec<Vec<f64>> = segments.map(|(index, row)| over(row, wall::segment_width(design, index))).collect();
    let (moment, width) = wall::metre_moment(histories, design);
    let moment = over(moment, width);
    let chart = |title: &'static str, label, units: [&'static str; 2], series: Vec<Series>, note: &str| {
        let largest = series.iter().flat_map(|series| series.values).copied().fold(0.0, f64::max);
        let (unit, factor) = if largest < 2000.0 { (units[0], 1.0) } else { (units[1], 1e-3) };
        let time = &histories.time;
        let svg =
            LineChart { title: label, unit, factor, along: TIME, time, series, levels: Vec::new(), band: None }.svg();
        Chart::of(title, svg, note)
    };
    let segment = |(index, values)| Series { label: format!("segment {}", index + 1), values, colour: index % 6 };
    let of_segments = segments.iter().map(Vec::as_slice).enumerate().map(segment).collect();
    let of_moment = vec![Series { label: "moment".into(), values: &moment, colour: 0 }];
    vec![
        chart("Segments of the wall", "force per width", ["N/m", "kN/m"], of_segments, "Numbered from the bottom."),
        chart(
            "Moment about the toe",
            "moment per width",
            ["N m/m", "kN m/m"],
            of_moment,
            "Of the force normal to the wall.",
        ),
    ]
}

/// Where the energy is and where it went.
fn energy_chart(seen: &Simulated) -> Chart {
    let ledger = &seen.histories.ledger;
    let start = ledger.first().copied().unwrap_or_default();
    let of = |value: fn(&Ledger) -> f64| -> Vec<f64> { ledger.iter().map(value).collect() };
    let released: Vec<f64> = ledger.iter().map(|now| start.potential - now.potential - now.carried_out).collect();
    let (motion, lost) = (of(|now| now.kinetic), of(Ledger::dissipated));
    let contacts = of(|now| now.lost_damping + now.lost_friction);
    let largest = released.iter().chain(&motion).copied().fold(0.0, f64::max);
    let (unit, factor) = match largest {
        small if small < 2e3 => ("J", 1.0),
        medium if medium < 2e6 => ("kJ", 1e-3),
        _ => ("MJ", 1e-6),
    };
    let series = |label: &str, values, colour| Series { label: label.into(), values, colour };
    let chart = LineChart {
        title: "energy",
        unit,
        factor,
        along: TIME,
        time: &seen.histories.time,
        series: vec![
            series("released", &released, 2),
            series("motion", &motion, 0),
            series("lost in all", &lost, 1),
            series("lost in contacts", &contacts, 3),
        ],
        levels: Vec::new(),
        band: None,
    };
    let note = "Released: by falling. Lost in contacts: by impacts and by friction; the rest goes into dissipators and the damping of ropes. Energy that departed grains carry is taken off what falling has released.";
    Chart::of("Energy account", chart.svg(), note)
}

/// Half of the length of bed that is drawn at the most (m).
const FAR: f64 = 1e3;

/// The lowest line of the bed in the channel's frame, (x, z) (m).
fn bed_line(channel: &Channel) -> Vec<[f64; 2]> {
    let Some(profile) = &channel.profile else { return vec![[-FAR, 0.0], [FAR, 0.0]] };
    let corners = profile.corners().iter().map(|corner| corner[0]);
    let places: Vec<f64> = [-FAR].into_iter().chain(corners).chain([FAR]).collect();
    let place = |x: f64| {
        let there = frame_of(channel.slope, x, 0.0, profile.elevation(x));
        [there.x, there.z]
    };
    places.into_iter().map(place).collect()
}

/// The slice along the middle at every moment kept.
pub fn views(run: &Run, seen: &Simulated) -> Vec<Chart> {
    let design = &run.file.design;
    let bed = run.guideline.section.bed_ends();
    let setting = Setting {
        slope: design.channel.slope,
        bed: bed_line(&design.channel),
        middle: 0.5 * (bed[0] + bed[1]),
        width: run.guideline.section.width(run.guideline.input.barrier_height),
        height: run.guideline.input.barrier_height,
        wall: match &design.barrier {
            BarrierDesign::RigidWall(wall) => {
                Some([-libm::sin(wall.lean), libm::cos(wall.lean)].map(|share| wall.height * share))
            }
            BarrierDesign::FlexibleNet(_) => None,
        },
        fastest: seen.first().one(&mass::VELOCITY),
    };
    let chart = |snapshot: &Snapshot| {
        let title = match snapshot.moment {
            Moment::FirstContact => "First contact",
            Moment::LargestForce => "Largest force",
            Moment::HalfAtRest => "Half of the mass at rest",
            Moment::End => "End",
        };
        Chart {
            title,
            file: format!("flow_{}", file_name(title)),
            svg: labelled(&side_view(snapshot, &setting), &format!("Flow from the side: {title}")),
            note: match snapshot.moment {
                Moment::LargestForce => format!("at {:.2} s, within half a percent of the largest", snapshot.time),
                Moment::FirstContact => {
                    format!("at {:.2} s; the first grains touch, not all in this slice", snapshot.time)
                }
                Moment::HalfAtRest | Moment::End => format!("at {:.2} s", snapshot.time),
            },
        }
    };
    seen.histories.snapshots.iter().map(chart).collect()
}

/// Pressure over height when the force is largest, and at the end, beside the guideline's for the depths seen then.
pub fn profiles(run: &Run, seen: &Simulated) -> Vec<Chart> {
    let input = &run.guideline.input;
    let told = &seen.first().coefficients;
    let chart = |snapshot: &Snapshot| {
        let (title, moving) = match snapshot.moment {
            Moment::LargestForce => ("Pressure at the largest force", true),
            Moment::End => ("Pressure at rest", false),
            Moment::FirstContact | Moment::HalfAtRest => return None,
        };
        let at = told.time.partition_point(|time| *time < snapshot.time).min(told.time.len().checked_sub(1)?);
        let (deposit, depth) = (told.deposit[at], told.moving[at]);
        let velocity = if moving { told.velocity_mean[at].max(0.0) } else { 0.0 };
        let diagram = Diagram {
            unit: input.unit_pressure(),
            surface: deposit + depth,
            top: input.barrier_height,
            block: input.dynamic_pressure * input.density * velocity * velocity,
            block_from: deposit,
            block_to: deposit + depth,
        };
        let note = format!(
            "at {:.3} s; strips: forces of grains at that instant; line: guideline with the design's K and λ for H_d = {}, h = {} and the mean velocity of {}",
            snapshot.time,
            with_unit(deposit, "m"),
            with_unit(depth, "m"),
            with_unit(velocity, "m/s")
        );
        let svg = profile(&snapshot.touches, &run.guideline.section, input.barrier_height, &diagram);
        Some(Chart::of(title, svg, note))
    };
    seen.histories.snapshots.iter().filter_map(chart).collect()
}

/// The barrier when the force on it is largest.
pub fn elevation_chart(run: &Run, seen: &Simulated) -> Option<Chart> {
    let design = &run.file.design;
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return None };
    let snapshot = seen.histories.snapshots.iter().find(|snapshot| snapshot.moment == Moment::LargestForce)?;
    let resistance = |kind: SegmentKind| {
        let holds = match kind {
            SegmentKind::Main(rope) => ropes::resistance(design, &net.main_ropes.levels[usize::from(rope)].rope),
            SegmentKind::Lateral => ropes::resistance(design, &net.lateral_rope),
            SegmentKind::Net | SegmentKind::Ring => ropes::resistance_of_net(design, net),
            SegmentKind::Retaining(_) | SegmentKind::Post(_) => {
                return of_posts(design, net, kind) / design.factors.load;
            }
        };
        holds.characteristic / holds.factor / design.factors.load
    };
    Some(Chart {
        title: "Barrier from upstream, at its largest load",
        file: file_name("Barrier from upstream"),
        svg: elevation(snapshot, run.guideline.section.banks(run.guideline.input.barrier_height), resistance),
        note: format!(
            "At {:.2} s, as deformed then, seen normal to the bed; colour by tension over design resistance at that instant, the partial factor on loads included. Main ropes are numbered from the bottom{}.{}{}",
            snapshot.time,
            if net.rings.is_some() {
                "; rings are drawn as they are modelled, straight from contact to contact"
            } else {
                ""
            },
            if net.posts.is_some() {
                " Posts stand upright, and the ropes from their heads run to their anchors upstream."
            } else {
                ""
            },
            if net.bottom == Bottom::Fixed {
                " The lowest one is held at every knot here; the check of it between its bolts follows from the load of the worst bolt and is not in the picture."
            } else {
                ""
            }
        ),
    })
}

/// What a post or a rope that retains one holds (N), without end where nobody says.
fn of_posts(design: &Design, net: &FlexibleNet, kind: SegmentKind) -> f64 {
    let Some(given) = &net.posts else { return f64::INFINITY };
    match kind {
        SegmentKind::Post(number) => {
            posts::strut(design, given, usize::from(number)).map_or(f64::INFINITY, |strut| strut.compression)
        }
        _ => {
            let holds = ropes::resistance(design, &given.retaining.rope);
            holds.characteristic / holds.factor
        }
    }
}

/// The film of the first start.
pub fn replay(run: &Run, seen: &Simulated) -> Option<Replay> {
    let channel = &run.file.design.channel;
    let wall = match &run.file.design.barrier {
        BarrierDesign::RigidWall(wall) => {
            Some([-libm::sin(wall.lean), libm::cos(wall.lean)].map(|share| wall.height * share))
        }
        BarrierDesign::FlexibleNet(_) => None,
    };
    let wall_ends = run.guideline.section.banks(run.guideline.input.barrier_height);
    let film = &seen.histories.film;
    let ground = channel.ground().map_or(Vec::new(), |_| pieces(channel, film.stretch()));
    pack(film, &Stage { width: channel.width, ground, slope: channel.slope, wall, wall_ends })
}

fn split_chart(seen: &Simulated) -> Chart {
    let told = &seen.first().coefficients;
    let largest = [&told.force_dead, &told.force_moving, &told.guideline_dead, &told.guideline_moving];
    let largest = largest.iter().flat_map(|series| series.iter()).copied().fold(0.0, f64::max);
    let (unit, factor) = if largest < 2000.0 { ("N/m", 1.0) } else { ("kN/m", 1e-3) };
    let series = |label: &str, values, colour| Series { label: label.into(), values, colour };
    let chart = LineChart {
        title: "force per width",
        unit,
        factor,
        along: TIME,
        time: &seen.histories.time,
        series: vec![
            series("F₁ at rest", &told.force_dead, 0),
            series("F₂ moving", &told.force_moving, 1),
            series("F₁ guideline", &told.guideline_dead, 2),
            series("F₂ guideline", &told.guideline_moving, 3),
        ],
        levels: Vec::new(),
        band: None,
    };
    let note = "Force per width of the barrier. Grains at rest (F₁) and moving grains (F₂) that touch the barrier; the guideline's values of the same with the design's K and λ, the simulated depths, and the mean velocity of all grains, from before the first contact on.";
    Chart::of("Deposit and moving flow", chart.svg(), note)
}

/// K and λ beyond this are cut off in the chart.
const HIGHEST_COEFFICIENT: f64 = 10.0;

fn coefficient_chart(run: &Run, seen: &Simulated) -> Chart {
    let told = &seen.first().coefficients;
    let shown = |series: &[f64]| -> Vec<f64> {
        series.iter().map(|value| if *value <= HIGHEST_COEFFICIENT { value.max(0.0) } else { f64::NAN }).collect()
    };
    let (k, upstream) = (shown(&told.earth_pressure), shown(&told.dynamic_upstream));
    let factors = &run.file.design.factors;
    let chart = LineChart {
        title: "coefficient",
        unit: "–",
        factor: 1.0,
        along: TIME,
        time: &seen.histories.time,
        series: vec![
            Series { label: "K".into(), values: &k, colour: 0 },
            Series { label: "λ".into(), values: &upstream, colour: 1 },
        ],
        levels: vec![
            Level { label: "K design".into(), value: factors.earth_pressure },
            Level { label: "λ design".into(), value: factors.dynamic_pressure },
        ],
        band: None,
    };
    let note = format!(
        "λ with the velocity just upstream; left out where the depth is less than a grain, the flow has all but stopped, or the value is above {HIGHEST_COEFFICIENT:.0}."
    );
    Chart::of("K and λ over time", chart.svg(), note)
}

fn force_chart(run: &Run, seen: &Simulated) -> Chart {
    let histories = &seen.histories;
    let force: Vec<f64> = histories.force.iter().map(|force| force.norm()).collect();
    let force = smoothed(&force, crate::scene::build::SAMPLES_PER_WINDOW as usize);
    let levels = run.guideline.cases.iter();
    let (unit, factor) = if seen.first().one(&total_force::PEAK) < 2000.0 { ("N", 1.0) } else { ("kN", 1e-3) };
    let chart = LineChart {
        title: "total force",
        unit,
        factor,
        along: TIME,
        time: &histories.time,
        series: vec![Series { label: "simulation".into(), values: &force, colour: 0 }],
        levels: levels
            .map(|case| Level { label: case.id.replace('_', " "), value: case.spread_force(&run.guideline.section) })
            .collect(),
        band: force_band(seen),
    };
    let band = if seen.starts.len() > 1 { " Band: envelope of all runs." } else { "" };
    let note = format!(
        "Length of the force vector, mean over {:.0} ms. Dashed: guideline, along the bed.{band}",
        1e3 * seen.facts.smoothing
    );
    Chart::of("Force on the barrier", chart.svg(), note)
}

fn mass_chart(run: &Run, seen: &Simulated) -> Chart {
    let histories = &seen.histories;
    let retained: Vec<f64> = histories.lost.iter().map(|lost| 1.0 - lost.iter().sum::<f64>()).collect();
    let chart = LineChart {
        title: "share of the mass",
        unit: "%",
        factor: 100.0,
        along: TIME,
        time: &histories.time,
        series: vec![
            Series { label: "held".into(), values: &retained, colour: 0 },
            Series { label: "at rest".into(), values: &histories.dead, colour: 1 },
        ],
        levels: vec![Level { label: "limit".into(), value: run.file.design.limits.retained_mass }],
        band: None,
    };
    Chart::of(
        "Retained mass",
        chart.svg(),
        "Held: not past the barrier. At rest: slower than 5 % of the highest mean velocity.",
    )
}

fn rope_chart(run: &Run, seen: &Simulated) -> Chart {
    let design = &run.file.design;
    let kinds = match &design.barrier {
        BarrierDesign::FlexibleNet(net) => net.main_ropes.kinds(),
        BarrierDesign::RigidWall(_) => Vec::new(),
    };
    let resistance = kinds.iter().map(|(levels, rope)| {
        let label =
            if kinds.len() > 1 { format!("holds: {}", rope_numbers(levels)) } else { "design resistance".into() };
        Level { label, value: rope.breaking_load * design.factors.rope_end / design.factors.rope }
    });
    let chart = LineChart {
        title: "largest tension",
        unit: "kN",
        factor: 1e-3,
        along: TIME,
        time: &seen.histories.time,
        series: rope_series(seen.histories.barrier.rows(&of_ropes::LARGEST)),
        levels: resistance.collect(),
        band: None,
    };
    let note = "Largest along each rope and its dissipators, without partial factors; ropes are numbered from the bottom. Their means are in histories.csv.";
    Chart::of("Main ropes", chart.svg(), note)
}

fn velocity_chart(seen: &Simulated) -> Chart {
    let velocity: Vec<f64> = seen.histories.velocity.iter().map(|velocity| velocity[0]).collect();
    let chart = LineChart {
        title: "mean velocity",
        unit: "m/s",
        factor: 1.0,
        along: TIME,
        time: &seen.histories.time,
        series: vec![Series { label: "along the bed".into(), values: &velocity, colour: 0 }],
        levels: Vec::new(),
        band: None,
    };
    Chart::of("Velocity of the flow", chart.svg(), "Mean over all grains that have not left the model.")
}
