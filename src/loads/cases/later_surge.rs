//! A surge over a deposit of height H_d: K ρ g' (H_d + h − z), and λ ρ v² between H_d and H_d + h, as far as the barrier stands.

use crate::loads::cases::load_case::{Certainty, LoadCase};
use crate::loads::cases::working::Working;
use crate::loads::input::GuidelineInput;
use crate::loads::pressure::Diagram;
use crate::sources::VOLKWEIN_2014;
use crate::text::Text;

pub(crate) const TEXTS: &[Text] = &[
    Text {
        id: "later_surge",
        meaning: "A surge runs over a deposit of the depth H_d: the deposit carries the weight of the surge, and the surge hits above it. Every depth of deposit from empty to full is tried, and each part of the barrier is held against the worst.",
        formula: "R = ½ K ρ g cos α (H_d + h)² + λ ρ v² h",
        source: VOLKWEIN_2014,
    },
    Text {
        id: "last_surge",
        meaning: "The last surge that the barrier has room for: the deposit reaches to one flow depth below the height to which the barrier fills.",
        formula: "R = ½ K ρ g cos α (H_d + h)² + λ ρ v² h with H_d = H − h",
        source: VOLKWEIN_2014,
    },
];

pub fn case(input: &GuidelineInput, deposit: f64) -> LoadCase {
    let moving = input.depth;
    let surface = deposit + moving;
    let top = surface.min(input.barrier_height);
    let diagram = Diagram {
        unit: input.unit_pressure(),
        surface,
        top,
        block: input.impact_pressure(),
        block_from: deposit,
        block_to: top,
    };
    LoadCase {
        id: "later_surge",
        title: "Surge over a deposit",
        deposit,
        moving,
        one_of_the_stages: true,
        not_simulated: None,
        working: Working::OfASurge { input: *input, diagram, deposit, moving },
        diagram,
        shear: 0.0,
        shear_certainty: Certainty::Derived,
        point: None,
        formula: "R = ½ K ρ g' (H_d + h)² + λ ρ v² h",
        certainty: Certainty::Cited,
        source: VOLKWEIN_2014,
    }
}

/// The last surge, which fills the barrier.
pub fn last(input: &GuidelineInput) -> LoadCase {
    let deposit = input.fill_height - input.moving_depth();
    LoadCase {
        id: "last_surge",
        title: "Last surge over the deposit",
        one_of_the_stages: false,
        ..case(input, deposit)
    }
}
