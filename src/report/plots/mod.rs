//! Charts as plain SVG, so that the report opens offline and prints sharply.

pub(crate) mod cost_margin;
pub(crate) mod cross_section;
pub(crate) mod elevation;
pub(crate) mod importance;
pub(crate) mod line_chart;
pub(crate) mod long_profile;
pub(crate) mod pareto;
pub(crate) mod plan;
pub(crate) mod posts_plan;
pub(crate) mod pressure;
pub(crate) mod profile;
pub(crate) mod side_view;
pub(crate) mod surges;
pub(crate) mod utilisation;

/// Text as it may stand in SVG.
pub(in crate::report) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A bar of a round length with its label, from the given place to the right; `scale` in units of the picture per metre.
pub(super) fn scale_bar(left: f64, y: f64, scale: f64, room: f64) -> String {
    let lengths = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0];
    let length = lengths.into_iter().rev().find(|length| length * scale <= room).unwrap_or(lengths[0]);
    let right = left + length * scale;
    format!(
        r#"<line class="scale" x1="{left:.1}" x2="{right:.1}" y1="{y:.1}" y2="{y:.1}"/><text x="{:.1}" y="{:.1}">{length} m</text>"#,
        right + 5.0,
        y + 4.0
    )
}
