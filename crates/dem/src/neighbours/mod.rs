//! Who might touch whom: trees of boxes, and candidate lists with a skin so that they are renewed only
//! when something has moved far enough.

pub mod alarms;
pub mod blocks;
pub mod broad_phase;
pub mod candidates;
pub mod clocks;
pub mod drift;
pub mod kept;
pub mod memory_rows;
pub mod order;
pub mod renew;
