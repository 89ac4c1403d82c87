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
        return Err(too_long(longest));
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

/// What stands for standard input where a design file is named.
const STANDARD_INPUT: &str = "-";

/// The name of a design file as it is shown: a line break in it would begin a line that the program seems to say.
pub fn name_of(path: &Path) -> String {
    match path == Path::new(STANDARD_INPUT) {
        true => "stdin".to_string(),
        false => path.display().to_string().replace(['\n', '\r'], "\u{fffd}"),
    }
}

/// The text of a design file, or of standard input where it is named `-`; the files that such a design names are sought in the current folder.
pub fn read_text(path: &Path) -> io::Result<Vec<u8>> {
    if path != Path::new(STANDARD_INPUT) {
        return read(path, LONGEST_TEXT, b"");
    }
    let mut bytes = Vec::new();
    io::stdin().lock().take(LONGEST_TEXT + 1).read_to_end(&mut bytes)?;
    match bytes.len() as u64 > LONGEST_TEXT {
        true => Err(too_long(LONGEST_TEXT)),
        false => Ok(bytes),
    }
}

fn too_long(longest: u64) -> io::Error {
    io::Error::other(format!("it is longer than {} MB", longest >> 20))
}

/// Folder of a report in which the files lie that its design names.
pub const ATTACHED: &str = "attached";
/// Bytes of such a file at the most.
const LONGEST_ATTACHED: u64 = 512 << 20;

/// The content of a file that a design names, from the design's folder, or from where a report keeps it beside its copy of the design.
pub fn beside(design: &Path, name: &str) -> Result<Vec<u8>, String> {
    let folder = design.parent().unwrap_or(Path::new(""));
    let kept = Path::new(name).file_name().map(|name| folder.join(ATTACHED).join(name));
    let read = |path: &Path| read(path, LONGEST_ATTACHED, b"");
    match (read(&folder.join(name)), kept) {
        (Ok(bytes), _) => Ok(bytes),
        (Err(error), Some(kept)) => read(&kept).map_err(|_| error.to_string()),
        (Err(error), None) => Err(error.to_string()),
    }
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
