//! The barrier filled and everything at rest: K ρ g' (H − z).

use crate::loads::cases::later_surge;
use crate::loads::cases::load_case::LoadCase;
use crate::loads::cases::working::Working;
use crate::loads::input::GuidelineInput;
use crate::loads::pressure::Diagram;
use crate::sources::VOLKWEIN_2014;
use crate::text::Text;

pub(crate) const TEXTS: &[Text] = &[Text {
    id: "full",
    meaning: "The barrier is full and everything is at rest: static pressure alone, over the height H to which the event fills it.",
    formula: "R = ½ K ρ g cos α H²",
    source: VOLKWEIN_2014,
}];

pub fn case(input: &GuidelineInput) -> LoadCase {
    let height = input.fill_height;
    let diagram = Diagram { unit: input.unit_pressure(), surface: height, top: height, ..Diagram::default() };
    LoadCase {
        id: "full",
        title: "Full, at rest",
        deposit: height,
        moving: 0.0,
        one_of_the_stages: false,
        working: Working::AtRest { input: *input, diagram },
        diagram,
        formula: "R = ½ K ρ g' H²",
        ..later_surge::case(input, height)
    }
}
