//! Values that a study puts in place of those of a design.

use crate::design::document::{Document, Node};
use crate::design::kit;

/// Dotted paths of keys, and what stands there.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Changes(Vec<(String, Node)>);

impl Changes {
    pub fn new(changes: Vec<(String, Node)>) -> Self {
        Self(changes)
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether the value at a path is one of them, or below one.
    pub fn has(&self, path: &str) -> bool {
        let below =
            |of: &String| path.strip_prefix(of.as_str()).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
        self.0.iter().any(|(of, _)| below(of))
    }

    /// Values that are texts, as the name of a file is.
    pub fn texts(&self) -> impl Iterator<Item = &str> {
        self.0.iter().filter_map(|(_, node)| match node {
            Node::Text(text) => Some(text.as_str()),
            _ => None,
        })
    }

    /// Puts them onto the tree of a design. A list is taken as a whole, and where the same thing can be given in different ways, the way of the
    /// change stands alone. A value of [`Node::Nothing`] removes the key.
    pub fn put_onto(&self, root: &mut Node) {
        for (path, node) in &self.0 {
            // A key that is not there is set to nothing, so that reading the design reports a wrong path.
            if *node == Node::Nothing && leave_out(root, path) {
                continue;
            }
            let mut tree = node.clone();
            for name in path.rsplit('.') {
                tree = Node::Map(vec![(name.to_string(), tree)]);
            }
            let Node::Map(mut changed) = tree else { continue };
            kit::merge(&mut changed, root);
            *root = Node::Map(in_the_order_of(changed, root));
        }
    }

    /// The design as it is with them, as the text of a file without comments. What looks like a number stands as it was typed: a revision 1.10
    /// is not 1.1.
    pub fn text_of(&self, document: &Document) -> String {
        let mut root = document.root.clone();
        self.put_onto(&mut root);
        let as_typed = |path: &str, read: String| {
            let plain = if self.has(path) { None } else { document.plain(path, &read) };
            plain.map_or(read.clone(), String::from)
        };
        let mut text = String::new();
        write(&root, "", &as_typed, &mut text);
        text
    }
}

/// Takes a key away; false if it is not there.
fn leave_out(root: &mut Node, path: &str) -> bool {
    let Node::Map(keys) = root else { return false };
    let (first, rest) = path.split_once('.').map_or((path, None), |(first, rest)| (first, Some(rest)));
    let Some(index) = keys.iter().position(|(name, _)| name == first) else { return false };
    match rest {
        Some(rest) => leave_out(&mut keys[index].1, rest),
        None => {
            keys.remove(index);
            true
        }
    }
}

/// Keys as they stood before, new ones behind them.
fn in_the_order_of(mut keys: Vec<(String, Node)>, before: &Node) -> Vec<(String, Node)> {
    let Node::Map(before) = before else { return keys };
    keys.sort_by_key(|(name, _)| before.iter().position(|(known, _)| known == name).unwrap_or(before.len()));
    keys
}

/// A number or truth value of a path as a file has it.
type AsTyped<'a> = dyn Fn(&str, String) -> String + 'a;

fn below(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_string() } else { format!("{path}.{name}") }
}

/// Writes groups in block style, with all else on the line of its key.
fn write(node: &Node, path: &str, as_typed: &AsTyped, text: &mut String) {
    let Node::Map(keys) = node else { return };
    let depth = if path.is_empty() { 0 } else { path.split('.').count() };
    for (name, value) in keys {
        let (blank, path) = ("  ".repeat(depth), below(path, name));
        match value {
            Node::Map(inner) if !inner.is_empty() => {
                text.push_str(&format!("{blank}{name}:\n"));
                write(value, &path, as_typed, text);
            }
            value => text.push_str(&format!("{blank}{name}: {}\n", inline(value, &path, as_typed))),
        }
    }
}

fn inline(node: &Node, path: &str, as_typed: &AsTyped) -> String {
    match node {
        Node::Map(keys) => {
            let key =
                |(name, value): &(String, Node)| format!("{name}: {}", inline(value, &below(path, name), as_typed));
            format!("{{{}}}", keys.iter().map(key).collect::<Vec<_>>().join(", "))
        }
        Node::List(items) => {
            let item = |(number, item): (usize, &Node)| inline(item, &below(path, &number.to_string()), as_typed);
            format!("[{}]", items.iter().enumerate().map(item).collect::<Vec<_>>().join(", "))
        }
        Node::Text(text) => quoted(text),
        Node::Number(number) => as_typed(path, number.to_string()),
        Node::Flag(flag) => as_typed(path, flag.to_string()),
        Node::Nothing => "~".to_string(),
    }
}

