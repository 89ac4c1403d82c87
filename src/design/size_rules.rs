//! Contradictions within grain sizes, those of the flow or of one surge.

use crate::design::entries::Entries;
use crate::design::flow_entries::{SIZES, quantiles};
use crate::design::show::length;
use crate::problem::Problem;

pub fn sizes_have_an_order(e: &Entries) -> Option<Problem> {
    sizes_have_an_order_at(e, SIZES)
}

/// Of the grain sizes at a path.
pub fn sizes_have_an_order_at(e: &Entries, sizes: &str) -> Option<Problem> {
    let [low, high] = ["min", "max"].map(|key| format!("{sizes}.uniform.{key}"));
    (e.number(&low)? > e.number(&high)?).then(|| {
        let found = format!("`{}`, above max `{}`", e.typed(&low), e.typed(&high));
        Problem::new(low, found, format!("at most {high}"))
    })
}

pub fn curve_has_two_quantiles(e: &Entries) -> Option<Problem> {
    curve_has_two_quantiles_at(e, SIZES)
}

/// Of the grain sizes at a path.
pub fn curve_has_two_quantiles_at(e: &Entries, sizes: &str) -> Option<Problem> {
    let (path, count) = (format!("{sizes}.curve"), quantiles(e, sizes).len());
    (e.has_section(&path) && count < 2)
        .then(|| Problem::new(path, format!("{count} quantile(s)"), "two or more of d1 … d100"))
}

pub fn curve_increases(e: &Entries) -> Option<Problem> {
    curve_increases_at(e, SIZES)
}

/// Of the grain sizes at a path.
pub fn curve_increases_at(e: &Entries, sizes: &str) -> Option<Problem> {
    let points = quantiles(e, sizes);
    let pair = points.windows(2).find(|pair| pair[1].1 <= pair[0].1)?;
    let name = |share: f64| format!("d{:.0}", 100.0 * share);
    let found =
        format!("{} = {}, not above {} = {}", name(pair[1].0), length(pair[1].1), name(pair[0].0), length(pair[0].1));
    Some(Problem::new(format!("{sizes}.curve.{}", name(pair[1].0)), found, "diameters that increase with the share"))
}
