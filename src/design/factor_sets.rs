//! Named sets of partial factors; what the file itself sets stands above them.

use crate::design::entries::{Entries, Origin, Value};

/// A set with where it comes from.
struct FactorSet {
    name: &'static str,
    source: &'static str,
    /// Load, rope, anchor; as typed, so that the report shows them like the rest.
    factors: [(&'static str, &'static str); 3],
}

/// The rope's factor is 1.5 γ_R with γ_R = 1.0, for a rope in tension (EN 1993-1-11).
const SETS: &[FactorSet] = &[
    FactorSet {
        name: "en_1997",
        source: "EN 1997-1: variable action 1.5, anchor 1.1; EN 1993-1-11, not checked against the original: rope 1.5",
        factors: [("factors.load", "1.5"), ("factors.rope", "1.5"), ("factors.anchor", "1.1")],
    },
    FactorSet {
        name: "onr_24810",
        source: "ONR 24810 (rockfall nets), consequence classes 1 and 2: action 1.5, anchor in the ground 1.2; EN 1993-1-11, not checked against the original: rope 1.5",
        factors: [("factors.load", "1.5"), ("factors.rope", "1.5"), ("factors.anchor", "1.2")],
    },
    FactorSet {
        name: "onr_24810_cc3",
        source: "ONR 24810 (rockfall nets), consequence class 3: action 1.5, anchor in the ground 1.5; EN 1993-1-11, not checked against the original: rope 1.5",
        factors: [("factors.load", "1.5"), ("factors.rope", "1.5"), ("factors.anchor", "1.5")],
    },
];

/// Names that the key `factors.set` takes; `none` leaves the defaults of each factor.
pub const NAMES: &[&str] = &["none", "en_1997", "onr_24810", "onr_24810_cc3"];

/// Puts the factors of the set named in the file where the file does not set them itself.
pub fn apply(entries: &mut Entries) {
    let Some(set) = SETS.iter().find(|set| entries.text("factors.set") == Some(set.name)) else { return };
    for (path, typed) in set.factors {
        if let Some(entry) = entries.values.get_mut(path)
            && entry.origin == Origin::Default
            && let Ok(number) = typed.parse()
        {
            entry.value = Value::Number(number);
            entry.typed = typed.to_string();
            entry.origin = Origin::Set(set.source);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::read::read_design;

    #[test]
    fn every_name_is_a_set_and_the_file_stands_above_it() {
        assert!(NAMES.iter().skip(1).eq(SETS.iter().map(|set| &set.name)));
        let text = include_str!("../../designs/small_net.yaml");
        let (before, rest) = text.split_once("\nfactors:").unwrap();
        let (_, after) = rest.split_once("\n\n").unwrap();
        let with = format!("{before}\nfactors:\n  set: onr_24810\n  anchor: 1.3\n\n{after}");
        let factors = read_design("x", with.as_bytes()).unwrap().design.factors;
        assert_eq!((factors.load, factors.rope, factors.anchor), (1.5, 1.5, 1.3));
    }
}
