//! Reads a design file: text, then words, then values, then rules; every problem at once.

use crate::design::Design;
use crate::design::attached::{Attached, Open, read_attached};
use crate::design::changes::Changes;
use crate::design::dissipator_rules;
use crate::design::document::{Document, Node};
use crate::design::entries::{Entries, Origin, Purpose, Value, read};
use crate::design::factor_sets;
use crate::design::grain_lengths;
use crate::design::kit::{self, Kit};
use crate::design::resolve::resolve;
use crate::design::rules::{GRAIN_RULES, RULES};
use crate::design::schema::DESIGN;
use crate::problem::{MOST_PROBLEMS, Problem, Problems, harmless};

/// A design with the words it was read from.
#[derive(Clone, Debug)]
pub struct DesignFile {
    /// The file's name without folder and extension.
    pub name: String,
    /// SHA-256 of the file, in hexadecimal.
    pub sha256: String,
    /// The file itself.
    pub text: Vec<u8>,
    pub design: Design,
    pub entries: Entries,
    /// Files that the design names, as they were read with it.
    pub attached: Attached,
}

/// Reads the bytes of the file called `file`, to be simulated. On failure returns every problem that was found, with its place.
///
/// ```
/// use barrier_check::design::read::read_design;
///
/// let text = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/designs/small_net.yaml"));
/// let file = read_design("small_net.yaml", text).unwrap();
/// // Everything inside is in SI units: metres, newtons, radians.
/// assert_eq!(file.design.channel.width, 3.0);
///
/// let problems = read_design("empty.yaml", b"").unwrap_err();
/// assert!(problems.to_string().contains("an empty file"));
/// ```
pub fn read_design(file: &str, bytes: &[u8]) -> Result<DesignFile, Problems> {
    read_design_for(Purpose::Simulation, file, bytes, &|_| Err("the design is read alone".to_string()))
}

/// What a file has to be, as an error tells it.
pub(super) const KEYS: &str = "a design with the sections project, channel, flow, barrier";

/// The same for a purpose, with the files that the design names.
pub fn read_design_for(purpose: Purpose, file: &str, bytes: &[u8], open: Open) -> Result<DesignFile, Problems> {
    read_design_changed(purpose, file, bytes, open, &Changes::default())
}

/// The same with values in place of some of the file's. Remarks and places of problems are then not sought, which takes longer than all else.
pub fn read_design_changed(
    purpose: Purpose,
    file: &str,
    bytes: &[u8],
    open: Open,
    changes: &Changes,
) -> Result<DesignFile, Problems> {
    Source::parse(file, bytes)?.read(purpose, open, changes)
}

/// The text of a design, parsed once, to be read with one set of changes after the other.
#[derive(Clone, Debug)]
pub struct Source {
    file: String,
    bytes: Vec<u8>,
    sha256: String,
    document: Document,
}

impl Source {
    pub fn parse(file: &str, bytes: &[u8]) -> Result<Self, Problems> {
        let document =
            Document::parse(bytes, KEYS).map_err(|problem| Problems { file: file.to_string(), list: vec![problem] })?;
        if let Some(kind) = kind_of_a_study(&document.root) {
            let problem = Problem::new("", format!("a study (kind: {kind})"), KEYS)
                .hint(format!("run it with `barrier-check study {file}`"));
            return Err(Problems { file: file.to_string(), list: vec![problem] });
        }
        Ok(Self { file: file.to_string(), bytes: bytes.to_vec(), sha256: sha256(bytes), document })
    }

    pub fn document(&self) -> &Document {
        &self.document
    }

