//! The site: the barrier in its section, what lies behind it along the channel, and how much that is.

use crate::design::{BarrierDesign, Bottom, Design};
use crate::guideline::{Guideline, event_fill, reservoir};
use crate::loads::fill::Surface as Slope;
use crate::pipeline::Run;
use crate::profile::Profile;
use crate::report::numbers::with_unit;
use crate::report::pictures::Chart;
use crate::report::plots::cross_section::{CrossSection, Member, cross_section};
use crate::report::plots::line_chart::{Level, LineChart, Series};
use crate::report::plots::long_profile::{LongProfile, Surface, long_profile};
use crate::section::Section;

/// Points of the storage curve.
const HEIGHTS: usize = 60;

/// All pictures of the site that the design allows.
pub fn charts(run: &Run) -> Vec<Chart> {
    let mut charts = vec![across(run)];
    charts.extend(along(run));
    charts.extend(storage(run));
    charts
}

/// Distances to the right, as surveyed where the section was, and plumb heights.
struct Drawing<'a> {
    design: &'a Design,
    section: &'a Section,
    plumb: f64,
}

impl Drawing<'_> {
    fn right(&self, y: f64) -> f64 {
        match self.section {
            Section::Rectangle { width } => 0.5 * width - y,
            Section::Surveyed(survey) => survey.surveyed(y),
        }
    }

    fn ends(&self, [from, to]: [f64; 2]) -> [f64; 2] {
        // y runs to the left.
        [self.right(to), self.right(from)]
    }

    fn ground(&self) -> Vec<[f64; 2]> {
        let points = self.design.channel.ground_line();
        points.iter().rev().map(|[y, z]| [self.right(*y), z / self.plumb]).collect()
    }
}

/// Heights of the main ropes over the bed, normal to it, from the bottom (m).
fn rope_heights(design: &Design, guideline: &Guideline) -> Vec<f64> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return Vec::new() };
    let above = |along: &f64| along * libm::cos(guideline.lean) + net.bottom.gap();
    net.main_ropes.heights.iter().map(above).collect()
}

fn across(run: &Run) -> Chart {
    let (design, guideline) = (&run.file.design, &run.guideline);
    let plumb = libm::cos(design.channel.slope);
    let section = &guideline.section;
    let drawing = Drawing { design, section, plumb };
    let held = matches!(&design.barrier, BarrierDesign::FlexibleNet(net) if net.bottom == Bottom::Fixed);
    let heights = rope_heights(design, guideline);
    let bolted = |index: usize| index == 0 && held;
    let ends = |index: usize, z: f64| if bolted(index) { section.bed_ends() } else { section.banks(z) };
    let member = |(index, z): (usize, &f64)| {
        let [from, to] = ends(index, *z);
        Member {
            label: format!("rope {}, {:.2} m", index + 1, to - from),
            height: z / plumb,
            ends: drawing.ends([from, to]),
            is_anchored: !bolted(index),
        }
    };
    let mut members: Vec<Member> = heights.iter().enumerate().map(member).collect();
    let top = guideline.input.barrier_height;
    if members.is_empty() {
        let [from, to] = section.banks(top);
        let label = format!("top of the wall, {:.2} m", to - from);
        members.push(Member { label, height: top / plumb, ends: drawing.ends([from, to]), is_anchored: false });
    }
    let low = heights.first().copied().unwrap_or(0.0);
    let chart = CrossSection {
        ground: drawing.ground(),
        members,
        outline: outline(&drawing, low, top),
        bed: drawing.ends(section.bed_ends()),
        surfaces: vec![(format!("flow, {:.2} m", guideline.input.depth / plumb), guideline.input.depth / plumb)],
    };
    let note = format!(
        "To scale, looking downstream; heights plumb over the lowest point of the bed. The barrier's top is {:.2} m high, plumb, and {:.2} m normal to the bed, which is the height that the load equations use.{} Ropes are drawn straight, with the length from bank to bank.",
        top / plumb,
        top,
        match section {
            Section::Rectangle { .. } => String::new(),
            Section::Surveyed(_) => format!(
                " Where a load or a result is told per width, it is over the mean width of the section up to there, {:.2} m, unless it says otherwise.",
                guideline.width
            ),
        }
    );
    Chart::of("Barrier in its section", cross_section(&chart), note)
}

