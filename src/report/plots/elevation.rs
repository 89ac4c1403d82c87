//! The barrier seen along the channel, from upstream, its right bank at the right: ropes and net coloured by the share of their design resistance.

use std::collections::BTreeMap;
use std::fmt::Write;

use dem::Vec3;
use dem::elements::segment::SegmentKind;
use dem::recorders::snapshots::{AxialMember, Snapshot};

const WIDTH: f64 = 720.0;
const MARGIN: f64 = 8.0;
/// Room that a number needs above its rope; without it the number stands below.
const ROOM_ABOVE: f64 = 16.0;
/// Room for the scale below the picture.
const FOOT: f64 = 22.0;
/// Upper ends of the classes, as shares of the design resistance.
pub const CLASSES: [f64; 6] = [0.05, 0.25, 0.5, 0.75, 1.0, f64::INFINITY];

/// SVG of the barrier, which hangs from one place across the channel to another (m); `resistance` gives the design resistance of a part (N).
pub fn elevation(snapshot: &Snapshot, [from, to]: [f64; 2], resistance: impl Fn(SegmentKind) -> f64) -> String {
    let points = || snapshot.axial_members.iter().flat_map(|member| member.ends);
    let highest = points().map(|place| place.z).fold(0.0, f64::max);
    let lowest = points().map(|place| place.z).fold(0.0, f64::min);
    let scale = (WIDTH - 2.0 * MARGIN) / (to - from);
    let height = (highest - lowest) * scale + 2.0 * MARGIN + FOOT;
    let screen = |place: &Vec3| (MARGIN + (to - place.y) * scale, MARGIN + (highest - place.z) * scale);
    let class = |member: &AxialMember| {
        // A post is pressed.
        let used = member.tension.abs() / resistance(member.kind);
        CLASSES.iter().position(|limit| used <= *limit).unwrap_or(CLASSES.len() - 1)
    };
    let mut paths = vec![[String::new(), String::new()]; CLASSES.len()];
    for member in &snapshot.axial_members {
        let [(x1, y1), (x2, y2)] = [screen(&member.ends[0]), screen(&member.ends[1])];
        let thick = usize::from(!matches!(member.kind, SegmentKind::Net | SegmentKind::Ring));
        let _ = write!(paths[class(member)][thick], "M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}");
    }
    let mut svg = format!(
        "<svg viewBox=\"0 0 {WIDTH} {height:.0}\" role=\"img\" aria-label=\"barrier from upstream, coloured by utilisation\">"
    );
    for (class, [thin, thick]) in paths.iter().enumerate() {
        let _ =
            write!(svg, "<path class=\"u{class} thin\" d=\"{thin}\"/><path class=\"u{class} thick\" d=\"{thick}\"/>");
    }
    for (rope, place) in rope_ends(snapshot) {
        let (x, y) = screen(&place);
        let _ = write!(
            svg,
            r#"<text class="on" x="{:.1}" y="{:.1}">{}</text>"#,
            x + 3.0,
            if y < ROOM_ABOVE { y + ROOM_ABOVE } else { y - 4.0 },
            rope + 1
        );
    }
    svg + &super::scale_bar(MARGIN, height - 8.0, scale, 0.2 * WIDTH) + "</svg>"
}

/// The left end of each main rope, where its number is written.
fn rope_ends(snapshot: &Snapshot) -> BTreeMap<u16, Vec3> {
    let mut ends: BTreeMap<u16, Vec3> = BTreeMap::new();
    for member in &snapshot.axial_members {
        if let SegmentKind::Main(rope) = member.kind {
            let outer = member.ends.into_iter().max_by(|a, b| a.y.total_cmp(&b.y)).unwrap_or(member.ends[0]);
            let known = ends.entry(rope).or_insert(outer);
            if outer.y > known.y {
                *known = outer;
            }
        }
    }
    ends
}

/// Words for the classes, for the legend.
pub fn class_names() -> Vec<String> {
    let mut low = 0.0;
    let mut names = Vec::new();
    for limit in CLASSES {
        names.push(if limit.is_finite() {
            format!("{:.0} to {:.0} %", 100.0 * low, 100.0 * limit)
        } else {
            "more than 100 %".to_string()
        });
        low = limit;
    }
    names
}
