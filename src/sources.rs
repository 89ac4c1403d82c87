//! Papers, guidelines and clauses that figures of the report come from.

pub const VOLKWEIN_2014: &str = "Volkwein 2014, Flexible debris flow barriers: design and application, WSL";
pub const ALBABA_2015: &str = "Albaba 2015, Discrete element modeling of the impact of granular debris flows on rigid and flexible structures, thesis, Grenoble";
pub const CUNDALL_STRACK_1979: &str =
    "Cundall & Strack 1979, A discrete numerical model for granular assemblies, Géotechnique 29";
pub const EN_1990: &str = "EN 1990, annex D: design assisted by testing";
pub const EN_1993_1_11: &str =
    "EN 1993-1-11: structures with tension components (the partial factor of ropes; not checked against the original)";
pub const EN_1997_1: &str = "EN 1997-1: geotechnical design (the partial factor of anchors)";
pub const OTHER_MODELS: &str = "Other models of impact and rules of detailing: named with their range and how sure we are of them where they are used; none of them decides a check";
pub const FRIEDL_2025: &str = "Friedl et al. 2025, Engineering Geology 357:108312 (peak force of flows laden with wood on a bridge deck: 1.51 to 2.00 times that without logs, 1.19 to 1.53 times over depth squared; Froude numbers of 0.9 to 1.1)";
pub const NO_LIMIT: &str = "no limit set; for information";
pub const NOTHING_BREAKS: &str = "no rope may break";
pub const DESIGN_LIMIT: &str = "limit of the design file, or its default (see the inputs)";
/// Of the rings of a ring net.
pub const RING_FACTOR: &str = "half the break of a chain of such rings, of one that follows from the wires 0.83 (the lowest of the tests, Guo 2022) / partial factor of the rope (after EN 1993-1-11, not checked against the original)";
pub const ROPE_FACTOR: &str = "breaking load × termination efficiency / partial factor of the rope (after EN 1993-1-11, not checked against the original; all are in the design file)";
pub const ANCHOR_FACTOR: &str = "anchor resistance / partial factor (after EN 1997-1; set it in the design file)";
pub const POST_STRENGTH: &str = "resistance to buckling (EN 1993-1-1, 6.3.1) or the resistance given / partial factor of posts; a moment counts as the compression that uses up as much, N_b M/(M_R (1 − N/N_cr))";
pub const STROKE_DATA: &str = "stroke of the dissipator, data of the design file";
pub const PLATEAU_DATA: &str = "plateau of the dissipator or largest force of its curve, data of the design file; yielding passes, more than that means that the stroke is used up and fails";
pub const WALL_BALANCE: &str = "balance of forces and moments on the wall, with the factors of the design file";