/// What closes the section between two heights, along its banks.
fn outline(drawing: &Drawing, low: f64, top: f64) -> Vec<[f64; 2]> {
    let mut heights: Vec<f64> = drawing.section.kinks().into_iter().filter(|z| *z > low && *z < top).collect();
    heights.insert(0, low);
    heights.push(top);
    let bank = |side: usize| {
        let point = move |z: &f64| [drawing.right(drawing.section.banks(*z)[side]), z / drawing.plumb];
        heights.iter().map(point).collect::<Vec<[f64; 2]>>()
    };
    let mut line = bank(0);
    // Along the ground from the one bank to the other, where nothing is open below.
    if let (Section::Surveyed(survey), true) = (drawing.section, low == 0.0) {
        line.splice(0..0, survey.bed().iter().rev().map(|[y, z]| [drawing.right(*y), z / drawing.plumb]));
    }
    let mut left = bank(1);
    left.reverse();
    line.extend(left);
    line
}

/// Bed, barrier and the deposit that the filled barrier keeps; nothing where none ends on the bed.
fn along(run: &Run) -> Option<Chart> {
    let (design, guideline) = (&run.file.design, &run.guideline);
    let held = guideline.retention?;
    let reservoir = reservoir(design);
    let surface = |name: &str, slope: Slope| {
        let stored = reservoir.stored(held.deposit.height, slope, 0.0)?;
        let name = format!("{name}: {}, {} long", with_unit(stored.volume, "m³"), with_unit(stored.length, "m"));
        Some(Surface { name, height: held.deposit.height, slope, length: stored.length })
    };
    let mut surfaces: Vec<Surface> =
        surface("at the design slope", Slope::OfTheBed(design.loads.deposit_slope)).into_iter().collect();
    if held.deposit.surface > 0.0 {
        surfaces.extend(surface("level", Slope::Plane(0.0)));
    }
    let top = guideline.input.barrier_height;
    let drawn = LongProfile {
        slope: design.channel.slope,
        profile: design.channel.profile.clone().unwrap_or_else(|| Profile::new(design.channel.slope, &[], &[], 0.0)),
        top: [-top * libm::tan(guideline.lean), top],
        surfaces,
    };
    let note = format!(
        "To scale, plumb. What the filled barrier holds below a surface that starts {} above the bed (normal to it) at the barrier.{}",
        with_unit(held.deposit.height, "m"),
        if design.channel.profile.is_some() {
            " Volumes are summed along the bed, reach by reach; at the design slope the surface has its share of the slope of each reach."
        } else {
            ""
        }
    );
    Some(Chart::of("Bed, barrier and deposit along the channel", long_profile(&drawn), note))
}

/// Volume behind the barrier by the height of the deposit at it.
fn storage(run: &Run) -> Option<Chart> {
    let (design, guideline) = (&run.file.design, &run.guideline);
    let held = guideline.retention?;
    let top = guideline.input.barrier_height;
    let heights: Vec<f64> = (0..=HEIGHTS).map(|index| top * index as f64 / HEIGHTS as f64).collect();
    let reservoir = reservoir(design);
    let volumes = |surface: Slope| -> Vec<f64> {
        let of = |height: &f64| {
            // No deposit is as much as none of a height.
            if *height == 0.0 {
                0.0
            } else {
                reservoir.stored(*height, surface, 0.0).map_or(f64::NAN, |stored| stored.volume)
            }
        };
        heights.iter().map(of).collect()
    };
    let (sloping, level) = (volumes(Slope::OfTheBed(design.loads.deposit_slope)), volumes(Slope::Plane(0.0)));
    let mut series = vec![Series { label: "design slope".into(), values: &sloping, colour: 0 }];
    if held.deposit.surface > 0.0 {
        series.push(Series { label: "level".into(), values: &level, colour: 1 });
    }
    let mut levels = vec![Level { label: "event".into(), value: design.flow.event_volume }];
    if design.flow.is_one_of_several() {
        levels.push(Level { label: "one surge".into(), value: design.flow.volume() });
    }
    let chart = LineChart {
        title: "volume",
        unit: "m³",
        factor: 1.0,
        along: "height of the deposit at the barrier, normal to the bed (m)",
        time: &heights,
        series,
        levels,
        band: None,
    };
    let event = event_fill(design, &guideline.input);
    let note = format!(
        "Design slope: at the barrier the deposit's surface falls at {:.1}°, the bed at {:.1}°. The filled barrier keeps {} of its {} (loads.filled_height). The event stands {} high with a level surface.{}",
        held.deposit.surface.to_degrees(),
        held.deposit.slope.to_degrees(),
        with_unit(held.deposit.height, "m"),
        with_unit(top, "m"),
        with_unit(event.level, "m"),
        if event.level > top { " That is more than the barrier's height." } else { "" }
    );
    Some(Chart::of("Storage curve", chart.svg(), note))
}
