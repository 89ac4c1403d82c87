//! Eight numbers side by side, and the rows of four that bodies are kept in.

use std::ops::{Add, Mul, Sub};

use crate::simd::quad::Quad;
use crate::simd::real::{Real, Triple};

/// Numbers handled side by side.
pub const LANES: usize = 8;

/// An array with the value of an expression for each lane, written out so that all of it stays in registers.
macro_rules! each_lane {
    (|$lane:ident| $value:expr) => {
        each_lane!(@array $lane, $value, 0, 1, 2, 3, 4, 5, 6, 7)
    };
    (@array $lane:ident, $value:expr, $($number:literal),*) => {
        [$({
            let $lane: usize = $number;
            $value
        }),*]
    };
}
pub(crate) use each_lane;

/// A row of four numbers in a register.
pub trait Row: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    fn load(row: &Quad) -> Self;

    /// A row of short numbers.
    fn widened(row: &[f32; 4]) -> Self;

    /// The same number in all entries.
    fn all(value: f64) -> Self;

    fn store(self, row: &mut Quad);

    /// This row with the fourth entry of another.
    fn with_fourth_of(self, other: Self) -> Self;
}

/// Eight numbers in registers.
pub trait Eight: Real {
    type Row: Row;

    /// Turns eight rows of four into four columns of eight.
    fn columns(rows: [Self::Row; LANES]) -> [Self; 4];

    /// Turns four columns of eight into eight rows of four.
    fn rows(columns: [Self; 4]) -> [Self::Row; LANES];

    fn from_lanes(lanes: [f64; LANES]) -> Self;

    fn lanes(self) -> [f64; LANES];

    /// One bit for each lane, from the lowest up: set where the number is above zero.
    fn above_zero(self) -> u8;
}

/// The vector and the fourth numbers of four columns.
#[inline(always)]
pub fn parted<E>([x, y, z, fourth]: [E; 4]) -> (Triple<E>, E) {
    ([x, y, z], fourth)
}

/// Four columns of a vector and fourth numbers.
#[inline(always)]
pub fn joined<E>([x, y, z]: Triple<E>, fourth: E) -> [E; 4] {
    [x, y, z, fourth]
}
