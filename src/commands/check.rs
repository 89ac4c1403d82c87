//! `barrier-check DESIGN`: from a design file to a report and an exit code.

use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::checkpoint::file::CheckpointError;
use crate::checkpoint::{self, CheckpointStore, Request};
use crate::commands::input;
use crate::commands::messages::Format;
use crate::commands::output::{exit_code, hand_over, write_report};
use crate::commands::printed::Browser;
use crate::commands::progress::{Audience, Progress, duration};
use crate::commands::signals::{listen, listen_to_whoever_started_it, stop};
use crate::commands::{ExitCode, Failure};
use crate::design::FidelityWish;
use crate::design::attached::within;
use crate::design::entries::Purpose;
use crate::design::read::{DesignFile, read_design_for, stem};
use crate::exports::Exports;
use crate::fidelity::choose;
use crate::flow_cases::cases;
use crate::pipeline::{Run, by_equations, climb, run, vary};
use crate::problem::{Problem, Problems};
use crate::report::folder::{Folder, Named, folder_name};
use crate::report::kind::Kind;
use crate::scene::estimate::{Estimate, estimate, slowness};
use crate::scene::event::{ProgressReport, RunControl};
use crate::sensitivity::simulated::variants;
use crate::simulated::RunError;
use crate::terminal;

/// Packings of a run at the most.
pub const MOST_STARTS: u32 = 1000;

/// How to run a design.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// All cores unless given.
    pub threads: Option<usize>,
    /// Number of packings.
    pub starts: u32,
    /// Whether to run the design again with its inputs changed.
    pub vary: bool,
    /// Files for other programs that are to be written.
    pub exports: Exports,
    pub format: Format,
    /// Whom progress is told.
    pub audience: Audience,
}

/// Runs one design and writes its report below `out`, or `out/<design name>` when none is given. The run is kept every so often, so
/// that it can be resumed.
pub fn check(path: &Path, out: Option<&Path>, options: Options, keep_every: Duration) -> ExitCode {
    if let Err(code) = can_print(options.exports) {
        return code;
    }
    let (file, folder) = match prepare(Purpose::Simulation, path, out, options.format) {
        Ok(prepared) => prepared,
        Err(code) => return code,
    };
    let place = folder.path().to_path_buf();
    tell_what_auto_leaves_out(&file, options);
    let Options { starts, vary, exports, .. } = options;
    let source = folder.source().map(str::to_string);
    let request = Request {
        name: file.name.clone(),
        design: file.text.clone(),
        attached: file.attached.clone(),
        source,
        starts,
        vary,
        exports,
    };
    let store = open_store(&place, request, &file, keep_every, true).watched(folder.watch());
    if let Ok(kept) = CheckpointStore::request_in(store.folder()) {
        if !store.is_of_the_same_file_as(&kept) {
            terminal::warn(format_args!(
                "error: in {} an interrupted run of another design file is kept ({}): go on with it (`barrier-check resume {}`), remove that folder, or name another with --out",
                store.folder().display(),
                kept.name,
                as_typed(&place)
            ));
            return ExitCode::Undecided;
        }
        terminal::warn(format_args!(
            "note: an interrupted run is kept in {}; this one begins anew and takes its place once it has been kept itself (`barrier-check resume {}` would go on with the one kept)",
            store.folder().display(),
            as_typed(&place)
        ));
    }
    run_kept(file, folder, options, &store)
}

/// The ladder chooses its packings itself, and what it settles without a simulation has none to vary.
fn tell_what_auto_leaves_out(file: &DesignFile, options: Options) {
    if file.design.simulation.fidelity != FidelityWish::Auto {
        return;
    }
    let left_out = [
        (options.starts > 1, "--seeds is not used: it chooses the number of runs itself"),
        (options.vary, "--vary is used only where a simulation runs"),
    ];
    for (_, what) in left_out.into_iter().filter(|(asked, _)| *asked) {
        terminal::warn(format_args!("note: the design asks for simulation.fidelity: auto, with which {what}"));
    }
}

