//! One program at a time in one folder. The lock is the operating system's: it goes with the process that holds it, however that ends.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

/// Name of the file that is locked; it is there while a program works in the folder, or after one was killed.
pub const FILE: &str = ".barrier-check.lock";

/// The right to write into a folder.
#[derive(Debug)]
pub struct Lock {
    path: PathBuf,
    /// Nothing where the file system knows no locks.
    held: Option<File>,
}

impl Lock {
    /// Takes the lock of a folder that exists; nothing where another program has it.
    pub fn take(folder: &Path) -> io::Result<Option<Self>> {
        let path = folder.join(FILE);
        loop {
            if fs::symlink_metadata(&path).is_ok_and(|found| !found.is_file()) {
                return Err(io::Error::other(format!("{} is no file", path.display())));
            }
            let file = File::options().create(true).truncate(false).write(true).open(&path)?;
            match file.try_lock() {
                Ok(()) if same_file(&file, &path) => return Ok(Some(Self { path, held: Some(file) })),
                // The one that had it has removed it in the meantime.
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => return Ok(None),
                Err(TryLockError::Error(_)) => return Ok(Some(Self { path, held: None })),
            }
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // While it is held, so that nobody else's is removed.
        if self.held.is_some() {
            let _ = fs::remove_file(&self.path);
        }
    }
}

#[cfg(unix)]
fn same_file(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let found = |found: fs::Metadata| (found.dev(), found.ino());
    file.metadata().ok().map(found) == fs::metadata(path).ok().map(found)
}

#[cfg(not(unix))]
fn same_file(_: &File, path: &Path) -> bool {
    path.exists()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_has_one_holder_and_then_the_next() {
        let folder = std::env::temp_dir().join(format!("barrier-check-{}-lock", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        let first = Lock::take(&folder).expect("a lock").expect("free");
        assert!(Lock::take(&folder).expect("a look").is_none());
        drop(first);
        assert!(!folder.join(FILE).exists());
        // One that was killed leaves its file and no lock.
        fs::write(folder.join(FILE), "").expect("a file");
        assert!(Lock::take(&folder).expect("a lock").is_some());
        fs::remove_dir(&folder).expect("an empty folder");
    }
}
