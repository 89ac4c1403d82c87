//! `recording.bin`: what a simulation said, in full, so that its report can be made again without it.
//!
//! Sealed ([`crate::container`]), in the wire format of postcard.

use serde::{Deserialize, Serialize};

use crate::container::{Broken, seal, unseal};
use crate::design::attached::{Attached, within};
use crate::design::entries::Purpose;
use crate::design::read::read_design_for;
use crate::fidelity::choose;
use crate::fidelity::ladder::{RUNGS, Step};
use crate::pipeline::{Run, restore};
use crate::problem::Problems;
use crate::sensitivity::Swing;
use crate::simulated::Simulated;

/// Name of the file.
pub const FILE: &str = "recording.bin";

pub const NAME: &[u8; 8] = b"BARRCHK\n";
/// Changes whenever what is recorded beside quantities and channels changes, which are known by their names.
pub const FORMAT: u32 = 15;

/// Why a recording cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    #[error("not a recording of barrier-check")]
    Foreign,
    #[error("a recording of format {0}, but this program reads format {FORMAT}: run the design again")]
    Format(u32),
    #[error("a damaged recording: its checksum is wrong. Run the design again")]
    Damaged,
    #[error(
        "a recording that lacks what this program measures, made by another version of it or changed since: run the design again"
    )]
    Incomplete,
    #[error("a recording of a design that this program refuses:\n{0}")]
    Design(Problems),
}

/// The recorded parts, owned or borrowed.
#[derive(Serialize, Deserialize)]
struct Recording<Runs, Varied> {
    design_name: String,
    design: Vec<u8>,
    attached: Attached,
    simulated: Option<Runs>,
    varied: Varied,
    climb: Vec<Step>,
}

/// A run as bytes.
pub fn encode(run: &Run) -> Result<Vec<u8>, postcard::Error> {
    let body = postcard::to_stdvec(&Recording {
        design_name: run.file.name.clone(),
        design: run.file.text.clone(),
        attached: run.file.attached.clone(),
        simulated: run.simulated.as_ref(),
        varied: run.varied.as_slice(),
        climb: run.climb.clone(),
    })?;
    Ok(seal(NAME, FORMAT, &body))
}

/// The run that the bytes record; equations are worked out anew.
pub fn decode(bytes: &[u8]) -> Result<Run, RecordingError> {
    let body = unseal(NAME, FORMAT, bytes).map_err(|broken| match broken {
        Broken::Foreign => RecordingError::Foreign,
        Broken::Format(other) => RecordingError::Format(other),
        Broken::Damaged => RecordingError::Damaged,
    })?;
    let recording: Recording<Simulated, Vec<Swing>> =
        postcard::from_bytes(body).map_err(|_| RecordingError::Damaged)?;
    let name = format!("{}.yaml", recording.design_name);
    let purpose = if recording.simulated.is_some() { Purpose::Simulation } else { Purpose::Equations };
    let file = read_design_for(purpose, &name, &recording.design, &within(&recording.attached))
        .map_err(RecordingError::Design)?;
    if recording.climb.iter().any(|step| step.rung >= RUNGS.len()) {
        return Err(RecordingError::Damaged);
    }
    let fidelity = match recording.climb.last() {
        Some(step) => choose(&RUNGS[step.rung].of(&file.design)),
        None => choose(&file.design),
    };
    if recording.simulated.as_ref().is_some_and(|seen| !seen.fits(&file.design)) {
        return Err(RecordingError::Incomplete);
    }
    let simulated = recording.simulated.map(|seen| Simulated { fidelity, ..seen });
    Ok(restore(file, simulated, recording.varied, recording.climb))
}
