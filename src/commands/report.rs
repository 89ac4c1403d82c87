//! `barrier-check report DIR`: the report again, from what was recorded.

use std::path::Path;

use crate::commands::ExitCode;
use crate::commands::Failure;
use crate::commands::input::{self, LONGEST_RECORDING};
use crate::commands::messages::Format;
use crate::commands::output::{start_printing, tell, write_report_for};
use crate::exports::Exports;
use crate::pipeline::Run;
use crate::report::folder::{Folder, Named};
use crate::report::kind::Kind;
use crate::report::recording::{self, decode};
use crate::terminal;

/// Makes the report in `folder` again from its recording, with the files for other programs that are asked for.
pub fn report(folder: &Path, exports: Exports) -> ExitCode {
    let read = start_printing(exports).and_then(|printing| Ok((read_recording(folder)?, printing)));
    match read {
        Err(error) => {
            terminal::warn(format_args!("error: {error}"));
            ExitCode::Undecided
        }
        Ok((run, printing)) => {
            let claimed = Folder::claim(folder, None, Named::Explicitly);
            match claimed.and_then(|folder| folder.for_recorded(kind_of(&run))) {
                Ok(mut folder) => {
                    let written = write_report_for(&run, &mut folder, exports, printing);
                    tell(&run, &folder, exports, Format::Text, written)
                }
                Err(refusal) => {
                    terminal::warn(format_args!("error: {refusal}"));
                    ExitCode::Undecided
                }
            }
        }
    }
}

/// The kind of report that a run makes.
pub fn kind_of(run: &Run) -> Kind {
    if run.simulated.is_some() { Kind::Simulation } else { Kind::Equations }
}

/// The run recorded in `folder`.
pub fn read_recording(folder: &Path) -> Result<Run, Failure> {
    let file = folder.join(recording::FILE);
    let bytes = input::read(&file, LONGEST_RECORDING, recording::NAME).map_err(|error| {
        format!("{}: {error}. A folder written by `barrier-check DESIGN` is wanted", file.display())
    })?;
    Ok(decode(&bytes).map_err(|error| format!("{}: {error}", file.display()))?)
}
