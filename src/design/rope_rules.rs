//! Rules of single ropes.

use crate::design::entries::Entries;
use crate::design::show::at;
use crate::problem::Problem;

/// Breaking load over the full circle of the diameter beyond which no wire rope is (Pa): the strongest wires, of 2160 MPa, fill less than
/// nine tenths of it.
const STRONGEST: f64 = 2e9;

pub fn net_rope_is_one(e: &Entries) -> Option<Problem> {
    is_one(e, "net_rope")
}

pub fn main_rope_is_one(e: &Entries) -> Option<Problem> {
    is_one(e, "main_ropes")
}

pub fn lateral_rope_is_one(e: &Entries) -> Option<Problem> {
    is_one(e, "lateral_ropes")
}

/// No rope of this diameter has this breaking load.
fn is_one(e: &Entries, rope: &str) -> Option<Problem> {
    let [diameter, load] = ["diameter", "breaking_load"].map(|key| e.number(&at(&format!("{rope}.{key}"))));
    let most = STRONGEST * std::f64::consts::FRAC_PI_4 * diameter?.powi(2);
    (load? > most).then(|| {
        let [load_key, diameter_key] = ["breaking_load", "diameter"].map(|key| at(&format!("{rope}.{key}")));
        let found = format!("`{}` for a rope of `{}`", e.typed(&load_key), e.typed(&diameter_key));
        Problem::new(
            load_key,
            found,
            format!("at most {:.0} kN, which is 2 GPa on the full circle of the diameter", most * 1e-3),
        )
        .hint("look at the units of the breaking load and of the diameter")
    })
}
