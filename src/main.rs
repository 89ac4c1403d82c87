//! Arguments → command → exit code: 0 pass, 1 a check fails, 2 cannot decide.

use std::path::PathBuf;
use std::process;
use std::time::Duration;

use barrier_check::commands::check::{MOST_STARTS, Options, check, dry_run, loads, resume};
use barrier_check::commands::compare::compare;
use barrier_check::commands::engines::{Engine, Mode};
use barrier_check::commands::explain::explain;
use barrier_check::commands::messages::Format;
use barrier_check::commands::misspelt::meant;
use barrier_check::commands::new::{Given, new};
use barrier_check::commands::progress::Audience;
use barrier_check::commands::report::report;
use barrier_check::commands::schema::SchemaOf;
use barrier_check::commands::serve::{self, serve};
use barrier_check::commands::study::study;
use barrier_check::commands::validate::{Selection, validate};
use barrier_check::exports::Exports;
use barrier_check::terminal;
use clap::{Args, CommandFactory, Parser, Subcommand};
use clap_complete::Shell;

/// Checks a debris-flow barrier: guideline loads, granular-flow simulation, limits, report.
#[derive(Parser)]
#[command(version, args_conflicts_with_subcommands = true, arg_required_else_help = true)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    check: CheckArguments,
}

#[derive(Args)]
struct CheckArguments {
    /// Design file in YAML, for example designs/small_net.yaml; - reads it from standard input
    #[arg(required = true)]
    design: Option<PathBuf>,
    /// Tells how many grains, steps, minutes and megabytes the run would take, and runs nothing
    #[arg(long)]
    dry_run: bool,
    /// Folder for the report [default: out/<name of the design file>]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    how: HowArguments,
    #[command(flatten)]
    keep: KeepArguments,
    /// How problems of the design and the verdict are printed
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    watched: WatchedArguments,
}

/// Whether another program runs this one.
#[derive(Args)]
struct WatchedArguments {
    /// For a program that runs this one: tells progress as lines of JSON on standard error, and stops the run, kept, when standard input ends
    #[arg(long)]
    watched: bool,
}

impl WatchedArguments {
    fn audience(&self) -> Audience {
        if self.watched { Audience::Program } else { Audience::Person }
    }
}

/// How a run is kept.
#[derive(Args)]
struct KeepArguments {
    /// Seconds between two times that a run is kept, so that `resume` can go on with it
    #[arg(long, value_name = "SECONDS", default_value_t = 30.0, value_parser = seconds)]
    keep_every: f64,
}

impl KeepArguments {
    fn every(&self) -> Duration {
        Duration::from_secs_f64(self.keep_every)
    }
}

fn seconds(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "a number of seconds is wanted".to_string())?;
    let sound = (0.0..=1e6).contains(&value);
    sound.then_some(value).ok_or_else(|| "from 0 to 1000000 seconds".to_string())
}

/// How to simulate.
#[derive(Args)]
struct HowArguments {
    /// Number of threads [default: all cores]; the result does not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Number of runs, each with another random packing of the grains: their scatter enters the verdict
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_STARTS)))]
    seeds: u32,
    /// Also simulates the design with each of its main inputs changed alone, down and up
    #[arg(long)]
    vary: bool,
    #[command(flatten)]
    exports: ExtraArguments,
}

/// What is written beside the report.
#[derive(Args)]
struct ExtraArguments {
    /// Also writes the course of the event for ParaView, into the folder `vtk` of the report
    #[arg(long)]
    vtk: bool,
    #[command(flatten)]
    office: OfficeArguments,
}

/// What is written for the programs of an office.
#[derive(Args)]
struct OfficeArguments {
    /// Also writes checks, load cases and time series for a spreadsheet program: tables.xlsx
    #[arg(long)]
    xlsx: bool,
    /// Also draws the barrier in its section and along the channel for a drawing program: drawing.dxf
    #[arg(long)]
    dxf: bool,
    /// Also prints the report with a browser of the Chromium family: report.pdf
    #[arg(long)]
    pdf: bool,
}

impl OfficeArguments {
    fn exports(&self, vtk: bool) -> Exports {
        Exports { vtk, xlsx: self.xlsx, dxf: self.dxf, pdf: self.pdf }
    }
}

impl HowArguments {
    fn options(&self, format: Format, audience: Audience) -> Options {
        let threads = self.threads.map(usize::from);
        Options {
            threads,
            starts: self.seeds,
            vary: self.vary,
            exports: self.exports.office.exports(self.exports.vtk),
            format,
            audience,
        }
    }
}

