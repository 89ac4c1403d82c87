//! From the tree of words to checked values, with every problem noted on the way.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::design::document::Node;
use crate::design::grain_multiple;
use crate::design::key::{Bounded, Key, Kind, Need, names};
use crate::problem::{MOST_PROBLEMS, Problem, nearest};
use crate::relief::Relief;
use crate::units::{self, Dimension, separators};

/// What a design is read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Grains must be described, and be such that they can be simulated.
    Simulation,
    /// The equations alone, which need no grains and refuse none.
    Equations,
}

/// A checked value. Quantities are SI.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    Number(f64),
    Numbers(Vec<f64>),
    Points(Vec<[f64; 2]>),
    Text(String),
    /// A length told as so many times the grain size below which the share `finer` of the mass lies, and its bounds (m);
    /// [`super::grain_lengths`] puts a number in its place.
    OfGrains {
        times: f64,
        finer: f64,
        bounds: [f64; 2],
    },
}

/// Where a value comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    File,
    Default,
    /// A named set of factors, with its source.
    Set(&'static str),
}

/// One value of the design, as typed and as understood.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    pub value: Value,
    pub typed: String,
    pub origin: Origin,
    pub meaning: &'static str,
    /// What the designer has written beside it, as a comment.
    pub remark: String,
}

/// All values by their dotted path, and the sections that are there.
#[derive(Clone, Debug, Default)]
pub struct Entries {
    pub values: BTreeMap<String, Entry>,
    sections: Vec<String>,
    /// Paths in the order of the tables.
    pub order: Vec<String>,
    /// Paths typed in the file, right or wrong.
    mentioned: Vec<String>,
    /// The ground that a raster tells.
    pub relief: Option<Arc<Relief>>,
    /// Paths of texts that the parser took for a number or a truth value, and may have rewritten.
    pub rewritten: Vec<String>,
}

impl Entries {
    pub fn has_section(&self, path: &str) -> bool {
        self.sections.iter().any(|section| section == path)
    }

    /// Whether the file has a list of sections there.
    pub fn has_list(&self, path: &str) -> bool {
        self.has_section(&join(path, "0"))
    }

    pub fn number(&self, path: &str) -> Option<f64> {
        match self.values.get(path)?.value {
            Value::Number(number) => Some(number),
            _ => None,
        }
    }

    /// Puts a value in, as if it had been typed.
    pub fn put(&mut self, path: &str, entry: Entry) {
        self.mentioned.push(path.to_string());
        self.order.push(path.to_string());
        self.values.insert(path.to_string(), entry);
    }

    /// Whether the file or a named set gives the value, not a default.
    pub fn given(&self, path: &str) -> bool {
        self.values.get(path).is_some_and(|entry| entry.origin != Origin::Default)
    }

    pub fn numbers(&self, path: &str) -> Option<&[f64]> {
        match &self.values.get(path)?.value {
            Value::Numbers(numbers) => Some(numbers),
            _ => None,
        }
    }

    pub fn points(&self, path: &str) -> Option<&[[f64; 2]]> {
        match &self.values.get(path)?.value {
            Value::Points(points) => Some(points),
            _ => None,
        }
    }

    pub fn text(&self, path: &str) -> Option<&str> {
        match &self.values.get(path)?.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// What the word of a choice stands for. `None` for a word that has no meaning here, so that one that is new in the schema is not taken for
    /// another.
    pub fn chosen<T: Copy>(&self, path: &str, meanings: &[(&str, T)]) -> Option<T> {
        let word = self.text(path)?;
        meanings.iter().find(|(name, _)| *name == word).map(|(_, meaning)| *meaning)
    }

    /// Whether the key was typed in the file, even with a value that cannot be used.
    pub fn mentions(&self, path: &str) -> bool {
        self.mentioned.iter().any(|mentioned| mentioned == path)
    }

    /// The value as typed, for messages.
    pub fn typed(&self, path: &str) -> &str {
        self.values.get(path).map_or("", |entry| &entry.typed)
    }
}

/// Reads a whole design by its table of keys; problems go to `problems`.
pub fn read(root: &Node, keys: &'static [Key], purpose: Purpose, problems: &mut Vec<Problem>) -> Entries {
    let mut reader = Reader { entries: Entries::default(), all: keys, purpose, problems };
    reader.section(root, keys, "");
    reader.entries
}

/// Longest list of sections.
const MOST_SECTIONS: usize = 50;

struct Reader<'a> {
    entries: Entries,
    /// The keys of the whole design.
    all: &'static [Key],
    purpose: Purpose,
    problems: &'a mut Vec<Problem>,
}

