//! The layers of the program: which part may name which, and that no two files need each other.
//!
//! The engine is a crate of its own, so that the compiler keeps it from the rest. Within the main crate this test reads the sources as the
//! compiler does: every path of the code, in `use` trees, expressions, types and macros, absolute or relative, is followed to the file of
//! the module that it names.

mod uses;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use uses::{Crate, Name};

/// Every module at the top of `src`, and what it may name besides itself.
const LAYERS: &[(&str, &[&str])] = &[
    ("larger", &[]),
    ("lock", &[]),
    ("problem", &[]),
    ("profile", &[]),
    ("raster", &[]),
    ("relief", &[]),
    ("program", &[]),
    ("container", &[]),
    ("sources", &[]),
    ("section", &[]),
    ("starts", &[]),
    ("reliability", &["larger", "starts"]),
    ("ring_law", &[]),
    ("lattice", &[]),
    ("yield_curve", &[]),
    ("exports", &[]),
    ("terminal", &["problem"]),
    ("units", &["problem"]),
    ("design", &["lattice", "problem", "profile", "raster", "relief", "ring_law", "section", "units", "yield_curve"]),
    ("flow_cases", &["design"]),
    ("new_design", &["units"]),
    ("text", &[]),
    ("loads", &["larger", "lattice", "profile", "relief", "section", "sources", "text", "units", "yield_curve"]),
    ("checkpoint", &["dem", "exports", "lock", "program", "container", "terminal"]),
    ("guideline", &["design", "larger", "loads", "section", "units"]),
    ("quantities", &["dem", "design", "guideline", "loads", "section"]),
    ("demand", &["design", "guideline", "larger", "quantities", "starts", "yield_curve"]),
    (
        "checks",
        &["demand", "design", "guideline", "larger", "loads", "quantities", "sources", "text", "units", "yield_curve"],
    ),
    ("explain", &["checks", "design", "loads", "problem", "sources", "text"]),
    ("fidelity", &["checks", "dem", "demand", "design", "guideline", "quantities", "ring_law", "scene"]),
    (
        "scene",
        &["checkpoint", "dem", "design", "fidelity", "lattice", "profile", "relief", "ring_law", "section", "units"],
    ),
    ("sensitivity", &["checks", "demand", "design", "guideline", "loads"]),
    (
        "simulated",
        &[
            "checkpoint",
            "checks",
            "dem",
            "demand",
            "design",
            "fidelity",
            "guideline",
            "larger",
            "flow_cases",
            "program",
            "quantities",
            "scene",
            "starts",
        ],
    ),
    ("arriving", &["design", "larger", "quantities", "section", "simulated", "starts"]),
    ("stages", &["design", "guideline", "larger", "loads", "quantities", "section", "simulated", "starts"]),
    (
        "first_surge",
        &[
            "arriving",
            "checks",
            "design",
            "fidelity",
            "guideline",
            "larger",
            "quantities",
            "simulated",
            "stages",
            "starts",
        ],
    ),
    (
        "pipeline",
        &[
            "arriving",
            "checks",
            "demand",
            "design",
            "fidelity",
            "first_surge",
            "guideline",
            "flow_cases",
            "quantities",
            "scene",
            "sensitivity",
            "simulated",
            "stages",
            "starts",
        ],
    ),
    (
        "validation",
        &[
            "lattice",
            "ring_law",
            "dem",
            "demand",
            "design",
            "fidelity",
            "guideline",
            "loads",
            "pipeline",
            "quantities",
            "section",
            "scene",
            "simulated",
            "starts",
            "units",
        ],
    ),
    (
        "studies",
        &[
            "arriving",
            "larger",
            "lattice",
            "checks",
            "dem",
            "demand",
            "design",
            "fidelity",
            "guideline",
            "pipeline",
            "problem",
            "quantities",
            "reliability",
            "ring_law",
            "scene",
            "simulated",
            "starts",
            "validation",
        ],
    ),
    (
        "report",
        &[
            "checkpoint",
            "checks",
            "dem",
            "demand",
            "design",
            "fidelity",
            "first_surge",
            "guideline",
            "flow_cases",
            "loads",
            "pipeline",
            "problem",
            "program",
            "profile",
            "reliability",
            "relief",
            "section",
            "quantities",
            "scene",
            "container",
            "sensitivity",
            "simulated",
            "stages",
            "sources",
            "starts",
            "studies",
            "units",
            "validation",
            "lock",
        ],
    ),
    (
        "commands",
        &[
            "checkpoint",
            "exports",
            "design",
            "explain",
            "fidelity",
            "flow_cases",
            "new_design",
            "pipeline",
            "problem",
            "program",
            "report",
            "scene",
            "container",
            "sensitivity",
            "simulated",
            "starts",
            "studies",
            "terminal",
            "units",
            "validation",
        ],
    ),
];

fn main_crate() -> Crate {
    Crate::read(Path::new("src"))
}

fn engine() -> Crate {
    Crate::read(Path::new("crates/dem/src"))
}

/// What is wrong with what a crate names.
fn breaches(of: &Crate) -> Vec<String> {
    let mut list = Vec::new();
    for (file, name) in of.names() {
        let own = of.top(file);
        if own == "lib" || own == "main" {
            continue;
        }
        let Some((_, allowed)) = LAYERS.iter().find(|(context, _)| *context == own) else {
            list.push(format!("{own} has no line in LAYERS"));
            continue;
        };
        let other = match &name {
            Name::Own(module) => module.first().cloned().unwrap_or_default(),
            Name::Other(krate) if krate == "dem" => krate.clone(),
            Name::Other(_) => continue,
        };
        let context = other == "dem" || LAYERS.iter().any(|(context, _)| *context == other);
        if context && other != own && !allowed.contains(&other.as_str()) {
            list.push(format!("{file} names {other}"));
        }
    }
    list.sort();
    list.dedup();
    list
}

