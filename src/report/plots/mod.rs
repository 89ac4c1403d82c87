//! Charts as plain SVG, so that the report opens offline and prints sharply.

pub mod elevation;
pub mod line_chart;
pub mod pressure;
pub mod profile;
pub mod side_view;