    /// The design with changes. On failure returns every problem that was found.
    pub fn read(&self, purpose: Purpose, open: Open, changes: &Changes) -> Result<DesignFile, Problems> {
        let refuse = |list: Vec<Problem>| Problems { file: self.file.clone(), list };
        let document = &self.document;
        let mut root = document.root.clone();
        let mut problems = Vec::new();
        changes.put_onto(&mut root);
        let kit = kit::take(&mut root, open, &mut problems);
        if let Some(mut broken) = problems.pop() {
            // What it should have said would be missing everywhere.
            broken.position = document.position(&broken.path);
            return Err(refuse(vec![broken]));
        }
        let mut entries = read(&root, DESIGN, purpose, &mut problems);
        if let Some(kit) = kit.as_ref().filter(|_| changes.is_empty()) {
            kit.tell_origins(&mut entries, |document, bytes, path| {
                let text = String::from_utf8_lossy(bytes);
                let line = text.lines().nth(document.position(path)?.line.checked_sub(1)?)?;
                comment(line).map(String::from)
            });
        }
        if changes.is_empty() {
            take_remarks(&mut entries, document, &self.bytes);
        }
        problems.extend(keep_texts_as_typed(&mut entries, document, kit.as_ref(), changes));
        make_harmless(&mut entries);
        let mut attached = read_attached(&mut entries, open, &mut problems);
        attached.extend(kit.iter().map(|kit| (kit.name.clone(), kit.bytes.clone())));
        factor_sets::apply(&mut entries);
        grain_lengths::put_lengths(&mut entries, &mut problems);
        problems.extend(RULES.iter().filter_map(|rule| rule(&entries)));
        problems.extend(dissipator_rules::are_sound(&entries));
        if purpose == Purpose::Simulation {
            problems.extend(GRAIN_RULES.iter().filter_map(|rule| rule(&entries)));
        }
        if problems.is_empty() {
            if let Some(design) = resolve(&entries) {
                let (name, sha256, text) = (stem(&self.file), self.sha256.clone(), self.bytes.clone());
                return Ok(DesignFile { name, sha256, text, design, entries, attached });
            }
            problems.push(Problem::new("", "a design that cannot be put together", "all required keys"));
        }
        let more = problems.len().saturating_sub(MOST_PROBLEMS);
        problems.truncate(MOST_PROBLEMS);
        for problem in problems.iter_mut().filter(|_| changes.is_empty()) {
            kit.iter().for_each(|kit| kit.tell_of(problem));
            problem.position = problem.position.or_else(|| match problem.again {
                true => document.position_again(&problem.path),
                false => nearest_position(document, &problem.path),
            });
        }
        problems.sort_by_key(|problem| problem.position);
        if more > 0 {
            problems.push(
                Problem::new("", format!("more than {MOST_PROBLEMS} problems"), "a design")
                    .hint("mend these first: the rest is told then"),
            );
        }
        Err(refuse(problems))
    }
}

/// What kind of a study a file is, if it is one and no design.
fn kind_of_a_study(root: &Node) -> Option<String> {
    let Node::Map(keys) = root else { return None };
    let is_there = |name: &str| keys.iter().any(|(key, _)| key == name);
    let kind = keys.iter().find(|(key, _)| key == "kind").map(|(_, value)| value.describe());
    kind.filter(|_| !is_there("project") && !is_there("barrier"))
}

/// Hands every value the comment that stands on its line. A value that stands in several places of the design, by an alias or a merge, stands
/// on one line of the file, whose comment need not be of all of them.
fn take_remarks(entries: &mut Entries, document: &Document, bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let lines: Vec<&str> = text.lines().collect();
    let from_file = entries.values.iter().filter(|(_, entry)| entry.origin == Origin::File);
    let places: Vec<_> = from_file.filter_map(|(path, _)| Some((path.clone(), document.position(path)?))).collect();
    for (path, place) in &places {
        let shared = places.iter().any(|(other, there)| other != path && there == place);
        let line = lines.get(place.line.saturating_sub(1)).filter(|_| !shared);
        if let (Some(entry), Some(remark)) = (entries.values.get_mut(path), line.and_then(|line| comment(line)))
            && entry.remark.is_empty()
        {
            entry.remark = remark.to_string();
        }
    }
}

