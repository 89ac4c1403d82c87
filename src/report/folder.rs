//! The folder of a report: whose it is, who may write into it, and how its files get there, whole or not at all.
//!
//! Nothing of the user's is lost: a folder that holds files and is not that of an earlier run is refused, and so is one in which files of
//! an earlier run were changed; what turns up during a run is moved aside. `manifest.json` tells which files are the program's.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use sha2::Digest;

use crate::checkpoint;
use crate::lock::{self, Lock, Watch};
use crate::program::PROGRAM;
use crate::report::kind::Kind;
use crate::report::manifest::{self, Manifest, digest_of, hexadecimal, is_plain};
use crate::report::recording;

/// Bytes of a manifest at the most.
const LONGEST_MANIFEST: u64 = 16 << 20;

/// Bytes of a file of a report at the most: what is larger is none of the program's.
const LARGEST: u64 = 4 << 30;

/// Folder of what a study has computed so far, below that of its report.
pub const KEPT_BY_STUDIES: &str = "kept";

/// With which every result that a study keeps begins.
pub const OF_A_RESULT: &[u8; 8] = b"bc-study";

/// What lies beside them for the engines that make runs: the list of runs, and what hands it to HyperQueue and to Slurm.
pub const OF_ENGINES: [&str; 3] = ["runs.txt", "on_hyperqueue.py", "on_slurm.sh"];

/// What the program puts into a folder besides the files of a report.
pub const OWN_NAMES: [&str; 4] = [manifest::FILE, lock::FILE, checkpoint::FOLDER, KEPT_BY_STUDIES];

/// The file that is put in place last.
const RESULT: &str = "result.json";

/// A file of the report by its name, which may lie in one folder below.
pub struct ReportFile {
    pub name: String,
    pub bytes: Vec<u8>,
}

impl ReportFile {
    pub fn new(name: impl Into<String>, content: impl Into<Vec<u8>>) -> Self {
        Self { name: name.into(), bytes: content.into() }
    }
}

/// Why nothing is written into a folder.
#[derive(Debug, thiserror::Error)]
pub enum Refusal {
    #[error("{0} is a file; a folder is wanted")]
    File(String),
    #[error(
        "{0} holds files that barrier-check has not written ({1}), and they might be lost: use a new or empty folder"
    )]
    Foreign(String, String),
    #[error(
        "in {0}, files of an earlier run have been changed since ({1}), and the changes would be lost: move them elsewhere, or use another folder"
    )]
    Changed(String, String),
    #[error(
        "{0} holds a report of something else, as of another design file of the same name: use another folder, or remove that report"
    )]
    OtherDesign(String),
    #[error("{0} holds {1}, whose place {2} would take: use another folder")]
    OtherKind(String, &'static str, &'static str),
    #[error("in {0} an interrupted run is kept, of a design or a study: finish it first, or use another folder")]
    Interrupted(String),
    #[error("another run is writing into {0}: wait until it has ended, or use another folder")]
    Taken(String),
    #[error("the report could not be written to {0}: {1}")]
    Unwritable(String, io::Error),
}

/// How a folder was named.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Named {
    /// By the user.
    Explicitly,
    /// By the program, after the design file.
    ByDefault,
}

/// A folder in which this program alone writes, until it is dropped.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    there_before: bool,
    manifest: Manifest,
    /// Its text as it was put into the folder last.
    laid: RefCell<String>,
    /// The design file whose report is to be written.
    source: Option<String>,
    /// What is to be written.
    kind: Option<Kind>,
    /// Whether all there is of the program's is a recording that was brought here.
    brought: bool,
    // Last, so that the folder is in order before the next may have it.
    lock: Option<Lock>,
}

