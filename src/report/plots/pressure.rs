//! The pressure diagram of a load case: height upwards, pressure to the right, the static part hatched apart.

use std::fmt::Write;

use crate::loads::pressure::Diagram;

const WIDTH: f64 = 234.0;
const HEIGHT: f64 = 150.0;
const LEFT: f64 = 48.0;
const BASE: f64 = 126.0;

/// SVG of one diagram; all cases of a report share the largest pressure (Pa) and height (m).
pub fn pressure_diagram(diagram: &Diagram, highest: f64, tallest: f64) -> String {
    let across = |pressure: f64| LEFT + (WIDTH - LEFT - 62.0) * pressure / highest.max(1e-9);
    let up = |height: f64| BASE - (BASE - 12.0) * height / tallest.max(1e-9);
    let fixed = |height: f64| diagram.unit * (diagram.surface - height).max(0.0);
    let top = diagram.top.min(diagram.surface.max(diagram.block_to));
    let mut svg = format!("<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"pressure over height\">");
    let mut polygon = |class: &str, points: &[(f64, f64)]| {
        let points: Vec<String> =
            points.iter().map(|(pressure, height)| format!("{:.1},{:.1}", across(*pressure), up(*height))).collect();
        let _ = write!(svg, "<polygon class=\"{class}\" points=\"{}\"/>", points.join(" "));
    };
    polygon("static", &[(0.0, 0.0), (fixed(0.0), 0.0), (fixed(top), top), (0.0, top)]);
    if diagram.block > 0.0 {
        let (low, high) = (diagram.block_from, diagram.block_to.min(diagram.top));
        let beside = |height: f64| (fixed(height) + diagram.block, height);
        polygon("dynamic", &[(fixed(low), low), beside(low), beside(high), (fixed(high), high)]);
    }
    let label = |pressure: f64, height: f64| {
        let (x, y) = (across(pressure) + 4.0, (up(height) + 4.0).min(BASE));
        format!("<text x=\"{x:.1}\" y=\"{y:.1}\">{:.1} kPa</text>", pressure / 1e3)
    };
    svg += &format!("<line class=\"axis\" x1=\"{LEFT}\" y1=\"{:.1}\" x2=\"{LEFT}\" y2=\"{BASE}\"/>", up(tallest));
    svg += &label(diagram.at(0.0), 0.0);
    if diagram.block > 0.0 && diagram.block_from > 0.0 {
        svg += &label(diagram.at(diagram.block_from), 0.5 * (diagram.block_from + diagram.block_to));
    }
    svg += &format!("<text x=\"2\" y=\"{:.1}\">{top:.2} m</text>", (up(top) + 4.0).min(BASE - 12.0));
    svg += &format!("<text x=\"2\" y=\"{BASE}\">bed</text></svg>");
    svg
}
