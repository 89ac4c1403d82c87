//! The barrier filled and everything at rest: K ρ g' (H − z).

use crate::loads::cases::later_surge;
use crate::loads::cases::load_case::LoadCase;
use crate::loads::input::GuidelineInput;
use crate::loads::pressure::Diagram;

pub fn case(input: &GuidelineInput) -> LoadCase {
    let height = input.fill_height;
    LoadCase {
        id: "full",
        title: "Full, at rest",
        deposit: height,
        moving: 0.0,
        diagram: Diagram { unit: input.unit_pressure(), surface: height, top: height, ..Diagram::default() },
        formula: "R = ½ K ρ g' H²",
        ..later_surge::case(input, height)
    }
}
