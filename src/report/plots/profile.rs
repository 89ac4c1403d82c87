//! Pressure on the barrier over its height: what the simulation shows in strips, beside a pressure diagram.

use std::fmt::Write;

use crate::loads::pressure::Diagram;
use crate::section::Section;

const WIDTH: f64 = 460.0;
const HEIGHT: f64 = 300.0;
const LEFT: f64 = 52.0;
const RIGHT: f64 = 20.0;
const BASE: f64 = 262.0;
const TOP: f64 = 14.0;
/// Strips into which the height is cut.
const STRIPS: usize = 10;
/// Points of the diagram.
const POINTS: usize = 60;

/// Touches as height (m) and force along the channel (N), over a section.
pub fn profile(touches: &[[f64; 2]], section: &Section, height: f64, guideline: &Diagram) -> String {
    let strip = height / STRIPS as f64;
    let mut pressures = [0.0; STRIPS];
    let area = |index: usize| match section {
        Section::Rectangle { width } => strip * width,
        Section::Surveyed(_) => section.area((index + 1) as f64 * strip) - section.area(index as f64 * strip),
    };
    for [place, force] in touches {
        let index = (place / strip).max(0.0) as usize;
        if index < STRIPS {
            pressures[index] += force / area(index);
        }
    }
    let heights = (0..=POINTS).map(|point| height * point as f64 / POINTS as f64);
    let line: Vec<[f64; 2]> = heights.map(|height| [guideline.at(height), height]).collect();
    let largest = pressures.iter().copied().chain(line.iter().map(|point| point[0])).fold(1.0, f64::max);
    let across = |pressure: f64| LEFT + (WIDTH - LEFT - RIGHT) * pressure.max(0.0) / largest;
    let up = |height_at: f64| BASE - (BASE - TOP) * height_at / height;
    let mut svg = format!("<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"pressure over height\">");
    for (index, pressure) in pressures.iter().enumerate() {
        let (y, tall) = (up((index + 1) as f64 * strip), (BASE - TOP) / STRIPS as f64);
        let _ = write!(
            svg,
            "<rect class=\"static\" x=\"{LEFT}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"{tall:.1}\"/>",
            across(*pressure) - LEFT
        );
    }
    let points: Vec<String> =
        line.iter().map(|[pressure, height]| format!("{:.1},{:.1}", across(*pressure), up(*height))).collect();
    let _ = write!(svg, "<polyline class=\"series c1\" points=\"{}\"/>", points.join(" "));
    let _ = write!(svg, "<line class=\"axis\" x1=\"{LEFT}\" y1=\"{TOP}\" x2=\"{LEFT}\" y2=\"{BASE}\"/>");
    let _ = write!(svg, "<line class=\"axis\" x1=\"{LEFT}\" y1=\"{BASE}\" x2=\"{}\" y2=\"{BASE}\"/>", WIDTH - RIGHT);
    for share in [0.0, 0.5, 1.0] {
        let _ = write!(
            svg,
            "<text text-anchor=\"middle\" x=\"{:.1}\" y=\"{}\">{:.1}</text><text text-anchor=\"end\" x=\"{}\" y=\"{:.1}\">{:.2} m</text>",
            across(share * largest),
            BASE + 16.0,
            share * largest / 1e3,
            LEFT - 6.0,
            up(share * height) + 4.0,
            share * height
        );
    }
    let _ = write!(
        svg,
        "<text text-anchor=\"middle\" x=\"{}\" y=\"{}\">pressure (kPa)</text></svg>",
        0.5 * WIDTH,
        BASE + 32.0
    );
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strip_is_as_long_as_its_pressure() {
        // One touch of 10 kN in the lowest of ten strips of 0.1 m, on 2 m: 50 kPa, the largest there is.
        let svg = profile(&[[0.05, 1e4]], &Section::Rectangle { width: 2.0 }, 1.0, &Diagram::default());
        let whole = WIDTH - LEFT - RIGHT;
        assert!(svg.contains(&format!("width=\"{whole:.1}\"")) && svg.contains(">50.0<"), "{svg}");
    }
}
