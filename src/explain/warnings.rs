//! The warnings of a report: points for the reviewer.

use crate::text::Text;

/// In the order of the report.
pub const WARNINGS: &[Text] = &[
    Text {
        id: "inputs_far_from_usual",
        meaning: "An input is allowed, but far from what such barriers usually have: mostly a slip in the number or its unit.",
        formula: "",
        source: "usual ranges of practice",
    },
    Text {
        id: "flow_not_stopped",
        meaning: "More than a tenth of the mass goes past the barrier in the simulation: all forces are those of the rest.",
        formula: "share lost > 10 %",
        source: "",
    },
    Text {
        id: "flow_that_stopped_upstream",
        meaning: "A good part of the flow comes to rest before it reaches the barrier: the simulated barrier is loaded by less than the design flow.",
        formula: "",
        source: "",
    },
    Text {
        id: "slows_on_its_way",
        meaning: "The bed's friction holds back a flow on this slope. The surge is released faster so that it arrives with the velocity that was given; its tail arrives slower.",
        formula: "tan φ > tan α, with the pore pressure taken off",
        source: "",
    },
    Text {
        id: "event_larger_than_the_flow",
        meaning: "The event is more than the flow that is simulated. Further surges onto the deposit are in the equations alone.",
        formula: "flow.event_volume > volume of all surges",
        source: "",
    },
    Text {
        id: "discharge_and_volume",
        meaning: "The discharge of the design flow and the volume of the event do not go together by the empirical rule: the design flow itself is in doubt.",
        formula: "b h v, or A v in a section, against Q = 0.1 V^0.833 and its scatter",
        source: "Rickenmann 1999, not checked against the original",
    },
    Text {
        id: "grains_that_hide_losses",
        meaning: "The simulated grains are larger than the mesh, or the finest are simulated as larger ones: what finer ones would do the simulation cannot show.",
        formula: "D10 of the simulated grains > mesh opening, or simulation.coarsen",
        source: "",
    },
    Text {
        id: "grains_scaled_to_the_mass",
        meaning: "The mass makes no whole number of grains of the sizes that were given: they are scaled by more than 1 %.",
        formula: "",
        source: "",
    },
    Text {
        id: "coarsest_grains_not_given",
        meaning: "The grain-size curve ends below D84: it is continued with its last slope on a logarithmic axis of diameters, and the largest grain is taken from there. What the largest stone does to a wall is left open.",
        formula: "",
        source: "",
    },
    Text {
        id: "stone_on_the_wall",
        meaning: "No point load of the design stands for the largest stone of the flow: how hard it may hit, and what a metre of the wall would use under it, with the loads.impact_reduction that the design gives.",
        formula: "F = max(c F_Hertz, v √(E r m))",
        source: "Hertz 1882; loads.impact_reduction is the designer's",
    },
    Text {
        id: "escaped",
        meaning: "Grains have gone through the bed or a side wall. They count as lost; beyond a limit the run is not relied on.",
        formula: "",
        source: "",
    },
    Text {
        id: "run_up_over_the_banks",
        meaning: "The flow may run up higher than the side walls or banks that the design describes, and leave the channel there.",
        formula: "",
        source: "",
    },
    Text {
        id: "level_over_the_barrier",
        meaning: "By the equations run-up or deposit of the event go over the barrier, or how high they reach is not known, and no freeboard is asked for: that the barrier is overtopped must be wanted.",
        formula: "level of the event > height of the barrier",
        source: "",
    },
    Text {
        id: "storage_without_an_end",
        meaning: "The surface of the deposit does not meet the bed in the part of the channel that is known, so that the volume held is not told.",
        formula: "",
        source: "",
    },
    Text {
        id: "gully_turns",
        meaning: "The gully turns upstream of the barrier. Slopes and distances are told along the square to the barrier, so that a bent gully counts as steeper and shorter than it is.",
        formula: "turn > 15°",
        source: "",
    },
    Text {
        id: "force_beyond_the_guideline",
        meaning: "The simulated surge pushes harder than the guideline's first surge on the empty barrier: the λ of the design is low for this flow.",
        formula: "F_simulated/F_guideline > 1.1, both without partial factors",
        source: "",
    },
    Text {
        id: "faster_flow_than_the_guideline_was_given",
        meaning: "The front speeds up and thins on its way, and arrives faster than the velocity with which the guideline's pressures are computed.",
        formula: "v_simulated > 1.05 v_given",
        source: "",
    },
    Text {
        id: "dissipators_used_up",
        meaning: "The dissipators of a rope are used up in the simulation: from then on nothing limits the load of its anchors.",
        formula: "",
        source: "",
    },
    Text {
        id: "ropes_broken",
        meaning: "Ropes have broken in the simulation. What it shows later is no load of the barrier as it was designed.",
        formula: "",
        source: "",
    },
    Text {
        id: "sag_beyond_the_equations",
        meaning: "A rope sags more than the equations of a flat parabola allow: its tension, stroke and anchor loads by the equations are an order of magnitude only.",
        formula: "",
        source: "",
    },
    Text {
        id: "formulas_that_stand",
        meaning: "The design lets checks stand that would be open, because a formula is used outside its range (limits.outside_range: warn).",
        formula: "",
        source: "",
    },
    Text {
        id: "parts_that_no_check_sees",
        meaning: "A part of the barrier is not checked, or is taken at the word of the design: the foundation of a wall with a given resistance, the strength of a wall that stands by its weight, what holds the side strips of a net.",
        formula: "",
        source: "",
    },
    Text {
        id: "loads_without_factor",
        meaning: "Loads carry no partial factor. Choose the set of your design standard (factors.set), unless the design flow includes the margin already.",
        formula: "factors.load = 1",
        source: "",
    },
    Text {
        id: "rope_ends_that_hold_all",
        meaning: "The ends of the ropes are taken to hold the whole breaking load, as sockets do; ferrules and grips hold 0.8 to 0.9 of it.",
        formula: "factors.rope_end not given",
        source: "EN 13411-3 and -5, from memory",
    },
    Text {
        id: "soft_ropes",
        meaning: "Ropes are far softer than wire ropes: a softer rope sags more and is loaded less.",
        formula: "modulus < 20 GPa",
        source: "",
    },
    Text {
        id: "validation_case_like_this",
        meaning: "A validation case of a barrier like this one does not hold; the text tells by how much strokes and losses are off.",
        formula: "",
        source: "Albaba 2015; see docs/validation.md",
    },
];
