//! A main rope under the guideline's loads.

use crate::loads::cases::load_case::LoadCase;
use crate::loads::rope::RopeState;

/// A main rope under the load of its tributary height, with the partial factor on loads.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RopeLoad {
    /// Heights above the bed of the strip that the rope carries (m); the topmost has no upper end.
    pub strip: [f64; 2],
    /// From bank to bank, or the longest between banks and posts (m), and the other spans.
    pub span: f64,
    pub other_spans: Vec<f64>,
    /// Of the rope between the edges of the net and its anchors, at both ends together (m).
    pub to_anchors: f64,
    /// Ropes that run side by side and share the load.
    pub ropes: u16,
    /// Load across the span, of all of them and of one (N/m): a point load is that of one.
    pub load: f64,
    pub of_one: f64,
    /// The point load that enters it, as a force at one place, with the partial factor (N).
    pub point: f64,
    /// The case that governs; nothing for a rope that the bed holds.
    pub case: Option<LoadCase>,
    /// Of one rope.
    pub state: RopeState,
    /// The same where the dissipators pull with their least force, if that is known.
    pub weak: Option<RopeState>,
    /// Largest tension of an inner span over that at the ends, where friction on the heads of posts holds the rope: e^(μ Σθ) over the heads that
    /// lie between, from the nearer end.
    pub over_heads: f64,
    /// What each anchor takes along the rope's span and down the channel (N).
    pub anchor: [f64; 2],
}
