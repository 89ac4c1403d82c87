//! The one place that writes to the terminal. What cannot be written, because nobody listens or the disk behind is full, ends no run; and
//! what would steer the terminal, from the name of a file or a text of the design, is made visible.

use std::fmt::Display;
use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::problem::harmless;

/// Whether a line to standard output could not be written.
static LOST: AtomicBool = AtomicBool::new(false);

/// Writes a line to standard output; whether it could be written.
pub fn say(line: impl Display) -> bool {
    let written = line_to(std::io::stdout().lock(), line);
    LOST.fetch_or(!written, Ordering::Relaxed);
    written
}

/// Whether all that was said to standard output so far was written.
pub fn was_heard() -> bool {
    !LOST.load(Ordering::Relaxed)
}

/// Writes a line of warning or error to standard error; whether it could be written.
pub fn warn(line: impl Display) -> bool {
    line_to(std::io::stderr().lock(), line)
}

fn line_to(mut out: impl Write, line: impl Display) -> bool {
    writeln!(out, "{}", harmless(&line.to_string())).and_then(|()| out.flush()).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A disk that is full.
    struct Full;

    impl Write for Full {
        fn write(&mut self, _: &[u8]) -> std::io::Result<usize> {
            Err(std::io::ErrorKind::StorageFull.into())
        }

        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_line_that_cannot_be_written_is_told_and_ends_nothing() {
        assert!(!line_to(Full, "x"));
        let mut kept = Vec::new();
        assert!(line_to(&mut kept, "x"));
        assert_eq!(kept, b"x\n");
    }
}
