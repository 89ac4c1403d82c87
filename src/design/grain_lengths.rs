//! Lengths told as a multiple of a grain size: `0.8 D90`, or `D90` alone, in the measure in which the sizes are given
//! ([`crate::design::sizes::SizeCurve::named`]).

use crate::design::entries::{Entries, Value};
use crate::design::rules::{length, size_curve};
use crate::problem::Problem;

/// Reads `<number> D<percent>` or `D<percent>`: how many times, and the share that is finer. `None` if the text is nothing of the kind.
pub fn parse(text: &str) -> Option<(f64, f64)> {
    let (times, percent) = text.trim().split_once(['D', 'd'])?;
    let times: f64 = if times.trim().is_empty() { 1.0 } else { times.trim().parse().ok()? };
    let percent: u32 = percent.parse().ok()?;
    (times.is_finite() && (1..=99).contains(&percent)).then_some((times, f64::from(percent) / 100.0))
}

/// Puts lengths in place of all multiples of grain sizes; notes those that are out of bounds and takes them out, and those that
/// have no sizes to refer to, which is told elsewhere.
pub fn put_lengths(entries: &mut Entries, problems: &mut Vec<Problem>) {
    let curve = size_curve(entries);
    let mut out = Vec::new();
    for (path, entry) in &mut entries.values {
        let Value::OfGrains { times, finer, bounds: [low, high] } = entry.value else { continue };
        let Some(curve) = &curve else {
            out.push(path.clone());
            continue;
        };
        let wanted = times * curve.named(finer);
        if !(low..=high).contains(&wanted) {
            let found = format!("`{}`, which is {}", entry.typed.trim(), length(wanted));
            problems.push(Problem::new(path, found, format!("a length from {} to {}", length(low), length(high))));
            out.push(path.clone());
        }
        entry.typed = format!("{} = {}, {}", entry.typed.trim(), length(wanted), curve.measure());
        entry.value = Value::Number(wanted);
    }
    out.iter().for_each(|path| drop(entries.values.remove(path)));
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
