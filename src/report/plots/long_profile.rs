//! Bed, barrier and deposits along the channel, to scale, gravity downwards.

use std::fmt::Write;

const WIDTH: f64 = 720.0;
const MARGIN: f64 = 12.0;
/// Room below the bed for the scale, and above for names.
const BELOW: f64 = 30.0;
const ABOVE: f64 = 22.0;
/// Bed drawn downstream of the barrier, over the height of the barrier.
const DOWNSTREAM: f64 = 1.5;
/// Least length drawn upstream of it, over the same.
const UPSTREAM: f64 = 4.0;

/// A plane surface of a deposit, from the barrier upstream.
pub struct Surface {
    pub name: String,
    /// Height at the barrier, normal to the bed (m), and slope below the horizontal downstream (rad).
    pub height: f64,
    pub slope: f64,
}

/// What is drawn.
pub struct LongProfile {
    /// Of the bed (rad).
    pub slope: f64,
    /// Top of the barrier over its foot: along the bed, and normal to it (m).
    pub top: [f64; 2],
    pub surfaces: Vec<Surface>,
}

pub fn long_profile(drawn: &LongProfile) -> String {
    let (sine, cosine) = libm::sincos(drawn.slope);
    // Level and plumb, from what is along the bed and normal to it.
    let turned = |[along, normal]: [f64; 2]| [along * cosine + normal * sine, normal * cosine - along * sine];
    let [top_x, top_z] = turned(drawn.top);
    let lean = drawn.top[0] / drawn.top[1];
    let end_of = |surface: &Surface| {
        let start = turned([lean * surface.height, surface.height]);
        let falls = libm::tan(drawn.slope) - libm::tan(surface.slope);
        // Heights over the bed fall by this much per level metre upstream.
        let above = start[1] + start[0] * libm::tan(drawn.slope);
        let length = above / falls;
        (start, [start[0] - length, start[1] + length * libm::tan(surface.slope)])
    };
    let ends = drawn.surfaces.iter().map(|surface| end_of(surface).1[0]);
    let tall = top_z.abs().max(drawn.top[1]);
    let left = ends.fold(-UPSTREAM * tall, f64::min) * 1.05;
    let right = DOWNSTREAM * tall;
    let scale = (WIDTH - 2.0 * MARGIN) / (right - left);
    let bed = |x: f64| -x * libm::tan(drawn.slope);
    let highest = bed(left).max(top_z);
    let lowest = bed(right);
    let place = |[x, z]: [f64; 2]| [MARGIN + (x - left) * scale, ABOVE + (highest - z) * scale];
    let height = ABOVE + (highest - lowest) * scale + BELOW;
    let mut svg = format!(
        "<svg viewBox=\"0 0 {WIDTH} {height:.0}\" role=\"img\" aria-label=\"bed, barrier and deposits along the channel\">"
    );
    for surface in &drawn.surfaces {
        let (start, end) = end_of(surface);
        let ([x1, y1], [x2, y2]) = (place(start), place(end));
        let [x3, y3] = place([0.0, 0.0]);
        let _ = write!(svg, "<polygon class=\"deposit\" points=\"{x1:.1},{y1:.1} {x2:.1},{y2:.1} {x3:.1},{y3:.1}\"/>");
    }
    let line = |class: &str, from: [f64; 2], to: [f64; 2]| {
        let ([x1, y1], [x2, y2]) = (place(from), place(to));
        format!("<line class=\"{class}\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>")
    };
    svg += &line("bed", [left, bed(left)], [right, bed(right)]);
    svg += &line("wall", [0.0, 0.0], [top_x, top_z]);
    // Names one below the other at the left, over the bed, each at the upstream end of its surface.
    for (index, surface) in drawn.surfaces.iter().enumerate() {
        let (start, end) = end_of(surface);
        let [x, y] = place([0, 1].map(|axis| 0.4 * start[axis] + 0.6 * end[axis]));
        let _ = write!(
            svg,
            "<polyline class=\"leader\" points=\"{x:.1},{y:.1} {:.1},{:.1}\"/><text x=\"{:.1}\" y=\"{:.1}\">{}</text>",
            WIDTH - 300.0,
            14.0 + 15.0 * index as f64,
            WIDTH - 296.0,
            18.0 + 15.0 * index as f64,
            super::escape(&surface.name)
        );
    }
    svg + &super::scale_bar(MARGIN, height - 10.0, scale, 0.25 * WIDTH) + "</svg>"
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plumb barrier of 3 m on 20°: its level deposit ends 3/tan 20° = 8.24 m upstream.
    #[test]
    fn a_level_deposit_ends_where_it_meets_the_bed() {
        let slope = 20_f64.to_radians();
        let normal = 3.0 * libm::cos(slope);
        let drawn = LongProfile {
            slope,
            top: [-3.0 * libm::sin(slope), normal],
            surfaces: vec![Surface { name: "level".into(), height: normal, slope: 0.0 }],
        };
        let svg = long_profile(&drawn);
        let points = svg.split("class=\"deposit\" points=\"").nth(1).and_then(|rest| rest.split('"').next()).unwrap();
        let x: Vec<f64> = points.split(' ').map(|pair| pair.split(',').next().unwrap().parse().unwrap()).collect();
        let y: Vec<f64> = points.split(' ').map(|pair| pair.split(',').nth(1).unwrap().parse().unwrap()).collect();
        assert!((y[0] - y[1]).abs() < 0.2);
        let ratio = (x[0] - x[1]) / (y[2] - y[0]);
        assert!((ratio - 1.0 / libm::tan(slope)).abs() < 0.02, "{ratio}");
    }
}
