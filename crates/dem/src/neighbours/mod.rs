//! Who might touch whom: trees of boxes, and candidate lists with a skin so that they are renewed only
//! when something has moved far enough.

pub(crate) mod alarms;
pub(crate) mod blocks;
pub mod broad_phase;
pub(crate) mod candidates;
pub mod clocks;
pub(crate) mod drift;
pub(crate) mod kept;
pub(crate) mod memory_rows;
pub(crate) mod order;
pub(crate) mod reach;
pub(crate) mod renew;
