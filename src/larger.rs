//! A maximum that keeps what is not a number.

/// The larger of two numbers; NaN if either is, so that nothing is judged by half of what is known.
pub fn larger_or_nan(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}