impl Folder {
    /// Takes a folder for writing, and makes it where it is not there. `source` is the design file whose report it will hold.
    pub fn claim(path: &Path, source: Option<&Path>, named: Named) -> Result<Self, Refusal> {
        let unwritable = |error: io::Error| Refusal::Unwritable(path.display().to_string(), error);
        if path.exists() && !path.is_dir() {
            return Err(Refusal::File(path.display().to_string()));
        }
        let there_before = path.exists();
        fs::create_dir_all(path).map_err(unwritable)?;
        let mut folder = Self {
            path: path.to_path_buf(),
            there_before,
            manifest: Manifest::default(),
            laid: RefCell::default(),
            source: None,
            kind: None,
            brought: false,
            lock: None,
        };
        folder.whose()?;
        folder.lock =
            Some(Lock::take(path).map_err(unwritable)?.ok_or_else(|| Refusal::Taken(path.display().to_string()))?);
        // Another run may have ended in between.
        folder.whose()?;
        folder.brought = folder.manifest.files.keys().eq([recording::FILE]);
        let place = source.and_then(|source| place_beside(source, path));
        // What was brought, or made of what was, has an owner that is not known.
        let another = folder.manifest.source != place;
        if named == Named::ByDefault && another && !folder.manifest.files.is_empty() {
            return Err(Refusal::OtherDesign(path.display().to_string()));
        }
        let changed = folder.changed();
        if !changed.is_empty() {
            return Err(Refusal::Changed(path.display().to_string(), listed(&changed)));
        }
        folder.remove_leftovers();
        // Another's report stays another's until this one is written.
        folder.manifest.source = folder.manifest.source.take().or(place.clone());
        folder.source = place;
        if folder.manifest.program.is_empty() {
            folder.manifest.program = PROGRAM.to_string();
        }
        folder.put_manifest().map_err(unwritable)?;
        Ok(folder)
    }

    /// What tells the design file whose report is to be written from others of its name.
    pub fn source(&self) -> Option<&str> {
        self.source.as_deref()
    }

    /// What is written will be the report of another design file: of the run that was interrupted.
    pub fn go_on_with(&mut self, source: Option<String>) {
        self.source = source;
    }

    /// The folder, if the report of its own recording may be made again in it.
    pub fn for_recorded(self, kind: Kind) -> Result<Self, Refusal> {
        if self.brought { Ok(self) } else { self.for_kind(kind) }
    }

    /// The folder, if a report of this kind may be written into it.
    pub fn for_kind(mut self, kind: Kind) -> Result<Self, Refusal> {
        let place = || self.path.display().to_string();
        if self.brought {
            return Err(Refusal::Foreign(place(), recording::FILE.to_string()));
        }
        // That of a finished study is told by its report.
        let of_a_study =
            kind != Kind::Study && self.manifest.files.is_empty() && self.path.join(KEPT_BY_STUDIES).is_dir();
        if (kind != Kind::Simulation && self.keeps_a_run()) || of_a_study {
            return Err(Refusal::Interrupted(place()));
        }
        match Kind::of(self.manifest.files.keys()).or(self.manifest.kind) {
            Some(there) if !kind.may_replace(there) => Err(Refusal::OtherKind(place(), there.words(), kind.words())),
            _ => {
                self.kind = Some(kind);
                Ok(self)
            }
        }
    }

    /// Whether an interrupted run is kept here, to be resumed.
    fn keeps_a_run(&self) -> bool {
        starts_with(&self.path.join(checkpoint::FOLDER).join(checkpoint::REQUEST), checkpoint::file::NAME)
    }

    /// Takes a folder for what is made from no single design: a comparison, a validation.
    pub fn claim_for(path: &Path, kind: Kind) -> Result<Self, Refusal> {
        let mut folder = Self::claim(path, None, Named::Explicitly)?.for_kind(kind)?;
        folder.source = Some(kind.words().to_string());
        Ok(folder)
    }

    /// Whether there is a report in it, whose place the one that is to be written takes.
    pub fn holds_a_report(&self) -> bool {
        !self.manifest.files.is_empty()
    }

    /// Whether that is of another design file than the one whose report is to be written.
    pub fn holds_anothers_report(&self) -> bool {
        self.holds_a_report() && self.manifest.source != self.source
    }