/// A text that the parser takes for a number or a truth value is what stands in the file: revision 1.10 is not 1.1. Where that cannot be told
/// it is refused.
fn keep_texts_as_typed(
    entries: &mut Entries,
    document: &Document,
    kit: Option<&Kit>,
    changes: &Changes,
) -> Vec<Problem> {
    let mut problems = Vec::new();
    for path in std::mem::take(&mut entries.rewritten).into_iter().filter(|path| !changes.has(path)) {
        let Some(entry) = entries.values.get_mut(&path).filter(|entry| entry.origin == Origin::File) else { continue };
        let of_kit = kit.filter(|kit| kit.has(&path));
        let plain = match of_kit {
            Some(kit) => kit.plain(&path, &entry.typed),
            None => document.plain(&path, &entry.typed),
        };
        if let Some(plain) = plain {
            (entry.value, entry.typed) = (Value::Text(plain.to_string()), plain.to_string());
            continue;
        }
        let found = format!("a text that looks like a number or a truth value, read as `{}`", entry.typed);
        let hint = "put it between quotation marks, so that it stays as it is written";
        problems.push(Problem::new(path, found, "a text").hint(hint));
    }
    problems
}

/// No text of the design steers what shows it, terminal or page.
fn make_harmless(entries: &mut Entries) {
    for entry in entries.values.values_mut() {
        if let Value::Text(text) = &mut entry.value {
            *text = harmless(text);
        }
        entry.typed = harmless(&entry.typed);
        entry.remark = harmless(&entry.remark);
    }
}

/// What follows the first `#` that begins a comment: one after a blank, outside quotes.
fn comment(line: &str) -> Option<&str> {
    let (mut quote, mut before) = (None, ' ');
    for (place, letter) in line.char_indices() {
        match (quote, letter) {
            (None, '#') if before.is_whitespace() => return Some(line[place + 1..].trim()),
            (None, '"' | '\'') => quote = Some(letter),
            (Some(open), close) if open == close => quote = None,
            _ => {}
        }
        before = letter;
    }
    None
}

/// Position of the key at `path`, or of the nearest key above it that is in the file.
fn nearest_position(document: &Document, path: &str) -> Option<crate::problem::Position> {
    let mut path = path;
    loop {
        if let Some(position) = document.position(path) {
            return Some(position);
        }
        path = path.rsplit_once('.')?.0;
    }
}

/// The name of a design, from that of its file: without folder and extension.
pub fn stem(file: &str) -> String {
    std::path::Path::new(file)
        .file_stem()
        .map_or_else(|| "design".to_string(), |stem| harmless(&stem.to_string_lossy()))
}