impl Reader<'_> {
    fn section(&mut self, node: &Node, keys: &'static [Key], path: &str) {
        self.entries.sections.push(path.to_string());
        let Node::Map(map) = node else {
            if !(matches!(node, Node::Nothing)
                && keys.iter().all(|key| !matches!(key.need, Need::Required | Need::ForGrains)))
            {
                let allowed = Kind::Section(keys).allowed();
                self.problems.push(Problem::new(path, node.describe(), allowed));
                return;
            }
            return self.fields(&[], keys, path);
        };
        self.report_unknown(map, keys, path);
        self.fields(map, keys, path);
    }

    fn fields(&mut self, map: &[(String, Node)], keys: &'static [Key], path: &str) {
        for key in keys {
            let here = join(path, key.name);
            match map.iter().find(|(name, _)| name == key.name) {
                Some((_, node)) => {
                    self.entries.mentioned.push(here.clone());
                    self.value(node, key, &here, Origin::File);
                }
                None => match map.iter().find(|(name, _)| key.former == Some(name)) {
                    Some((former, node)) => self.under_a_former_name(node, key, path, former),
                    None => self.absent(key, path, &here),
                },
            }
        }
    }

    /// A key under the name that it had before: problems are told where it stands.
    fn under_a_former_name(&mut self, node: &Node, key: &'static Key, path: &str, former: &str) {
        let here = join(path, key.name);
        self.entries.mentioned.push(here.clone());
        let told = self.problems.len();
        self.value(node, key, &here, Origin::File);
        for problem in &mut self.problems[told..] {
            problem.path = join(path, former);
        }
        if let Some(entry) = self.entries.values.get_mut(&here) {
            entry.remark = format!("given as `{former}`, its former name");
        }
    }

    fn report_unknown(&mut self, map: &[(String, Node)], keys: &'static [Key], path: &str) {
        for (index, (name, _)) in map.iter().enumerate() {
            if self.problems.len() > MOST_PROBLEMS {
                return;
            }
            let here = join(path, name);
            if map[..index].iter().any(|(earlier, _)| earlier == name) {
                self.problems
                    .push(Problem::new(&here, format!("the key `{name}` a second time"), "each key once").again());
            }
            let named_twice =
                keys.iter().find(|key| key.former == Some(name) && map.iter().any(|(other, _)| other == key.name));
            if let Some(key) = named_twice {
                let found = format!("the key `{}` a second time, under its former name `{name}`", key.name);
                self.problems.push(Problem::new(&here, found, "each key once").again());
            }
            if !keys.iter().any(|key| key.name == name || key.former == Some(name)) {
                let mut problem =
                    Problem::new(&here, format!("the unknown key `{name}`"), format!("the keys {}", names(keys)));
                if name.starts_with(|first: char| first.is_ascii_digit()) {
                    problem = problem.hint("between braces a comma begins another key: is this the end of a number? Write it without commas, as `1200 kN` or `1.8 m`");
                } else if let Some(near) = nearest(name, keys.iter().map(|key| key.name)) {
                    problem = problem.hint(format!("did you mean `{near}`?"));
                } else if let [place] = &groups_with(name, self.all, "")[..] {
                    problem = problem.hint(format!("`{name}` is a key of {place}"));
                }
                self.problems.push(problem);
            }
        }
    }

    fn absent(&mut self, key: &'static Key, path: &str, here: &str) {
        match (key.need, key.kind) {
            (Need::Optional, _) => {}
            (Need::ForGrains, _) if self.purpose == Purpose::Equations => {}
            (Need::Default(_), Kind::Section(keys)) => self.section(&Node::Map(Vec::new()), keys, here),
            (Need::Default(typed), _) => {
                let node = typed.parse().map_or_else(|_| Node::Text(typed.to_string()), Node::Number);
                self.value(&node, key, here, Origin::Default);
            }
            (Need::Required | Need::ForGrains, kind) => {
                let problem = Problem::new(path, format!("no key `{}`", key.name), kind.allowed());
                self.problems.push(problem.hint(format!("`{}` is {}", key.name, key.meaning)));
            }
        }
    }

    fn value(&mut self, node: &Node, key: &'static Key, path: &str, origin: Origin) {
        match key.kind {
            Kind::SectionOrNone(_) if *node == Node::Text("none".into()) => return,
            Kind::Section(keys) | Kind::SectionOrNone(keys) => return self.section(node, keys, path),
            Kind::Sections(keys) => return self.sections(node, keys, path),
            Kind::OneOf(keys) => return self.one_of(node, keys, path),
            _ => {}
        }
        if let (Kind::Pairs { first, second, example }, Node::List(items)) = (key.kind, node)
            && self.pairs_are_wrong(items, [first, second], example, path)
        {
            return;
        }
        match understand(node, &key.kind) {
            Ok(value) => {
                let entry = Entry { value, typed: typed(node), origin, meaning: key.meaning, remark: String::new() };
                if matches!((&entry.value, node), (Value::Text(_), Node::Number(_) | Node::Flag(_))) {
                    self.entries.rewritten.push(path.to_string());
                }
                self.entries.order.push(path.to_string());
                self.entries.values.insert(path.to_string(), entry);
            }
            Err((found, hint)) => {
                let mut problem = Problem::new(path, found, key.kind.allowed());
                problem.hint = hint.map(String::into_boxed_str);
                self.problems.push(problem);
            }
        }
    }

    fn sections(&mut self, node: &Node, keys: &'static [Key], path: &str) {
        match node {
            Node::List(items) if (1..=MOST_SECTIONS).contains(&items.len()) => {
                for (index, item) in items.iter().enumerate() {
                    self.section(item, keys, &join(path, &index.to_string()));
                }
            }
            Node::List(items) => {
                let found =
                    if items.is_empty() { "an empty list".into() } else { format!("a list of {}", items.len()) };
                self.problems.push(Problem::new(path, found, format!("a list of 1 to {MOST_SECTIONS}")));
            }
            other => {
                let allowed = Kind::Sections(keys).allowed();
                self.problems
                    .push(Problem::new(path, other.describe(), allowed).hint("begin each of them with a dash"));
            }
        }
    }

    /// Tells every pair of a list that is not understood, at its own place.
    fn pairs_are_wrong(&mut self, items: &[Node], kinds: [Bounded; 2], example: &str, path: &str) -> bool {
        let before = self.problems.len();
        for (index, item) in items.iter().enumerate() {
            if let Err((found, hint)) = pair(item, kinds, example) {
                let [one, other] = kinds.map(|value| value.kind().allowed());
                let mut problem = Problem::new(join(path, &index.to_string()), found, format!("{one}, and {other}"));
                problem.hint = hint.map(String::into_boxed_str);
                self.problems.push(problem);
            }
        }
        self.problems.len() > before
    }

    fn one_of(&mut self, node: &Node, keys: &'static [Key], path: &str) {
        self.entries.sections.push(path.to_string());
        let allowed = Kind::OneOf(keys).allowed();
        let Node::Map(map) = node else {
            self.problems.push(Problem::new(path, node.describe(), allowed));
            return;
        };
        self.report_unknown(map, keys, path);
        let known: Vec<_> = map.iter().filter(|(name, _)| keys.iter().any(|key| key.name == name)).collect();
        if known.len() != 1 {
            let found = match known.len() {
                0 => "none of them".to_string(),
                _ => known.iter().map(|(name, _)| format!("`{name}`")).collect::<Vec<_>>().join(" and "),
            };
            let problem = Problem::new(path, found, allowed);
            self.problems.push(match known.len() {
                0 => problem.hint("write one of them as a key of its own and indent its keys below it"),
                _ => problem,
            });
        }
        for (name, node) in known {
            if let Some(key) = keys.iter().find(|key| key.name == name) {
                self.entries.mentioned.push(join(path, name));
                self.value(node, key, &join(path, name), Origin::File);
            }
        }
    }
}

