//! Charts as plain SVG, so that the report opens offline and prints sharply.

pub mod elevation;
pub mod line_chart;
pub mod pareto;
pub mod pressure;
pub mod profile;
pub mod side_view;
pub mod utilisation;

/// Text as it may stand in SVG.
pub(super) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
