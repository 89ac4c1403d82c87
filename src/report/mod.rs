//! The report: HTML and Markdown for people, JSON and CSV for programs. Computes no engineering number.

pub mod csv;
pub mod findings;
pub mod json;
pub mod loads;
pub mod plots;
pub mod render;
pub mod validation;
pub mod view;
pub mod write;
