//! Runs that were begun from the page, each a process of its own: one that breaks takes nothing else with it, and one whose server is gone keeps
//! what it has come to and ends. And the runs that lie in the folder `out`, whoever made them.

use std::collections::BTreeMap;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use std::{fs, thread};

use serde::{Deserialize, Serialize};

use super::answer::Refused;
use crate::checkpoint;
use crate::commands::input;
use crate::commands::progress::Line;
use crate::report::folder::{folder_name, inner};
use crate::report::glimpse::Picture;
use crate::report::manifest::{self, Manifest};

/// Where reports go, below the folder that is served.
pub const OUT: &str = "out";
/// Runs side by side at the most: each uses all cores.
const MOST_AT_ONCE: usize = 2;
/// Bytes of a line that a run tells at the most.
const LONGEST_LINE: u64 = 1 << 20;
/// Pictures kept of a run at the most; of more, every other one goes.
const MOST_PICTURES: usize = 200;
/// Points of the force so far at the most.
const MOST_POINTS: usize = 2000;
/// Bytes of a result.json at the most.
const LONGEST_RESULT: u64 = 8 << 20;
/// Bytes of a file of a report that is handed out at the most.
const LONGEST_FILE: u64 = 64 << 20;

pub struct Runs {
    root: PathBuf,
    under_way: Mutex<BTreeMap<String, Arc<Mutex<UnderWay>>>>,
}

/// A run of this server, under way or over.
struct UnderWay {
    began: Instant,
    /// What stops it when it is closed; nothing once it is stopped.
    stdin: Option<ChildStdin>,
    told: Option<Line>,
    /// Simulated time (s) and force (N) of the first simulation.
    force: Vec<[f64; 2]>,
    /// By their numbers, which only grow.
    pictures: Vec<(usize, Picture)>,
    next_picture: usize,
    messages: Vec<String>,
    stopped: bool,
    /// Exit code, once it has ended; -1 where it was killed.
    ended: Option<i32>,
}

/// A folder of `out`.
#[derive(Debug, Serialize)]
pub struct Listed {
    folder: String,
    /// Name of the design, where a report says it.
    title: String,
    /// Files of the report that other programs open.
    files: Vec<&'static str>,
    /// running, kept (interrupted, can be resumed) or done
    state: &'static str,
    verdict: String,
    /// The page of the report, where there is one.
    page: Option<String>,
    /// When the report was written (s since 1970).
    written: u64,
}

/// How far a run has come.
#[derive(Debug, Serialize)]
pub struct Progress {
    state: &'static str,
    /// Since it began (s).
    taken: f64,
    told: Option<Line>,
    force: Vec<[f64; 2]>,
    /// Those that the page does not have yet.
    pictures: Vec<(usize, Picture)>,
    messages: Vec<String>,
    stopped: bool,
    /// Whether there is something to go on with.
    kept: bool,
    exit_code: Option<i32>,
    page: Option<String>,
}

/// How to run a design.
#[derive(Clone, Copy, Debug)]
pub struct How {
    pub seeds: u32,
}

impl Runs {
    pub fn new(root: &Path) -> Self {
        Self { root: root.to_path_buf(), under_way: Mutex::default() }
    }

    /// Begins to run a design; the folder of its report. The report of another text of it is not replaced.
    pub fn begin(&self, design: &str, digest: &str, how: How) -> Result<String, Refused> {
        let stem = Path::new(design).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let name = folder_name(&stem);
        let numbered = (2..).map(|number| format!("{name}_{number}"));
        let mut folders = std::iter::once(name.clone()).chain(numbered);
        let folder = folders.find(|folder| self.takes(folder, digest)).unwrap_or(name);
        self.place(&folder)?;
        let design = format!("./{design}");
        let seeds = how.seeds.to_string();
        self.start(
            &folder,
            &[&design, "--out", &format!("{OUT}/{folder}"), "--seeds", &seeds, "--xlsx", "--dxf", "--watched"],
        )?;
        Ok(folder)
    }

    /// Whether a run of a text may go into a folder: into one that has no report, or one of the same text.
    fn takes(&self, folder: &str, digest: &str) -> bool {
        let place = self.root.join(OUT).join(folder);
        let kept = place.join(checkpoint::FOLDER).join(checkpoint::REQUEST).is_file();
        match of_the_result(&place) {
            Some(result) => result.digest == digest && !kept,
            None => !kept && page_of(&place).is_none(),
        }
    }

