//! The site: the barrier in its section, what lies behind it along the channel, and how much that is.

use crate::design::{Bank, BarrierDesign, BarrierModel, Bottom, Design};
use crate::guideline::posts::input;
use crate::guideline::{Guideline, event_fill, reservoir};
use crate::loads::fill::Surface as Slope;
use crate::pipeline::Run;
use crate::profile::Profile;
use crate::report::chart::Chart;
use crate::report::numbers::with_unit;
use crate::report::plots::cross_section::{CrossSection, Member, Ring, cross_section};
use crate::report::plots::line_chart::{Level, LineChart, Series};
use crate::report::plots::long_profile::{LongProfile, Surface, long_profile};
use crate::report::plots::plan::{Plan, plan};
use crate::report::plots::posts_plan::{PostsPlan, posts_plan};
use crate::report::row::{Row, row};
use crate::scene::flow::release::Block;
use crate::scene::net::build::build as build_net;
use crate::section::Section;
use dem::elements::net_ring::NetRing;

/// Points of the storage curve.
const HEIGHTS: usize = 60;

/// All pictures of the site that the design allows.
pub fn charts(run: &Run) -> Vec<Chart> {
    let mut charts = vec![across(run)];
    charts.extend(retained(run));
    charts.extend(above(run));
    charts.extend(along(run));
    charts.extend(storage(run));
    charts
}

/// Where ropes are anchored in a surveyed section, and where the flow starts.
pub fn rows(run: &Run) -> Vec<Row> {
    rope_rows(run).into_iter().chain(release_row(run)).collect()
}

fn rope_rows(run: &Run) -> Vec<Row> {
    let (design, guideline) = (&run.file.design, &run.guideline);
    let Section::Surveyed(_) = &guideline.section else { return Vec::new() };
    let drawing = Drawing { design, section: &guideline.section, plumb: libm::cos(design.channel.slope) };
    let heights = rope_heights(design, guideline);
    let held = matches!(&design.barrier, BarrierDesign::FlexibleNet(net) if net.bottom == Bottom::Fixed);
    let ropes = heights.iter().enumerate().map(|(index, z)| {
        let bolted = index == 0 && held;
        let ends = if bolted { guideline.section.bed_ends() } else { guideline.section.banks(*z) };
        let [left, right] = drawing.ends(ends);
        let (what, value) = match bolted {
            true => ("bolted to the bed", guideline.section.bed_length()),
            false => ("anchored in the banks", right - left),
        };
        row(
            format!("Main rope {}, {what}", index + 1),
            with_unit(value, "m"),
            format!(
                "{}{:.2} m vertically above the lowest point; from {left:.2} m to {right:.2} m across, as surveyed, to the right looking downstream; area below it {:.2} m², normal to the bed",
                of_level(design, index),
                z / drawing.plumb,
                guideline.section.area(*z)
            ),
        )
    });
    ropes.collect()
}

/// The ropes of a level, by number and kind.
fn of_level(design: &Design, index: usize) -> String {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return String::new() };
    let level = &net.main_ropes.levels[index];
    format!(
        "{} of {}, breaking load {}, EA {} (each); ",
        if level.ropes > 1 { format!("{} ropes side by side", level.ropes) } else { "one rope".to_string() },
        with_unit(level.rope.diameter, "m"),
        with_unit(level.rope.breaking_load, "N"),
        with_unit(level.rope.axial_stiffness(), "N")
    )
}

fn release_row(run: &Run) -> Option<Row> {
    let (design, channel) = (&run.file.design, &run.file.design.channel);
    let surveyed = channel.survey.is_some() || channel.profile.is_some();
    run.simulated.as_ref().filter(|_| surveyed)?;
    let reach = (run.guideline.input.barrier_height * libm::tan(run.guideline.lean)).max(0.0);
    // An inlet is told with its hydrograph.
    if design.flow.hydrograph.is_some() {
        return None;
    }
    let block = Block::of(&design.flow, channel, reach);
    let [near, far] = [-block.front, block.length - block.front];
    let slopes = channel.profile.as_ref().map_or(String::new(), |profile| {
        let slope = |along: f64| profile.at(-along).slope.to_degrees();
        format!(", where the bed slopes at {:.1}° and {:.1}°", slope(near), slope(far))
    });
    let remark = format!(
        "from {near:.1} m to {far:.1} m upstream of the barrier's foot, along the bed{slopes}; reaches beyond take no part in the simulation, only in what is stored"
    );
    Some(row("Flow at its release", with_unit(block.length, "m"), remark))
}

