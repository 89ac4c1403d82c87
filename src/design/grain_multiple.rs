//! A length told as a multiple of a grain size: `0.8 D90`, or `D90` alone.

/// Reads `<number> D<percent>` or `D<percent>`: how many times, and the share that is finer. `None` if the text is nothing of the kind.
pub fn parse(text: &str) -> Option<(f64, f64)> {
    let (times, percent) = text.trim().split_once(['D', 'd'])?;
    let times: f64 = if times.trim().is_empty() { 1.0 } else { times.trim().parse().ok()? };
    let percent: u32 = percent.parse().ok()?;
    (times.is_finite() && (1..=99).contains(&percent)).then_some((times, f64::from(percent) / 100.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn multiples_of_grain_sizes_and_nothing_else() {
        assert_eq!(parse("0.8 D90"), Some((0.8, 0.9)));
        assert_eq!(parse(" 2D50 "), Some((2.0, 0.5)));
        assert_eq!(parse("1 d30"), Some((1.0, 0.3)));
        assert_eq!(parse("D30"), Some((1.0, 0.3)));
        for other in ["0.8 D", "0.8 D100", "0.8 D0", "0.8 D-5", "inf D50", "NaN D50", "300 mm", "0.8 D5.5", ""] {
            assert_eq!(parse(other), None, "{other}");
        }
    }
}
