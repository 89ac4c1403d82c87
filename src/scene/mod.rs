//! From a design to bodies: `Design` + `Fidelity` → `dem::Model`.

pub mod build;
pub(crate) mod estimate;
pub mod event;
pub mod flow;
pub(crate) mod ground;
pub mod inlet;
pub(crate) mod interrupt_grace;
pub(crate) mod net;
pub(crate) mod surges;
