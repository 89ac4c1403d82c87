//! Four numbers in one vector register: three are a vector, the fourth is wanted at the same time.

use serde::{Deserialize, Serialize};

use crate::Vec3;

/// Four numbers that are handled together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[repr(C, align(32))]
pub struct Quad(pub [f64; 4]);

impl Quad {
    #[inline(always)]
    pub fn new(vector: &Vec3, fourth: f64) -> Self {
        Self([vector.x, vector.y, vector.z, fourth])
    }

    #[inline(always)]
    pub fn vector(&self) -> Vec3 {
        Vec3::new(self.0[0], self.0[1], self.0[2])
    }

    #[inline(always)]
    pub fn fourth(&self) -> f64 {
        self.0[3]
    }

    #[inline(always)]
    pub fn set_vector(&mut self, vector: &Vec3) {
        self.0[..3].copy_from_slice(vector.as_slice());
    }
}
