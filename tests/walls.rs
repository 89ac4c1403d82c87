//! The walls between the parts of the program: which folder may name which.

use std::path::{Path, PathBuf};

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).expect("folder") {
        let path = entry.expect("entry").path();
        if path.is_dir() {
            files.extend(sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files
}

/// Every module at the top of `src`, and what it may name besides itself.
const WALLS: &[(&str, &[&str])] = &[
    ("problem", &[]),
    ("program", &[]),
    ("sealed", &[]),
    ("sources", &[]),
    ("starts", &[]),
    ("terminal", &["problem"]),
    ("units", &["problem"]),
    ("design", &["problem", "units"]),
    ("load_cases", &["design"]),
    ("loads", &["sources", "units"]),
    ("dem", &[]),
    ("checkpoint", &["dem", "program", "sealed", "terminal"]),
    ("demand", &["dem", "design", "loads", "starts", "units"]),
    ("checks", &["demand", "design", "loads", "sources", "units"]),
    ("fidelity", &["checks", "dem", "demand", "design", "scene"]),
    ("scene", &["checkpoint", "dem", "design", "fidelity", "units"]),
    ("sensitivity", &["checks", "demand", "design", "loads"]),
    (
        "simulated",
        &["checkpoint", "checks", "dem", "demand", "design", "fidelity", "load_cases", "program", "scene", "starts"],
    ),
    (
        "pipeline",
        &["checks", "demand", "design", "fidelity", "load_cases", "scene", "sensitivity", "simulated", "starts"],
    ),
    (
        "validation",
        &["dem", "demand", "design", "fidelity", "loads", "pipeline", "scene", "simulated", "starts", "units"],
    ),
    (
        "studies",
        &["checks", "dem", "demand", "design", "fidelity", "problem", "scene", "simulated", "starts", "validation"],
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
            "load_cases",
            "loads",
            "pipeline",
            "problem",
            "program",
            "scene",
            "sealed",
            "sensitivity",
            "simulated",
            "sources",
            "starts",
            "studies",
            "units",
            "validation",
        ],
    ),
    (
        "commands",
        &[
            "checkpoint",
            "design",
            "fidelity",
            "load_cases",
            "pipeline",
            "problem",
            "report",
            "scene",
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

/// The module at the top of `src` that a file belongs to.
fn module_of(path: &Path) -> String {
    let first = path.components().nth(1).expect("a file below src");
    Path::new(first.as_os_str()).file_stem().expect("a name").to_string_lossy().into_owned()
}

/// The modules at the top that the code of a text names; its comments may point anywhere.
fn named(text: &str) -> Vec<&str> {
    let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    let after = code.flat_map(|line| line.split("crate::").skip(1));
    after.filter_map(|rest| rest.split(|letter: char| !(letter.is_alphanumeric() || letter == '_')).next()).collect()
}

#[test]
fn each_part_knows_only_what_the_walls_allow() {
    for path in sources(Path::new("src")) {
        let module = module_of(&path);
        if module == "lib" || module == "main" {
            continue;
        }
        let allowed = WALLS.iter().find(|(name, _)| *name == module).map(|(_, allowed)| *allowed);
        let allowed = allowed.unwrap_or_else(|| panic!("{module} has no line in WALLS"));
        let text = std::fs::read_to_string(&path).expect("source");
        for other in named(&text) {
            let known = WALLS.iter().any(|(name, _)| *name == other);
            let fine = !known || other == module || allowed.contains(&other);
            assert!(fine, "{} names {other}", path.display());
        }
    }
}

#[test]
fn only_one_file_names_rapier() {
    let named: Vec<_> = sources(Path::new("src"))
        .into_iter()
        .filter(|path| std::fs::read_to_string(path).expect("source").contains("rapier3d"))
        .collect();
    assert_eq!(named, [Path::new("src/dem/neighbours/broad_phase.rs")]);
}

#[test]
fn only_commands_and_writers_touch_files() {
    for path in sources(Path::new("src")) {
        let text = std::fs::read_to_string(&path).expect("source");
        let writers = ["src/report/folder.rs", "src/report/lock.rs", "src/checkpoint/file.rs"];
        let allowed = path.starts_with("src/commands") || writers.iter().any(|writer| path == Path::new(writer));
        assert!(allowed || !text.contains("std::fs"), "{} touches files", path.display());
    }
}

/// Where the compiler does not look is told in the map.
#[test]
fn unsafe_stands_only_where_the_map_says() {
    let allowed =
        ["crew.rs", "simd/x86.rs", "simd/widest.rs", "sweep.rs", "tables/grain_rows.rs", "tables/prefetch.rs"];
    let allowed = allowed.map(|file| Path::new("src/dem").join(file));
    for path in sources(Path::new("src")) {
        let text = std::fs::read_to_string(&path).expect("source");
        let used = text.lines().any(|line| !line.trim_start().starts_with("//") && line.contains("unsafe "));
        assert!(!used || allowed.contains(&path), "{} is unsafe", path.display());
    }
}
