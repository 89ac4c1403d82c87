//! Papers, guidelines and clauses that figures of the report come from.

pub const VOLKWEIN_2014: &str = "Volkwein 2014, Flexible debris flow barriers: design and application, WSL";
pub const WENDELER_2008: &str = "Wendeler 2008, dissertation on debris-flow protection systems";
pub const ALBABA_2015: &str = "Albaba 2015, doctoral thesis, Université Grenoble Alpes";
pub const RITTER_1892: &str = "Ritter 1892, dam-break wave: depth at the gate is 4/9 of the height behind it";
pub const PARABOLIC_CABLE: &str = "statics of a parabolic cable with exact arc length";
pub const NO_LIMIT: &str = "no limit set; for information";
pub const DESIGN_LIMIT: &str = "limit set in the design file";
pub const ROPE_FACTOR: &str =
    "breaking load over the rope's partial factor (after EN 1993-1-11; set it in the design file)";
pub const ANCHOR_FACTOR: &str =
    "anchor resistance over its partial factor (after EN 1997-1; set it in the design file)";
pub const BRAKE_DATA: &str = "stroke of the dissipator, data of the design file";
pub const PLATEAU_DATA: &str = "plateau force of the dissipator, data of the design file";
