//! Writes all files of a report, whole or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The file that is written last.
const RESULT: &str = "result.json";

/// A file of the report by its name.
pub struct ReportFile {
    pub name: String,
    pub bytes: Vec<u8>,
}

impl ReportFile {
    pub fn new(name: impl Into<String>, content: impl Into<Vec<u8>>) -> Self {
        Self { name: name.into(), bytes: content.into() }
    }
}

/// Writes `files` into `folder`. They are first written beside it under temporary names and then renamed one by
/// one, `result.json` last, so that a reader who finds that file finds the others complete.
pub fn write_all(folder: &Path, files: &[ReportFile]) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    remove_leftovers(folder, files);
    let temporary = |name: &str| -> PathBuf { folder.join(format!(".{name}.{}.tmp", std::process::id())) };
    let written = files.iter().try_for_each(|file| {
        // Never through a link that somebody has put there.
        let place = temporary(&file.name);
        let _ = fs::remove_file(&place);
        fs::File::create_new(&place)?.write_all(&file.bytes)
    });
    let renamed = written.and_then(|()| {
        // While the others are replaced there is no result, rather than the old one among new files.
        let result = folder.join(RESULT);
        if files.iter().any(|file| file.name == RESULT) && result.exists() {
            fs::remove_file(&result)?;
        }
        files.iter().try_for_each(|file| fs::rename(temporary(&file.name), folder.join(&file.name)))
    });
    if renamed.is_err() {
        for file in files {
            let _ = fs::remove_file(temporary(&file.name));
        }
    }
    renamed
}

/// Removes what programs that were killed while they wrote these files have left.
fn remove_leftovers(folder: &Path, files: &[ReportFile]) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let owner =
            name.strip_prefix('.').and_then(|name| name.strip_suffix(".tmp")).and_then(|name| name.rsplit_once('.'));
        let Some((of, process)) = owner else { continue };
        let gone = process.parse::<u32>().is_ok_and(|process| !Path::new("/proc").join(process.to_string()).exists());
        if gone && Path::new("/proc/self").exists() && files.iter().any(|file| file.name == of) {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// The folder `name` within `folder`; refused where it is a link that leads elsewhere.
pub fn inner(folder: &Path, name: &str) -> io::Result<PathBuf> {
    let inner = folder.join(name);
    match fs::symlink_metadata(&inner) {
        Ok(found) if found.is_symlink() => {
            Err(io::Error::other(format!("{} is a link; a folder is wanted", inner.display())))
        }
        _ => Ok(inner),
    }
}

/// Removes the named files from `folder`, but for those that are `written`.
pub fn remove_unless(folder: &Path, names: &[&str], written: &[&str]) {
    for name in names.iter().filter(|name| !written.contains(name)) {
        let _ = fs::remove_file(folder.join(name));
    }
}