/// SHA-256 in hexadecimal.
pub fn sha256(bytes: &[u8]) -> String {
    use sha2::Digest;
    sha2::Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_that_look_like_numbers_stay_as_typed() {
        let text = include_str!("../../designs/small_net.yaml");
        for typed in ["1.10", "007", "1e3", "0x1A", "2026-11-01", "true", "1_000", "+5"] {
            let changed = text.replace("revision: A  ", &format!("revision: {typed}  "));
            assert!(changed.contains(typed), "{typed}");
            let file = read_design("x", changed.as_bytes()).unwrap();
            assert_eq!(file.design.project.revision, typed);
            assert_eq!(file.entries.typed("project.revision"), typed);
            let (_, rest) = text.split_once("\nchannel:").unwrap();
            let in_brackets = format!("project: {{name: x, revision: {typed}, barrier: y}} # z\nchannel:{rest}");
            assert_eq!(read_design("x", in_brackets.as_bytes()).unwrap().design.project.revision, typed);
        }
    }

    /// In a group over several lines, with a tab before the comment; and refused where it cannot be told, never rewritten.
    #[test]
    fn a_text_that_cannot_be_kept_as_typed_is_refused() {
        let text = include_str!("../../designs/small_net.yaml");
        let (_, rest) = text.split_once("\nchannel:").unwrap();
        let with = |project: &str| read_design("x", format!("{project}\nchannel:{rest}").as_bytes());
        for project in [
            "project: {name: x,\n  revision: 1.10, barrier: y}",
            "project: {name: x,\n  barrier: y, revision: 1.10}",
            "project: {\n  name: x,\n  revision: 1.10,\n  barrier: y\n  }",
            "project:\n  name: x\n  barrier: y\n  revision: 1.10\t# as built",
            "project:\n  <<: {revision: \"1.10\"}\n  name: x\n  barrier: y",
        ] {
            let file = with(project).unwrap_or_else(|problems| panic!("{project}\n{problems}"));
            assert_eq!(file.design.project.revision, "1.10", "{project}");
        }
        for project in [
            "project:\n  name: x\n  <<: {revision: 1.10}\n  barrier: y",
            "project:\n  name: x\n  barrier: y\n  revision: &a 1.10",
            "project:\n  name: x\n  barrier: y\n  revision: !!float 1.10",
        ] {
            let problems = with(project).expect_err("refused").to_string();
            assert!(problems.contains("put it between quotation marks"), "{project}: {problems}");
        }
    }

    /// The comment of a line is no remark on what an alias takes from it.
    #[test]
    fn a_remark_is_of_what_stands_on_its_line_alone() {
        let text = include_str!("../../designs/small_net.yaml");
        let remark = |text: &str, path: &str| {
            let file = read_design("x", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}"));
            file.entries.values[path].remark.clone()
        };
        let path = "barrier.flexible_net.lateral_ropes.modulus";
        let own = text.replacen("      modulus: 40 GPa\n", "      modulus: &m 40 GPa  # rope test report 17\n", 1);
        assert_eq!(remark(&own, "barrier.flexible_net.main_ropes.modulus"), "rope test report 17");
        let (before, after) = own.split_once("    lateral_ropes:").unwrap();
        let aliased =
            format!("{before}    lateral_ropes:{}", after.replacen("modulus: 40 GPa", "modulus: *m  # assumed", 1));
        assert_eq!(remark(&aliased, path), "");
    }

    #[test]
    fn of_many_problems_some_dozens_are_told_soon() {
        let text = include_str!("../../designs/small_net.yaml");
        let unknown: String = (0..4000).map(|number| format!("k{number}: 1\n")).collect();
        let started = std::time::Instant::now();
        let problems = read_design("x", format!("{text}{unknown}").as_bytes()).expect_err("problems");
        assert_eq!(problems.list.len(), MOST_PROBLEMS + 1);
        assert!(started.elapsed().as_secs_f64() < 5.0);
    }

    #[test]
    fn a_group_takes_over_the_keys_of_another() {
        let text = include_str!("../../designs/small_net.yaml");
        let rope = "    lateral_ropes:\n      diameter: 18 mm\n      modulus: 40 GPa\n";
        let merged = text
            .replace("    main_ropes:\n", "    main_ropes:\n      <<: &steel {modulus: 40 GPa}\n")
            .replace(rope, "    lateral_ropes:\n      <<: *steel\n      diameter: 18 mm\n")
            .replace("      diameter: 20 mm\n      modulus: 40 GPa\n", "      diameter: 20 mm\n");
        assert_ne!(merged, text);
        let [one, other] = [text, merged.as_str()].map(|text| read_design("x", text.as_bytes()).unwrap().design);
        assert_eq!(one, other);
    }

    #[test]
    fn a_comment_is_what_stands_behind_the_value() {
        assert_eq!(comment("  width: 3 m   # measured"), Some("measured"));
        assert_eq!(comment("  name: \"a # b\"  # c"), Some("c"));
        assert_eq!(comment("  name: a#b"), None);
        assert_eq!(comment("  width: 3 m"), None);
        let file = read_design("x", include_bytes!("../../designs/site_a.yaml")).unwrap();
        assert_eq!(
            file.entries.values["barrier.flexible_net.anchors.resistance"].remark,
            "characteristic; assumed, the thesis sets none"
        );
        assert_eq!(file.entries.values["barrier.flexible_net.net_slack"].remark, "");
    }
}