    /// Takes a folder within this one, of a report of its own.
    pub fn claim_inner(&self, name: &str, source: Option<&Path>, kind: Kind) -> Result<Self, Refusal> {
        let path = inner(&self.path, name)
            .map_err(|error| Refusal::Unwritable(self.path.join(name).display().to_string(), error))?;
        Self::claim(&path, source, Named::ByDefault)?.for_kind(kind)
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Reads the manifest, or tells that the folder is not the program's.
    fn whose(&mut self) -> Result<(), Refusal> {
        let place = self.path.join(manifest::FILE);
        let regular =
            fs::symlink_metadata(&place).is_ok_and(|found| found.is_file() && found.len() <= LONGEST_MANIFEST);
        let read = regular.then(|| fs::read(&place).ok()).flatten();
        if let Some(manifest) = read.and_then(|bytes| Manifest::read(&bytes)) {
            self.manifest = manifest;
            return Ok(());
        }
        // A recording that was brought here is to have its report; a run that was interrupted is to go on.
        let recording = self.path.join(recording::FILE);
        let recorded = starts_with(&recording, recording::NAME).then(|| digest_in(&recording)).flatten();
        let kept = self.keeps_a_run();
        let mut foreign = self.others();
        if fs::symlink_metadata(&place).is_ok() {
            foreign.push(manifest::FILE.to_string());
        }
        let results = self.keeps_results();
        foreign.retain(|name| (name != recording::FILE || recorded.is_none()) && (name != checkpoint::FOLDER || !kept));
        foreign.retain(|name| name != KEPT_BY_STUDIES || !results);
        if !foreign.is_empty() {
            return Err(Refusal::Foreign(self.path.display().to_string(), listed(&foreign)));
        }
        let files = recorded.map(|digest| (recording::FILE.to_string(), digest)).into_iter().collect();
        self.manifest = Manifest { files, ..Manifest::default() };
        Ok(())
    }

    /// Whether runs of a study have been kept here before its page was written, as workers on other machines do.
    fn keeps_results(&self) -> bool {
        let Ok(kept) = inner(&self.path, KEPT_BY_STUDIES) else { return false };
        let mut files = fs::read_dir(kept).into_iter().flatten().flatten().map(|entry| entry.path());
        let of_engines =
            |file: &Path| file.file_name().is_some_and(|name| OF_ENGINES.iter().any(|known| name == *known));
        let half = |file: &Path| file.extension().is_some_and(|end| end == "tmp");
        files.all(|file| starts_with(&file, OF_A_RESULT) || half(&file) || of_engines(&file))
    }

    /// What lies in the folder besides the lock, the manifest and what a killed program has left.
    fn others(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.path).into_iter().flatten().flatten();
        let mut names: Vec<String> = entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
        names.retain(|name| name != lock::FILE && name != manifest::FILE && temporary_of(name).is_none());
        names.sort();
        names
    }

    /// Files that the program has written and somebody has changed.
    fn changed(&self) -> Vec<String> {
        let changed = |name: &&String| {
            let path = self.path.join(name);
            fs::symlink_metadata(&path).is_ok() && !self.is_ours(name)
        };
        self.manifest.names().filter(changed).cloned().collect()
    }

    /// Whether the file of this name is as the program wrote it.
    fn is_ours(&self, name: &str) -> bool {
        // What lies behind a link is not in the folder.
        let inside = folder_of(name).is_none_or(|below| inner(&self.path, &below.to_string_lossy()).is_ok());
        inside && digest_in(&self.path.join(name)).is_some_and(|digest| self.manifest.wrote(name, &digest))
    }

