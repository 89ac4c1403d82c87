//! The engine: rigid grains, fixed surfaces and a barrier of ropes, stepped in time. SI numbers only; knows
//! nothing of designs, guidelines or reports.

#![allow(rustdoc::private_intra_doc_links)]

pub mod contact;
pub mod elements;
pub mod geometry;
pub mod ledger;
pub mod model;
pub mod neighbours;
pub mod net;
pub mod recorders;
pub mod schedule;
pub mod simd;
pub mod simulation;
pub mod sweep;
pub mod tables;
pub mod time;
pub mod workers;

/// A vector in the channel frame: x down the slope, y across, z normal to the bed (m, m/s, N, as used).
pub type Vec3 = nalgebra::Vector3<f64>;

/// The largest of some numbers, none of them negative; NaN if any is. 0 where there are none.
pub(crate) fn largest_or_nan(values: &[f64]) -> f64 {
    // Side by side, and the sum beside them, which is no number if any is none.
    const SIDE_BY_SIDE: usize = 8;
    let (mut most, mut sum) = ([0.0_f64; SIDE_BY_SIDE], [0.0_f64; SIDE_BY_SIDE]);
    let chunks = values.chunks_exact(SIDE_BY_SIDE);
    let rest = chunks.remainder();
    for chunk in chunks {
        for ((most, sum), &value) in most.iter_mut().zip(&mut sum).zip(chunk) {
            *most = if value > *most { value } else { *most };
            *sum += value;
        }
    }
    let rest = rest.iter().copied().fold(0.0, larger_or_nan);
    let sum: f64 = sum.iter().sum();
    if sum.is_nan() { sum } else { most.into_iter().fold(rest, larger_or_nan) }
}

/// The larger of two numbers; NaN if either is, so that a run that has lost its footing is noticed.
#[inline(always)]
pub fn larger_or_nan(a: f64, b: f64) -> f64 {
    if a > b || a.is_nan() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::largest_or_nan;

    /// At every place, in a row of eight and after the last.
    #[test]
    fn the_largest_is_found_wherever_it_stands_and_so_is_what_is_no_number() {
        assert_eq!(largest_or_nan(&[]), 0.0);
        for count in [1, 7, 8, 19] {
            for place in 0..count {
                let with = |value: f64| {
                    let mut values = vec![1.0; count];
                    values[place] = value;
                    largest_or_nan(&values)
                };
                assert_eq!([2.0, f64::INFINITY].map(with), [2.0, f64::INFINITY], "{place} of {count}");
                assert!(with(f64::NAN).is_nan(), "{place} of {count}");
            }
        }
    }
}
