//! A kit: a file with keys of `barrier`, of which a design takes over what it does not say itself.
//!
//! What the design says overrides the kit key by key. A list is taken as a whole. Where the same thing can be given in different ways, the way of
//! the design stands alone ([`WAYS`]). Comments of the kit go along as remarks, so that every number keeps its origin.

use crate::design::attached::Open;
use crate::design::document::{Document, Node};
use crate::design::entries::{Entries, Origin};
use crate::problem::Problem;

const BARRIER: &str = "barrier";
const KEY: &str = "kit";
const PATH: &str = "barrier.kit";
/// What a file has to be, as an error tells it.
const KEYS: &str = "keys of a barrier: flexible_net or rigid_wall, with what stands below them";
/// Different ways to give the same thing, each by its keys, the first of which says that it is that way.
const WAYS: &[&[&[&str]]] = &[
    &[&["mesh_opening", "net_rope", "mesh_angle", "mesh_shape"], &["net"]],
    &[&["count"], &["heights"], &["levels"]],
    &[&["rope"], &["diameter", "modulus", "breaking_load"]],
    &[&["plateau_force", "stroke"], &["curve"]],
    &[&["after_unloading"], &["under_load"]],
    &[&["resistance"], &["proof_load"], &["design_resistance"]],
    &[&["bed_resistance"], &["bed_bolt_resistance"]],
    &[
        &["resistance", "bending_resistance"],
        &["radius_of_gyration", "section_modulus", "yield_strength", "buckling_curve", "lateral_torsional_factor"],
    ],
    &[&["fixed"], &["opening"]],
];

/// Keys that name files.
const FILES: [&str; 2] = ["file", "rope_table"];

/// A kit that a design has taken over.
pub struct Kit {
    pub name: String,
    pub bytes: Vec<u8>,
    document: Document,
    /// The barrier as the design itself has it.
    own: Node,
}

/// Takes the kit out of a design that names one, and puts what it says below what the design says.
pub fn take(root: &mut Node, open: Open, problems: &mut Vec<Problem>) -> Option<Kit> {
    let Node::Map(root) = root else { return None };
    let (_, Node::Map(barrier)) = root.iter_mut().find(|(name, _)| name == BARRIER)? else { return None };
    let place = barrier.iter().position(|(name, node)| name == KEY && matches!(node, Node::Text(_)))?;
    let (_, Node::Text(name)) = barrier.remove(place) else { return None };
    let wanted = "a kit: a YAML file with keys of a barrier";
    let read = open(&name).map_err(|why| {
        Problem::new(PATH, format!("`{name}`, which cannot be read: {why}"), wanted)
            .hint("the name is taken from the folder of the design file")
    });
    let parsed = read.and_then(|bytes| {
        let document = Document::parse(&bytes, KEYS).map_err(|problem| {
            Problem::new(PATH, format!("`{name}`, in which there is {}", problem.found), problem.allowed)
        })?;
        let names_a_kit = matches!(&document.root, Node::Map(map) if map.iter().any(|(name, _)| name == KEY));
        if names_a_kit {
            return Err(Problem::new(PATH, format!("`{name}`, which names a kit itself"), wanted)
                .hint("copy the keys of that kit into this one"));
        }
        match names_a_file(&document.root) {
            Some(key) => Err(Problem::new(PATH, format!("`{name}`, which names a file under `{key}`"), wanted)
                .hint("a kit says all itself: write the points of a curve and the ropes out")),
            None => Ok((bytes, document)),
        }
    });
    match parsed {
        Ok((bytes, document)) => {
            let own = Node::Map(barrier.clone());
            merge(barrier, &document.root);
            Some(Kit { name, bytes, document, own })
        }
        Err(problem) => {
            problems.push(problem);
            None
        }
    }
}

/// The first key that names a file.
fn names_a_file(node: &Node) -> Option<String> {
    match node {
        Node::Map(map) => {
            map.iter().find_map(
                |(name, node)| {
                    if FILES.contains(&name.as_str()) { Some(name.clone()) } else { names_a_file(node) }
                },
            )
        }
        Node::List(items) => items.iter().find_map(names_a_file),
        _ => None,
    }
}

/// Adds what a group does not have from another, group by group.
pub(super) fn merge(own: &mut Vec<(String, Node)>, other: &Node) {
    let Node::Map(other) = other else { return };
    let told: Vec<String> = own.iter().map(|(name, _)| name.clone()).collect();
    // Whether the design gives in another way what this key of the kit gives.
    let is_given_otherwise = |name: &String| {
        let otherwise = |ways: &&&[&[&str]]| {
            let of_this = ways.iter().position(|way| way.contains(&name.as_str()));
            let of_design = ways.iter().position(|way| told.iter().any(|own| own == way[0]));
            of_this.zip(of_design).is_some_and(|(this, design)| this != design)
        };
        WAYS.iter().any(|ways| otherwise(&ways))
    };
    for (name, node) in other {
        match own.iter_mut().find(|(known, _)| known == name) {
            Some((_, Node::Map(inner))) => merge(inner, node),
            Some(_) => {}
            None if is_given_otherwise(name) => {}
            None => own.push((name.clone(), node.clone())),
        }
    }
}

impl Kit {
    /// Whether a value comes from the kit and not from the design itself.
    pub fn has(&self, path: &str) -> bool {
        let Some(below) = path.strip_prefix("barrier.") else { return false };
        finds(&self.document.root, below) && !finds(&self.own, below)
    }

    /// Tells of each value that comes from the kit where it comes from, with the comment beside it there.
    pub fn tell_origins(&self, entries: &mut Entries, comment: impl Fn(&Document, &[u8], &str) -> Option<String>) {
        let from_kit = entries.values.iter_mut().filter(|(path, entry)| entry.origin == Origin::File && self.has(path));
        for (path, entry) in from_kit {
            let below = path.strip_prefix("barrier.").unwrap_or(path);
            let own = comment(&self.document, &self.bytes, below);
            entry.remark = match own {
                Some(own) => format!("kit {}: {own}", self.name),
                None => format!("kit {}", self.name),
            };
        }
    }

    /// The text at a path as it stands in the kit.
    pub fn plain(&self, path: &str, typed: &str) -> Option<&str> {
        self.document.plain(path.strip_prefix("barrier.")?, typed)
    }

    /// Tells of a problem with a value of the kit that it stands there.
    pub fn tell_of(&self, problem: &mut Problem) {
        if self.has(&problem.path) {
            problem.found = format!("{} (in the kit {})", problem.found, self.name);
        }
    }
}

/// Whether a tree has a value at a path.
fn finds(node: &Node, path: &str) -> bool {
    let (first, rest) = path.split_once('.').map_or((path, None), |(first, rest)| (first, Some(rest)));
    let inner = match node {
        Node::Map(map) => map.iter().find(|(name, _)| name == first).map(|(_, node)| node),
        Node::List(items) => first.parse().ok().and_then(|number: usize| items.get(number)),
        _ => None,
    };
    match (inner, rest) {
        (None, _) => false,
        (Some(_), None) => true,
        (Some(inner), Some(rest)) => finds(inner, rest),
    }
}