    /// Goes on with a run that was interrupted.
    pub fn resume(&self, folder: &str) -> Result<(), Refused> {
        self.folder(folder)?;
        self.start(folder, &["resume", &format!("{OUT}/{folder}"), "--watched"])
    }

    /// Stops a run; it is kept.
    pub fn stop(&self, folder: &str) -> Result<(), Refused> {
        let run = self.of_this_server(folder).ok_or_else(|| Refused::missing(format_args!("a run of {folder}")))?;
        let mut run = held(&run);
        run.stdin = None;
        run.stopped = true;
        Ok(())
    }

    /// Stops all runs and waits until they are kept.
    pub fn stop_all(&self, at_most: Duration) {
        let runs: Vec<_> = held(&self.under_way).values().cloned().collect();
        runs.iter().for_each(|run| held(run).stdin = None);
        let began = Instant::now();
        while began.elapsed() < at_most && runs.iter().any(|run| held(run).ended.is_none()) {
            thread::sleep(Duration::from_millis(20));
        }
    }

    fn start(&self, folder: &str, arguments: &[&str]) -> Result<(), Refused> {
        let mut under_way = held(&self.under_way);
        let running = |run: &Arc<Mutex<UnderWay>>| held(run).ended.is_none();
        if under_way.get(folder).is_some_and(running) {
            return Err(Refused::conflict(format!("a run into {OUT}/{folder} is under way: wait for it, or stop it")));
        }
        if under_way.values().filter(|run| running(run)).count() >= MOST_AT_ONCE {
            return Err(Refused::conflict(format!(
                "{MOST_AT_ONCE} runs are under way, and each uses all cores: wait for one, or stop it"
            )));
        }
        let mut child = self.command(arguments).and_then(|mut command| command.spawn()).map_err(Refused::failed)?;
        let run = Arc::new(Mutex::new(UnderWay::of(&mut child)));
        under_way.insert(folder.to_string(), Arc::clone(&run));
        follow(child, &run);
        Ok(())
    }

    fn command(&self, arguments: &[&str]) -> io::Result<Command> {
        let mut command = Command::new(std::env::current_exe()?);
        command.args(arguments).current_dir(&self.root);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        Ok(command)
    }

    /// Holds two reports side by side; the path of the page.
    pub fn compare(&self, folders: &[String; 2]) -> Result<String, Refused> {
        let [a, b] = folders;
        self.folder(a)?;
        self.folder(b)?;
        let name = folder_name(&format!("compare {a} and {b}"));
        self.place(&name)?;
        let [one, other, out] = [a, b, &name].map(|folder| format!("{OUT}/{folder}"));
        let arguments = ["compare", &one, &other, "--out", &out];
        let output = self.command(&arguments).and_then(|mut command| command.stdin(Stdio::null()).output());
        let output = output.map_err(Refused::failed)?;
        let page = format!("{name}/compare.html");
        // It tells a line of each design on standard output; an error has none there.
        match !output.stdout.is_empty() && self.root.join(OUT).join(&page).is_file() {
            true => Ok(page),
            false => Err(Refused::bad(String::from_utf8_lossy(&output.stderr).trim().to_string())),
        }
    }

    fn of_this_server(&self, folder: &str) -> Option<Arc<Mutex<UnderWay>>> {
        held(&self.under_way).get(folder).cloned()
    }

    /// A folder of `out` that is there.
    fn folder(&self, name: &str) -> Result<PathBuf, Refused> {
        let place = self.place(name)?;
        if place.is_dir() { Ok(place) } else { Err(Refused::missing("this report")) }
    }

    /// Where a folder of `out` is, or is to be: nowhere else, whatever links there are.
    fn place(&self, name: &str) -> Result<PathBuf, Refused> {
        let out = self.root.join(OUT);
        let place = out.join(name);
        let is_a_link = |place: &Path| fs::symlink_metadata(place).is_ok_and(|found| found.is_symlink());
        // A name with a stroke at its end would be followed through a link.
        let plain = folder_name(name) == name && !name.contains(['/', '\\']);
        if !plain || is_a_link(&out) || is_a_link(&place) {
            return Err(Refused::bad(format!(
                "{OUT}/{} is no folder for a report: a link, or no plain name",
                crate::problem::harmless(name)
            )));
        }
        Ok(place)
    }

