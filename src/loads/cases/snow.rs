//! Snow against the barrier: a uniform pressure that the designer gives.

use crate::loads::cases::full;
use crate::loads::cases::load_case::{Certainty, LoadCase};
use crate::loads::cases::working::Working;
use crate::loads::input::GuidelineInput;
use crate::loads::pressure::Diagram;
use crate::text::Text;

pub(crate) const TEXTS: &[Text] = &[Text {
    id: "snow",
    meaning: "Snow pressure on the empty barrier, as the design gives it (loads.snow_pressure).",
    formula: "R = p_snow H",
    source: "",
}];

pub fn case(input: &GuidelineInput, pressure: f64) -> LoadCase {
    let top = input.barrier_height;
    let diagram = Diagram { block: pressure, block_to: top, top, ..Diagram::default() };
    LoadCase {
        id: "snow",
        title: "Snow",
        deposit: 0.0,
        not_simulated: Some("the snow"),
        working: Working::Even { diagram },
        diagram,
        formula: "R = p H",
        certainty: Certainty::Given,
        source: "pressure of the snow: design file",
        ..full::case(input)
    }
}
