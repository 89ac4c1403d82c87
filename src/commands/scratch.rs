//! A folder for what is temporary, which nobody else can read and which goes with its owner.

use std::path::{Path, PathBuf};
use std::{fs, io};

use crate::commands::random_name::random_name;

pub struct Scratch(PathBuf);

impl Scratch {
    pub fn new() -> io::Result<Self> {
        let folder = std::env::temp_dir().join(format!("barrier-check-{}", random_name::<8>()?));
        let mut builder = fs::DirBuilder::new();
        #[cfg(unix)]
        std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
        builder.create(&folder)?;
        Ok(Self(folder))
    }

    pub fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // A browser may still be at it; what it leaves is in the folder for what is temporary.
        let _ = fs::remove_dir_all(&self.0);
    }
}
