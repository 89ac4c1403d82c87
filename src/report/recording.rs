//! `recording.bin`: what a simulation said, in full, so that its report can be made again without it.
//!
//! Eight bytes that name the format, its version and the CRC-32 of what follows (four bytes each, the lowest first), then the
//! recording in the wire format of postcard.

use serde::{Deserialize, Serialize};

use crate::checks::credibility::Numerics;
use crate::dem::recorders::histories::Histories;
use crate::design::read::read_design;
use crate::fidelity::choose;
use crate::fidelity::ladder::{RUNGS, Step};
use crate::pipeline::{Facts, Run, Simulated, Start, restore};
use crate::problem::Problems;
use crate::sensitivity::Swing;

/// Name of the file.
pub const FILE: &str = "recording.bin";

const MAGIC: &[u8; 8] = b"BARRCHK\n";
/// Changes whenever anything that is recorded changes.
const FORMAT: u32 = 3;
const HEAD: usize = MAGIC.len() + 8;

/// Why a recording cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    #[error("not a recording of barrier-check")]
    Foreign,
    #[error("a recording of format {0}, but this program reads format {FORMAT}: run the design again")]
    Format(u32),
    #[error("a damaged recording: its checksum is wrong. Run the design again")]
    Damaged,
    #[error("a recording of a design that this program refuses:\n{0}")]
    Design(Problems),
}

/// The recorded parts; `T` owns or borrows them.
#[derive(Serialize, Deserialize)]
struct Recording<Seen, Varied> {
    design_name: String,
    design: Vec<u8>,
    simulated: Option<Seen>,
    varied: Varied,
    climb: Vec<Step>,
}

#[derive(Deserialize)]
struct Seen {
    histories: Histories,
    facts: Facts,
    numerics: Numerics,
    starts: Vec<Start>,
    doubts: Vec<String>,
}

/// The same, to be written.
#[derive(Serialize)]
struct SeenRef<'a> {
    histories: &'a Histories,
    facts: &'a Facts,
    numerics: &'a Numerics,
    starts: &'a [Start],
    doubts: &'a [String],
}

impl<'a> SeenRef<'a> {
    fn of(seen: &'a Simulated) -> Self {
        let Simulated { histories, facts, numerics, starts, doubts, fidelity: _ } = seen;
        Self { histories, facts, numerics, starts, doubts }
    }
}

/// A run as bytes.
pub fn encode(run: &Run) -> Result<Vec<u8>, postcard::Error> {
    let body = postcard::to_stdvec(&Recording {
        design_name: run.file.name.clone(),
        design: run.file.text.clone(),
        simulated: run.simulated.as_ref().map(SeenRef::of),
        varied: run.varied.as_slice(),
        climb: run.climb.clone(),
    })?;
    let mut bytes = Vec::with_capacity(HEAD + body.len());
    bytes.extend_from_slice(MAGIC);
    bytes.extend_from_slice(&FORMAT.to_le_bytes());
    bytes.extend_from_slice(&crc32fast::hash(&body).to_le_bytes());
    bytes.extend_from_slice(&body);
    Ok(bytes)
}

/// The run that the bytes record; equations are worked out anew.
pub fn decode(bytes: &[u8]) -> Result<Run, RecordingError> {
    let Some((head, body)) = bytes.split_at_checked(HEAD) else { return Err(RecordingError::Foreign) };
    let (magic, numbers) = head.split_at(MAGIC.len());
    let number = |at: usize| numbers[at..at + 4].iter().rev().fold(0, |sum, byte| sum << 8 | u32::from(*byte));
    match (magic == MAGIC, number(0)) {
        (false, _) => return Err(RecordingError::Foreign),
        (true, FORMAT) => {}
        (true, other) => return Err(RecordingError::Format(other)),
    }
    if crc32fast::hash(body) != number(4) {
        return Err(RecordingError::Damaged);
    }
    let recording: Recording<Seen, Vec<Swing>> = postcard::from_bytes(body).map_err(|_| RecordingError::Damaged)?;
    let name = format!("{}.yaml", recording.design_name);
    let file = read_design(&name, &recording.design).map_err(RecordingError::Design)?;
    if recording.climb.iter().any(|step| step.rung >= RUNGS.len()) {
        return Err(RecordingError::Damaged);
    }
    let fidelity = match recording.climb.last() {
        Some(step) => choose(&RUNGS[step.rung].of(&file.design)),
        None => choose(&file.design),
    };
    let simulated = recording.simulated.map(|seen| {
        let Seen { histories, facts, numerics, starts, doubts } = seen;
        Simulated { fidelity, histories, facts, numerics, starts, doubts }
    });
    Ok(restore(file, simulated, recording.varied, recording.climb))
}
