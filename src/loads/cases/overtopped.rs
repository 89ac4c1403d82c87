//! The full barrier with a flow of depth h_o over its top: K ρ g' (H + h_o − z) below the top, and the drag
//! ρ g' h_o tan φ times the length on which the flow rides on the barrier's top. That both act is read (Volkwein, Wendeler,
//! Guasti 2011); the form of the drag is Coulomb's. It decides only with a friction and a length that the designer gives; else a
//! usual friction and the depth h_o as length show its size.

use crate::loads::cases::full;
use crate::loads::cases::load_case::{AdditionalActions, Certainty, LoadCase};
use crate::loads::cases::working::Working;
use crate::loads::input::GuidelineInput;
use crate::loads::pressure::Diagram;
use crate::text::Text;

pub(crate) const TEXTS: &[Text] = &[Text {
    id: "overtopped",
    meaning: "The full barrier is overtopped by a flow of the depth loads.overflow_depth, whose weight presses on the deposit and which may drag the crest along.",
    formula: "R = ½ K ρ g cos α (H² + 2 H h_o), and ρ g cos α h_o tan φ times the length on which the flow rides where the design gives both",
    source: "Volkwein, Wendeler, Guasti 2011, Design of flexible debris flow barriers",
}];

/// Friction of the drag where none is given: tan 25°, from memory.
pub const DEFAULT_FRICTION: f64 = 0.4663;

/// Nothing where the design flow does not fill the barrier.
pub fn case(input: &GuidelineInput, extras: &AdditionalActions) -> Option<LoadCase> {
    let height = input.barrier_height;
    let depth = extras.overflow_depth.unwrap_or(input.depth);
    let weight = input.density * input.gravity_normal * depth;
    let [friction, length] = extras.overflow_drag.unwrap_or([DEFAULT_FRICTION, depth]);
    let shear = weight * friction * length;
    let diagram = Diagram { unit: input.unit_pressure(), surface: height + depth, top: height, ..Diagram::default() };
    (input.fills() || extras.overflow_depth.is_some()).then(|| LoadCase {
        id: "overtopped",
        title: "Full and overtopped",
        deposit: height,
        moving: depth,
        not_simulated: extras.overflow_depth.map(|_| "the flow over the full barrier"),
        working: Working::Overtopped { input: *input, diagram, depth },
        diagram,
        shear,
        shear_certainty: if extras.overflow_drag.is_some() { Certainty::Given } else { Certainty::Memory },
        formula: "R = ½ K ρ g' (H² + 2 H h_o)",
        certainty: Certainty::Read,
        source: "Volkwein, Wendeler, Guasti 2011, Design of flexible debris flow barriers",
        ..full::case(input)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loads::cases::tests::input;
    use approx::assert_relative_eq;

    #[test]
    fn the_overflow_adds_its_depth_all_the_way_down() {
        let case = case(&input(), &AdditionalActions::default()).unwrap();
        let expected = 0.5 * input().unit_pressure() * (16.0 + 2.0 * 4.0 * 1.0);
        assert_relative_eq!(case.force_per_width(), expected, max_relative = 1e-12);
        assert!(super::case(&GuidelineInput { fill_height: 3.0, ..input() }, &AdditionalActions::default()).is_none());
    }
}