/// Goes on with a run that was interrupted, whose report was to go to `folder`.
pub fn resume(folder: &Path, threads: Option<usize>, audience: Audience, keep_every: Duration) -> ExitCode {
    let claimed = match folder.is_dir().then(|| claim(folder)).transpose() {
        Ok(claimed) => claimed,
        Err(code) => return code,
    };
    let kept = folder.join(checkpoint::FOLDER);
    let request = match CheckpointStore::request_in(&kept) {
        Ok(request) => request,
        Err(CheckpointError::Missing) => {
            terminal::warn(format_args!("error: {}: no interrupted run is kept there", folder.display()));
            return ExitCode::Undecided;
        }
        Err(error) => {
            terminal::warn(format_args!(
                "error: the run kept in {} cannot be resumed: {error}. Run the design again",
                kept.display()
            ));
            return ExitCode::Undecided;
        }
    };
    let name = format!("{}.yaml", request.name);
    let file = match read_design_for(Purpose::Simulation, &name, &request.design, &within(&request.attached)) {
        Ok(file) => file,
        Err(problems) => {
            terminal::warn(problems.to_string().trim_end());
            return ExitCode::Undecided;
        }
    };
    let Some(mut claimed) = claimed else { return ExitCode::Undecided };
    claimed.go_on_with(request.source.clone());
    if !(1..=MOST_STARTS).contains(&request.starts) {
        terminal::warn(format_args!("error: the run kept in {} asks for {} runs", kept.display(), request.starts));
        return ExitCode::Undecided;
    }
    let Request { starts, vary, exports, .. } = request;
    let store = open_store(folder, request, &file, keep_every, false).watched(claimed.watch());
    run_kept(file, claimed, Options { threads, starts, vary, exports, format: Format::Text, audience }, &store)
}

fn open_store(
    folder: &Path,
    request: Request,
    file: &DesignFile,
    keep_every: Duration,
    fresh: bool,
) -> CheckpointStore {
    let several = request.starts > 1
        || request.vary
        || file.design.simulation.fidelity == FidelityWish::Auto
        || cases(&file.design).len() > 1;
    let reported = folder.join("result.json").exists();
    CheckpointStore::new(folder.join(checkpoint::FOLDER), request, keep_every, several || reported, fresh)
}

/// Runs a design whose simulations are kept in `store`, and writes its report into `folder`.
fn run_kept(file: DesignFile, mut folder: Folder, options: Options, store: &CheckpointStore) -> ExitCode {
    let ran = simulate(file, options, Some(store));
    match ran.and_then(|run| Ok((write_report(&run, &mut folder, options.exports)?, run))) {
        Ok((view, run)) => {
            store.clear();
            options.format.tell_verdict(&run, &view, folder.path(), options.exports);
            exit_code(run.verdict)
        }
        Err(error) => {
            terminal::warn(format_args!("error: {error}"));
            if store.still_holds_the_one_before() {
                terminal::warn(format_args!(
                    "note: this run was too short to take the place of the one that was kept before: `barrier-check resume {}` goes on with that one",
                    as_typed(folder.path())
                ));
            } else if store.can_be_resumed() {
                terminal::warn(format_args!(
                    "note: `barrier-check resume {}` goes on where the run was kept last",
                    as_typed(folder.path())
                ));
            } else if matches!(error.downcast_ref(), Some(RunError::Interrupted)) {
                terminal::warn(format_args!(
                    "note: nothing of this run has been kept yet: run it again from the start"
                ));
            }
            tell_of_earlier_run(folder.path());
            ExitCode::Undecided
        }
    }
}

/// A path as it is typed after a command: quoted where a shell would take it apart, and never like an option.
fn as_typed(path: &Path) -> String {
    let text = path.display().to_string();
    let text = if text.starts_with('-') { format!("./{text}") } else { text };
    let plain = |letter: char| letter.is_alphanumeric() || "/._-+,=@:".contains(letter);
    if text.chars().all(plain) { text } else { format!("'{}'", text.replace('\'', "'\\''")) }
}

