//! A slice along the middle of the channel, seen from the side with gravity downwards: grains by speed, barrier, bed.

use std::fmt::Write;

use dem::Vec3;
use dem::recorders::snapshots::Snapshot;

const WIDTH: f64 = 460.0;
const HEIGHT: f64 = 330.0;
/// How far the picture reaches up and down from the barrier's foot, level, in plumb heights of the barrier.
const UPSTREAM: f64 = 2.2;
const DOWNSTREAM: f64 = 1.4;
/// Spheres drawn at the most.
const MOST: usize = 900;
/// Share of the channel's width that the slice takes, if that is not too many spheres.
const SLICE: f64 = 0.1;
/// Upper ends of the classes of speed, as shares of the highest mean velocity; the first is at rest.
const CLASSES: [f64; 4] = [0.05, 0.35, 0.75, f64::INFINITY];

/// What is drawn around the snapshot, SI.
pub struct Setting {
    pub slope: f64,
    /// (x, z) of the bed along the channel (m).
    pub bed: Vec<[f64; 2]>,
    /// Where the middle of the bed is across the channel, and the width of which the slice is a share.
    pub middle: f64,
    pub width: f64,
    /// Of the barrier, normal to the bed.
    pub height: f64,
    /// Top of a rigid wall over its foot (m along the channel, m normal to the bed), if that is the barrier.
    pub wall: Option<[f64; 2]>,
    /// Highest mean velocity of the flow.
    pub fastest: f64,
}

pub fn side_view(snapshot: &Snapshot, setting: &Setting) -> String {
    let (sine, cosine) = libm::sincos(setting.slope);
    let turned = |place: &Vec3| (place.x * cosine + place.z * sine, place.z * cosine - place.x * sine);
    let reach = setting.height / cosine;
    let (left, right) = (-UPSTREAM * reach, DOWNSTREAM * reach);
    let scale = (WIDTH - 8.0) / (right - left);
    let middle = HEIGHT * 0.5;
    let screen = |place: &Vec3| {
        let (across, up) = turned(place);
        (4.0 + (across - left) * scale, middle - (up - 0.25 * reach) * scale)
    };
    let mut svg = format!(
        "<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"side view at {:.2} s\">",
        snapshot.time
    );
    let mut line = |class: &str, from: Vec3, to: Vec3| {
        let ((x1, y1), (x2, y2)) = (screen(&from), screen(&to));
        let _ = write!(svg, "<line class=\"{class}\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>");
    };
    for pair in setting.bed.windows(2) {
        let ([from, to], reach) = ([pair[0], pair[1]], [2.0 * left / cosine, 2.0 * right / cosine]);
        // As far as the picture goes.
        let [near, far] = reach.map(|x| x.clamp(from[0], to[0]));
        let at = |x: f64| Vec3::new(x, 0.0, from[1] + (to[1] - from[1]) * (x - from[0]) / (to[0] - from[0]));
        if far > near {
            line("bed", at(near), at(far));
        }
    }
    if let Some([x, z]) = setting.wall {
        line("wall", Vec3::zeros(), Vec3::new(x, 0.0, z));
    }
    let within = |place: &Vec3, share: f64| (place.y - setting.middle).abs() <= 0.5 * share * setting.width;
    let visible = |place: &Vec3| {
        let (x, y) = screen(place);
        (-20.0..WIDTH + 20.0).contains(&x) && (-20.0..HEIGHT + 20.0).contains(&y)
    };
    let inside =
        |share: f64| snapshot.balls.iter().filter(move |ball| within(&ball.place, share) && visible(&ball.place));
    let share = SLICE * (MOST as f64 / inside(SLICE).count().max(1) as f64).min(1.0);
    let mut groups = vec![String::new(); CLASSES.len()];
    for ball in inside(share) {
        let class = CLASSES.iter().position(|limit| ball.speed <= limit * setting.fastest).unwrap_or(CLASSES.len() - 1);
        let (x, y) = screen(&ball.place);
        let _ = write!(groups[class], "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{:.1}\"/>", ball.radius * scale);
    }
    for (class, group) in groups.iter().enumerate() {
        let _ = write!(svg, "<g class=\"v{class}\">{group}</g>");
    }
    let near = |member: &&dem::recorders::snapshots::AxialMember| within(&member.ends[0], 2.0 * SLICE);
    let mut path = String::new();
    for member in snapshot.axial_members.iter().filter(near) {
        let [(x1, y1), (x2, y2)] = [screen(&member.ends[0]), screen(&member.ends[1])];
        let _ = write!(path, "M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}");
    }
    let _ = write!(
        svg,
        "<path class=\"net\" d=\"{path}\"/>{}</svg>",
        super::scale_bar(10.0, HEIGHT - 12.0, scale, 0.25 * WIDTH)
    );
    svg
}
