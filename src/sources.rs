//! Papers, guidelines and clauses that figures of the report come from.

pub const VOLKWEIN_2014: &str = "Volkwein 2014, Flexible debris flow barriers: design and application, WSL";
pub const NO_LIMIT: &str = "no limit set; for information";
pub const DESIGN_LIMIT: &str = "limit set in the design file";
pub const ROPE_FACTOR: &str = "breaking load that the ends hold over the rope's partial factor (after EN 1993-1-11, from memory; both are in the design file)";
pub const ANCHOR_FACTOR: &str =
    "anchor resistance over its partial factor (after EN 1997-1; set it in the design file)";
pub const BRAKE_DATA: &str = "stroke of the dissipator, data of the design file";
pub const PLATEAU_DATA: &str = "plateau force of the dissipator, data of the design file";
pub const WALL_BALANCE: &str = "balance of forces and moments on the wall, with the factors of the design file";
