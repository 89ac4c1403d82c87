//! What a check, a load case, a warning or a key of the design file is: for `barrier-check explain` and for `docs/reference.md`, which is made of
//! the same text.

mod entry;
mod keys;
mod warnings;

use std::fmt::Write;

use crate::checks;
use crate::loads::cases;
use crate::problem::nearest;

pub use crate::explain::entry::{Entry, Of};

/// Everything that is explained, in the order of the reference.
pub fn all() -> Vec<Entry> {
    let checks = checks::texts().map(|text| Entry::of(Of::Check, text));
    let cases = cases::texts().map(|text| Entry::of(Of::LoadCase, text));
    let warnings = warnings::WARNINGS.iter().map(|text| Entry::of(Of::Warning, text));
    checks.chain(cases).chain(warnings).chain(keys::entries()).collect()
}

/// An id with `N` for its number and without the bank: of `rope_3_tension` and `anchor_2_left_load` that of all such checks.
fn general(id: &str) -> String {
    let parts = id.split('_').filter(|part| !matches!(*part, "left" | "right"));
    let parts =
        parts.map(|part| if !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit()) { "N" } else { part });
    parts.collect::<Vec<_>>().join("_")
}

/// What has this id: a check, a load case, a warning, or all keys whose path ends so.
///
/// # Errors
/// The nearest id that is known, where there is one.
pub fn find(id: &str) -> Result<Vec<Entry>, Option<String>> {
    let all = all();
    let id = id.trim();
    let general = general(id);
    let ends_so = |path: &str| path == id || path.strip_suffix(id).is_some_and(|before| before.ends_with('.'));
    let is_meant = |entry: &&Entry| match entry.of {
        Of::Key => ends_so(&entry.id),
        _ => entry.id == id || entry.id == general,
    };
    let found: Vec<Entry> = all.iter().filter(is_meant).cloned().collect();
    if !found.is_empty() {
        return Ok(found);
    }
    let last = |path: &str| path.rsplit('.').next().unwrap_or_default().to_string();
    let names: Vec<String> = all.iter().flat_map(|entry| [entry.id.clone(), last(&entry.id)]).collect();
    Err(nearest(id, names.iter().map(String::as_str)).map(String::from))
}

/// All ids, by what they are of.
pub fn list() -> String {
    let mut text = String::new();
    for of in [Of::Check, Of::LoadCase, Of::Warning] {
        let _ = writeln!(text, "{}:", of.heading());
        for entry in all().into_iter().filter(|entry| entry.of == of) {
            let _ = writeln!(text, "  {}", entry.id);
        }
    }
    text + "Keys of the design file: by their path or the end of it, for example `explain barrier.flexible_net.height` or `explain tilt`.\n"
}

/// The reference as Markdown, as it is kept in `docs/reference.md`.
pub fn reference() -> String {
    let mut text = String::from(
        "# Reference\n\nEvery check, load case, warning and key. `barrier-check explain ID` prints the same in the terminal; this file is the output of\n`barrier-check explain --all`. In ids `N` stands for a number counted from 1, from the bottom upwards for ropes.\n",
    );
    let cell = |text: &str| text.replace('|', "\\|");
    for of in [Of::Check, Of::LoadCase, Of::Warning, Of::Key] {
        let entries: Vec<Entry> = all().into_iter().filter(|entry| entry.of == of).collect();
        let _ = writeln!(text, "\n## {}", of.heading());
        if of == Of::Key {
            let _ = writeln!(text, "\n| key | meaning | allowed | given |\n|---|---|---|---|");
            for entry in entries {
                let [id, meaning, formula, source] =
                    [&entry.id, &entry.meaning, &entry.formula, &entry.source].map(|it| cell(it));
                let _ = writeln!(text, "| `{id}` | {meaning} | {formula} | {source} |");
            }
            continue;
        }
        for entry in entries {
            let _ = writeln!(text, "\n### `{}`\n\n{}", entry.id, entry.meaning);
            for (name, value) in [("Formula", &entry.formula), ("Source", &entry.source)] {
                if !value.is_empty() {
                    let _ = writeln!(text, "\n{name}: {value}");
                }
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_is_found_with_its_number_a_key_by_the_end_of_its_path_and_a_slip_is_told() {
        let ids = |id: &str| find(id).map(|found| found.into_iter().map(|entry| entry.id).collect::<Vec<_>>());
        assert_eq!(ids("rope_3_tension"), Ok(vec!["rope_N_tension".to_string()]));
        assert_eq!(ids("anchor_2_left_load"), Ok(vec!["anchor_N_load".to_string()]));
        assert_eq!(ids("full"), Ok(vec!["full".to_string()]));
        assert_eq!(ids("flexible_net.height"), Ok(vec!["barrier.flexible_net.height".to_string()]));
        assert!(ids("height").is_ok_and(|found| found.len() > 2));
        assert_eq!(find("wall_slidin"), Err(Some("wall_sliding".to_string())));
        assert_eq!(find("mesh_openin"), Err(Some("mesh_opening".to_string())));
        assert_eq!(find("xyzzy"), Err(None));
    }
}
