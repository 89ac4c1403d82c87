//! The file as a tree of typed words, and the way back from a key path to a line.

use std::cell::Cell;
use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::design::yaml_faults::explain;
use crate::problem::{Position, Problem};

/// Larger files are refused unread: a design is a few kilobytes.
const MOST_BYTES: usize = 1 << 20;
/// Values after which reading stops: protects against aliases that refer to themselves in growing numbers.
const MOST_VALUES: usize = 20_000;
/// Prefix by which an exhausted budget is recognised among parser messages.
const TOO_MANY: &str = "more than 20000 values";

/// Characters of a text that a message shows.
const LONGEST_SHOWN: usize = 80;

/// A value of the file as typed.
#[derive(Clone, Debug, PartialEq)]
pub enum Node {
    /// Keys in the order of the file; a key may stand twice (which is then reported).
    Map(Vec<(String, Node)>),
    List(Vec<Node>),
    Text(String),
    Number(f64),
    Flag(bool),
    Nothing,
}

impl Node {
    /// What the value is, for messages.
    pub fn describe(&self) -> String {
        match self {
            Self::Map(_) => "a group of keys".into(),
            Self::List(_) => "a list".into(),
            Self::Text(text) => match text.char_indices().nth(LONGEST_SHOWN) {
                Some((end, _)) => format!("`{}…`, a long text", &text[..end]),
                None => format!("`{text}`"),
            },
            Self::Number(number) => format!("`{number}`, a number without a unit"),
            Self::Flag(flag) => format!("`{flag}`"),
            Self::Nothing => "nothing".into(),
        }
    }
}

/// A design file in memory.
#[derive(Clone, Debug)]
pub struct Document {
    text: String,
    pub root: Node,
}

/// The first character that YAML takes for a line break and others do not: a value and its remark would be told of the wrong line.
fn odd_line_break(text: &str) -> Option<Position> {
    let mut lines = text.split('\n').enumerate();
    lines.find_map(|(line, text)| {
        let text = text.strip_suffix('\r').unwrap_or(text);
        let column = text.chars().position(|letter| "\r\u{85}\u{2028}\u{2029}".contains(letter))?;
        Some(Position { line: line + 1, column: column + 1 })
    })
}

/// Whether a line that says something is indented with a tab.
fn tab_indented(line: &str) -> bool {
    let content = line.trim_start();
    !content.is_empty() && !content.starts_with('#') && line[..line.len() - content.len()].contains('\t')
}

/// Brackets open at once beyond which a text is refused unread: the parser takes time with the square of them.
const DEEPEST: usize = 1000;

/// Whether more brackets are ever open at once than any design needs, wherever they stand.
pub fn brackets_are_too_deep(text: &str) -> bool {
    let mut open = 0_usize;
    for letter in text.bytes() {
        match letter {
            b'[' | b'{' => open += 1,
            b']' | b'}' => open = open.saturating_sub(1),
            _ => {}
        }
        if open > DEEPEST {
            return true;
        }
    }
    false
}

impl Document {
    /// Parses the bytes of a file, which is to have these `keys`. On failure says where and why.
    pub fn parse(bytes: &[u8], keys: &str) -> Result<Self, Problem> {
        let whole = |found: &str, allowed: &str| Problem::new("", found, allowed);
        if bytes.len() > MOST_BYTES {
            return Err(whole(
                &format!("a file of {} bytes", bytes.len()),
                "at most 1 MiB; a design is a few kilobytes",
            ));
        }
        let Ok(text) = std::str::from_utf8(bytes) else {
            return Err(whole("bytes that are not UTF-8 text", "a YAML text file")
                .hint("save the file as UTF-8 text; is it a binary file?"));
        };
        let text = text.strip_prefix('\u{feff}').unwrap_or(text).to_string();
        if let Some(position) = odd_line_break(&text) {
            let problem =
                whole("a line break other than that of a text file", "line feeds, with or without a carriage return");
            let hint = "a line or paragraph separator may have come with a pasted text, or the file is of an old Mac: retype the blank there";
            return Err(problem.hint(hint).at(Some(position)));
        }
        if let Some(line) = text.lines().position(tab_indented) {
            let position = Position { line: line + 1, column: 1 };
            let problem = whole("a tab in the indentation of the line", "spaces");
            return Err(problem.hint("indent with spaces").at(Some(position)));
        }
        if brackets_are_too_deep(&text) {
            return Err(whole("brackets within brackets within brackets", "at most a few levels"));
        }
        BUDGET.set(MOST_VALUES);
        let parsed = serde_yaml::Deserializer::from_str(&text);
        match NodeSeed.deserialize(parsed) {
            Ok(root @ Node::Map(_)) => Ok(Self { text, root }),
            Ok(Node::Nothing) => Err(whole("an empty file", keys)),
            Ok(other) => Err(whole(&other.describe(), keys)),
            Err(error) => Err(unreadable(&error, &text)),
        }
    }

