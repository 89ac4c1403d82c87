//! The full barrier once its deposit has drained: a smaller K and density, both given by the designer.

use crate::loads::cases::full;
use crate::loads::cases::load_case::{AdditionalActions, Certainty, LoadCase};
use crate::loads::input::GuidelineInput;
use crate::text::Text;

pub(crate) const TEXTS: &[Text] = &[Text {
    id: "drained",
    meaning: "The full barrier after the water has drained: with the earth pressure coefficient and density of loads.drained.",
    formula: "R = ½ K_d ρ_d g cos α H²",
    source: "K and density of the drained deposit are of the design file",
}];

pub fn case(input: &GuidelineInput, extras: &AdditionalActions) -> Option<LoadCase> {
    let [earth_pressure, density] = extras.drained?;
    let drained = full::case(&GuidelineInput { earth_pressure, density, ..*input });
    Some(LoadCase {
        id: "drained",
        title: "Full, drained",
        not_simulated: Some("the drained deposit"),
        certainty: Certainty::Given,
        source: "K and density of the drained deposit: design file",
        ..drained
    })
}