    /// Writes `files`, and removes what the program has put there before and does not write now. All are first written beside their
    /// places and then renamed one by one, `result.json` last, so that a reader who finds that file finds the others complete. What is
    /// not the program's is moved aside; returned is what was moved, and to where.
    pub fn write(&mut self, files: &[ReportFile]) -> io::Result<Vec<[String; 2]>> {
        self.hold_again()?;
        let mut moved = self.clear_the_way(files)?;
        if self.manifest_is_another() {
            moved.extend(self.move_aside(manifest::FILE)?);
        }
        if let Err(error) = self.lay_out(files) {
            files.iter().for_each(|file| drop(fs::remove_file(self.temporary(&file.name))));
            return Err(error);
        }
        let digests = files.iter().map(|file| (file.name.clone(), digest_of(&file.bytes))).collect();
        self.manifest.kind = self.kind.or(self.manifest.kind);
        // Should the rest be cut short, both the old files and the new ones are the program's.
        self.manifest = std::mem::take(&mut self.manifest).replaced_by(PROGRAM.to_string(), digests);
        let placed = self.place(files);
        if placed.is_ok() {
            self.manifest.replaced.clear();
            self.manifest.source = self.source.clone().or(self.manifest.source.take());
            self.remove_leftovers();
        }
        self.put_manifest()?;
        moved.extend(placed?);
        Ok(moved)
    }

    /// Takes the folder anew where it was removed during the run. Where another works in it now, or has left a report, it is that one's.
    fn hold_again(&mut self) -> io::Result<()> {
        if self.lock.as_ref().is_some_and(Lock::is_in_place) {
            return Ok(());
        }
        let another = || io::Error::other("the folder was removed during the run, and another run has taken its place");
        fs::create_dir_all(&self.path)?;
        self.lock = None;
        self.lock = Some(Lock::take(&self.path)?.ok_or_else(another)?);
        let found = fs::read(self.path.join(manifest::FILE)).ok().and_then(|bytes| Manifest::read(&bytes));
        let of_another = found.is_some_and(|found| found.files != self.manifest.files);
        if of_another { Err(another()) } else { Ok(()) }
    }

    /// What tells whether another run has taken the folder since.
    pub fn watch(&self) -> Option<Watch> {
        self.lock.as_ref().map(Lock::watch)
    }

    /// Makes the folder where it was removed during the run, and moves aside what stands in the place of one below it.
    fn clear_the_way(&self, files: &[ReportFile]) -> io::Result<Vec<[String; 2]>> {
        fs::create_dir_all(&self.path)?;
        let below: BTreeSet<&Path> = files.iter().filter_map(|file| folder_of(&file.name)).collect();
        let in_the_way = |below: &&Path| fs::symlink_metadata(self.path.join(below)).is_ok_and(|found| !found.is_dir());
        let moved = below.into_iter().filter(in_the_way).map(|below| self.move_aside(&below.to_string_lossy()));
        Ok(moved.collect::<io::Result<Vec<_>>>()?.into_iter().flatten().collect())
    }

    /// Writes the files beside their places.
    fn lay_out(&self, files: &[ReportFile]) -> io::Result<()> {
        for file in files {
            if !is_plain(&file.name) {
                return Err(io::Error::other(format!("{:?} is no name for a file of the report", file.name)));
            }
            if let Some(below) = folder_of(&file.name) {
                fs::create_dir_all(inner(&self.path, &below.to_string_lossy())?)?;
            }
            create(&self.temporary(&file.name), &file.bytes)?;
        }
        Ok(())
    }

    /// Puts the files that are laid out in their places.
    fn place(&self, files: &[ReportFile]) -> io::Result<Vec<[String; 2]>> {
        let moved = files.iter().filter_map(|file| self.move_aside(&file.name).transpose());
        let moved = moved.collect::<io::Result<Vec<_>>>()?;
        self.put_manifest()?;
        // While the others are replaced there is no result, rather than the old one among new files.
        if self.is_ours(RESULT) {
            fs::remove_file(self.path.join(RESULT))?;
        }
        let last = |file: &&ReportFile| file.name == RESULT;
        let put = |file: &ReportFile| fs::rename(self.temporary(&file.name), self.path.join(&file.name));
        files.iter().filter(|file| !last(file)).try_for_each(put)?;
        for name in self.manifest.replaced.keys().filter(|name| !self.manifest.files.contains_key(*name)) {
            if self.is_ours(name) {
                let _ = fs::remove_file(self.path.join(name));
                // Only where it is empty now.
                folder_of(name).map(|below| fs::remove_dir(self.path.join(below)));
            }
        }
        files.iter().filter(last).try_for_each(put)?;
        sync(&self.path);
        Ok(moved)
    }

