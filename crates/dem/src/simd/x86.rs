//! Eight numbers in the vector registers of x86-64.
//!
//! The types here may be used only on a processor that has their instructions; `widest` alone makes use of them, after it
//! has asked the processor. That is what every SAFETY note below refers to.

#![allow(unsafe_code)]

use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::simd::eight::{Eight, LANES, Row};
use crate::simd::quad::Quad;
use crate::simd::real::Real;

/// A row of four in one register (AVX).
#[derive(Clone, Copy)]
pub struct Row256(__m256d);

/// Eight numbers in two registers (AVX2).
#[derive(Clone, Copy)]
pub struct Avx2([__m256d; 2]);

/// Eight numbers in one register (AVX-512).
#[derive(Clone, Copy)]
pub struct Avx512(__m512d);

macro_rules! operator {
    ($kind:ident, $operator:ident, $method:ident, |$a:ident, $b:ident| $body:expr) => {
        impl $operator for $kind {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                let ($a, $b) = (self.0, other.0);
                // SAFETY: the processor has the instructions.
                unsafe { Self($body) }
            }
        }
    };
}

macro_rules! eight {
    ($kind:ident) => {
        impl Default for $kind {
            #[inline(always)]
            fn default() -> Self {
                Self::all(0.0)
            }
        }

        impl Add<f64> for $kind {
            type Output = Self;

            #[inline(always)]
            fn add(self, other: f64) -> Self {
                self + Self::all(other)
            }
        }

        impl Mul<f64> for $kind {
            type Output = Self;

            #[inline(always)]
            fn mul(self, other: f64) -> Self {
                self * Self::all(other)
            }
        }

        impl Neg for $kind {
            type Output = Self;

            #[inline(always)]
            fn neg(self) -> Self {
                self * Self::all(-1.0)
            }
        }
    };
}

operator!(Row256, Add, add, |a, b| _mm256_add_pd(a, b));
operator!(Row256, Sub, sub, |a, b| _mm256_sub_pd(a, b));
operator!(Row256, Mul, mul, |a, b| _mm256_mul_pd(a, b));
operator!(Avx2, Add, add, |a, b| [_mm256_add_pd(a[0], b[0]), _mm256_add_pd(a[1], b[1])]);
operator!(Avx2, Sub, sub, |a, b| [_mm256_sub_pd(a[0], b[0]), _mm256_sub_pd(a[1], b[1])]);
operator!(Avx2, Mul, mul, |a, b| [_mm256_mul_pd(a[0], b[0]), _mm256_mul_pd(a[1], b[1])]);
operator!(Avx2, Div, div, |a, b| [_mm256_div_pd(a[0], b[0]), _mm256_div_pd(a[1], b[1])]);
operator!(Avx512, Add, add, |a, b| _mm512_add_pd(a, b));
operator!(Avx512, Sub, sub, |a, b| _mm512_sub_pd(a, b));
operator!(Avx512, Mul, mul, |a, b| _mm512_mul_pd(a, b));
operator!(Avx512, Div, div, |a, b| _mm512_div_pd(a, b));
eight!(Avx2);
eight!(Avx512);

impl Row for Row256 {
    #[inline(always)]
    fn load(row: &Quad) -> Self {
        // SAFETY: the processor has the instruction, and a `Quad` is four numbers on a boundary of 32 bytes.
        unsafe { Self(_mm256_load_pd(row.0.as_ptr())) }
    }

    #[inline(always)]
    fn widened(row: &[f32; 4]) -> Self {
        // SAFETY: the processor has the instructions; four numbers are read from four.
        unsafe { Self(_mm256_cvtps_pd(_mm_loadu_ps(row.as_ptr()))) }
    }

    #[inline(always)]
    fn all(value: f64) -> Self {
        // SAFETY: the processor has the instruction.
        unsafe { Self(_mm256_set1_pd(value)) }
    }

    #[inline(always)]
    fn store(self, row: &mut Quad) {
        // SAFETY: as in `load`.
        unsafe { _mm256_store_pd(row.0.as_mut_ptr(), self.0) }
    }

    #[inline(always)]
    fn with_fourth_of(self, other: Self) -> Self {
        // SAFETY: the processor has the instruction.
        unsafe { Self(_mm256_blend_pd::<0b1000>(self.0, other.0)) }
    }
}

