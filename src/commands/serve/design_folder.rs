//! The folder that was chosen: the designs in it. Nothing outside it is read or written, whatever a request or a design names.

use std::io::Write;
use std::path::{Component, Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::{fs, io};

use axum::http::StatusCode;
use serde::Serialize;

use super::answer::Refused;
use crate::commands::input;
use crate::design::entries::Purpose;
use crate::design::read::{DesignFile, read_design_for, sha256};
use crate::problem::Problems;

/// Designs are sought so many folders deep, and so many are listed at the most.
const DEEPEST: usize = 4;
const MOST: usize = 500;
/// Folders in which nobody looks for designs of their own: reports keep copies of theirs.
const PASSED_BY: [&str; 3] = ["out", "target", "node_modules"];

pub struct Chosen {
    root: PathBuf,
    /// Held by whoever writes, from the look at what is there to the end.
    writes: Mutex<()>,
}

/// A design as it stands on the disk.
#[derive(Debug, Serialize)]
pub struct Written {
    pub path: String,
    pub text: String,
    /// SHA-256, by which it is told whether somebody else has changed it since.
    pub digest: String,
}

impl Chosen {
    pub fn open(folder: &Path) -> io::Result<Self> {
        let root = folder.canonicalize()?;
        if root.is_dir() {
            Ok(Self { root, writes: Mutex::new(()) })
        } else {
            Err(io::Error::other("it is not a folder"))
        }
    }

    pub fn root(&self) -> &Path {
        &self.root
    }

    /// All designs, by their path; studies and kits are none.
    pub fn designs(&self) -> Vec<String> {
        let mut found = Vec::new();
        self.seek(Path::new(""), 0, &mut found);
        found.sort();
        found
    }

    fn seek(&self, below: &Path, depth: usize, found: &mut Vec<String>) {
        let Ok(entries) = fs::read_dir(self.root.join(below)) else { return };
        for entry in entries.flatten() {
            let Ok(name) = entry.file_name().into_string() else { continue };
            let path = below.join(&name);
            // A link is not followed: it may lead out of the folder.
            let Ok(kind) = entry.file_type() else { continue };
            if name.starts_with('.') || found.len() >= MOST {
                continue;
            }
            if kind.is_dir() && depth < DEEPEST && !PASSED_BY.contains(&name.as_str()) {
                self.seek(&path, depth + 1, found);
            } else if kind.is_file() && is_yaml(&path) {
                let text = input::read(&self.root.join(&path), input::LONGEST_TEXT, b"").unwrap_or_default();
                if looks_like_a_design(&text) {
                    found.push(with_slashes(&path));
                }
            }
        }
    }

    /// Where a design is, or is to be, by its path within the folder.
    fn place(&self, path: &str) -> Result<PathBuf, Refused> {
        let named = Path::new(path);
        let plain = |part: Component| matches!(part, Component::Normal(name) if name.to_str().is_some_and(|name| !name.starts_with('.')));
        let harmless = !path.contains(['\\', ':', '\0', '\n', '\r'])
            && !path.ends_with(['/', '.'])
            && path.split('/').all(|part| part.len() <= 200);
        if path.is_empty() || !harmless || !named.components().all(plain) || !is_yaml(named) {
            return Err(Refused::bad(format!(
                "`{}` is no name for a design: a file in this folder or one below it, with the ending .yaml",
                crate::problem::harmless(path)
            )));
        }
        let place = self.root.join(named);
        let folder = place.parent().unwrap_or(&self.root);
        let folder = folder.canonicalize().map_err(|_| Refused::missing("the folder of this design"))?;
        if !folder.is_dir() {
            return Err(Refused::missing("the folder of this design"));
        }
        let leads_out = !folder.starts_with(&self.root)
            || fs::symlink_metadata(&place).is_ok_and(|found| found.is_symlink() || !found.is_file());
        if leads_out { Err(Refused::bad("this name leads out of the folder")) } else { Ok(place) }
    }

    pub fn read(&self, path: &str) -> Result<Written, Refused> {
        let place = self.place(path)?;
        if !place.exists() {
            return Err(Refused::missing(path));
        }
        let bytes = input::read(&place, input::LONGEST_TEXT, b"").map_err(Refused::failed)?;
        let digest = sha256(&bytes);
        let text = String::from_utf8(bytes).map_err(|_| Refused::bad(format!("{path} is no text in UTF-8")))?;
        Ok(Written { path: path.to_string(), text, digest })
    }

    /// Writes a design in one piece. `before` is the digest of what it takes the place of, nothing where there is none yet: what somebody else has
    /// written since is not overwritten.
    pub fn write(&self, path: &str, text: &str, before: Option<&str>) -> Result<Written, Refused> {
        let place = self.place(path)?;
        if text.len() as u64 > input::LONGEST_TEXT {
            return Err(Refused::new(StatusCode::PAYLOAD_TOO_LARGE, "the text is too long for a design"));
        }
        let _alone = self.writes.lock().unwrap_or_else(PoisonError::into_inner);
        let there = match place.exists() {
            true => Some(self.read(path)?.digest),
            false => None,
        };
        if there.as_deref() != before {
            return Err(Refused::conflict(match (there, before) {
                (Some(_), None) => format!("{path} is there already"),
                (Some(_), Some(_)) => format!(
                    "{path} was changed elsewhere, in another tab or by another program, since it was read here"
                ),
                (None, _) => format!("{path} is no longer on the disk"),
            }));
        }
        replace(&place, text.as_bytes()).map_err(|error| Refused::failed(format_args!("{path}: {error}")))?;
        self.read(path)
    }

    /// Reads a text as the design with a path; the files that it names are sought beside it, within the folder.
    pub fn design(&self, path: &str, text: &str) -> Result<Result<DesignFile, Problems>, Refused> {
        let place = self.place(path)?;
        let open = |other: &str| {
            let folder = place.parent().unwrap_or(&self.root);
            // Where the program reads it when it runs the design: there, or in the folder `attached`.
            let kept = Path::new(other).file_name().map(|name| folder.join(input::ATTACHED).join(name));
            let leads_out = |place: PathBuf| place.canonicalize().is_ok_and(|real| !real.starts_with(&self.root));
            if leads_out(folder.join(other)) || kept.is_some_and(leads_out) {
                return Err("it lies outside the folder that is served".to_string());
            }
            input::beside(&place, other)
        };
        Ok(read_design_for(Purpose::Simulation, path, text.as_bytes(), &open))
    }
}

fn is_yaml(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "yaml" || ending == "yml")
}

