//! What a recorder is to record.

use serde::{Deserialize, Serialize};

use crate::recorders::gauge::GaugeWindow;
use crate::recorders::passage::WallFace;

/// What and how often to record.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RecorderSetup {
    /// Sampling interval (s).
    pub interval: f64,
    /// Time between two looks at which grains have passed (s).
    pub passage_interval: f64,
    /// Knots of the net, row by row; empty for a rigid wall.
    pub net_rows: Vec<Vec<u32>>,
    /// The same with all that a grain must have passed to be lost.
    pub screen_rows: Vec<Vec<u32>>,
    /// Main ropes of the net; 0 for a rigid wall.
    pub ropes: usize,
    /// Row of knots along each main rope, and where its nodes are at first along the channel (m).
    pub rope_rows: Vec<usize>,
    pub rope_places: Vec<f64>,
    /// The rigid wall, if that is the barrier.
    pub wall: Option<WallFace>,
    /// Spaces between the bolts of the lowest main rope; 0 where it has none or their distance is not known.
    pub bolt_spaces: usize,
    /// Where across the channel that rope begins and ends (m).
    pub bolted: [f64; 2],
    /// Window in which the incoming flow is gauged, just upstream of the barrier.
    pub incoming: GaugeWindow,
    /// The same about a barrier's height upstream.
    pub approaching: GaugeWindow,
    /// Where the level of the flow at the barrier is sought.
    pub at_the_barrier: GaugeWindow,
    /// Where the depth of the deposit at the barrier is sought.
    pub deposit: GaugeWindow,
    /// Mass of the whole flow, all surges (kg), and what of it is there from the start.
    pub mass: f64,
    pub at_first: f64,
    /// What of that comes in through an inlet later (kg).
    pub to_come: f64,
    /// Numbers of the boulders, from the first to the one after the last.
    pub boulders: [u32; 2],
    /// Diagonal of a mesh of the net (m).
    pub mesh: f64,
    /// Height of the side walls, normal to the bed (m).
    pub side_walls: f64,
    /// Length upstream of the barrier within which whatever lies has arrived (m).
    pub near: f64,
}
