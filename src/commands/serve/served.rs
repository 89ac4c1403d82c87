//! What the answers to requests are made from.

use super::chosen::Chosen;
use super::runs::Runs;

/// The folder that is served, and the runs in it.
pub struct Served {
    pub chosen: Chosen,
    pub runs: Runs,
}