/// The ground from above, where a raster tells it.
fn above(run: &Run) -> Option<Chart> {
    let (design, guideline) = (&run.file.design, &run.guideline);
    let channel = &design.channel;
    let (relief, profile) = (channel.mesh.as_ref()?, channel.profile.as_ref()?);
    let block = Block::of(&design.flow, channel, (guideline.input.barrier_height * libm::tan(guideline.lean)).max(0.0));
    let level = |along: f64| -profile.at(along).x;
    let release = [level(block.front), level(block.front - block.length)];
    let barrier = guideline.section.banks(guideline.input.barrier_height);
    let note = "To scale, in the directions of the barrier; grey: the lowest line. The section is taken on the line between the barrier's ends, the ground of the simulation is the raster itself, two triangles to each cell.";
    let drawn = Plan { relief, barrier, release: run.simulated.is_some().then_some(release) };
    Some(Chart::of("Terrain from above", plan(&drawn), note))
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

    /// The bed, from the left to the right.
    fn bed(&self) -> Vec<[f64; 2]> {
        let Section::Surveyed(survey) = self.section else { return Vec::new() };
        survey.bed().iter().rev().map(|[y, z]| [self.right(*y), z / self.plumb]).collect()
    }

    fn ground(&self) -> Vec<[f64; 2]> {
        let points = self.design.channel.ground_line();
        points.iter().rev().map(|[y, z]| [self.right(*y), z / self.plumb]).collect()
    }
}

/// Heights of the main ropes over the bed, normal to it, from the bottom (m).
fn rope_heights(design: &Design, guideline: &Guideline) -> Vec<f64> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return Vec::new() };
    let above = |along: f64| along * libm::cos(guideline.lean) + net.bottom.gap();
    net.main_ropes.heights().into_iter().map(above).collect()
}

/// The rings of a ring net as they are modelled, whole ones as circles.
fn rings(drawing: &Drawing) -> Vec<Ring> {
    let BarrierDesign::FlexibleNet(net) = &drawing.design.barrier else { return Vec::new() };
    let Some(rings) = &net.rings else { return Vec::new() };
    let barrier = build_net(net, &drawing.design.channel, BarrierModel::PinnedRopes, 1).barrier;
    let place = |node: &u32| {
        let place = barrier.nodes[*node as usize].position;
        [drawing.right(place.y), place.z / drawing.plumb]
    };
    let ring = |ring: &NetRing| {
        let contacts: Vec<[f64; 2]> = ring.nodes.iter().map(place).collect();
        if ring.bending > 0.0 {
            let middle =
                [0, 1].map(|axis| contacts.iter().map(|contact| contact[axis]).sum::<f64>() / contacts.len() as f64);
            Ring::Whole { middle, diameter: rings.diameter }
        } else {
            Ring::Cut { contacts }
        }
    };
    barrier.net_rings.iter().map(ring).collect()
}

