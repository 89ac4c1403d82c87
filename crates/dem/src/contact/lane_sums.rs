//! Energies and extremes of contacts side by side.

use crate::contact::law::Response;
use crate::ledger::ContactSums;
use crate::simd::eight::Eight;

#[derive(Default)]
pub struct LaneSums<E> {
    stored: E,
    lost_damping: E,
    lost_friction: E,
    overlap_ratio: E,
}

impl<E: Eight> LaneSums<E> {
    /// Books what the law said of eight contacts; `overlap_ratio` is the overlap over the smaller radius.
    #[inline(always)]
    pub fn count(&mut self, response: &Response<E>, overlap_ratio: E) {
        self.stored = self.stored + response.stored;
        self.lost_damping = self.lost_damping + response.lost_damping;
        self.lost_friction = self.lost_friction + response.lost_friction;
        self.overlap_ratio = overlap_ratio.or_larger(self.overlap_ratio);
    }

    #[inline(always)]
    pub fn total(&self) -> ContactSums {
        ContactSums {
            stored: added(self.stored),
            lost_damping: added(self.lost_damping),
            lost_friction: added(self.lost_friction),
            overlap_ratio: self.overlap_ratio.lanes().into_iter().fold(0.0, f64::max),
        }
    }
}

#[inline(always)]
fn added<E: Eight>(lanes: E) -> f64 {
    lanes.lanes().iter().sum()
}