/// Tells what a run of the design would take, without running it.
pub fn dry_run(path: &Path, options: Options) -> ExitCode {
    let file = match load(path) {
        Ok(file) => file,
        Err(problems) => {
            options.format.tell_problems(&problems);
            return ExitCode::Undecided;
        }
    };
    let fidelity = choose(&file.design);
    let estimate = estimate(&file.design, &fidelity);
    let Estimate { grains, spheres, elements, simulated, steps, seconds, bytes } = estimate;
    let seconds = seconds * slowness();
    let cores = options.threads.or_else(|| std::thread::available_parallelism().ok().map(usize::from)).unwrap_or(1);
    let cases = cases(&file.design).len();
    tell_what_auto_leaves_out(&file, options);
    let auto = file.design.simulation.fidelity == FidelityWish::Auto;
    let starts = if auto { 1 } else { options.starts as usize } * cases;
    let varied = if options.vary { 2 * variants(&file.design).len() } else { 0 };
    let runs = starts + varied;
    if options.format == Format::Json {
        Format::tell_estimate(&file.name, &estimate, runs, seconds);
        return decided(&estimate);
    }
    let say = |line: String| {
        let _ = terminal::say(line);
    };
    say(format!("grains            {grains:.0} of {spheres:.0} spheres"));
    say(format!("barrier           {elements:.0} elements"));
    say(format!("event             about {simulated:.1} s in {steps:.0} steps of {:.2e} s", fidelity.time_step));
    if runs > 1 {
        let flows = if cases > 1 { ", the flow as it is and with the partial factor on loads" } else { "" };
        let inputs = if varied > 0 { format!(", {varied} with one input changed") } else { String::new() };
        say(format!("simulations       {runs}: {} initial packings{flows}{inputs}", options.starts));
    }
    let time = duration(seconds * runs as f64);
    say(format!("time              about {time} on one core, to a factor of two"));
    if cores > 1 {
        // One simulation shares its work out worse than several that run side by side.
        let gain = if runs > 1 { cores.min(runs) as f64 } else { 0.8 * cores as f64 };
        say(format!("                  about {} on {cores} cores", duration(seconds * runs as f64 / gain)));
    }
    say(format!("memory            about {:.0} MB for each simulation", bytes / 1e6));
    if file.design.simulation.fidelity == FidelityWish::Auto {
        let most = "this is one run; a marginal design takes up to eleven, five of them with the finest model";
        say(format!("fidelity: auto    {most}"));
    }
    decided(&estimate)
}

/// How a program ends that was asked what a run would take.
fn decided(estimate: &Estimate) -> ExitCode {
    match estimate.too_much() {
        Some(reason) => {
            terminal::warn(format_args!("error: this design is not run: {reason}"));
            ExitCode::Undecided
        }
        None => ExitCode::Pass,
    }
}

/// Checks one design by the equations alone; the report goes to `out` or `out/<design name>_loads`.
pub fn loads(path: &Path, out: Option<&Path>, exports: Exports, format: Format) -> ExitCode {
    if let Err(code) = can_print(exports) {
        return code;
    }
    let (file, mut folder) = match prepare(Purpose::Equations, path, out, format) {
        Ok(prepared) => prepared,
        Err(code) => return code,
    };
    hand_over(&by_equations(file), &mut folder, exports, format)
}

/// Whether there is what prints, where that is asked for: nobody is to wait for a run whose report cannot be written.
pub fn can_print(exports: Exports) -> Result<(), ExitCode> {
    match exports.pdf.then(Browser::find).transpose() {
        Ok(_) => Ok(()),
        Err(error) => {
            terminal::warn(format_args!("error: {error}"));
            Err(ExitCode::Undecided)
        }
    }
}

