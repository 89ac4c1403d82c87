//! What the answers to requests are made from.

use super::design_folder::Chosen;
use super::runs::Runs;

/// The folder that is served, and the runs in it.
pub struct Served {
    pub chosen: Chosen,
    pub runs: Runs,
}