    /// All reports and interrupted runs, the newest first.
    pub fn list(&self) -> Vec<Listed> {
        let out = self.root.join(OUT);
        let is_a_link = fs::symlink_metadata(&out).is_ok_and(|found| found.is_symlink());
        let entries = fs::read_dir(out).ok().filter(|_| !is_a_link).into_iter().flatten().flatten();
        let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
        let mut listed: Vec<Listed> = names.filter_map(|name| self.listed(&name)).collect();
        listed.sort_by(|a, b| b.written.cmp(&a.written).then_with(|| a.folder.cmp(&b.folder)));
        listed
    }

    fn listed(&self, name: &str) -> Option<Listed> {
        let folder = self.folder(name).ok()?;
        let running = self.of_this_server(name).is_some_and(|run| held(&run).ended.is_none());
        let kept = folder.join(checkpoint::FOLDER).join(checkpoint::REQUEST).is_file();
        let page = page_of(&folder);
        let written = |page: &str| {
            let changed = fs::metadata(folder.join(page)).and_then(|found| found.modified()).ok()?;
            Some(changed.duration_since(std::time::UNIX_EPOCH).ok()?.as_secs())
        };
        let written = page.and_then(written).unwrap_or(u64::MAX);
        let state = match (running, kept, page) {
            (true, ..) => "running",
            (_, true, _) => "kept",
            (_, _, Some(_)) => "done",
            // Nothing of this program's.
            _ => return None,
        };
        let Of { title, verdict, .. } = of_the_result(&folder).unwrap_or_default();
        let files = FOR_OTHERS.into_iter().filter(|file| folder.join(file).is_file()).collect();
        Some(Listed { folder: name.to_string(), title, files, state, verdict, page: page.map(String::from), written })
    }

    /// How far a run of this server has come; `after` is the number of the last picture that the page has.
    pub fn progress(&self, folder: &str, after: usize) -> Result<Progress, Refused> {
        let run = self.of_this_server(folder).ok_or_else(|| Refused::missing(format_args!("a run of {folder}")))?;
        let run = held(&run);
        let place = self.root.join(OUT).join(folder);
        let page = run.ended.and_then(|_| page_of(&place)).filter(|_| !run.stopped || run.ended == Some(0));
        Ok(Progress {
            state: if run.ended.is_none() { "running" } else { "ended" },
            taken: run.began.elapsed().as_secs_f64(),
            told: run.told.clone().map(|told| Line { picture: None, ..told }),
            force: run.force.clone(),
            pictures: run.pictures.iter().filter(|(number, _)| *number > after).cloned().collect(),
            messages: run.messages.clone(),
            stopped: run.stopped,
            kept: place.join(checkpoint::FOLDER).join(checkpoint::REQUEST).is_file(),
            exit_code: run.ended,
            page: page.map(String::from),
        })
    }

    /// A file of a report, or of one of those that a comparison holds: one that the program has written there.
    pub fn file(&self, folder: &str, name: &str) -> Result<Vec<u8>, Refused> {
        let place = self.folder(folder)?;
        file_in(&place, name).or_else(|missing| {
            let (below, name) = name.split_once('/').ok_or(missing)?;
            let place = inner(&place, below).map_err(|_| Refused::missing("this file of the report"))?;
            file_in(&place, name)
        })
    }
}

/// A file that the program has written into a folder.
fn file_in(place: &Path, name: &str) -> Result<Vec<u8>, Refused> {
    let missing = || Refused::missing("this file of the report");
    let manifest = input::read(&place.join(manifest::FILE), LONGEST_FILE, b"").map_err(|_| missing())?;
    let manifest = Manifest::read(&manifest).ok_or_else(missing)?;
    if !manifest.names().any(|known| known == name) {
        return Err(missing());
    }
    let file = place.join(name);
    // A link that somebody has put in the place of a file or of a folder of the report leads elsewhere.
    let real = file.canonicalize().ok().filter(|real| real.starts_with(place)).ok_or_else(missing)?;
    input::read(&real, LONGEST_FILE, b"").map_err(|_| missing())
}

/// What a folder of `out` shows first, where it shows anything.
fn page_of(folder: &Path) -> Option<&'static str> {
    ["report.html", "compare.html", "size.html", "reliability.html", "sweep.html", "study.html"]
        .into_iter()
        .find(|page| folder.join(page).is_file())
}