/// Four rows of four turned over.
#[inline(always)]
unsafe fn turned([a, b, c, d]: [__m256d; 4]) -> [__m256d; 4] {
    // SAFETY: the caller's processor has the instructions.
    unsafe {
        let (ab_even, ab_odd) = (_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
        let (cd_even, cd_odd) = (_mm256_unpacklo_pd(c, d), _mm256_unpackhi_pd(c, d));
        [
            _mm256_permute2f128_pd::<0x20>(ab_even, cd_even),
            _mm256_permute2f128_pd::<0x20>(ab_odd, cd_odd),
            _mm256_permute2f128_pd::<0x31>(ab_even, cd_even),
            _mm256_permute2f128_pd::<0x31>(ab_odd, cd_odd),
        ]
    }
}

/// Ones where `a` is above `b`.
#[inline(always)]
unsafe fn above(a: __m256d, b: __m256d) -> __m256d {
    // SAFETY: the caller's processor has the instruction.
    unsafe { _mm256_cmp_pd::<_CMP_GT_OQ>(a, b) }
}

/// Two rows in one register.
#[inline(always)]
unsafe fn pair(low: Row256, high: Row256) -> __m512d {
    // SAFETY: as above.
    unsafe { _mm512_insertf64x4::<1>(_mm512_castpd256_pd512(low.0), high.0) }
}

/// The two rows of one register.
#[inline(always)]
unsafe fn parts(rows: __m512d) -> [Row256; 2] {
    // SAFETY: as above.
    unsafe { [Row256(_mm512_castpd512_pd256(rows)), Row256(_mm512_extractf64x4_pd::<1>(rows))] }
}

impl Real for Avx2 {
    #[inline(always)]
    fn all(value: f64) -> Self {
        // SAFETY: the processor has the instruction.
        unsafe { Self([_mm256_set1_pd(value); 2]) }
    }

    #[inline(always)]
    fn root(self) -> Self {
        // SAFETY: as above.
        unsafe { Self([_mm256_sqrt_pd(self.0[0]), _mm256_sqrt_pd(self.0[1])]) }
    }

    #[inline(always)]
    fn if_above(self, other: Self, then: Self, otherwise: Self) -> Self {
        // SAFETY: as above.
        unsafe {
            let above = [above(self.0[0], other.0[0]), above(self.0[1], other.0[1])];
            Self([
                _mm256_blendv_pd(otherwise.0[0], then.0[0], above[0]),
                _mm256_blendv_pd(otherwise.0[1], then.0[1], above[1]),
            ])
        }
    }
}

impl Eight for Avx2 {
    type Row = Row256;

    #[inline(always)]
    fn columns([a, b, c, d, e, f, g, h]: [Row256; LANES]) -> [Self; 4] {
        // SAFETY: the processor has the instructions.
        let (low, high) = unsafe { (turned([a.0, b.0, c.0, d.0]), turned([e.0, f.0, g.0, h.0])) };
        [Self([low[0], high[0]]), Self([low[1], high[1]]), Self([low[2], high[2]]), Self([low[3], high[3]])]
    }

    #[inline(always)]
    fn rows([x, y, z, w]: [Self; 4]) -> [Row256; LANES] {
        // SAFETY: as above.
        let (low, high) =
            unsafe { (turned([x.0[0], y.0[0], z.0[0], w.0[0]]), turned([x.0[1], y.0[1], z.0[1], w.0[1]])) };
        let [a, b, c, d] = low;
        let [e, f, g, h] = high;
        [Row256(a), Row256(b), Row256(c), Row256(d), Row256(e), Row256(f), Row256(g), Row256(h)]
    }

    #[inline(always)]
    fn from_lanes(lanes: [f64; LANES]) -> Self {
        // SAFETY: the processor has the instructions; eight numbers are read from eight.
        unsafe { Self([_mm256_loadu_pd(lanes.as_ptr()), _mm256_loadu_pd(lanes[4..].as_ptr())]) }
    }

    #[inline(always)]
    fn lanes(self) -> [f64; LANES] {
        let mut lanes = [0.0; LANES];
        // SAFETY: as above, for writing.
        unsafe {
            _mm256_storeu_pd(lanes.as_mut_ptr(), self.0[0]);
            _mm256_storeu_pd(lanes[4..].as_mut_ptr(), self.0[1]);
        }
        lanes
    }

    #[inline(always)]
    fn above_zero(self) -> u8 {
        // SAFETY: the processor has the instructions.
        unsafe {
            let zero = _mm256_setzero_pd();
            let bits = [_mm256_movemask_pd(above(self.0[0], zero)), _mm256_movemask_pd(above(self.0[1], zero))];
            (bits[0] | (bits[1] << 4)) as u8
        }
    }
}

impl Real for Avx512 {
    #[inline(always)]
    fn all(value: f64) -> Self {
        // SAFETY: the processor has the instruction.
        unsafe { Self(_mm512_set1_pd(value)) }
    }

    #[inline(always)]
    fn root(self) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm512_sqrt_pd(self.0)) }
    }

    #[inline(always)]
    fn if_above(self, other: Self, then: Self, otherwise: Self) -> Self {
        // SAFETY: as above.
        unsafe {
            let above = _mm512_cmp_pd_mask::<_CMP_GT_OQ>(self.0, other.0);
            Self(_mm512_mask_blend_pd(above, otherwise.0, then.0))
        }
    }
}