#[derive(Subcommand)]
enum Command {
    /// Checks a design by the equations alone, without the simulation
    Loads {
        /// Design file in YAML; - reads it from standard input
        design: PathBuf,
        /// Folder for the report [default: out/<name of the design file>_loads]
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
        #[command(flatten)]
        office: OfficeArguments,
        /// How problems of the design and the verdict are printed
        #[arg(long, value_enum, value_name = "FORMAT", default_value_t = Format::Text)]
        format: Format,
    },
    /// Writes a commented design that runs at once, from ten answers: asked for, or given as flags
    New(Box<NewArguments>),
    /// Holds several designs side by side on one page
    Compare {
        /// Design files, or folders of earlier runs; the first is what the others are compared with
        #[arg(required = true, num_args = 2.., value_name = "DESIGN")]
        designs: Vec<PathBuf>,
        /// Folder for the page and the reports
        #[arg(long, value_name = "DIR", default_value = "out/compare")]
        out: PathBuf,
        #[command(flatten)]
        how: HowArguments,
    },
    /// Tells what a check, a load case, a warning or a key of the design file is, with formula and source
    Explain {
        /// Id as in result.json, or a key or the end of its path; without it all ids are listed
        #[arg(conflicts_with = "all")]
        id: Option<String>,
        /// Prints everything as Markdown
        #[arg(long)]
        all: bool,
    },
    /// Makes the report of an earlier run again, without running it
    Report {
        /// Folder of the earlier run
        folder: PathBuf,
        #[command(flatten)]
        exports: ExtraArguments,
    },
    /// Goes on with a run that was interrupted: the result is that of a run that was not
    Resume {
        /// Folder of the report that was to be written
        folder: PathBuf,
        /// Number of threads [default: all cores]; the result does not depend on it
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
        threads: Option<u16>,
        #[command(flatten)]
        keep: KeepArguments,
        #[command(flatten)]
        watched: WatchedArguments,
    },
    /// Prints a script that completes commands and options in a shell
    Completions {
        /// Shell, for example bash: `source <(barrier-check completions bash)`
        shell: Shell,
    },
    /// Prints a JSON Schema
    Schema { of: SchemaOf },
    /// Serves a page to this machine's browser: designs to write, judged while they are typed, to simulate, and their reports
    Serve {
        /// Folder of the designs; reports go to its folder out
        #[arg(default_value = ".")]
        folder: PathBuf,
        /// Port on the loopback address [default: 8732, or one that is free]
        #[arg(long, value_name = "N")]
        port: Option<u16>,
        /// Opens no browser
        #[arg(long)]
        no_open: bool,
    },
    /// Makes many runs and what follows from them: a table over values of keys, the cheapest barrier that passes, the probability that it fails, what a choice of the model costs, where steps break
    Study {
        /// Study file in YAML, for example designs/studies/size_gully.yaml
        file: PathBuf,
        /// Folder for the page and what is kept [default: out/studies/<name>]
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
        #[command(flatten)]
        runs: RunsArguments,
    },
    /// Runs validation cases: scenes with known answers
    Validate(ValidateArguments),
}

#[derive(Args)]
struct NewArguments {
    /// Design file to be written, for example my_site.yaml; one that is there already is never replaced
    file: PathBuf,
    /// Name of the project
    #[arg(long)]
    project: Option<String>,
    /// net (of ropes), rings (a ring net) or wall (a gravity wall)
    #[arg(long)]
    barrier: Option<String>,
    /// Width of the bed, for example "6 m"
    #[arg(long)]
    width: Option<String>,
    /// vertical, an angle ("45 deg") or a ratio of rise to run ("1:1")
    #[arg(long)]
    banks: Option<String>,
    /// Slope of the bed, for example "20 deg"
    #[arg(long)]
    slope: Option<String>,
    /// Height of the barrier, for example "3 m"
    #[arg(long)]
    height: Option<String>,
    /// Volume of the event with pores, for example "50 m3"
    #[arg(long)]
    volume: Option<String>,
    /// Depth of the flow at the barrier, for example "0.8 m"
    #[arg(long)]
    depth: Option<String>,
    /// Velocity of the flow at the barrier, for example "4 m/s"
    #[arg(long)]
    velocity: Option<String>,
    /// Grain size which 90 % of the mass is finer than, for example "0.4 m"
    #[arg(long)]
    d90: Option<String>,
    /// Bulk density of the flow
    #[arg(long, default_value = "1800 kg/m3")]
    density: String,
    /// Set of partial factors: none, en_1997, onr_24810 or onr_24810_cc3
    #[arg(long, default_value = "en_1997")]
    factors: String,
    /// Kit that supplies the barrier, from the folder of the design, for example kits/ring_net_4m.yaml
    #[arg(long)]
    kit: Option<String>,
}

impl NewArguments {
    fn given(self) -> Given {
        let Self { file, project, barrier, width, banks, slope, height, volume, depth, velocity, d90, .. } = self;
        Given {
            file,
            answers: [project, barrier, width, banks, slope, height, volume, depth, velocity, d90],
            density: self.density,
            factors: self.factors,
            kit: self.kit,
        }
    }
}

/// What is done with the runs of a sweep.
#[derive(Args)]
struct RunsArguments {
    /// Where the runs of a sweep are made
    #[arg(long, value_enum, value_name = "ENGINE", default_value_t = Engine::Local, conflicts_with_all = ["list", "collect", "only"])]
    on: Engine,
    /// Prints a command for each run of a sweep that has not been made, for GNU parallel or anything else
    #[arg(long, conflicts_with_all = ["collect", "only"])]
    list: bool,
    /// Writes the page of the runs of a sweep that have been made
    #[arg(long, conflicts_with = "only")]
    collect: bool,
    /// Makes the runs of a sweep with these names, as --list prints them
    #[arg(long, value_name = "NAME", num_args = 1..)]
    only: Vec<String>,
}

