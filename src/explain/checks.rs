//! The checks. Each holds a demand with partial factors against a design resistance; its utilisation is the one over the other.

use crate::explain::entry::Text;
use crate::sources::{
    ANCHOR_FACTOR, DESIGN_LIMIT, NOTHING_BREAKS, PLATEAU_DATA, POST_STRENGTH, RING_FACTOR, ROPE_FACTOR, STROKE_DATA,
    WALL_BALANCE,
};

/// In the order of the report.
pub const CHECKS: &[Text] = &[
    Text {
        id: "total_force",
        meaning: "The largest total force on the barrier, normal to its face. A rigid wall is held against its resistance; for a net, and for a block that stands by its weight alone, it is told for information, because its parts are checked one by one.",
        formula: "γ_F F ≤ R_k/γ_M",
        source: DESIGN_LIMIT,
    },
    Text {
        id: "wall_local_force",
        meaning: "The force on the metre of a wall that the point load hits, per metre of width, with the pressure of the flow there.",
        formula: "γ_F (R + P/l) ≤ R_k/(γ_M b), l the length over which the point load spreads, b the width of the wall",
        source: DESIGN_LIMIT,
    },
    Text {
        id: "wall_moment",
        meaning: "The moment of flow and point load about the foot of a wall, per metre of width, or about its base where it is founded deeper.",
        formula: "γ_F (M + F d) ≤ M_k/γ_M, d the founding depth",
        source: DESIGN_LIMIT,
    },
    Text {
        id: "wall_sliding",
        meaning: "A wall that stands by its weight slides along its base: what pushes along the base, uplift and the thrust of water and ground on its buried face included, against friction. A point load counts on 0.41 of the block that it hits, because at the end of a block it turns it as well.",
        formula: "γ_F R (cos δ + tan θ sin δ + tan φ · lift) + W sin β + U tan φ + E ≤ W cos β tan φ/γ_R",
        source: WALL_BALANCE,
    },
    Text {
        id: "wall_overturning",
        meaning: "A wall that stands by its weight tips about the downstream edge of its base.",
        formula: "γ_F M + lift · b + W sin β H/2 + 2 U b/3 + M_E ≤ W cos β (b − a)/γ_R",
        source: WALL_BALANCE,
    },
    Text {
        id: "wall_eccentricity",
        meaning: "How far the resultant stands off the middle of the base. Beyond a third of the base special precautions are needed (EN 1997-1, 6.5.4, not checked against the original).",
        formula: "e ≤ b/3",
        source: WALL_BALANCE,
    },
    Text {
        id: "wall_bearing",
        meaning: "The mean pressure on the part of the base that is centred under the resultant, against the bearing resistance of the ground.",
        formula: "N/(b − 2 e) ≤ q_k/γ_R",
        source: "EN 1997-1, annex D, not checked against the original",
    },
    Text {
        id: "rope_N_tension",
        meaning: "The tension of a main rope, counted from the bottom, or between its bolts of one that the bed holds. By the equations a rope sags to a parabola under its share of the pressure; with dissipators they cap its pull.",
        formula: "T = √(H² + (q L/2)²), H = q L²/(8 f) ≤ rope_utilisation · F_br · rope_end/γ_M",
        source: ROPE_FACTOR,
    },
    Text {
        id: "net_tension",
        meaning: "The tension of the ropes of the net, or the force of a leg of a ring of a ring net, as that of a chain of such rings that is as near to breaking.",
        formula: "T ≤ rope_utilisation · F_br · rope_end/γ_M; of rings 0.83 · half of what a chain holds/γ_M",
        source: RING_FACTOR,
    },
    Text {
        id: "lateral_tension",
        meaning: "The tension of the lateral ropes, which hold the edges of the net. The equations do not know it.",
        formula: "T ≤ rope_utilisation · F_br · rope_end/γ_M",
        source: ROPE_FACTOR,
    },
    Text {
        id: "broken_pieces",
        meaning: "Whether any rope breaks in the simulation, where the design lets ropes break. How near a rope is to breaking, its tension tells.",
        formula: "no piece breaks",
        source: NOTHING_BREAKS,
    },
    Text {
        id: "drawn_out",
        meaning: "By how much ropes draw out at their elastic limit. The design gives no allowable elongation: more than 0.1 % leaves the check open.",
        formula: "permanent elongation ≤ 0.1 %",
        source: "",
    },
    Text {
        id: "brake_N_stroke",
        meaning: "The stroke of the dissipators of a main rope against what is available.",
        formula: "s ≤ dissipator_utilisation · s_max",
        source: STROKE_DATA,
    },
    Text {
        id: "brake_plateau",
        meaning: "The tension of the dissipators against their plateau or the largest force of their curve. A dissipator that yields works as it should; more than its plateau means that a stroke is used up.",
        formula: "T ≤ F_plateau",
        source: PLATEAU_DATA,
    },
    Text {
        id: "rope_plateau",
        meaning: "A rule of design, whatever the event: a main rope must hold the force of its yielding dissipators, with their overstrength.",
        formula: "overstrength · F_plateau ≤ rope_utilisation · F_br · rope_end/γ_M",
        source: ROPE_FACTOR,
    },
    Text {
        id: "anchor_N_load",
        meaning: "The load of the anchors of a main rope: the higher of its two, or each where their resistances differ.",
        formula: "T ≤ anchor_utilisation · R_k/γ_M",
        source: ANCHOR_FACTOR,
    },
    Text {
        id: "anchor_plateau",
        meaning: "A rule of design, whatever the event: an anchor must hold the force of the yielding dissipators at its rope, with their overstrength.",
        formula: "overstrength · F_plateau ≤ anchor_utilisation · R_k/γ_M",
        source: ANCHOR_FACTOR,
    },
    Text {
        id: "bed_bolts",
        meaning: "The load of the worst bolt that holds the lowest rope to the bed. The equations spread the load evenly and can fail the bolts, but never pass them: the worst bolt takes two to three times the mean.",
        formula: "T = √(H² + (P/2)²), H = (c P² EA/24)^⅓ ≤ anchor_utilisation · R_k/γ_M",
        source: ANCHOR_FACTOR,
    },
    Text {
        id: "post_N_compression",
        meaning: "The compression of a post, counted in the order of posts.at, together with its bending by what presses on it.",
        formula: "N + N_b M/(M_R (1 − N/N_cr)) ≤ N_b = χ A f_y/γ",
        source: POST_STRENGTH,
    },
    Text {
        id: "post_N_uplift",
        meaning: "The pull on the foundation of a post, where its ropes lift it.",
        formula: "T ≤ anchor_utilisation · R_k/γ_M",
        source: ANCHOR_FACTOR,
    },
    Text {
        id: "post_N_foot",
        meaning: "The force of a post on its foundation, all directions taken together.",
        formula: "F ≤ anchor_utilisation · R_k/γ_M",
        source: ANCHOR_FACTOR,
    },
    Text {
        id: "post_N_retaining_tension",
        meaning: "The tension of the ropes that retain a post.",
        formula: "T ≤ rope_utilisation · F_br · rope_end/γ_M",
        source: ROPE_FACTOR,
    },
    Text {
        id: "post_N_retaining_stroke",
        meaning: "The stroke of the dissipators of the ropes that retain a post. Where they would yield, nothing else holds the head of the post, and by the equations their strokes count as used up.",
        formula: "s ≤ dissipator_utilisation · s_max",
        source: STROKE_DATA,
    },
    Text {
        id: "post_N_anchor_load",
        meaning: "The load of the anchors of the ropes that retain a post.",
        formula: "T ≤ anchor_utilisation · R_k/γ_M",
        source: ANCHOR_FACTOR,
    },
    Text {
        id: "retaining_plateau",
        meaning: "A rule of design, whatever the event: a retaining rope must hold the force of its yielding dissipators, with their overstrength.",
        formula: "overstrength · F_plateau ≤ rope_utilisation · F_br · rope_end/γ_M",
        source: ROPE_FACTOR,
    },
    Text {
        id: "retaining_anchor_plateau",
        meaning: "A rule of design, whatever the event: the anchor of a retaining rope must hold the force of its yielding dissipators, with their overstrength.",
        formula: "overstrength · F_plateau ≤ anchor_utilisation · R_k/γ_M",
        source: ANCHOR_FACTOR,
    },
    Text {
        id: "retained_mass",
        meaning: "The share of the released mass that the barrier holds at the end of the simulation. Its utilisation is what is missing over what may be missing.",
        formula: "(1 − m/m₀)/(1 − limit) ≤ 1",
        source: DESIGN_LIMIT,
    },
    Text {
        id: "residual_height",
        meaning: "The height of a net at the end of the simulation over its height before it.",
        formula: "(1 − h/h₀)/(1 − limit) ≤ 1",
        source: DESIGN_LIMIT,
    },
    Text {
        id: "freeboard",
        meaning: "The level that deposit and run-up reach at the barrier against its height, less the freeboard that the design asks for. Without limits.freeboard it is told for information.",
        formula: "max(H_deposit, H_before the last surge + run-up) ≤ H − freeboard",
        source: DESIGN_LIMIT,
    },
];
