//! From a design to bodies: `Design` + `Fidelity` → `dem::Model`.

pub mod flow;
pub mod net;
