//! Runs that can be taken up again: what is kept of them, when, and where.
//!
//! A store is a folder with the request (the design and how to run it) and, for every simulation of the run, a file that is renewed
//! now and then while it goes on and once it is done. To resume a run is to give the same request again with the same store: what is
//! done is taken from it, what was under way goes on, the rest is begun. A simulation is kept at its stops alone
//! ([`dem::simulation::Simulation::at_stop`]), where all that it depends on can be kept; so the result is that of a run that was
//! never interrupted, bit for bit.

pub(crate) mod file;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use sha2::Digest;

use crate::checkpoint::file::{CheckpointError, Kind, read, write};
use crate::exports::Exports;
use crate::lock::Watch;
use crate::terminal;

/// Name of a store's folder within that of the report.
pub const FOLDER: &str = "checkpoint";
pub const REQUEST: &str = "request.bin";

/// What was asked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Request {
    /// Name of the design file without folder and extension, and its bytes.
    pub name: String,
    pub design: Vec<u8>,
    /// Files that it names.
    pub attached: BTreeMap<String, Vec<u8>>,
    /// What tells the design file from others of its name, as seen from the folder of the report.
    pub source: Option<String>,
    pub starts: u32,
    pub vary: bool,
    pub exports: Exports,
}

impl Request {
    /// What a file of a store must have been kept for: the design, and which of its simulations.
    fn print(&self, identity: &str) -> [u8; 32] {
        let mut hash = sha2::Sha256::new_with_prefix(&self.design);
        for (name, bytes) in &self.attached {
            hash.update([0]);
            hash.update(name);
            hash.update([0]);
            hash.update(bytes);
        }
        hash.chain_update([0]).chain_update(identity).finalize().into()
    }
}

/// Where a run is kept.
#[derive(Debug)]
pub struct CheckpointStore {
    folder: PathBuf,
    request: Request,
    every: Duration,
    /// Whether simulations are kept when they are done, too: because others follow, or because the report of before must not get lost
    /// while the new one is written.
    keep_done: bool,
    /// Whether what is there is of an earlier run, which goes when first something of this one is kept.
    fresh: bool,
    /// Whether such a run was kept there when this one began, and when that was: until this one has gone on for the time between two times
    /// that it is kept, the other is worth more.
    of_before: bool,
    began: Instant,
    /// Tells whether another run has taken the folder of the report.
    watch: Option<Watch>,
    /// Whether the request is there; starts that run side by side write it once.
    ordered: Mutex<bool>,
    /// Whether anything has been kept, and whether it was told that nothing can be.
    kept: AtomicBool,
    warned: AtomicBool,
    /// Names of the files that the simulations of this run have asked for.
    asked: Mutex<BTreeSet<String>>,
    /// Names of those that this run has kept: a fresh one takes these alone.
    written: Mutex<BTreeSet<String>>,
}

impl CheckpointStore {
    /// A store in `folder`, which is made when first something is kept; `every` is the time between two times that a simulation is.
    /// A `fresh` one takes nothing of what is there.
    pub fn new(folder: PathBuf, request: Request, every: Duration, keep_done: bool, fresh: bool) -> Self {
        let no = || AtomicBool::new(false);
        let (ordered, asked) = (Mutex::new(false), Mutex::default());
        let of_before = fresh && Self::request_in(&folder).is_ok();
        Self {
            of_before,
            began: Instant::now(),
            folder,
            request,
            every,
            keep_done,
            fresh,
            watch: None,
            ordered,
            kept: no(),
            warned: no(),
            asked,
            written: Mutex::default(),
        }
    }

    /// The same, which keeps nothing and throws nothing away once the folder is no longer the one that this run has locked.
    pub fn watched(self, watch: Option<Watch>) -> Self {
        Self { watch, ..self }
    }

    fn folder_is_lost(&self) -> bool {
        self.watch.as_ref().is_some_and(Watch::is_lost)
    }

    /// The request of the store in `folder`.
    pub fn request_in(folder: &Path) -> Result<Request, CheckpointError> {
        read(&folder.join(REQUEST), Kind::Request, None)
    }

    /// Whether the run that another request asked for was of the design file that this one is of, be its text another by now.
    pub fn is_of_the_same_file_as(&self, other: &Request) -> bool {
        self.request.name == other.name && self.request.source == other.source
    }

    /// Whether there is something of this run to go on with.
    pub fn can_be_resumed(&self) -> bool {
        let kept = self.kept.load(Ordering::Relaxed) || !self.fresh;
        kept && !self.folder_is_lost() && Self::request_in(&self.folder).is_ok()
    }