/// The groups that have a key of this name, by their paths.
fn groups_with(name: &str, keys: &'static [Key], path: &str) -> Vec<String> {
    let mut found = Vec::new();
    if keys.iter().any(|key| key.name == name) {
        found.push(if path.is_empty() { "the design itself, without indent".to_string() } else { format!("`{path}`") });
    }
    for key in keys {
        if let Kind::Section(keys) | Kind::SectionOrNone(keys) | Kind::Sections(keys) | Kind::OneOf(keys) = key.kind {
            found.extend(groups_with(name, keys, &join(path, key.name)));
        }
    }
    found
}

fn join(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_string() } else { format!("{path}.{name}") }
}

fn typed(node: &Node) -> String {
    match node {
        Node::Text(text) => text.clone(),
        Node::Number(number) => number.to_string(),
        Node::Flag(flag) => flag.to_string(),
        Node::List(items) => {
            let one =
                |item: &Node| if matches!(item, Node::List(_)) { format!("[{}]", typed(item)) } else { typed(item) };
            items.iter().map(one).collect::<Vec<_>>().join(", ")
        }
        Node::Map(_) | Node::Nothing => String::new(),
    }
}

type Misunderstood = (String, Option<String>);

fn understand(node: &Node, kind: &Kind) -> Result<Value, Misunderstood> {
    match *kind {
        Kind::Quantity { dimension, low, high } => quantity(node, dimension, low, high).map(Value::Number),
        Kind::LengthOrGrains { low, high } => match grain_multiple::parse(&typed(node)) {
            Some((times, finer)) => Ok(Value::OfGrains { times, finer, bounds: [low, high] }),
            None => quantity(node, Dimension::Length, low, high).map(Value::Number),
        },
        Kind::Quantities { dimension, low, high } => match node {
            Node::List(items) if !items.is_empty() => items
                .iter()
                .map(|item| quantity(item, dimension, low, high))
                .collect::<Result<_, _>>()
                .map(Value::Numbers),
            Node::List(_) => Err(("an empty list".into(), None)),
            other => Err((other.describe(), Some("write a list: `[1 m, 2 m]`".into()))),
        },
        Kind::Pairs { first, second, example } => match node {
            Node::List(items) if !items.is_empty() => items
                .iter()
                .map(|item| pair(item, [first, second], example))
                .collect::<Result<_, _>>()
                .map(Value::Points),
            Node::List(_) => Err(("an empty list".into(), None)),
            other => Err((other.describe(), Some(format!("write a list of pairs: `{example}`")))),
        },
        Kind::Pair { first, second, example } => {
            pair(node, [first, second], example).map(|pair| Value::Points(vec![pair]))
        }
        Kind::Steepness { low, high } => steepness(node, low, high).map(Value::Number),
        Kind::Number { low, high } => match *node {
            Node::Number(number) if (low..=high).contains(&number) => Ok(Value::Number(number)),
            Node::Number(number) => Err((format!("`{number}`"), None)),
            _ => Err(match separators(typed(node).trim()) {
                Some((found, hint)) => (found, Some(hint)),
                None => (node.describe(), Some("this is a plain number without a unit".into())),
            }),
        },
        Kind::Count { low, high } => match *node {
            Node::Number(number) if number.fract() == 0.0 && number >= low as f64 && number <= high as f64 => {
                Ok(Value::Number(number))
            }
            Node::Number(number) => Err((format!("`{number}`"), None)),
            _ => Err(match separators(typed(node).trim()) {
                Some((found, hint)) => (found, Some(hint)),
                None => (node.describe(), None),
            }),
        },
        Kind::Text => match node {
            Node::Map(_) | Node::List(_) | Node::Nothing => Err((node.describe(), None)),
            _ => Ok(Value::Text(typed(node))),
        },
        Kind::File => match node {
            Node::Text(name) if !name.trim().is_empty() => Ok(Value::Text(name.clone())),
            other => Err((other.describe(), None)),
        },
        Kind::Choice(words) => match node {
            Node::Text(text) if words.contains(&text.as_str()) => Ok(Value::Text(text.clone())),
            Node::Text(text) => {
                let near =
                    nearest(&text.to_lowercase(), words.iter().copied()).map(|near| format!("did you mean `{near}`?"));
                Err((node.describe(), near))
            }
            _ => Err((node.describe(), None)),
        },
        Kind::Section(_) | Kind::SectionOrNone(_) | Kind::Sections(_) | Kind::OneOf(_) => Err((node.describe(), None)),
    }
}

