//! From a design to bodies: `Design` + `Fidelity` → `dem::Model`.

pub mod build;
pub mod estimate;
pub mod event;
pub mod flow;
pub mod net;
pub mod patience;
