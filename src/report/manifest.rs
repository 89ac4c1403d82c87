//! `manifest.json`: what the program has written into a folder, so that it knows its own files from those of the user.

use std::collections::BTreeMap;
use std::path::{Component, Path};

use serde::{Deserialize, Serialize};
use sha2::Digest;

use crate::report::kind::Kind;

/// Name of the file.
pub const FILE: &str = "manifest.json";

/// The files of a folder by name, with their SHA-256.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Manifest {
    /// The program that wrote them, down to the commit.
    pub program: String,
    /// What tells the design file they were made from, by its place beside the folder, from others of the same name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<String>,
    /// What it is a report of, or is to be one of: what its files do not tell before they are written.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kind: Option<Kind>,
    pub files: BTreeMap<String, String>,
    /// While files are being replaced, what may stand there still.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub replaced: BTreeMap<String, Vec<String>>,
}

impl Manifest {
    /// Reads a manifest; nothing where it is none, or that of another program. A name that leads elsewhere is not taken.
    pub fn read(bytes: &[u8]) -> Option<Self> {
        let mut manifest: Self = serde_json::from_slice(bytes).ok()?;
        if !manifest.program.starts_with("barrier-check ") {
            return None;
        }
        manifest.files.retain(|name, _| is_plain(name));
        manifest.replaced.retain(|name, _| is_plain(name));
        Some(manifest)
    }

    /// Whether a file of this name with this digest was written by the program.
    pub fn wrote(&self, name: &str, digest: &str) -> bool {
        let before = self.replaced.get(name).into_iter().flatten();
        self.files.get(name).into_iter().chain(before).any(|known| known == digest)
    }

    /// The manifest that holds while these files are replaced by others.
    pub fn replaced_by(self, program: String, files: BTreeMap<String, String>) -> Self {
        let mut replaced = self.replaced;
        for (name, digest) in self.files {
            replaced.entry(name).or_default().push(digest);
        }
        Self { program, source: self.source, kind: self.kind, files, replaced }
    }

    /// Names of all files that the program has put there.
    pub fn names(&self) -> impl Iterator<Item = &String> {
        self.files.keys().chain(self.replaced.keys().filter(|name| !self.files.contains_key(*name)))
    }
}

/// Whether a name stays within the folder, or one folder below.
pub fn is_plain(name: &str) -> bool {
    let parts: Vec<Component> = Path::new(name).components().collect();
    (1..=2).contains(&parts.len()) && parts.iter().all(|part| matches!(part, Component::Normal(_)))
}

/// SHA-256 in hexadecimal digits.
pub fn digest_of(bytes: &[u8]) -> String {
    hexadecimal(&sha2::Sha256::digest(bytes))
}

pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_lead_elsewhere_are_not_taken() {
        for (name, plain) in [
            ("report.md", true),
            ("vtk/0001.vtu", true),
            ("a b#1.svg", true),
            ("", false),
            ("..", false),
            ("../x", false),
            ("/etc/passwd", false),
            ("a/b/c", false),
            ("a/../b", false),
        ] {
            assert_eq!(is_plain(name), plain, "{name}");
        }
        let forged = br#"{"program": "barrier-check 1", "files": {"../x": "00", "report.md": "11"}}"#;
        let manifest = Manifest::read(forged).expect("a manifest");
        assert_eq!(manifest.names().collect::<Vec<_>>(), ["report.md"]);
        assert_eq!(Manifest::read(b"[]"), None);
        assert_eq!(Manifest::read(br#"{"program": "another", "files": {}}"#), None);
    }
}
