//! The first surge on the empty barrier: p = K ρ g' (h − z) + λ ρ v² up to h.

use crate::loads::cases::later_surge;
use crate::loads::cases::load_case::LoadCase;
use crate::loads::input::GuidelineInput;
use crate::sources::VOLKWEIN_2014;
use crate::text::Text;

pub(crate) const TEXTS: &[Text] = &[Text {
    id: "first_surge",
    meaning: "The first surge meets the empty barrier: its static and its dynamic pressure act over its depth h.",
    formula: "R = ½ K ρ g cos α h² + λ ρ v² h per metre of width",
    source: VOLKWEIN_2014,
}];

pub fn case(input: &GuidelineInput) -> LoadCase {
    LoadCase {
        id: "first_surge",
        title: "First surge on the empty barrier",
        one_of_the_stages: false,
        formula: "R = ½ K ρ g' h² + λ ρ v² h",
        ..later_surge::case(input, 0.0)
    }
}