/// The design, and the folder its report goes to.
fn prepare(
    purpose: Purpose,
    path: &Path,
    out: Option<&Path>,
    format: Format,
) -> Result<(DesignFile, Folder), ExitCode> {
    let (suffix, kind) = match purpose {
        Purpose::Simulation => ("", Kind::Simulation),
        Purpose::Equations => ("_loads", Kind::Equations),
    };
    let folder_of = |name: &str| out.map_or_else(|| Path::new("out").join(folder_name(name) + suffix), PathBuf::from);
    match load_for(purpose, path) {
        Ok(file) => {
            let named = if out.is_some() { Named::Explicitly } else { Named::ByDefault };
            let folder =
                Folder::claim(&folder_of(&file.name), Some(path), named).and_then(|folder| folder.for_kind(kind));
            let folder = folder.map_err(|refusal| {
                format.tell_refusal(&file.name, &refusal);
                ExitCode::Undecided
            })?;
            if folder.holds_anothers_report() {
                terminal::warn(format_args!(
                    "note: {} holds the report of another design file, whose place this one takes",
                    folder.path().display()
                ));
            }
            Ok((file, folder))
        }
        Err(problems) => {
            format.tell_problems(&problems);
            tell_of_earlier_run(&folder_of(&stem(&problems.file)));
            Err(ExitCode::Undecided)
        }
    }
}

/// Takes the folder of a run that is kept, before it goes on, so that nobody waits for what cannot be kept.
fn claim(folder: &Path) -> Result<Folder, ExitCode> {
    let claimed = Folder::claim(folder, None, Named::Explicitly);
    claimed.and_then(|folder| folder.for_kind(Kind::Simulation)).map_err(|refusal| {
        terminal::warn(format_args!("error: {refusal}"));
        ExitCode::Undecided
    })
}

/// Warns of a report that does not belong to this run.
fn tell_of_earlier_run(folder: &Path) {
    if folder.join("result.json").exists() {
        terminal::warn(format_args!("note: {} still holds the report of an earlier run", folder.display()));
    }
}

/// Reads and checks a design file that is to be simulated.
pub fn load(path: &Path) -> Result<DesignFile, Problems> {
    load_for(Purpose::Simulation, path)
}

/// The same for a purpose.
fn load_for(purpose: Purpose, path: &Path) -> Result<DesignFile, Problems> {
    let name = input::name_of(path);
    match input::read_text(path) {
        Ok(bytes) => read_design_for(purpose, &name, &bytes, &|other| input::beside(path, other)),
        Err(error) => {
            let problem = Problem::new("", format!("a file that cannot be read: {error}"), "a design file in YAML")
                .hint("the examples are in the folder `designs`");
            Err(Problems { file: name, list: vec![problem] })
        }
    }
}

/// Runs inside a pool of its own, so that no step has to enter one; shows progress.
pub fn simulate(file: DesignFile, options: Options, store: Option<&CheckpointStore>) -> Result<Run, Failure> {
    listen();
    if options.audience == Audience::Program {
        listen_to_whoever_started_it();
    }
    let progress = Progress::begin(options.audience);
    let show = |report: ProgressReport| progress.show(&report);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.threads.unwrap_or(0))
        .build()
        .map_err(|error| format!("the threads could not be started ({error}): ask for fewer with --threads"))?;
    let watch = RunControl { progress: &show, stop: stop(), store };
    let result = pool.install(|| {
        let mut result = match file.design.simulation.fidelity {
            FidelityWish::Auto => climb(file, options.starts, &watch)?,
            _ => run(file, options.starts, &watch)?,
        };
        if options.vary {
            vary(&mut result, &watch)?;
        }
        Ok(result)
    });
    progress.end();
    result.map_err(|error: RunError| error.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_told_as_a_shell_takes_it() {
        let typed = |path: &str| as_typed(Path::new(path));
        assert_eq!(typed("out/net_2"), "out/net_2");
        assert_eq!(typed("out/my net"), "'out/my net'");
        assert_eq!(typed("out/Smith's"), "'out/Smith'\\''s'");
        assert_eq!(typed("-o"), "./-o");
    }
}
