//! The keys of the design file, from the table that reading uses.

use crate::design::key::{Key, Kind, Need};
use crate::design::schema::DESIGN;
use crate::explain::entry::{Entry, Of};

/// Every key by its path; one of a list of groups has `[]` in its path.
pub fn entries() -> Vec<Entry> {
    let mut entries = Vec::new();
    below(DESIGN, "", &mut entries);
    entries
}

fn below(keys: &[Key], under: &str, entries: &mut Vec<Entry>) {
    for key in keys {
        let path = if under.is_empty() { key.name.to_string() } else { format!("{under}.{}", key.name) };
        entries.push(Entry {
            of: Of::Key,
            id: path.clone(),
            meaning: key.meaning.to_string(),
            formula: key.kind.allowed(),
            source: given(key),
        });
        match key.kind {
            Kind::Section(keys) | Kind::SectionOrNone(keys) | Kind::OneOf(keys) => below(keys, &path, entries),
            Kind::Sections(keys) => below(keys, &format!("{path}[]"), entries),
            _ => {}
        }
    }
}

/// Whether a key may be left out, and how it was called before.
fn given(key: &Key) -> String {
    let need = match key.need {
        Need::Required => "required".to_string(),
        Need::ForGrains => "required for a simulation".to_string(),
        Need::Optional => "optional".to_string(),
        Need::Default("") => "optional".to_string(),
        Need::Default(typed) => format!("by default {typed}"),
    };
    need + &key.former.map_or(String::new(), |former| format!("; formerly {former}"))
}
