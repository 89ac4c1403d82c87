//! `barrier-check compare A B ...`: several designs on one page.

use std::path::{Path, PathBuf};

use crate::commands::ExitCode;
use crate::commands::Failure;
use crate::commands::check::{Options, can_print, load, simulate};
use crate::commands::output::{exit_code, put, tell_of_replaced, write_report};
use crate::commands::report::{kind_of, read_recording};
use crate::pipeline::Run;
use crate::report::compare::{PAGE_FILES, Variant, files};
use crate::report::folder::{Folder, OWN_NAMES, free_name};
use crate::report::kind::Kind;
use crate::terminal;

/// Runs every design, or takes up the recording where a folder of an earlier run is named; writes each report below `out` as soon as it is
/// there, so that one that is cut short keeps those before it, and the page that holds them side by side. Ends by the worst verdict.
pub fn compare(paths: &[PathBuf], out: &Path, options: Options) -> ExitCode {
    if let Err(code) = can_print(options.exports) {
        return code;
    }
    let mut variants = Vec::new();
    // What may lie in the folder of a page is no name for that of a report.
    let mut folders = PAGE_FILES.iter().chain(&OWN_NAMES).map(ToString::to_string).collect();
    // All are read before the first runs, so that nobody waits for an error.
    let sources: Vec<_> = paths.iter().map(|path| Source::read(path)).collect();
    let mut refused = false;
    for (path, source) in paths.iter().zip(&sources) {
        if let Err(error) = source {
            terminal::warn(format_args!("{}: {error}", path.display()));
            refused = true;
        }
    }
    if refused {
        return ExitCode::Undecided;
    }
    // Their folders too: no run whose report cannot be written.
    let sources: Vec<Source> = sources.into_iter().flatten().collect();
    let names: Vec<String> = sources.iter().map(|source| free_name(source.name(), &mut folders)).collect();
    if let Some(overwritten) = overwritten(paths, out, &names) {
        terminal::warn(format_args!(
            "error: {} would be replaced by the report of another: name another folder with --out",
            overwritten.display()
        ));
        return ExitCode::Undecided;
    }
    let claimed = Folder::claim_for(out, Kind::Comparison).and_then(|page| {
        let inner =
            |((name, source), path): ((&String, &Source), &PathBuf)| page.claim_inner(name, Some(path), source.kind());
        let reports = names.iter().zip(&sources).zip(paths).map(inner).collect::<Result<Vec<_>, _>>()?;
        Ok((page, reports))
    });
    let (mut page, mut reports) = match claimed {
        Ok(claimed) => claimed,
        Err(refusal) => {
            terminal::warn(format_args!("error: {refusal}"));
            return ExitCode::Undecided;
        }
    };
    tell_of_replaced(&page, Kind::Comparison);
    for (((path, source), folder), report) in paths.iter().zip(sources).zip(names).zip(&mut reports) {
        terminal::warn(format_args!("{} of {}: {}", variants.len() + 1, paths.len(), path.display()));
        let ran = source.run(options).and_then(|run| {
            // A page of before does not stand beside reports that are not its own.
            put(&mut page, &[])?;
            write_report(&run, report, options.exports)?;
            Ok(run)
        });
        match ran {
            Ok(run) => variants.push(Variant { folder, run }),
            Err(error) => {
                terminal::warn(format_args!("error: {error}"));
                return ExitCode::Undecided;
            }
        }
    }
    let page_files = files(&variants).map_err(|error| Failure::from(error.to_string()));
    if let Err(error) = page_files.and_then(|files| put(&mut page, &files)) {
        terminal::warn(format_args!("error: the comparison could not be written to {}: {error}", out.display()));
        return ExitCode::Undecided;
    }
    for Variant { run, .. } in &variants {
        terminal::say(format_args!("{:<9} {}", run.verdict.word().to_uppercase(), run.file.name));
    }
    terminal::say(format_args!("comparison: {}", out.join("compare.html").display()));
    variants.iter().map(|variant| exit_code(variant.run.verdict)).max().unwrap_or(ExitCode::Undecided)
}

/// A folder that is compared and that the report of another would be written into.
fn overwritten<'a>(paths: &'a [PathBuf], out: &Path, names: &[String]) -> Option<&'a PathBuf> {
    let targets: Vec<Option<PathBuf>> = names.iter().map(|name| out.join(name).canonicalize().ok()).collect();
    let of_another = |(own, path): &(usize, &PathBuf)| {
        let place = path.is_dir().then(|| path.canonicalize().ok()).flatten();
        place.is_some() && targets.iter().enumerate().any(|(other, target)| other != *own && *target == place)
    };
    paths.iter().enumerate().find(of_another).map(|(_, path)| path)
}

/// What a variant comes from.
enum Source {
    Design(Box<crate::design::read::DesignFile>),
    Recorded(Box<Run>),
}

impl Source {
    fn read(path: &Path) -> Result<Self, Failure> {
        if path.is_dir() {
            return Ok(Self::Recorded(Box::new(read_recording(path)?)));
        }
        load(path).map(|file| Self::Design(Box::new(file))).map_err(|problems| problems.to_string().into())
    }

    fn name(&self) -> &str {
        match self {
            Self::Design(file) => &file.name,
            Self::Recorded(run) => &run.file.name,
        }
    }

    fn kind(&self) -> Kind {
        match self {
            Self::Design(_) => Kind::Simulation,
            Self::Recorded(run) => kind_of(run),
        }
    }

    fn run(self, options: Options) -> Result<Run, Failure> {
        match self {
            Self::Design(file) => simulate(*file, options, None),
            Self::Recorded(run) => Ok(*run),
        }
    }
}
