//! `barrier-check report DIR`: the report again, from what was recorded.

use std::path::Path;

use crate::commands::ExitCode;
use crate::commands::output::hand_over;
use crate::report::recording::{self, decode};

/// Makes the report in `folder` again from its recording, and the files for ParaView where asked for.
pub fn report(folder: &Path, with_vtk: bool) -> ExitCode {
    let file = folder.join(recording::FILE);
    let refuse = |what: &dyn std::fmt::Display| {
        eprintln!("error: {}: {what}", file.display());
        ExitCode::Undecided
    };
    match std::fs::read(&file) {
        Err(error) => refuse(&format!("{error}. A folder written by `barrier-check DESIGN` is wanted")),
        Ok(bytes) => match decode(&bytes) {
            Err(error) => refuse(&error),
            Ok(run) => hand_over(&run, folder, with_vtk),
        },
    }
}