impl Eight for Avx512 {
    type Row = Row256;

    #[inline(always)]
    fn columns([a, b, c, d, e, f, g, h]: [Row256; LANES]) -> [Self; 4] {
        // SAFETY: the processor has the instructions.
        unsafe {
            let (ae, bf, cg, dh) = (pair(a, e), pair(b, f), pair(c, g), pair(d, h));
            let (ab_even, ab_odd) = (_mm512_unpacklo_pd(ae, bf), _mm512_unpackhi_pd(ae, bf));
            let (cd_even, cd_odd) = (_mm512_unpacklo_pd(cg, dh), _mm512_unpackhi_pd(cg, dh));
            let lower = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
            let upper = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
            [
                Self(_mm512_permutex2var_pd(ab_even, lower, cd_even)),
                Self(_mm512_permutex2var_pd(ab_odd, lower, cd_odd)),
                Self(_mm512_permutex2var_pd(ab_even, upper, cd_even)),
                Self(_mm512_permutex2var_pd(ab_odd, upper, cd_odd)),
            ]
        }
    }

    #[inline(always)]
    fn rows([x, y, z, w]: [Self; 4]) -> [Row256; LANES] {
        // SAFETY: the processor has the instructions.
        unsafe {
            // Each half of a register holds two rows' halves: x0 y0 | x2 y2 and so on.
            let (xy_even, xy_odd) = (_mm512_unpacklo_pd(x.0, y.0), _mm512_unpackhi_pd(x.0, y.0));
            let (zw_even, zw_odd) = (_mm512_unpacklo_pd(z.0, w.0), _mm512_unpackhi_pd(z.0, w.0));
            let lower = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
            let upper = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
            let [a, e] = parts(_mm512_permutex2var_pd(xy_even, lower, zw_even));
            let [b, f] = parts(_mm512_permutex2var_pd(xy_odd, lower, zw_odd));
            let [c, g] = parts(_mm512_permutex2var_pd(xy_even, upper, zw_even));
            let [d, h] = parts(_mm512_permutex2var_pd(xy_odd, upper, zw_odd));
            [a, b, c, d, e, f, g, h]
        }
    }

    #[inline(always)]
    fn from_lanes(lanes: [f64; LANES]) -> Self {
        // SAFETY: the processor has the instruction; eight numbers are read from eight.
        unsafe { Self(_mm512_loadu_pd(lanes.as_ptr())) }
    }

    #[inline(always)]
    fn lanes(self) -> [f64; LANES] {
        let mut lanes = [0.0; LANES];
        // SAFETY: as above, for writing.
        unsafe { _mm512_storeu_pd(lanes.as_mut_ptr(), self.0) };
        lanes
    }

    #[inline(always)]
    fn above_zero(self) -> u8 {
        // SAFETY: the processor has the instruction.
        unsafe { _mm512_cmp_pd_mask::<_CMP_GT_OQ>(self.0, _mm512_setzero_pd()) }
    }
}