impl RunsArguments {
    fn mode(self) -> Mode {
        match self {
            Self { list: true, .. } => Mode::List,
            Self { collect: true, .. } => Mode::Collect,
            Self { only, .. } if !only.is_empty() => Mode::Only(only),
            Self { on, .. } => Mode::On(on),
        }
    }
}

#[derive(Args)]
struct ValidateArguments {
    /// Suites (contact, bulk, wall, rope, dissipator, net, full-scale) or cases (A1, C5, ...) [default: all]
    names: Vec<String>,
    /// Only the cases that take seconds
    #[arg(long)]
    quick: bool,
    /// Folder for the report
    #[arg(long, value_name = "DIR", default_value = "out/validation")]
    out: PathBuf,
}

/// Bytes of stack that the program needs, whatever the shell allows the first thread.
const STACK: usize = 16 << 20;

fn main() {
    // A fault of the program's own, in whatever thread, is told like any other error.
    std::panic::set_hook(Box::new(|fault| {
        terminal::warn(format_args!(
            "error: the program has a fault of its own and cannot go on ({fault}); nothing that was written before is lost, and an interrupted run that is kept can be resumed. Please report this with the design file"
        ));
    }));
    // A file that grows beyond what the shell allows is an error like a full disk, not the end of the program.
    #[cfg(unix)]
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, std::sync::Arc::default());
    let ran = std::thread::Builder::new().stack_size(STACK).spawn(run).map(std::thread::JoinHandle::join);
    process::exit(match ran {
        Ok(Ok(code)) => code,
        // It has told of itself.
        Ok(Err(_)) => 2,
        Err(error) => {
            terminal::warn(format_args!("error: no thread could be started: {error}"));
            2
        }
    });
}

/// Prints what was asked for; the exit code.
fn print(text: String) -> i32 {
    if terminal::say(text.trim_end()) {
        0
    } else {
        terminal::warn("error: standard output could not be written to");
        2
    }
}

/// The exit code of a command whose answer is what it prints: nobody has it where that could not be written.
fn if_heard(code: i32) -> i32 {
    if code == 0 && !terminal::was_heard() { 2 } else { code }
}

/// The command that was given; its exit code.
fn run() -> i32 {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        // Help and version are what was asked for, the rest is an error.
        Err(told) if told.use_stderr() => {
            terminal::warn(told.render().to_string().trim_end());
            let command = Arguments::command();
            let names: Vec<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
            if let Some(hint) = meant(&names, &std::env::args().skip(1).collect::<Vec<_>>()) {
                terminal::warn(format_args!("hint: {hint}"));
            }
            return 2;
        }
        Err(told) => return if terminal::say(told.render().to_string().trim_end()) { 0 } else { 2 },
    };
    match arguments.command {
        Some(Command::Schema { of }) => print(format!("{:#}", of.schema())),
        Some(Command::Completions { shell }) => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Arguments::command(), "barrier-check", &mut script);
            print(String::from_utf8_lossy(&script).into_owned())
        }
        Some(Command::Loads { design, out, office, format }) => {
            loads(&design, out.as_deref(), office.exports(false), format) as i32
        }
        Some(Command::New(arguments)) => new(&arguments.given()) as i32,
        Some(Command::Compare { designs, out, how }) => {
            compare(&designs, &out, how.options(Format::Text, Audience::Person)) as i32
        }
        Some(Command::Explain { id, all }) => explain(id.as_deref(), all) as i32,
        Some(Command::Report { folder, exports }) => report(&folder, exports.office.exports(exports.vtk)) as i32,
        Some(Command::Resume { folder, threads, keep, watched }) => {
            resume(&folder, threads.map(usize::from), watched.audience(), keep.every()) as i32
        }
        Some(Command::Serve { folder, port, no_open }) => {
            serve(&serve::Options { folder, port, open: !no_open }) as i32
        }
        Some(Command::Study { file, out, runs }) => {
            let (mode, code) = (runs.mode(), |mode| study(&file, out.as_deref(), mode) as i32);
            if mode == Mode::List { if_heard(code(&mode)) } else { code(&mode) }
        }
        Some(Command::Validate(ValidateArguments { names, quick, out })) => {
            if_heard(validate(&Selection { names: &names, quick_only: quick }, &out) as i32)
        }
        None => {
            let CheckArguments { design, dry_run: only_tell, out, how, keep, format, watched } = arguments.check;
            let design = design.unwrap_or_default();
            let options = how.options(format, watched.audience());
            if watched.watched && design == std::path::Path::new("-") {
                terminal::warn(
                    "error: with --watched standard input is what stops the run: name the file of the design",
                );
                return 2;
            }
            match only_tell {
                true => if_heard(dry_run(&design, options) as i32),
                false => check(&design, out.as_deref(), options, keep.every()) as i32,
            }
        }
    }
}
