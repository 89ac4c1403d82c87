//! The files of a store: written whole or not at all, checked when read.
//!
//! Sealed ([`crate::container`]), in the wire format of postcard: what kind of file it is, the program that wrote it, the SHA-256 of the
//! design it belongs to, and the content. A file is written beside its place, synced and renamed; the one it replaces stays as the one before.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::container::{Broken, seal, unseal};
use crate::program::PROGRAM;

pub const NAME: &[u8; 8] = b"BARRKPT\n";
/// Changes whenever anything that is kept changes.
const FORMAT: u32 = 20;

/// Bytes of a file at the most: ten times those of the largest run that is allowed.
const LONGEST: u64 = 8 << 30;
/// The same of a request: a design and some numbers.
const LONGEST_REQUEST: u64 = 4 << 20;

/// Why a file cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    #[error("there is none")]
    Missing,
    #[error("it cannot be read: {0}")]
    Unreadable(io::Error),
    #[error("it is not a checkpoint of barrier-check")]
    Foreign,
    #[error("its format is {0}, but this program reads format {FORMAT}")]
    Format(u32),
    #[error("it is damaged: its checksum is wrong")]
    Damaged,
    #[error("it was kept by {0}, but this is {PROGRAM}, which would go on differently")]
    Program(String),
    #[error("it belongs to another design or simulation")]
    Design,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Kind {
    Request,
    Simulation,
}

#[derive(Serialize, Deserialize)]
struct Label {
    kind: Kind,
    program: String,
    design: Option<[u8; 32]>,
}

/// Where the file stays that the one at `path` has replaced.
pub fn previous(path: &Path) -> PathBuf {
    path.with_extension("before")
}

/// Writes a file. Whatever happens on the way, one that was there stays, here or as the one before.
pub fn write<T: Serialize>(path: &Path, kind: Kind, design: Option<[u8; 32]>, content: &T) -> io::Result<()> {
    let label = Label { kind, program: PROGRAM.to_string(), design };
    let body = postcard::to_stdvec(&(label, content)).map_err(io::Error::other)?;
    let folder = path.parent().unwrap_or(Path::new("."));
    if fs::symlink_metadata(folder).is_ok_and(|found| found.is_symlink()) {
        return Err(io::Error::other("it is a link; a folder is wanted"));
    }
    fs::create_dir_all(folder)?;
    if let Some(other) = [path, &previous(path)].into_iter().find(|path| path.exists() && !is_ours(path)) {
        return Err(io::Error::other(format!("{} was not written by this program", other.display())));
    }
    let temporary = path.with_extension("tmp");
    let _ = fs::remove_file(&temporary);
    let mut file = File::create_new(&temporary)?;
    let written = file.write_all(&seal(NAME, FORMAT, &body)).and_then(|()| file.sync_all());
    drop(file);
    let renamed = written.and_then(|()| {
        if kind == Kind::Simulation && path.exists() {
            fs::rename(path, previous(path))?;
        }
        fs::rename(&temporary, path)?;
        // So that the names are on the disk as well; not every system lets a folder be synced.
        let _ = File::open(folder).and_then(|folder| folder.sync_all());
        Ok(())
    });
    if renamed.is_err() {
        let _ = fs::remove_file(&temporary);
    }
    renamed
}

/// Reads a file of the given kind, kept for the given design.
pub fn read<T: DeserializeOwned>(path: &Path, kind: Kind, design: Option<[u8; 32]>) -> Result<T, CheckpointError> {
    // Looked at first: a pipe would wait for somebody to write, a device has no end.
    let longest = match kind {
        Kind::Request => LONGEST_REQUEST,
        Kind::Simulation => LONGEST,
    };
    let regular = fs::metadata(path).and_then(|found| match found.is_file() && found.len() <= longest {
        true => fs::read(path),
        false => Err(io::Error::other("it is no regular file of a fair size")),
    });
    let bytes = regular.map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => CheckpointError::Missing,
        _ => CheckpointError::Unreadable(error),
    })?;
    let body = unseal(NAME, FORMAT, &bytes).map_err(|broken| match broken {
        Broken::Foreign => CheckpointError::Foreign,
        Broken::Format(other) => CheckpointError::Format(other),
        Broken::Damaged => CheckpointError::Damaged,
    })?;
    let (label, rest) = postcard::take_from_bytes::<Label>(body).map_err(|_| CheckpointError::Damaged)?;
    if label.program != PROGRAM {
        return Err(CheckpointError::Program(label.program));
    }
    if label.kind != kind || label.design != design {
        return Err(CheckpointError::Design);
    }
    match postcard::take_from_bytes(rest) {
        Ok((content, [])) => Ok(content),
        _ => Err(CheckpointError::Damaged),
    }
}

/// Removes a store's folder with what the program has put there, and nothing else; a link is left alone.
pub fn clear(folder: &Path) {
    if fs::symlink_metadata(folder).map_or(true, |found| !found.is_dir()) {
        return;
    }
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        if is_ours(&entry.path()) {
            let _ = fs::remove_file(entry.path());
        }
    }
    let _ = fs::remove_dir(folder);
}

/// Removes the simulations of a store but for those named.
pub fn clear_others(folder: &Path, names: &BTreeSet<String>) {
    for name in simulations(folder).into_iter().filter(|name| !names.contains(name)) {
        let path = folder.join(name);
        for path in [previous(&path), path].iter().filter(|path| is_ours(path)) {
            let _ = fs::remove_file(path);
        }
    }
}

