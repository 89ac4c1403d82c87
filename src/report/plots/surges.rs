//! A chart over the surges of an event: for each a bar by the guideline and one by the simulation, with its scatter.

use std::fmt::Write;

/// What one surge shows; forces in the unit of the chart.
pub struct Pair {
    pub guideline: f64,
    pub simulation: f64,
    /// Least and largest over several packings.
    pub scatter: Option<[f64; 2]>,
}

const WIDTH: f64 = 500.0;
const HEIGHT: f64 = 240.0;
const LEFT: f64 = 56.0;
const TOP: f64 = 30.0;
const BASE: f64 = 204.0;

/// SVG of the chart; forces in `unit`.
pub fn surges(pairs: &[Pair], unit: &str) -> String {
    let highest =
        pairs.iter().flat_map(|pair| [pair.guideline, pair.simulation, pair.scatter.map_or(0.0, |[_, most]| most)]);
    let highest = highest.filter(|value| value.is_finite()).fold(1e-9, f64::max);
    let up = |value: f64| BASE - (BASE - TOP) * value / (1.08 * highest);
    let room = (WIDTH - LEFT - 8.0) / pairs.len().max(1) as f64;
    let wide = (0.32 * room).min(60.0);
    let mut svg = format!(r#"<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="force of each surge">"#);
    for (key, x) in [("static", LEFT), ("dynamic", LEFT + 110.0)] {
        let name = if key == "static" { "guideline" } else { "simulation" };
        let _ = write!(
            svg,
            r#"<rect class="{key}" x="{x}" y="6" width="12" height="10"/><text x="{}" y="15">{name}</text>"#,
            x + 17.0
        );
    }
    for tick in ticks(highest) {
        let y = up(tick);
        let _ = write!(
            svg,
            r#"<line class="grid" x1="{LEFT}" y1="{y:.1}" x2="{WIDTH}" y2="{y:.1}"/><text class="tick" text-anchor="end" x="{}" y="{:.1}">{tick}</text>"#,
            LEFT - 6.0,
            y + 4.0
        );
    }
    let _ = write!(svg, r#"<text x="2" y="24">{unit}</text>"#);
    for (number, pair) in pairs.iter().enumerate() {
        let middle = LEFT + room * (number as f64 + 0.5);
        for (class, value, x) in
            [("static", pair.guideline, middle - wide - 1.0), ("dynamic", pair.simulation, middle + 1.0)]
        {
            if value.is_finite() && value > 0.0 {
                let y = up(value);
                let _ = write!(
                    svg,
                    r#"<rect class="{class}" x="{x:.1}" y="{y:.1}" width="{wide:.1}" height="{:.1}"/>"#,
                    BASE - y
                );
            }
        }
        if let Some([least, most]) = pair.scatter {
            let x = middle + 1.0 + 0.5 * wide;
            let _ = write!(
                svg,
                r#"<line class="scale" x1="{x:.1}" y1="{:.1}" x2="{x:.1}" y2="{:.1}"/>"#,
                up(least),
                up(most)
            );
        }
        let _ = write!(
            svg,
            r#"<text text-anchor="middle" x="{middle:.1}" y="{}">surge {}</text>"#,
            BASE + 16.0,
            number + 1
        );
    }
    let _ = write!(svg, r#"<line class="axis" x1="{LEFT}" y1="{BASE}" x2="{WIDTH}" y2="{BASE}"/></svg>"#);
    svg
}

/// Four round values or so, up to the highest.
fn ticks(highest: f64) -> Vec<f64> {
    let rough = highest / 4.0;
    let magnitude = libm::exp10(libm::log10(rough).floor());
    let step = [1.0, 2.0, 2.5, 5.0, 10.0].into_iter().map(|times| times * magnitude).find(|step| *step >= rough);
    let step = step.unwrap_or(10.0 * magnitude);
    (0..)
        .map(|count| (f64::from(count) * step * 1e6).round() / 1e6)
        .take_while(|tick| *tick <= 1.08 * highest)
        .collect()
}
