//! A barrier with posts from above, to scale, looking downstream: posts, retaining ropes and anchors.

use std::fmt::Write;

const WIDTH: f64 = 720.0;
const MARGIN: f64 = 14.0;
/// Room above for the labels of the anchors, and below for the barrier's name and the scale.
const ABOVE: f64 = 24.0;
const BELOW: f64 = 52.0;

/// What is drawn: distances to the right and level distances upstream (m).
pub struct PostsPlan {
    /// Where the barrier begins and ends.
    pub ends: [f64; 2],
    /// Anchors of the uppermost rope.
    pub anchors: [f64; 2],
    /// Head of each post, with the anchors of its ropes.
    pub posts: Vec<([f64; 2], Vec<[f64; 2]>)>,
}

pub fn posts_plan(drawn: &PostsPlan) -> String {
    let places = drawn.posts.iter().flat_map(|(head, anchors)| anchors.iter().chain([head]));
    let across = places.clone().map(|place| place[0]).chain(drawn.ends).chain(drawn.anchors);
    let (left, right) = across.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    let furthest = places.map(|place| place[1]).fold(0.0, f64::max);
    let scale = (WIDTH - 2.0 * MARGIN) / (right - left);
    let foot = ABOVE + furthest * scale;
    let (x, y) = (|across: f64| MARGIN + (across - left) * scale, |upstream: f64| foot - upstream * scale);
    let mut svg = format!(
        "<svg viewBox=\"0 0 {WIDTH} {:.0}\" role=\"img\" aria-label=\"posts and their ropes from above\">",
        foot + BELOW
    );
    let _ = write!(
        svg,
        "<line class=\"rope\" x1=\"{:.1}\" x2=\"{:.1}\" y1=\"{2:.1}\" y2=\"{2:.1}\"/><text x=\"{3:.1}\" y=\"{4:.1}\">barrier</text>",
        x(drawn.anchors[0]),
        x(drawn.anchors[1]),
        y(0.0),
        x(drawn.ends[0]) + 4.0,
        y(0.0) + 16.0
    );
    let circle = |place: [f64; 2], class: &str| {
        format!("<circle class=\"{class}\" cx=\"{:.1}\" cy=\"{:.1}\" r=\"3.5\"/>", x(place[0]), y(place[1]))
    };
    for (number, (head, anchors)) in drawn.posts.iter().enumerate() {
        for anchor in anchors {
            let _ = write!(
                svg,
                "<line class=\"retaining\" x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\"/>",
                x(head[0]),
                y(head[1]),
                x(anchor[0]),
                y(anchor[1])
            );
            svg += &circle(*anchor, "anchor");
        }
        let _ = write!(
            svg,
            "<rect class=\"post\" x=\"{:.1}\" y=\"{:.1}\" width=\"8\" height=\"8\"/><text text-anchor=\"middle\" x=\"{:.1}\" y=\"{:.1}\">post {}</text>",
            x(head[0]) - 4.0,
            y(head[1]) - 4.0,
            x(head[0]),
            y(0.0) + 16.0,
            number + 1
        );
    }
    for place in drawn.anchors {
        svg += &circle([place, 0.0], "anchor");
    }
    let first = drawn.posts.first().and_then(|(_, anchors)| anchors.first());
    if let Some(anchor) = first {
        let _ = write!(
            svg,
            "<text text-anchor=\"middle\" x=\"{:.1}\" y=\"{:.1}\">ground anchor</text>",
            x(anchor[0]).max(MARGIN + 40.0),
            y(anchor[1]) - 8.0
        );
    }
    svg + &super::scale_bar(MARGIN, foot + BELOW - 8.0, scale, 0.2 * WIDTH) + "</svg>"
}
