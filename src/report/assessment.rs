//! What the page and the file of a reliability study tell of.

use crate::design::read::DesignFile;
use crate::reliability::distribution::Distribution;
use crate::studies::limit_states::Asked;
use crate::studies::reliability::{Answer, Assessed};
use crate::studies::reliability_plan::{Input, ReliabilityPlan};

/// An assessment with what it was asked.
pub struct Told<'a> {
    pub plan: &'a ReliabilityPlan,
    pub inputs: &'a [Input],
    /// Without any change.
    pub design: &'a DesignFile,
    /// Values of the inputs at standard normal numbers, and their weights from those of these numbers.
    pub values: &'a dyn Fn(&[f64]) -> Vec<f64>,
    pub weights: &'a dyn Fn(&[f64]) -> Vec<f64>,
    pub asked: &'a Asked,
    pub assessed: &'a Assessed,
    pub answer: Answer,
    /// Why simulations could not be relied on.
    pub doubts: &'a [String],
    /// Wall-clock time (s).
    pub took: f64,
}

/// A distribution by its name.
pub fn distribution(of: &Distribution) -> &'static str {
    match of {
        Distribution::Normal { .. } => "normal",
        Distribution::Lognormal { .. } => "lognormal",
        Distribution::Uniform { .. } => "uniform",
        Distribution::Triangular { .. } => "triangular",
        Distribution::Gumbel { .. } => "Gumbel, largest values",
        Distribution::Table(_) => "table",
    }
}