/// Names of the files of simulations in a store's folder.
pub fn simulations(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().filter(|entry| is_ours(&entry.path()));
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    names.filter(|name| name.ends_with(".bin") && !name.starts_with("request")).collect()
}

/// Whether a file is the program's: named `request` or by sixteen hexadecimal digits, with one of three endings, and beginning as all of
/// them do. One that was cut short while it was written may lack its beginning.
fn is_ours(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let Some((stem, end)) = name.rsplit_once('.') else { return false };
    let hexadecimal = stem.len() == 16 && stem.bytes().all(|letter| letter.is_ascii_hexdigit());
    let named = ["bin", "before", "tmp"].contains(&end) && (stem == "request" || hexadecimal);
    let mut head = Vec::new();
    let regular = named && fs::symlink_metadata(path).is_ok_and(|found| found.is_file());
    let read = regular && File::open(path).and_then(|file| file.take(NAME.len() as u64).read_to_end(&mut head)).is_ok();
    read && if end == "tmp" { NAME.starts_with(&head) } else { head == NAME }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("barrier-check-{}-{name}", std::process::id()));
        clear(&folder);
        folder.join("0123456789abcdef.bin")
    }

    #[test]
    fn what_is_written_is_read_and_the_one_before_stays() {
        let path = place("written");
        let read = |path: &Path| read::<Vec<f64>>(path, Kind::Simulation, Some([1; 32]));
        assert!(matches!(read(&path), Err(CheckpointError::Missing)));
        for value in [1.0, 2.0, 3.0] {
            write(&path, Kind::Simulation, Some([1; 32]), &vec![value, f64::NAN]).expect("a file");
            assert_eq!(read(&path).expect("readable")[0], value);
        }
        assert_eq!(read(&previous(&path)).expect("readable")[0], 2.0);
        clear(path.parent().expect("a folder"));
        assert!(!path.parent().expect("a folder").exists());
    }

    #[test]
    fn what_is_not_as_written_is_refused_with_the_reason() {
        let path = place("refused");
        write(&path, Kind::Simulation, Some([1; 32]), &vec![1.0; 100]).expect("a file");
        let good = std::fs::read(&path).expect("bytes");
        let told = |bytes: &[u8], design: [u8; 32]| {
            std::fs::write(&path, bytes).expect("a file");
            read::<Vec<f64>>(&path, Kind::Simulation, Some(design)).err().map(|error| error.to_string())
        };
        assert_eq!(told(&good, [1; 32]), None);
        assert_eq!(told(&good, [2; 32]).as_deref(), Some("it belongs to another design or simulation"));
        for length in 0..good.len() {
            assert!(told(&good[..length], [1; 32]).is_some(), "{length}");
        }
        for bit in (0..8 * good.len()).step_by(7) {
            let mut flipped = good.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            assert!(told(&flipped, [1; 32]).is_some(), "{bit}");
        }
        let mut newer = good.clone();
        newer[NAME.len()] = FORMAT as u8 + 1;
        assert!(told(&newer, [1; 32]).is_some_and(|told| told.contains(&format!("format is {}", FORMAT + 1))));
        clear(path.parent().expect("a folder"));
    }

    #[test]
    fn a_file_of_the_user_s_stays_whatever_it_is_called() {
        let path = place("theirs");
        let folder = path.parent().expect("a folder");
        fs::create_dir_all(folder).expect("a folder");
        let theirs = ["request.before", "0123456789abcdef.bin", "fedcba9876543210.tmp"].map(|name| folder.join(name));
        theirs.iter().for_each(|path| fs::write(path, "mine").expect("a file"));
        assert!(write(&path, Kind::Simulation, Some([1; 32]), &1_u8).is_err());
        assert!(write(&folder.join("00112233445566aa.bin"), Kind::Simulation, Some([1; 32]), &1_u8).is_ok());
        assert_eq!(simulations(folder), ["00112233445566aa.bin"]);
        clear_others(folder, &BTreeSet::new());
        clear(folder);
        assert!(theirs.iter().all(|path| fs::read(path).expect("a file") == b"mine"));
        assert_eq!(fs::read_dir(folder).expect("a folder").count(), theirs.len());
        fs::remove_dir_all(folder).expect("removed");
    }

    #[test]
    fn another_version_is_told_by_name() {
        let path = place("version");
        let label = Label { kind: Kind::Request, program: "0.0.1 abc".into(), design: None };
        let body = postcard::to_stdvec(&(label, 5_u32)).expect("bytes");
        let bytes = seal(NAME, FORMAT, &body);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(&path, bytes).expect("a file");
        let error = read::<u32>(&path, Kind::Request, None).expect_err("another version");
        assert!(error.to_string().contains("kept by 0.0.1 abc, but this is barrier-check "), "{error}");
        clear(path.parent().expect("a folder"));
    }

    #[test]
    fn a_file_of_another_kind_is_refused() {
        let path = place("kind");
        write(&path, Kind::Request, None, &vec![1.0]).expect("a file");
        assert!(matches!(read::<Vec<f64>>(&path, Kind::Simulation, None), Err(CheckpointError::Design)));
        assert!(read::<Vec<f64>>(&path, Kind::Request, None).is_ok());
        clear(path.parent().expect("a folder"));
    }
}