    /// The value at `path` as it stands in the file, where it is a plain scalar on one line that reads as `typed`: what is to be a text is
    /// not to be rewritten because it looks like a number. Nothing where it stands otherwise, as behind an anchor or a tag.
    pub fn plain(&self, path: &str, typed: &str) -> Option<&str> {
        let Position { line, column } = self.position(path)?;
        let line = self.text.lines().nth(line.checked_sub(1)?)?;
        let (start, _) = line.char_indices().nth(column.checked_sub(1)?)?;
        let value = &line[start..];
        let comment = value.find(" #").into_iter().chain(value.find("\t#")).min();
        let value = value[..comment.unwrap_or(value.len())].trim();
        // Between brackets the value ends before what follows it there.
        let before_mark = value.find([',', ']', '}']).map(|end| value[..end].trim());
        let bare = |plain: &&str| !plain.starts_with(['&', '*', '!']) && reads_as(plain, typed);
        std::iter::once(value).chain(before_mark).find(bare)
    }

    /// Position of the value at `path`, a dotted path with list indices as numbers.
    pub fn position(&self, path: &str) -> Option<Position> {
        self.locate(path, false)
    }

    /// Position of the second of two values at `path`.
    pub fn position_again(&self, path: &str) -> Option<Position> {
        self.locate(path, true)
    }

    fn locate(&self, path: &str, again: bool) -> Option<Position> {
        BUDGET.set(MOST_VALUES);
        let steps: Vec<&str> = if path.is_empty() { Vec::new() } else { path.split('.').collect() };
        let located = Locate { steps: &steps, again }.deserialize(serde_yaml::Deserializer::from_str(&self.text));
        let location = located.err()?.location()?;
        Some(Position { line: location.line(), column: location.column() })
    }
}

/// Whether a scalar, read alone, is what was read in its place.
fn reads_as(plain: &str, typed: &str) -> bool {
    BUDGET.set(MOST_VALUES);
    match NodeSeed.deserialize(serde_yaml::Deserializer::from_str(plain)) {
        Ok(Node::Number(number)) => number.to_string() == typed,
        Ok(Node::Flag(flag)) => flag.to_string() == typed,
        _ => false,
    }
}

fn unreadable(error: &serde_yaml::Error, text: &str) -> Problem {
    let message = error.to_string();
    let position = error.location().map(|place| Position { line: place.line(), column: place.column() });
    if message.contains(TOO_MANY) {
        let problem = Problem::new("", TOO_MANY, "a design of some hundred values");
        return problem.hint("does an alias (`*name`) repeat itself?").at(position);
    }
    explain(&message, position, text)
}

thread_local! {
    static BUDGET: Cell<usize> = const { Cell::new(0) };
}

/// Reads any value, within the budget.
struct NodeSeed;