    /// Moves what stands in the place of a file and is not the program's.
    fn move_aside(&self, name: &str) -> io::Result<Option<[String; 2]>> {
        let place = self.path.join(name);
        if fs::symlink_metadata(&place).is_err() || self.is_ours(name) {
            return Ok(None);
        }
        let free = (1..).map(|number| format!("{name}.{number}.kept")).find(|to| {
            let taken = fs::symlink_metadata(self.path.join(to));
            taken.is_err()
        });
        let to = free.unwrap_or_default();
        fs::rename(&place, self.path.join(&to))?;
        Ok(Some([name.to_string(), to]))
    }

    fn put_manifest(&self) -> io::Result<()> {
        let text = serde_json::to_string_pretty(&self.manifest).map_err(io::Error::other)? + "\n";
        let temporary = self.temporary(manifest::FILE);
        create(&temporary, text.as_bytes())?;
        fs::rename(temporary, self.path.join(manifest::FILE))?;
        self.laid.replace(text);
        Ok(())
    }

    /// Whether something else stands in the place of the manifest that was put there last.
    fn manifest_is_another(&self) -> bool {
        let place = self.path.join(manifest::FILE);
        let Ok(found) = fs::symlink_metadata(&place) else { return false };
        let laid = self.laid.borrow();
        let same = || fs::read(&place).is_ok_and(|bytes| bytes == laid.as_bytes());
        !(found.is_file() && found.len() == laid.len() as u64 && same())
    }

    /// Where a file is written before it takes its place.
    fn temporary(&self, name: &str) -> PathBuf {
        let place = self.path.join(name);
        let last = place.file_name().unwrap_or_default().to_string_lossy().into_owned();
        place.with_file_name(format!(".{last}.{}.tmp", std::process::id()))
    }

    /// Removes what programs that were killed while they wrote have left; with the lock held nobody else is writing.
    fn remove_leftovers(&self) {
        let below: BTreeSet<&Path> = self.manifest.names().filter_map(|name| folder_of(name)).collect();
        for folder in std::iter::once(Path::new("")).chain(below) {
            for entry in fs::read_dir(self.path.join(folder)).into_iter().flatten().flatten() {
                let name = entry.file_name().to_string_lossy().into_owned();
                let of = temporary_of(&name).map(|of| folder.join(of));
                let ours = |of: &Path| {
                    of == Path::new(manifest::FILE) || self.manifest.names().any(|known| Path::new(known) == of)
                };
                if of.is_some_and(|of| ours(&of)) {
                    let _ = fs::remove_file(entry.path());
                }
            }
        }
    }
}

impl Drop for Folder {
    /// A folder into which nothing came is left as it was.
    fn drop(&mut self) {
        // A recording that was brought stays its owner's until its report is made.
        let brought = self.brought && self.manifest.files.keys().eq([recording::FILE]);
        if self.lock.is_some() && (brought || self.manifest.files.is_empty() && self.others().is_empty()) {
            let _ = fs::remove_file(self.path.join(manifest::FILE));
        }
        self.lock = None;
        if !self.there_before {
            // Only if it is empty.
            let _ = fs::remove_dir(&self.path);
        }
    }
}

/// The folder `name` within `folder`; refused where it is a link that leads elsewhere, or no plain name.
pub fn inner(folder: &Path, name: &str) -> io::Result<PathBuf> {
    let inner = folder.join(name);
    if !is_plain(name) {
        return Err(io::Error::other(format!("{name:?} is no name for a folder")));
    }
    match fs::symlink_metadata(&inner) {
        Ok(found) if found.is_symlink() => {
            Err(io::Error::other(format!("{} is a link; a folder is wanted", inner.display())))
        }
        _ => Ok(inner),
    }
}