/// What the page offers beside a report.
const FOR_OTHERS: [&str; 6] =
    ["tables.xlsx", "drawing.dxf", "report.pdf", "histories.csv", "result.json", "design.yaml"];

/// What a report is of.
#[derive(Default)]
struct Of {
    title: String,
    /// SHA-256 of the design.
    digest: String,
    verdict: String,
}

fn of_the_result(folder: &Path) -> Option<Of> {
    /// What of it is looked at; the rest is not kept.
    #[derive(Deserialize)]
    struct Told {
        design: Design,
        verdict: String,
    }
    #[derive(Deserialize)]
    struct Design {
        name: String,
        sha256: String,
    }
    let bytes = input::read(&folder.join("result.json"), LONGEST_RESULT, b"").ok()?;
    let Told { design, verdict } = serde_json::from_slice(&bytes).ok()?;
    Some(Of { title: design.name, digest: design.sha256, verdict })
}

impl UnderWay {
    fn of(child: &mut Child) -> Self {
        Self {
            began: Instant::now(),
            stdin: child.stdin.take(),
            told: None,
            force: Vec::new(),
            pictures: Vec::new(),
            next_picture: 1,
            messages: Vec::new(),
            stopped: false,
            ended: None,
        }
    }

    /// Takes in a line that the run has told.
    fn take(&mut self, line: &str) {
        let Ok(mut told) = serde_json::from_str::<Line>(line) else {
            self.messages.push(line.to_string());
            return;
        };
        if let Some(peak) = told.peak {
            if self.force.last().is_some_and(|[time, _]| peak[0] < *time) {
                // Another step of the ladder begins anew.
                self.force.clear();
                self.pictures.clear();
            }
            self.force.push(peak);
            if self.force.len() > MOST_POINTS {
                // Of two the larger stays, so that no peak is lost.
                self.force = self.force.chunks(2).filter_map(larger).collect();
            }
        }
        if let Some(picture) = told.picture.take() {
            self.pictures.push((self.next_picture, picture));
            self.next_picture += 1;
            thin(&mut self.pictures, MOST_PICTURES);
        }
        self.told = Some(told);
    }
}

/// The moment with the larger force.
fn larger(moments: &[[f64; 2]]) -> Option<[f64; 2]> {
    moments.iter().copied().max_by(|[_, a], [_, b]| a.total_cmp(b))
}

/// Leaves out every other one but the last of more than `most`.
fn thin<T>(list: &mut Vec<T>, most: usize) {
    if list.len() > most {
        let mut place = list.len();
        list.retain(|_| {
            place -= 1;
            place.is_multiple_of(2)
        });
    }
}

/// Reads what a run tells until it ends.
fn follow(mut child: Child, run: &Arc<Mutex<UnderWay>>) {
    let streams: [Option<Box<dyn Read + Send>>; 2] = [
        child.stderr.take().map(|stream| Box::new(stream) as Box<dyn Read + Send>),
        child.stdout.take().map(|stream| Box::new(stream) as Box<dyn Read + Send>),
    ];
    let readers: Vec<_> = streams
        .into_iter()
        .flatten()
        .map(|stream| {
            let run = Arc::clone(run);
            thread::spawn(move || each_line(stream, |line| held(&run).take(line)))
        })
        .collect();
    let run = Arc::clone(run);
    thread::spawn(move || {
        readers.into_iter().for_each(|reader| {
            let _ = reader.join();
        });
        let code = child.wait().ok().and_then(|status| status.code()).unwrap_or(-1);
        let mut run = held(&run);
        run.stdin = None;
        run.ended = Some(code);
    });
}

fn each_line(stream: impl Read, mut take: impl FnMut(&str)) {
    let mut stream = BufReader::new(stream);
    let mut line = Vec::new();
    // A line without an end is read in pieces.
    while stream.by_ref().take(LONGEST_LINE).read_until(b'\n', &mut line).is_ok_and(|read| read > 0) {
        take(String::from_utf8_lossy(&line).trim_end());
        line.clear();
    }
}

/// What a fault of another thread has left is read all the same.
fn held<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_many_every_other_one_stays_and_the_last() {
        let mut list: Vec<usize> = (0..11).collect();
        thin(&mut list, 10);
        assert_eq!(list, [0, 2, 4, 6, 8, 10]);
        thin(&mut list, 10);
        assert_eq!(list.len(), 6);
    }
}
