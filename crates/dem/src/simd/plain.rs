//! Eight numbers in plain arrays, for processors that are not known better.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::simd::eight::{Eight, LANES, Row};
use crate::simd::quad::Quad;
use crate::simd::real::Real;

#[derive(Clone, Copy, Default)]
pub struct PlainRow([f64; 4]);

#[derive(Clone, Copy, Default)]
pub struct Plain([f64; LANES]);

macro_rules! by_entry {
    ($kind:ident, $operator:ident, $method:ident) => {
        impl $operator for $kind {
            type Output = Self;

            #[inline(always)]
            fn $method(mut self, other: Self) -> Self {
                for (mine, theirs) in self.0.iter_mut().zip(other.0) {
                    *mine = mine.$method(theirs);
                }
                self
            }
        }
    };
}

by_entry!(PlainRow, Add, add);
by_entry!(PlainRow, Sub, sub);
by_entry!(PlainRow, Mul, mul);
by_entry!(Plain, Add, add);
by_entry!(Plain, Sub, sub);
by_entry!(Plain, Mul, mul);
by_entry!(Plain, Div, div);

impl Add<f64> for Plain {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: f64) -> Self {
        self + Self::all(other)
    }
}

impl Mul<f64> for Plain {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        self * Self::all(other)
    }
}

impl Neg for Plain {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(|value| -value))
    }
}

impl Real for Plain {
    #[inline(always)]
    fn all(value: f64) -> Self {
        Self([value; LANES])
    }

    #[inline(always)]
    fn root(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }

    #[inline(always)]
    fn if_above(self, other: Self, then: Self, otherwise: Self) -> Self {
        let mut chosen = otherwise;
        for lane in 0..LANES {
            chosen.0[lane] = if self.0[lane] > other.0[lane] { then.0[lane] } else { otherwise.0[lane] };
        }
        chosen
    }
}

impl Row for PlainRow {
    #[inline(always)]
    fn load(row: &Quad) -> Self {
        Self(row.0)
    }

    #[inline(always)]
    fn widened(row: &[f32; 4]) -> Self {
        Self(row.map(f64::from))
    }

    #[inline(always)]
    fn all(value: f64) -> Self {
        Self([value; 4])
    }

    #[inline(always)]
    fn store(self, row: &mut Quad) {
        row.0 = self.0;
    }

    #[inline(always)]
    fn with_fourth_of(self, other: Self) -> Self {
        Self([self.0[0], self.0[1], self.0[2], other.0[3]])
    }
}

impl Eight for Plain {
    type Row = PlainRow;

    #[inline(always)]
    fn columns(rows: [PlainRow; LANES]) -> [Self; 4] {
        let mut columns = [Self::default(); 4];
        for (lane, row) in rows.iter().enumerate() {
            for (column, value) in columns.iter_mut().zip(row.0) {
                column.0[lane] = value;
            }
        }
        columns
    }

    #[inline(always)]
    fn rows(columns: [Self; 4]) -> [PlainRow; LANES] {
        let mut rows = [PlainRow::default(); LANES];
        for (lane, row) in rows.iter_mut().enumerate() {
            row.0 = columns.map(|column| column.0[lane]);
        }
        rows
    }

    #[inline(always)]
    fn from_lanes(lanes: [f64; LANES]) -> Self {
        Self(lanes)
    }

    #[inline(always)]
    fn lanes(self) -> [f64; LANES] {
        self.0
    }

    #[inline(always)]
    fn above_zero(self) -> u8 {
        (0..LANES).fold(0, |bits, lane| bits | (u8::from(self.0[lane] > 0.0) << lane))
    }
}
