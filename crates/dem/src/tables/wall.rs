//! The rigid wall as forces on it are told apart: its segments, and how wide it is at each height.

use serde::{Deserialize, Serialize};

/// The wall along its face, from its foot.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WallShape {
    /// Tops of its segments, from the bottom up (m); the last is its own. Empty without a wall.
    pub segment_tops: Vec<f64>,
    /// Width at equally spaced heights from the foot to the top (m); empty where it is the same all the way.
    pub widths: Vec<f64>,
}

impl WallShape {
    /// The segment at a height (m), which beyond the top is the last.
    pub fn segment(&self, height: f64) -> usize {
        let below = self.segment_tops.iter().take_while(|&&top| height > top).count();
        below.min(self.segment_tops.len().saturating_sub(1))
    }

    /// Width at a height along the face (m), between the heights by interpolation; nothing where it is the same all the way.
    pub fn width(&self, height: f64) -> Option<f64> {
        let spaces = self.widths.len().checked_sub(1).filter(|spaces| *spaces > 0)?;
        let place = (height / self.segment_tops.last()? * spaces as f64).clamp(0.0, spaces as f64);
        let below = (place as usize).min(spaces - 1);
        let share = place - below as f64;
        Some(self.widths[below] * (1.0 - share) + self.widths[below + 1] * share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_height_has_its_segment_and_its_width() {
        let even = WallShape { segment_tops: vec![1.0, 3.0], widths: Vec::new() };
        assert_eq!([0.0, 1.0, 1.1, 9.0].map(|height| even.segment(height)), [0, 0, 1, 1]);
        assert_eq!(even.width(1.0), None);
        let widening = WallShape { widths: vec![2.0, 4.0, 8.0], ..even };
        let widths = [-1.0, 0.0, 0.75, 1.5, 2.25, 3.0, 9.0].map(|height| widening.width(height).expect("a width"));
        assert_eq!(widths, [2.0, 2.0, 3.0, 4.0, 6.0, 8.0, 8.0]);
    }
}