#[test]
fn each_part_knows_only_what_its_layer_allows() {
    assert_eq!(breaches(&main_crate()), Vec::<String>::new());
}

/// Each form in which a part could name another is seen.
#[test]
fn a_forbidden_import_is_seen_in_every_form() {
    for planted in [
        "use crate::report::view::View;",
        "use crate::{design::Design, report::view::View};",
        "use crate::report as other;",
        "pub use crate::report::*;",
        "use super::super::report::view;",
        "use super::super::{loads::input, report};",
        "use crate as root; use root::report::view::View;",
        "fn f() { crate::report::render::render(); }",
        "fn f() -> crate::report::view::View { loop {} }",
        "fn f() { assert!(crate::report::view::good()); }",
        "fn f() { use super::super::report; }",
        "impl crate::report::view::Shown for i32 {}",
        "#[cfg(test)] mod tests { use crate::report::view::View; }",
        "mod inner { use super::super::super::report::view::View; }",
        "use dem::simulation::Simulation;",
        "use ::dem::simulation::Simulation;",
        "extern crate dem;",
        "extern crate dem as engine;",
    ] {
        let mut sources = main_crate();
        sources.plant("src/checks/anchors.rs", planted);
        assert_eq!(breaches(&sources).len(), 1, "{planted}: {:?}", breaches(&sources));
    }
}

#[test]
fn no_two_files_need_each_other() {
    for (name, sources) in [("engine", engine()), ("product", main_crate())] {
        let circles = circles(&sources.graph());
        assert!(circles.is_empty(), "{name}: {} circles\n{circles:#?}", circles.len());
    }
}

#[test]
fn a_circle_is_seen() {
    let graph = |pairs: &[[&str; 2]]| {
        let mut graph: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for [from, to] in pairs {
            graph.entry((*from).to_string()).or_default().insert((*to).to_string());
        }
        circles(&graph).len()
    };
    assert_eq!(graph(&[["a", "b"], ["b", "c"], ["a", "c"]]), 0);
    assert_eq!(graph(&[["a", "b"], ["b", "c"], ["c", "a"], ["c", "d"]]), 1);
    let mut sources = engine();
    sources.plant("crates/dem/src/geometry/point_segment.rs", "use crate::simulation::Simulation;");
    assert!(!circles(&sources.graph()).is_empty());
}

/// Groups of files each of which leads to every other of its group.
fn circles(graph: &BTreeMap<String, BTreeSet<String>>) -> Vec<BTreeSet<String>> {
    let reach: BTreeMap<&String, BTreeSet<&String>> = graph.keys().map(|from| (from, reached(graph, from))).collect();
    let meets = |a: &String, b: &String| reach[a].contains(b) && reach.get(b).is_some_and(|back| back.contains(a));
    let mut groups: Vec<BTreeSet<String>> = graph
        .keys()
        .map(|from| graph.keys().filter(|other| *other != from && meets(from, other)).chain([from]).cloned().collect())
        .filter(|group: &BTreeSet<String>| group.len() > 1)
        .collect();
    groups.sort();
    groups.dedup();
    groups
}

fn reached<'a>(graph: &'a BTreeMap<String, BTreeSet<String>>, from: &'a String) -> BTreeSet<&'a String> {
    let mut found = BTreeSet::new();
    let mut next = vec![from];
    while let Some(file) = next.pop() {
        next.extend(graph.get(file).into_iter().flatten().filter(|other| found.insert(*other)));
    }
    found
}

#[test]
fn only_one_file_names_rapier() {
    let named = |sources: &Crate| -> BTreeSet<String> {
        let rapier = |name: &Name| matches!(name, Name::Other(krate) if krate.starts_with("rapier"));
        sources.names().filter(|(_, name)| rapier(name)).map(|(file, _)| file.to_string()).collect()
    };
    assert_eq!(named(&main_crate()), BTreeSet::new());
    assert_eq!(named(&engine()), BTreeSet::from(["crates/dem/src/neighbours/broad_phase.rs".to_string()]));
}

#[test]
fn only_commands_and_writers_touch_files() {
    let writers = ["src/report/folder.rs", "src/lock.rs", "src/checkpoint/file.rs"];
    for (file, text) in main_crate().texts().chain(engine().texts()) {
        let allowed = file.starts_with("src/commands") || writers.contains(&file);
        assert!(allowed || !text.contains("std::fs"), "{file} touches files");
    }
}

/// Where the compiler does not look is told in the map.
#[test]
fn unsafe_stands_only_where_the_map_says() {
    let allowed =
        ["workers.rs", "simd/x86.rs", "simd/widest.rs", "sweep.rs", "tables/grain_rows.rs", "tables/prefetch.rs"];
    let allowed = allowed.map(|file| format!("crates/dem/src/{file}"));
    for (file, text) in main_crate().texts().chain(engine().texts()) {
        let used = text.lines().any(|line| !line.trim_start().starts_with("//") && line.contains("unsafe "));
        assert!(!used || allowed.iter().any(|context| context == file), "{file} is unsafe");
    }
}