/// In double quotes, with what YAML escapes there.
fn quoted(text: &str) -> String {
    let escaped = text.chars().map(|letter| match letter {
        '"' => "\\\"".to_string(),
        '\\' => "\\\\".to_string(),
        '\n' => "\\n".to_string(),
        '\t' => "\\t".to_string(),
        letter if letter.is_control() => format!("\\u{:04x}", u32::from(letter)),
        letter => letter.to_string(),
    });
    format!("\"{}\"", escaped.collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::entries::Purpose;
    use crate::design::read::{read_design, read_design_changed};
    use crate::design::{BarrierDesign, FlexibleNet};

    const SMALL_NET: &str = include_str!("../../designs/small_net.yaml");

    #[test]
    fn nothing_leaves_a_key_out() {
        let read = |changes: &Changes| {
            let read =
                read_design_changed(Purpose::Simulation, "x", SMALL_NET.as_bytes(), &|_| Err("none".into()), changes);
            read.map(|read| read.design.limits.retained_mass)
        };
        let without = |path: &str| Changes::new(vec![(path.to_string(), Node::Nothing)]);
        assert_eq!(read(&Changes::default()).ok(), Some(0.85));
        assert_eq!(read(&without("limits.retained_mass")).ok(), Some(0.9));
        assert_eq!(read(&without("limits")).ok(), Some(0.9));
        assert!(read(&without("limits.retained_mas")).is_err());
    }

    fn net(changes: &Changes) -> FlexibleNet {
        let read =
            read_design_changed(Purpose::Simulation, "x", SMALL_NET.as_bytes(), &|_| Err("none".into()), changes);
        let design = read.unwrap_or_else(|problems| panic!("{problems}")).design;
        let BarrierDesign::FlexibleNet(net) = design.barrier else { panic!("a net") };
        *net
    }

    fn text(text: &str) -> Node {
        Node::Text(text.into())
    }

    #[test]
    fn a_change_stands_in_place_of_the_value_and_leaves_the_others() {
        let asked = Changes::new(vec![("barrier.flexible_net.anchors.resistance".into(), text("321 kN"))]);
        let [before, after] = [net(&Changes::default()), net(&asked)];
        assert_eq!(after.anchor_designs.all.resistance.value(), 321e3);
        assert_eq!(FlexibleNet { anchor_designs: before.anchor_designs.clone(), ..after }, before);
        assert!(
            asked.has("barrier.flexible_net.anchors.resistance") && !asked.has("barrier.flexible_net.anchors.resist")
        );
    }

    /// Levels exclude the count of main ropes that the design gives.
    #[test]
    fn another_way_to_give_the_same_takes_its_place() {
        let level =
            |height: &str| Node::Map(vec![("height".into(), text(height)), ("ropes".into(), Node::Number(2.0))]);
        let levels = Node::List(vec![level("0 m"), level("1.8 m")]);
        let changed = net(&Changes::new(vec![("barrier.flexible_net.main_ropes.levels".into(), levels)]));
        assert_eq!(changed.main_ropes.levels.iter().map(|level| level.ropes).collect::<Vec<_>>(), [2, 2]);
    }

    /// What is written is read as the same design.
    #[test]
    fn the_text_of_a_changed_design_is_that_design() {
        let changes = Changes::new(vec![
            ("barrier.flexible_net.anchors.resistance".into(), text("321 kN")),
            ("project.name".into(), text("a \"b\" \\ # c: d")),
        ]);
        let typed = SMALL_NET.replace("revision: A  ", "revision: 1.10  ");
        assert_ne!(typed, SMALL_NET);
        let written = changes.text_of(&Document::parse(typed.as_bytes(), "").unwrap());
        let read = read_design("x", written.as_bytes()).unwrap_or_else(|problems| panic!("{written}\n{problems}"));
        let open: &dyn Fn(&str) -> Result<Vec<u8>, String> = &|_| Err("none".into());
        let changed = read_design_changed(Purpose::Simulation, "x", typed.as_bytes(), &open, &changes).unwrap();
        assert_eq!(read.design, changed.design);
        assert_eq!(read.design.project.revision, "1.10");
        assert_eq!(read.design.project.name, "a \"b\" \\ # c: d");
    }
}
