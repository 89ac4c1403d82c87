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

/// No file below `folder` may name any module in `forbidden`.
fn keeps_out(folder: &str, forbidden: &[&str]) {
    for path in sources(&Path::new("src").join(folder)) {
        let text = std::fs::read_to_string(&path).expect("source");
        for module in forbidden {
            assert!(!text.contains(&format!("crate::{module}::")), "{} names {module}", path.display());
        }
    }
}

const ABOVE_DESIGN: &[&str] =
    &["checks", "commands", "dem", "demand", "fidelity", "loads", "pipeline", "report", "scene", "validation"];

#[test]
fn each_part_knows_only_what_lies_below() {
    keeps_out("design", ABOVE_DESIGN);
    keeps_out(
        "dem",
        &[
            "checks",
            "commands",
            "demand",
            "design",
            "fidelity",
            "loads",
            "pipeline",
            "problem",
            "report",
            "scene",
            "sources",
            "units",
            "validation",
        ],
    );
    keeps_out("loads", &["dem", "scene", "checks", "report", "design"]);
    keeps_out("checks", &["dem", "scene", "report", "commands"]);
    keeps_out("scene", &["checks", "demand", "report", "commands", "pipeline"]);
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
        let writers = ["src/report/write.rs", "src/checkpoint/file.rs"];
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
