//! The report: HTML and Markdown for people, JSON and CSV for programs. Computes no engineering number.

pub mod compare;
pub mod findings;
pub mod folder;
pub mod json;
pub mod kind;
pub mod loads;
pub mod lock;
pub mod manifest;
pub mod numbers;
pub mod pictures;
pub mod plots;
pub mod recording;
pub mod render;
pub mod replay;
pub mod row;
pub mod series;
pub mod stability_map;
pub mod statements;
pub mod study;
pub mod validation;
pub mod view;
pub mod vtk;
pub mod warnings;
