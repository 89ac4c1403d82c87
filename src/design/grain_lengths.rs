//! Lengths told as a multiple of a grain size: `0.8 D90`, or `D90` alone, in the measure in which the sizes are given
//! ([`crate::design::sizes::SizeCurve::named`]).

use crate::design::entries::{Entries, Value};
use crate::design::flow_entries::size_curve;
use crate::design::show::length;
use crate::problem::Problem;

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