/// The barrier in its section, as it is drawn.
pub fn section_drawn(run: &Run) -> CrossSection {
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
        let length = if bolted(index) { section.bed_length() } else { to - from };
        let ropes = match &design.barrier {
            BarrierDesign::FlexibleNet(net) => net.main_ropes.levels[index].ropes,
            BarrierDesign::RigidWall(_) => 1,
        };
        let times = if ropes > 1 { format!("{ropes} ×, ") } else { String::new() };
        let posts = if index + 1 == heights.len() { design.posts().map_or(0, |posts| posts.at.len()) } else { 0 };
        let what = match (bolted(index), posts) {
            (true, _) => "bolted,".to_string(),
            (false, 0) => "span".to_string(),
            (false, 1) => "over a post,".to_string(),
            (false, posts) => format!("over {posts} posts,"),
        };
        Member {
            label: format!("rope {}, {times}{what} {length:.2} m", index + 1),
            height: z / plumb,
            ends: drawing.ends([from, to]),
            anchored: (!bolted(index)).then(|| set_backs(design, index)),
            line: if bolted(index) { drawing.bed() } else { Vec::new() },
        }
    };
    let mut members: Vec<Member> = heights.iter().enumerate().map(member).collect();
    let top = guideline.input.barrier_height;
    if members.is_empty() {
        let [from, to] = section.banks(top);
        let label = format!("top, {:.2} m wide", to - from);
        members.push(Member {
            label,
            height: top / plumb,
            ends: drawing.ends([from, to]),
            anchored: None,
            line: Vec::new(),
        });
    }
    let low = heights.first().copied().unwrap_or(0.0);
    CrossSection {
        ground: drawing.ground(),
        members,
        posts: posts(&drawing, top),
        outline: outline(&drawing, low, top),
        rings: rings(&drawing),
        bed: drawing.ends(section.bed_ends()),
        surfaces: vec![(format!("flow, {:.2} m", guideline.input.depth / plumb), guideline.input.depth / plumb)],
    }
}

fn across(run: &Run) -> Chart {
    let (design, guideline) = (&run.file.design, &run.guideline);
    let (plumb, top) = (libm::cos(design.channel.slope), guideline.input.barrier_height);
    let section = &guideline.section;
    let is_net = matches!(design.barrier, BarrierDesign::FlexibleNet(_));
    let note = format!(
        "To scale, looking downstream; heights are vertical, over the lowest point of the bed. The barrier's top is {:.2} m high, vertically, and {:.2} m normal to the bed, which is the height that the load equations use.{}{}",
        top / plumb,
        top,
        match (section, is_net) {
            (Section::Rectangle { .. }, _) => String::new(),
            (Section::Surveyed(_), true) => format!(
                " Where a load or a result is told per width, it is over the mean width of the section up to there, {:.2} m, unless it says otherwise.",
                guideline.width
            ),
            (Section::Surveyed(_), false) => format!(
                " What the wall bears per width is of its deepest metre, which takes the pressure of every height; segments are told over their own widths, and resistances of the whole wall over the mean width, {:.2} m.",
                guideline.width
            ),
        },
        if is_net {
            " Ropes are drawn straight, with the length from bank to bank; circles are the heads of ground anchors."
        } else {
            ""
        }
    );
    Chart::of("Barrier in its section", cross_section(&section_drawn(run)), note)
}

/// How far behind the left and the right edge of the net a main rope is anchored (m).
fn set_backs(design: &Design, rope: usize) -> [f64; 2] {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return [0.0; 2] };
    [Bank::Left, Bank::Right].map(|bank| net.anchor_designs.of(rope, bank).set_back)
}

/// Foot and head of each post.
fn posts(drawing: &Drawing, top: f64) -> Vec<[[f64; 2]; 2]> {
    let BarrierDesign::FlexibleNet(net) = &drawing.design.barrier else { return Vec::new() };
    let channel = &drawing.design.channel;
    let of = |right: &f64| [channel.ground_at(channel.across(*right)), top].map(|up| [*right, up / drawing.plumb]);
    net.posts.iter().flat_map(|posts| &posts.at).map(of).collect()
}

/// Posts and their ropes from above.
fn retained(run: &Run) -> Option<Chart> {
    let (design, guideline) = (&run.file.design, &run.guideline);
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return None };
    let posts = net.posts.as_ref()?;
    let drawing = Drawing { design, section: &guideline.section, plumb: libm::cos(design.channel.slope) };
    let top = guideline.input.barrier_height;
    let ends = drawing.ends(guideline.section.banks(top));
    let behind = set_backs(design, net.main_ropes.levels.len() - 1);
    // By the level: along the bed and out of it, turned by the slope.
    let upstream = |x: f64, z: f64| -(x * libm::cos(design.channel.slope) + z * libm::sin(design.channel.slope));
    let of = |right: &f64| {
        let held = input(design, posts, *right, top);
        let (sine, cosine) = libm::sincos(held.lean);
        let head = [*right, upstream(-sine * held.length, cosine * held.length)];
        let anchor = |place: &[f64; 3]| [*right - place[1], upstream(place[0], place[2])];
        (head, held.anchors.iter().map(anchor).collect())
    };
    let drawn = PostsPlan {
        ends,
        anchors: [ends[0] - behind[0], ends[1] + behind[1]],
        posts: posts.at.iter().map(of).collect(),
    };
    let note = "To scale, upstream at the top; squares: heads of posts, circles: heads of ground anchors. The ground has the section of the barrier over the bed upstream.";
    Some(Chart::of("Posts and retaining ropes from above", posts_plan(&drawn), note))
}