/// A pair of quantities, SI.
fn pair(node: &Node, kinds: [Bounded; 2], example: &str) -> Result<[f64; 2], Misunderstood> {
    let hint = || Some(format!("each is two values in brackets: `{example}`"));
    match node {
        Node::List(items) if items.len() == 2 => {
            let value = |index: usize| {
                let Bounded { dimension, low, high } = kinds[index];
                quantity(&items[index], dimension, low, high)
            };
            Ok([value(0)?, value(1)?])
        }
        Node::List(items) => {
            let parted = items.len() > 2
                && items
                    .iter()
                    .any(|item| matches!(item, Node::Number(_)) || typed(item).trim().parse::<f64>().is_ok());
            let comma =
                "between brackets a comma parts values: write numbers with a decimal point, as `1.8 m`".to_string();
            Err((
                format!("{} value(s) in brackets, `{}`", items.len(), typed(node)),
                if parted { Some(comma) } else { hint() },
            ))
        }
        other => Err((other.describe(), hint())),
    }
}

/// An angle (rad), or the angle of a ratio of rise to run.
fn steepness(node: &Node, low: f64, high: f64) -> Result<f64, Misunderstood> {
    let text = typed(node);
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| *number > 0.0 && number.is_finite());
    let ratio = text.split_once(':').and_then(|(rise, run)| Some([number(rise)?, number(run)?]));
    let Some([rise, run]) = ratio else {
        return quantity(node, Dimension::Angle, low, high).map_err(|(found, hint)| {
            let bare = text.trim().parse::<f64>().is_ok() || text.contains(':');
            let ratio = "write a ratio of rise to run, as `1:1.5`, or an angle, as `34 deg`".to_string();
            (found, if bare { Some(ratio) } else { hint })
        });
    };
    let angle = libm::atan2(rise, run);
    if !(low..=high).contains(&angle) {
        return Err((format!("`{}`, an angle of {}", text.trim(), Dimension::Angle.show(angle)), None));
    }
    Ok(angle)
}

fn quantity(node: &Node, dimension: Dimension, low: f64, high: f64) -> Result<f64, Misunderstood> {
    let text = match node {
        Node::Text(text) => text.clone(),
        Node::Number(number) => number.to_string(),
        other => {
            return Err((other.describe(), Some(format!("write for example `1 {}`", dimension.display_symbol()))));
        }
    };
    let value = units::parse(&text, dimension).map_err(|error| {
        let fits = units::with_a_unit_in(&text, dimension, low, high);
        (error.found, fits.map(|fits| format!("write for example `{fits}`")).or(error.hint))
    })?;
    // Bounds are inclusive up to rounding of the unit's factor.
    if value < low - 1e-9 * low.abs() || value > high + 1e-9 * high.abs() {
        return Err((format!("`{}`", text.trim()), Some("the value or its unit is out of range".into())));
    }
    Ok(value)
}
