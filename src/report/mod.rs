//! The report: HTML and Markdown for people, JSON and CSV for programs. Computes no engineering number.

pub(crate) mod compare;
pub(crate) mod findings;
pub(crate) mod folder;
pub mod json;
pub(crate) mod kind;
pub(crate) mod loads;
pub(crate) mod manifest;
pub(crate) mod measured;
pub(crate) mod numbers;
pub(crate) mod pictures;
pub(crate) mod plots;
pub mod recording;
pub(crate) mod reliability;
pub mod render;
pub(crate) mod replay;
pub(crate) mod row;
pub(crate) mod series;
pub(crate) mod site;
pub(crate) mod spreads;
pub(crate) mod stability_map;
pub(crate) mod statements;
pub(crate) mod study;
pub mod validation;
pub mod view;
pub(crate) mod vtk;
pub(crate) mod warnings;