/// What closes the section between two heights: from bank to bank, and down to the ground or to the lower edge.
fn outline(drawing: &Drawing, low: f64, top: f64) -> Vec<[f64; 2]> {
    let [right, left] = drawing.section.banks(top);
    let ground = drawing.design.channel.ground_line();
    let mut line = vec![[right, top]];
    line.extend(ground.iter().filter(|point| (right..=left).contains(&point[0])).map(|[y, z]| [*y, z.clamp(low, top)]));
    // Where a bank goes through the lower edge.
    for side in drawing.section.banks(low) {
        if low > 0.0 {
            line.push([side, low]);
        }
    }
    line.push([left, top]);
    line.sort_by(|a, b| a[0].total_cmp(&b[0]));
    line.into_iter().map(|[y, z]| [drawing.right(y), z / drawing.plumb]).collect()
}

/// Bed, barrier and the deposit that the filled barrier keeps, as they are drawn; no deposit where none ends on the bed.
pub fn profile_drawn(run: &Run) -> LongProfile {
    let (design, guideline) = (&run.file.design, &run.guideline);
    let surfaces = guideline.retention.map_or_else(Vec::new, |held| {
        let reservoir = reservoir(design);
        let surface = |name: &str, slope: Slope| {
            let stored = reservoir.stored(held.deposit.height, slope, 0.0)?;
            let name = format!("{name}: {}, {} long", with_unit(stored.volume, "m³"), with_unit(stored.length, "m"));
            Some(Surface { name, height: held.deposit.height, slope, length: stored.length })
        };
        let level = (held.deposit.surface > 0.0).then(|| surface("level", Slope::Plane(0.0))).flatten();
        surface("at the design slope", Slope::OfTheBed(design.loads.deposit_slope)).into_iter().chain(level).collect()
    });
    let top = guideline.input.barrier_height;
    LongProfile {
        slope: design.channel.slope,
        profile: design.channel.profile.clone().unwrap_or_else(|| Profile::new(design.channel.slope, &[], &[], 0.0)),
        top: [-top * libm::tan(guideline.lean), top],
        surfaces,
    }
}

/// The same as a picture; nothing where no deposit ends on the bed.
fn along(run: &Run) -> Option<Chart> {
    let (design, guideline) = (&run.file.design, &run.guideline);
    let held = guideline.retention?;
    let note = format!(
        "To scale, heights vertical. What the filled barrier holds below a surface that starts {} above the bed (normal to it) at the barrier.{}",
        with_unit(held.deposit.height, "m"),
        if design.channel.profile.is_some() {
            " Volumes are summed along the bed, reach by reach; at the design slope the surface has its share of the slope of each reach."
        } else {
            ""
        }
    );
    Some(Chart::of("Bed, barrier and deposit along the channel", long_profile(&profile_drawn(run)), note))
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
        "Design slope: at the barrier the deposit's surface falls at {:.1}°, the bed at {:.1}°. The filled barrier keeps {} of its {} (loads.filled_height). {}{}",
        held.deposit.surface.to_degrees(),
        held.deposit.slope.to_degrees(),
        with_unit(held.deposit.height, "m"),
        with_unit(top, "m"),
        match event.level.is_finite() {
            true => format!("The event stands {} high with a level surface.", with_unit(event.level, "m")),
            false => "How high the event stands with a level surface is not known.".to_string(),
        },
        if event.level.is_finite() && event.level > top { " That is more than the barrier's height." } else { "" }
    );
    Some(Chart::of("Storage curve", chart.svg(), note))
}
