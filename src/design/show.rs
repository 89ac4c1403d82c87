//! How a message names the keys of a net, and lengths.

use crate::units::Dimension;

pub const NET: &str = "barrier.flexible_net";

pub fn at(name: &str) -> String {
    format!("{NET}.{name}")
}

pub fn length(value: f64) -> String {
    Dimension::Length.show(value)
}