fn with_slashes(path: &Path) -> String {
    path.components().map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/")
}

/// By the keys that designs have and nothing else; what is empty may become one.
fn looks_like_a_design(text: &[u8]) -> bool {
    let begins = |key: &[u8]| text.split(|byte| *byte == b'\n').any(|line| line.starts_with(key));
    begins(b"project:") || begins(b"channel:") || begins(b"flow:") || text.trim_ascii().is_empty()
}

/// Puts a file in the place of another at once.
fn replace(place: &Path, bytes: &[u8]) -> io::Result<()> {
    let name = place.file_name().unwrap_or_default().to_string_lossy();
    // Two at once are in each other's way nowhere.
    static NUMBER: AtomicU64 = AtomicU64::new(0);
    let number = NUMBER.fetch_add(1, Ordering::Relaxed);
    let beside = place.with_file_name(format!(".{name}.{}.{number}.tmp", std::process::id()));
    let before = fs::metadata(place).ok().map(|found| found.permissions());
    if before.as_ref().is_some_and(fs::Permissions::readonly) {
        return Err(io::Error::other("it is protected against being written"));
    }
    let written = fs::File::create_new(&beside).and_then(|mut file| {
        // Readable by those who could read it before.
        if let Some(before) = before {
            file.set_permissions(before)?;
        }
        file.write_all(bytes)?;
        file.sync_all()
    });
    let replaced = written.and_then(|()| fs::rename(&beside, place));
    if replaced.is_err() {
        let _ = fs::remove_file(&beside);
    }
    replaced
}
