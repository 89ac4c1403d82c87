//! The full barrier once its deposit has drained: a smaller K and density, both given by the designer.

use crate::loads::cases::full;
use crate::loads::cases::load_case::{AdditionalActions, Certainty, LoadCase};
use crate::loads::input::GuidelineInput;

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
