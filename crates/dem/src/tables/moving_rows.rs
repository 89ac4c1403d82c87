//! What of the grain table a step moves, block by block.

use crate::simd::quad::Quad;
use crate::tables::grain_table::GrainLoad;

/// The rows of one block of grains, to be moved; `axis` and `momentum` are empty for spheres.
pub struct MovingRows<'a> {
    pub place: &'a mut [Quad],
    pub motion: &'a mut [Quad],
    pub spin: &'a mut [Quad],
    pub axis: &'a mut [Quad],
    pub momentum: &'a mut [Quad],
    /// Set to zero when used.
    pub loads: &'a mut [GrainLoad],
    /// Drift of the flow at each grain (m/s).
    pub drift: &'a [Drifting],
}

/// A drift velocity (m/s); the last entry is unused.
pub type Drifting = [f32; 4];
