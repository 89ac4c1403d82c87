//! Results that a study keeps, one file each, so that only what has changed runs again and one that is cut short loses little.
//!
//! Sealed ([`crate::container`]), in the wire format of postcard. The name of a file is the SHA-256 of what its result hangs on: the program
//! and what it was computed from.

use std::io;
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;
use sha2::Digest;

use crate::commands::input;
use crate::container::{seal, unseal};
use crate::report::folder::{KEPT_BY_STUDIES, OF_A_RESULT, create, inner};
use crate::report::manifest::hexadecimal;

const FORMAT: u32 = 1;

/// Bytes of a result at the most.
const LARGEST: u64 = 1 << 20;

/// Bytes of the digest in a file's name.
const DIGITS: usize = 16;

/// Where the results of a study are kept.
pub struct KeptResults {
    folder: PathBuf,
    program: [u8; 32],
}

impl KeptResults {
    /// Results in the folder of a study, which is made where it is not there.
    pub fn within(study: &Path) -> io::Result<Self> {
        let folder = inner(study, KEPT_BY_STUDIES)?;
        std::fs::create_dir_all(&folder)?;
        let program = sha2::Sha256::digest(std::fs::read(std::env::current_exe()?)?).into();
        Ok(Self { folder, program })
    }

    /// What was kept of a result; nothing where it was not, or where the file is not what was written.
    pub fn get<T: DeserializeOwned>(&self, of: &[&[u8]]) -> Option<T> {
        let bytes = input::read(&self.place(of), LARGEST, b"").ok()?;
        postcard::from_bytes(unseal(OF_A_RESULT, FORMAT, &bytes).ok()?).ok()
    }

    /// Keeps a result.
    pub fn put<T: Serialize>(&self, of: &[&[u8]], result: &T) -> io::Result<()> {
        let body = postcard::to_stdvec(result).map_err(io::Error::other)?;
        let place = self.place(of);
        // Somebody may have removed it in the meantime.
        std::fs::create_dir_all(&self.folder)?;
        // First beside it, so that nobody reads half a result; under a name of its own, as another may keep the same result at the same time.
        let half = place.with_extension(format!("{:016x}.tmp", fastrand::u64(..)));
        create(&half, &seal(OF_A_RESULT, FORMAT, &body)).and_then(|()| std::fs::rename(&half, &place)).map_err(
            |error| {
                let _ = std::fs::remove_file(&half);
                io::Error::new(error.kind(), format!("{}: {error}", half.display()))
            },
        )
    }

    /// The name of a result.
    pub fn id(&self, of: &[&[u8]]) -> String {
        let mut hash = sha2::Sha256::new_with_prefix(self.program);
        for part in of {
            hash.update(part.len().to_le_bytes());
            hash.update(part);
        }
        hexadecimal(&hash.finalize()[..DIGITS])
    }

    /// The folder of the results.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    fn place(&self, of: &[&[u8]]) -> PathBuf {
        self.folder.join(format!("{}.bin", self.id(of)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_result_is_found_again_unless_anything_it_hangs_on_or_its_file_has_changed() {
        let study = std::env::temp_dir().join(format!("barrier-check-{}-kept", std::process::id()));
        let _ = std::fs::remove_dir_all(&study);
        std::fs::create_dir_all(&study).unwrap();
        let kept = KeptResults::within(&study).unwrap();
        kept.put(&[b"scene", b"1"], &(0.5, f64::INFINITY)).unwrap();
        assert_eq!(kept.get(&[b"scene", b"1"]), Some((0.5, f64::INFINITY)));
        assert_eq!(kept.get::<(f64, f64)>(&[b"scene1", b""]), None);
        let file = kept.place(&[b"scene", b"1"]);
        let mut bytes = std::fs::read(&file).unwrap();
        *bytes.last_mut().unwrap() ^= 1;
        std::fs::write(&file, &bytes).unwrap();
        assert_eq!(kept.get::<(f64, f64)>(&[b"scene", b"1"]), None);
        std::fs::remove_dir_all(study).unwrap();
    }
}
