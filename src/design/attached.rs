//! Files that a design names beside itself: a surveyed section.

use std::collections::BTreeMap;

use crate::design::entries::{Entries, Origin, Value};
use crate::design::section_file;
use crate::problem::Problem;

/// Files by the name under which the design has them.
pub type Attached = BTreeMap<String, Vec<u8>>;

/// Opens a file that a design names: its bytes, or why there are none.
pub type Open<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, String>;

/// Opens files that were kept with a design.
pub fn within(attached: &Attached) -> impl Fn(&str) -> Result<Vec<u8>, String> {
    |name| attached.get(name).cloned().ok_or_else(|| "it was not kept with the design".to_string())
}

/// Key of the file of a section, and that of the points which it stands for.
const SECTION: [&str; 2] = ["channel.section.file", "channel.section.points"];

/// Reads the files that the entries name, and puts what they hold in their place.
pub fn read_attached(entries: &mut Entries, open: Open, problems: &mut Vec<Problem>) -> Attached {
    let mut attached = Attached::new();
    let [key, points] = SECTION;
    let Some(name) = entries.text(key).map(str::to_string) else { return attached };
    let problem = |found: String| Problem::new(key, found, "a text file of points beside the design file");
    let read = open(&name).map_err(|why| {
        problem(format!("`{name}`, which cannot be read: {why}"))
            .hint("the name is taken from the folder of the design file")
    });
    let read = read.and_then(|bytes| match section_file::parse(&bytes) {
        Ok(listed) => Ok((bytes, listed)),
        Err((found, hint)) => Err(problem(format!("`{name}`, {found}")).hint(hint)),
    });
    match read {
        Ok((bytes, listed)) => {
            let entry = entries.values[key].clone();
            let typed = format!("{} points of {name}", listed.len());
            entries.put(
                points,
                crate::design::entries::Entry { value: Value::Points(listed), typed, origin: Origin::File, ..entry },
            );
            attached.insert(name, bytes);
        }
        Err(problem) => problems.push(problem),
    }
    attached
}
