//! Numbers that a formula can be written in once: one, or eight side by side.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number, or several of them side by side, each on its own.
pub trait Real:
    Copy
    + Default
    + Add<Output = Self>
    + Add<f64, Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The same number everywhere.
    fn all(value: f64) -> Self;

    fn root(self) -> Self;

    /// `then` where this is above `other`, `otherwise` elsewhere and where either is not a number.
    fn if_above(self, other: Self, then: Self, otherwise: Self) -> Self;

    /// The larger of the two; `other` where either is not a number.
    #[inline(always)]
    fn or_larger(self, other: Self) -> Self {
        self.if_above(other, self, other)
    }
}

impl Real for f64 {
    #[inline(always)]
    fn all(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn if_above(self, other: Self, then: Self, otherwise: Self) -> Self {
        if self > other { then } else { otherwise }
    }
}

/// Three numbers in the directions of space.
pub type Triple<R> = [R; 3];

#[inline(always)]
pub fn dot<R: Real>(a: Triple<R>, b: Triple<R>) -> R {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub fn cross<R: Real>(a: Triple<R>, b: Triple<R>) -> Triple<R> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
pub fn plus<R: Real>(a: Triple<R>, b: Triple<R>) -> Triple<R> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub fn minus<R: Real>(a: Triple<R>, b: Triple<R>) -> Triple<R> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
pub fn negative<R: Real>(a: Triple<R>) -> Triple<R> {
    [-a[0], -a[1], -a[2]]
}

#[inline(always)]
pub fn scaled<R: Real>(a: Triple<R>, factor: R) -> Triple<R> {
    [a[0] * factor, a[1] * factor, a[2] * factor]
}

/// a + factor b
#[inline(always)]
pub fn add_scaled<R: Real>(a: Triple<R>, factor: R, b: Triple<R>) -> Triple<R> {
    plus(a, scaled(b, factor))
}