/// A name for a folder after what a design is called: letters, digits and a few marks, none that leads elsewhere.
pub fn folder_name(name: &str) -> String {
    const LONGEST: usize = 100;
    let plain = |letter: char| letter.is_alphanumeric() || " _-.()+,=&@".contains(letter);
    let named: String = name.chars().take(LONGEST).map(|letter| if plain(letter) { letter } else { '_' }).collect();
    let named = named.trim_matches(|letter: char| letter == '.' || letter == ' ');
    if named.is_empty() { "design".to_string() } else { named.to_string() }
}

/// Makes a new file, synced, in the place of what stands there, be it a link.
pub fn create(place: &Path, bytes: &[u8]) -> io::Result<()> {
    let _ = fs::remove_file(place);
    let mut file = File::create_new(place)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// Whether a regular file begins so.
fn starts_with(path: &Path, head: &[u8]) -> bool {
    let mut found = vec![0; head.len()];
    fs::symlink_metadata(path).is_ok_and(|found| found.is_file())
        && File::open(path).and_then(|mut file| file.read_exact(&mut found)).is_ok()
        && found == head
}

/// The folder below that a name lies in, if it does.
fn folder_of(name: &str) -> Option<&Path> {
    Path::new(name).parent().filter(|below| !below.as_os_str().is_empty())
}

/// Not every system lets a folder be synced.
fn sync(folder: &Path) {
    let _ = File::open(folder).and_then(|folder| folder.sync_all());
}

/// The name in `.name.process.tmp`.
fn temporary_of(name: &str) -> Option<&str> {
    let inside = name.strip_prefix('.')?.strip_suffix(".tmp")?;
    let (name, process) = inside.rsplit_once('.')?;
    process.parse::<u32>().is_ok().then_some(name)
}

/// SHA-256 of a regular file; nothing of anything else.
fn digest_in(path: &Path) -> Option<String> {
    fs::symlink_metadata(path).ok().filter(|found| found.is_file() && found.len() <= LARGEST)?;
    let mut file = File::open(path).ok()?;
    let mut hash = sha2::Sha256::new();
    let mut part = vec![0; 1 << 16];
    loop {
        match file.read(&mut part).ok()? {
            0 => return Some(hexadecimal(&hash.finalize())),
            count => hash.update(&part[..count]),
        }
    }
}

/// The place of a design file as seen from the folder, as a digest: the same when both are moved together.
fn place_beside(source: &Path, folder: &Path) -> Option<String> {
    let (source, folder) = (source.canonicalize().ok()?, folder.canonicalize().ok()?);
    let common = source.components().zip(folder.components()).take_while(|(one, other)| one == other).count();
    let down: PathBuf = source.components().skip(common).collect();
    let up = folder.components().count() - common;
    let mut place = format!("{up} up, then ").into_bytes();
    place.extend(down.as_os_str().as_encoded_bytes());
    Some(digest_of(&place)[..16].to_string())
}

/// A name for the folder or a file of something that goes by `name`, with a number behind it where that is taken.
pub fn free_name(name: &str, taken: &mut BTreeSet<String>) -> String {
    let name = folder_name(name);
    let numbered = (2..).map(|number| format!("{name}_{number}"));
    let free = std::iter::once(name.clone()).chain(numbered).find(|name| !taken.contains(name));
    let free = free.unwrap_or_default();
    taken.insert(free.clone());
    free
}

fn listed(names: &[String]) -> String {
    const MOST: usize = 4;
    let shown = names.iter().take(MOST).cloned().collect::<Vec<_>>().join(", ");
    match names.len().saturating_sub(MOST) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

#[cfg(test)]
#[path = "folder_tests.rs"]
mod tests;
