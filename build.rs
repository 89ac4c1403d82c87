//! Tells the program which commit it is built from, where there is a repository, and whether its sources differ from that commit's.

#![allow(clippy::print_stdout, reason = "cargo reads what a build script prints")]

use std::process::Command;

fn main() {
    // What is built is told by its sources as well: an edit after the last build must show.
    for watched in [".git/HEAD", ".git/logs/HEAD", "src", "templates", "Cargo.toml", "Cargo.lock", "build.rs"] {
        // What does not exist would count as changed in each build.
        if std::path::Path::new(watched).exists() {
            println!("cargo:rerun-if-changed={watched}");
        }
    }
    let commit = git(&["rev-parse", "--short=10", "HEAD"]);
    // Without locks: a status that refreshes the index would make the next build think that something has changed.
    let changes = git(&["--no-optional-locks", "status", "--porcelain", "--untracked-files=no"]);
    let edited = if changes.is_some_and(|changes| !changes.is_empty()) { differences() } else { String::new() };
    let told = commit.map_or_else(
        || format!("unknown-{:08x}", digest_below(std::path::Path::new("src"))),
        |commit| format!("{commit}{edited}"),
    );
    println!("cargo:rustc-env=BARRIER_CHECK_COMMIT={told}");
}

/// What git says, without the white space around it; nothing where there is no git or no repository.
fn git(arguments: &[&str]) -> Option<String> {
    let told = Command::new("git").args(arguments).output().ok().filter(|told| told.status.success())?;
    String::from_utf8(told.stdout).ok().map(|text| text.trim().to_string())
}

/// What tells sources that differ from their commit from others that differ otherwise: a digest of the differences.
fn differences() -> String {
    use std::hash::{DefaultHasher, Hash, Hasher};
    let mut digest = DefaultHasher::new();
    git(&["--no-optional-locks", "diff", "HEAD"]).hash(&mut digest);
    format!("-dirty-{:08x}", digest.finish() as u32)
}

/// Where there is no repository the sources themselves tell one program from another.
fn digest_below(folder: &std::path::Path) -> u32 {
    use std::hash::{DefaultHasher, Hash, Hasher};
    let mut entries: Vec<_> =
        std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect();
    entries.sort();
    let mut digest = DefaultHasher::new();
    for path in entries {
        path.hash(&mut digest);
        if path.is_dir() { digest_below(&path).hash(&mut digest) } else { std::fs::read(&path).ok().hash(&mut digest) }
    }
    digest.finish() as u32
}
