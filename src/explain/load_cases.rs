//! The load cases.

use crate::explain::entry::Text;
use crate::sources::VOLKWEIN_2014;

/// In the order of the report.
pub const LOAD_CASES: &[Text] = &[
    Text {
        id: "first_surge",
        meaning: "The first surge meets the empty barrier: its static and its dynamic pressure act over its depth h.",
        formula: "R = ½ K ρ g cos α h² + λ ρ v² h per metre of width",
        source: VOLKWEIN_2014,
    },
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
    Text {
        id: "full",
        meaning: "The barrier is full and everything is at rest: static pressure alone, over the height H to which the event fills it.",
        formula: "R = ½ K ρ g cos α H²",
        source: VOLKWEIN_2014,
    },
    Text {
        id: "drained",
        meaning: "The full barrier after the water has drained: with the earth pressure coefficient and density of loads.drained.",
        formula: "R = ½ K_d ρ_d g cos α H²",
        source: "K and density of the drained deposit are of the design file",
    },
    Text {
        id: "overtopped",
        meaning: "The full barrier is overtopped by a flow of the depth loads.overflow_depth, whose weight presses on the deposit and which may drag the crest along.",
        formula: "R = ½ K ρ g cos α (H² + 2 H h_o), and ρ g cos α h_o tan φ times the length on which the flow rides where the design gives both",
        source: "Volkwein, Wendeler, Guasti 2011, Design of flexible debris flow barriers",
    },
    Text {
        id: "point_load",
        meaning: "A boulder or log hits at one place together with the last surge: the force of loads.point_load, or on a wall the reduced Hertz force of the largest boulder of the flow. It is carried by the rope or the metres of wall that are hit, and by the block that stands on its base.",
        formula: "of boulders F = loads.impact_reduction · F_Hertz(r, m, v)",
        source: "Hertz contact; the reduction is a value of the design file",
    },
    Text {
        id: "snow",
        meaning: "Snow pressure on the empty barrier, as the design gives it (loads.snow_pressure).",
        formula: "R = p_snow H",
        source: "",
    },
];
