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

impl Lock {
    /// Whether the folder still has the file that is locked: it may have been removed, and made anew by another.
    pub fn is_in_place(&self) -> bool {
        self.held.as_ref().is_none_or(|file| same_file(file, &self.path))
    }

    /// What tells later whether another has come.
    pub fn watch(&self) -> Watch {
        let own = self.held.as_ref().and_then(|file| identity(&file.metadata().ok()?));
        Watch { path: self.path.clone(), own }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // While it is held, so that nobody else's is removed.
        if self.held.is_some() && self.is_in_place() {
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Tells whether a folder is still the one that was locked.
#[derive(Clone, Debug)]
pub struct Watch {
    path: PathBuf,
    own: Option<(u64, u64)>,
}

impl Watch {
    /// Whether the lock that was taken is no longer in its place: the folder was removed or moved away, and another run may have come and gone there.
    pub fn is_lost(&self) -> bool {
        let there = fs::metadata(&self.path).ok().and_then(|found| identity(&found));
        self.own.is_some_and(|own| there != Some(own))
    }
}

/// Device and number of a file, where the system has them.
#[cfg(unix)]
fn identity(found: &fs::Metadata) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt;
    Some((found.dev(), found.ino()))
}

#[cfg(not(unix))]
fn identity(_: &fs::Metadata) -> Option<(u64, u64)> {
    None
}

fn same_file(file: &File, path: &Path) -> bool {
    let own = file.metadata().ok().and_then(|found| identity(&found));
    fs::metadata(path).is_ok_and(|found| identity(&found) == own)
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
        // One whose folder is removed is told from the one that comes there then, and leaves it its lock.
        let first = Lock::take(&folder).expect("a lock").expect("free");
        let watch = first.watch();
        assert!(first.is_in_place() && !watch.is_lost());
        fs::remove_dir_all(&folder).expect("a folder");
        assert!(!first.is_in_place() && watch.is_lost());
        fs::create_dir(&folder).expect("a folder");
        let second = Lock::take(&folder).expect("a lock").expect("free");
        assert!(!first.is_in_place() && watch.is_lost());
        drop(first);
        assert!(second.is_in_place() && Lock::take(&folder).expect("a look").is_none());
        drop(second);
        fs::remove_dir(&folder).expect("an empty folder");
    }
}