impl<'de> DeserializeSeed<'de> for NodeSeed {
    type Value = Node;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Node, D::Error> {
        let left = BUDGET.get();
        if left == 0 {
            return Err(D::Error::custom(TOO_MANY));
        }
        BUDGET.set(left - 1);
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for NodeSeed {
    type Value = Node;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_bool<E>(self, value: bool) -> Result<Node, E> {
        Ok(Node::Flag(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Node, E> {
        Ok(Node::Number(value as f64))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Node, E> {
        Ok(Node::Number(value as f64))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Node, E> {
        Ok(Node::Number(value))
    }

    fn visit_str<E>(self, value: &str) -> Result<Node, E> {
        Ok(Node::Text(value.to_string()))
    }

    fn visit_unit<E>(self) -> Result<Node, E> {
        Ok(Node::Nothing)
    }

    fn visit_none<E>(self) -> Result<Node, E> {
        Ok(Node::Nothing)
    }

    fn visit_some<D: Deserializer<'de>>(self, deserializer: D) -> Result<Node, D::Error> {
        self.deserialize(deserializer)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Node, A::Error> {
        let mut list = Vec::new();
        while let Some(item) = items.next_element_seed(NodeSeed)? {
            list.push(item);
        }
        Ok(Node::List(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Node, A::Error> {
        let mut map = Vec::new();
        while let Some(key) = entries.next_key_seed(NodeSeed)? {
            let described = key.describe();
            let name = key_name(key).ok_or_else(|| A::Error::custom(format!("{described} as a key")))?;
            map.push((name, entries.next_value_seed(NodeSeed)?));
        }
        merge(&mut map);
        Ok(Node::Map(map))
    }
}

/// The key under which a group takes over the keys of another, or of several.
const MERGE: &str = "<<";

/// Takes over the keys of the groups under `<<` that the group does not have itself; of several groups the first counts.
fn merge(map: &mut Vec<(String, Node)>) {
    let groups = |node: &Node| match node {
        Node::Map(_) => true,
        Node::List(items) => items.iter().all(|item| matches!(item, Node::Map(_))),
        _ => false,
    };
    while let Some(place) = map.iter().position(|(name, node)| name == MERGE && groups(node)) {
        let (_, node) = map.remove(place);
        let groups = if let Node::List(items) = node { items } else { vec![node] };
        for group in groups {
            let Node::Map(entries) = group else { continue };
            for (name, value) in entries {
                if !map.iter().any(|(known, _)| *known == name) {
                    map.push((name, value));
                }
            }
        }
    }
}

/// Walks to the end of a path and fails there, so that the parser tells where "there" is.
struct Locate<'a> {
    steps: &'a [&'a str],
    /// Whether the last step is to be found a second time.
    again: bool,
}

impl<'de> DeserializeSeed<'de> for Locate<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Locate<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("the value sought")
    }

    fn visit_bool<E: Error>(self, _: bool) -> Result<(), E> {
        Err(E::custom("here"))
    }

    fn visit_i64<E: Error>(self, _: i64) -> Result<(), E> {
        Err(E::custom("here"))
    }

    fn visit_u64<E: Error>(self, _: u64) -> Result<(), E> {
        Err(E::custom("here"))
    }

    fn visit_f64<E: Error>(self, _: f64) -> Result<(), E> {
        Err(E::custom("here"))
    }

    fn visit_str<E: Error>(self, _: &str) -> Result<(), E> {
        Err(E::custom("here"))
    }

    fn visit_unit<E: Error>(self) -> Result<(), E> {
        Err(E::custom("here"))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<(), A::Error> {
        let Some((first, rest)) = self.steps.split_first() else {
            return Err(A::Error::custom("here"));
        };
        let wanted: usize = first.parse().map_err(A::Error::custom)?;
        for _ in 0..wanted {
            items.next_element::<IgnoredAny>()?;
        }
        items.next_element_seed(Locate { steps: rest, again: self.again })?;
        Err(A::Error::custom("here"))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<(), A::Error> {
        let mut again = self.again;
        while !self.steps.is_empty()
            && let Some(taken) = entries.next_key_seed(KeySeed { steps: self.steps })?
        {
            match taken {
                // The first of two is passed over.
                Some(taken) if again && taken == self.steps.len() => {
                    again = false;
                    entries.next_value::<IgnoredAny>()?;
                }
                Some(taken) => {
                    return entries.next_value_seed(Locate { steps: &self.steps[taken..], again: self.again });
                }
                None => drop(entries.next_value::<IgnoredAny>()?),
            }
        }
        // The value sought, or the group that should hold it: it may come from another by way of `<<`.
        Err(A::Error::custom("here"))
    }
}

/// Reads a key and tells how many of the steps it is: one, or more where it has dots in it.
struct KeySeed<'a> {
    steps: &'a [&'a str],
}

impl<'de> DeserializeSeed<'de> for KeySeed<'_> {
    type Value = Option<usize>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Option<usize>, D::Error> {
        let Some(name) = NodeSeed.deserialize(deserializer).ok().and_then(key_name) else { return Ok(None) };
        Ok((1..=self.steps.len()).find(|&taken| self.steps[..taken].join(".") == name))
    }
}

/// The text of a key.
fn key_name(key: Node) -> Option<String> {
    match key {
        Node::Text(text) => Some(text),
        Node::Number(number) => Some(number.to_string()),
        Node::Flag(flag) => Some(flag.to_string()),
        Node::Map(_) | Node::List(_) | Node::Nothing => None,
    }
}
