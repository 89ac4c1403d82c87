//! Reads the files that are named on the command line: regular ones, of a size that makes sense.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Bytes of a design or a study at the most.
pub const LONGEST_TEXT: u64 = 2 << 20;
/// Bytes of a recording at the most.
pub const LONGEST_RECORDING: u64 = 1 << 30;

/// The content of a file that starts with `head`; a device, a pipe and what is too long are refused before they are read.
pub fn read(path: &Path, longest: u64, head: &[u8]) -> io::Result<Vec<u8>> {
    // Before it is opened: a pipe would wait for somebody to write.
    let found = std::fs::metadata(path)?;
    if !found.is_file() {
        return Err(io::Error::other("it is not a regular file"));
    }
    if found.len() > longest {
        return Err(io::Error::other(format!("it is longer than {} MB", longest >> 20)));
    }
    let mut file = File::open(path)?;
    let mut bytes = Vec::new();
    file.by_ref().take(head.len() as u64).read_to_end(&mut bytes)?;
    // What does not start as it should is not read on; who asked sees that from the start alone.
    if bytes == head {
        file.take(longest).read_to_end(&mut bytes)?;
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_regular_files_of_a_fair_size_are_read() {
        let path = std::env::temp_dir().join(format!("barrier-check-{}-input", std::process::id()));
        std::fs::write(&path, "HEAD and the rest").expect("a file");
        assert_eq!(read(&path, 100, b"").expect("text"), b"HEAD and the rest");
        assert_eq!(read(&path, 100, b"HEAD").expect("text"), b"HEAD and the rest");
        assert_eq!(read(&path, 100, b"FOOT").expect("text"), b"HEAD");
        assert!(read(&path, 10, b"").is_err());
        assert!(read(Path::new("/dev/zero"), 100, b"").is_err() && read(Path::new("."), 100, b"").is_err());
        std::fs::remove_file(path).expect("the file");
    }
}