    /// Whether a run that was kept before is still there, because this one ended before it was worth more.
    pub fn still_holds_the_one_before(&self) -> bool {
        self.of_before && !self.kept.load(Ordering::Relaxed) && Self::request_in(&self.folder).is_ok()
    }

    fn is_too_young(&self) -> bool {
        self.of_before && !self.kept.load(Ordering::Relaxed) && self.began.elapsed() < self.every
    }

    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Throws everything away: the run is done. A resumed run to which nothing of what lay there belonged has begun anew, which is told.
    pub fn clear(&self) {
        if self.folder_is_lost() {
            return;
        }
        let asked = self.asked.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let others = file::simulations(&self.folder).into_iter().filter(|name| !asked.contains(name)).count();
        if !self.fresh && others > 0 {
            terminal::warn(format_args!(
                "note: {others} of the checkpoints in {} do not belong to this run and were ignored",
                self.folder.display()
            ));
        }
        file::clear(&self.folder);
    }

    /// The place of one simulation; `identity` tells it from the others of the run.
    pub fn slot(&self, identity: &str) -> Slot<'_> {
        let digest = sha2::Sha256::digest(identity.as_bytes());
        let name: String = digest.iter().take(8).map(|byte| format!("{byte:02x}")).collect();
        let (name, print) = (format!("{name}.bin"), self.request.print(identity));
        self.asked.lock().unwrap_or_else(std::sync::PoisonError::into_inner).insert(name.clone());
        Slot { store: self, name, print, last: Mutex::new(Instant::now()) }
    }

    /// Once something of this run is kept, the request takes the place of the one before, and only then what was kept for that one goes: a
    /// program that is killed in between leaves one of the two.
    fn put_request(&self) -> std::io::Result<()> {
        let mut ordered = self.ordered.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        // It may have been removed during the run; without it nothing can be resumed.
        if !*ordered || !self.folder.join(REQUEST).exists() {
            write(&self.folder.join(REQUEST), Kind::Request, None, &self.request)?;
            *ordered = true;
            if self.fresh {
                let asked = self.asked.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
                file::clear_others(&self.folder, &asked);
            }
        }
        Ok(())
    }

    fn put<T: Serialize>(&self, name: &str, print: [u8; 32], content: &T) {
        let kept = match self.folder_is_lost() {
            true => Err(std::io::Error::other("the folder was removed or moved away during the run")),
            false => write(&self.folder.join(name), Kind::Simulation, Some(print), content),
        };
        let result = kept.and_then(|()| self.put_request());
        match result {
            Ok(()) => {
                self.kept.store(true, Ordering::Relaxed);
                if let Ok(mut written) = self.written.lock() {
                    written.insert(name.to_string());
                }
            }
            Err(error) => {
                if !self.warned.swap(true, Ordering::Relaxed) {
                    terminal::warn(format_args!(
                        "warning: the run could not be kept in {}: {error}; it goes on",
                        self.folder.display()
                    ));
                }
            }
        }
    }
}

/// Where one simulation is kept.
#[derive(Debug)]
pub struct Slot<'a> {
    store: &'a CheckpointStore,
    name: String,
    /// What its files must have been kept for.
    print: [u8; 32],
    last: Mutex<Instant>,
}

impl Slot<'_> {
    /// What was kept last and can be read. What cannot is told, and the one before it taken, or none.
    pub fn take<T: DeserializeOwned>(&self) -> Option<T> {
        let own = |written: &BTreeSet<String>| written.contains(&self.name);
        if self.store.fresh && !self.store.written.lock().is_ok_and(|written| own(&written)) {
            return None;
        }
        let path = self.store.folder.join(&self.name);
        let before = file::previous(&path);
        let then = if before.exists() { "the one before it is used" } else { "this simulation begins anew" };
        for (path, otherwise) in [(&path, then), (&before, "this simulation begins anew")] {
            match read(path, Kind::Simulation, Some(self.print)) {
                Ok(content) => return Some(content),
                Err(CheckpointError::Missing) => {}
                Err(error) => {
                    terminal::warn(format_args!("warning: {} cannot be used: {error}; {otherwise}", path.display()));
                }
            }
        }
        None
    }

    /// Keeps what goes on, if it is time to or if it is the `last` time.
    pub fn keep<T: Serialize>(&self, content: &T, last: bool) {
        let due = self.last.lock().is_ok_and(|mut kept| {
            let due = last && !self.store.is_too_young() || kept.elapsed() >= self.store.every;
            if due {
                *kept = Instant::now();
            }
            due
        });
        if due {
            self.store.put(&self.name, self.print, content);
        }
    }

    /// Keeps what is done, where that is worth it.
    pub fn finish<T: Serialize>(&self, content: &T) {
        if self.store.keep_done && !self.store.is_too_young() {
            self.store.put(&self.name, self.print, content);
        }
    }
}
