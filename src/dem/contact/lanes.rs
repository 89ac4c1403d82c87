//! Contacts side by side: rows as bodies keep them, turned into columns, which become vector instructions.

use crate::dem::contact::law::{Memory, Response};
use crate::dem::ledger::ContactSums;
use crate::dem::tables::grain_table::Quad;

/// Contacts handled together; the arrays of a batch stay in the first-level cache.
pub const LANES: usize = 32;

/// One number for every lane.
pub type Lane = [f64; LANES];

/// Four numbers for every lane: a vector and one more.
#[derive(Clone, Copy, Debug)]
pub struct Quads {
    pub rows: [Quad; LANES],
    columns: [Lane; 4],
}

impl Default for Quads {
    fn default() -> Self {
        Self { rows: [Quad::default(); LANES], columns: [[0.0; LANES]; 4] }
    }
}

impl Quads {
    /// Makes the columns from the rows.
    #[inline(always)]
    pub fn turn_to_columns(&mut self) {
        for (lane, row) in self.rows.iter().enumerate() {
            for (column, value) in self.columns.iter_mut().zip(row.0) {
                column[lane] = value;
            }
        }
    }

    /// Makes the rows from the columns.
    #[inline(always)]
    pub fn turn_to_rows(&mut self) {
        let [x, y, z, fourth] = &self.columns;
        for (lane, row) in self.rows.iter_mut().enumerate() {
            *row = Quad([x[lane], y[lane], z[lane], fourth[lane]]);
        }
    }

    #[inline(always)]
    pub fn vector(&self, lane: usize) -> [f64; 3] {
        [self.columns[0][lane], self.columns[1][lane], self.columns[2][lane]]
    }

    #[inline(always)]
    pub fn fourth(&self, lane: usize) -> f64 {
        self.columns[3][lane]
    }

    #[inline(always)]
    pub fn put(&mut self, lane: usize, vector: [f64; 3], fourth: f64) {
        for (column, value) in self.columns.iter_mut().zip([vector[0], vector[1], vector[2], fourth]) {
            column[lane] = value;
        }
    }

    #[inline(always)]
    pub fn memory(&self, lane: usize) -> Memory {
        Memory { tangential: self.vector(lane), dashpot: self.fourth(lane) }
    }
}

/// Energies and extremes, lane by lane.
#[derive(Default)]
pub struct LaneSums {
    stored: Lane,
    lost_damping: Lane,
    lost_friction: Lane,
    overlap_ratio: Lane,
    contacts: Lane,
}

impl LaneSums {
    /// Books what the law said of the contact in a lane; `overlap_ratio` is its overlap over the smaller radius.
    #[inline(always)]
    pub fn count(&mut self, lane: usize, response: &Response, overlap_ratio: f64) {
        self.stored[lane] += response.stored;
        self.lost_damping[lane] += response.lost_damping;
        self.lost_friction[lane] += response.lost_friction;
        let before = self.overlap_ratio[lane];
        self.overlap_ratio[lane] = if overlap_ratio > before { overlap_ratio } else { before };
        self.contacts[lane] += if overlap_ratio > 0.0 { 1.0 } else { 0.0 };
    }

    pub fn total(&self) -> ContactSums {
        let add = |lane: &Lane| lane.iter().sum::<f64>();
        ContactSums {
            stored: add(&self.stored),
            lost_damping: add(&self.lost_damping),
            lost_friction: add(&self.lost_friction),
            overlap_ratio: self.overlap_ratio.iter().copied().fold(0.0, f64::max),
            contacts: add(&self.contacts) as u64,
        }
    }
}
