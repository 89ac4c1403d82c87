//! What every command that ends in a report does with it: write it, tell of it, end by its verdict.

use std::path::Path;

use crate::commands::ExitCode;
use crate::commands::Failure;
use crate::commands::input::ATTACHED;
use crate::commands::messages::Format;
use crate::commands::printed::{self, Browser, Printing};
use crate::exports::Exports;
use crate::pipeline::{Run, Verdict};
use crate::report::folder::{Folder, ReportFile};
use crate::report::json::ResultFile;
use crate::report::kind::Kind;
use crate::report::recording;
use crate::report::render::render;
use crate::report::series;
use crate::report::view::View;
use crate::report::{drawing, vtk, workbook};
use crate::scene::ground::pieces;
use crate::terminal;

/// Time series of a simulation, in every report of one.
const HISTORIES: &str = "histories.csv";

/// Writes all files of the report into `folder`, with those for other programs that are asked for, and tells the verdict.
pub fn hand_over(run: &Run, folder: &mut Folder, exports: Exports, format: Format) -> ExitCode {
    let written = write_report(run, folder, exports);
    tell(run, folder, exports, format, written)
}

/// Tells the verdict of a report that has been written, or why there is none.
pub fn tell(run: &Run, folder: &Folder, exports: Exports, format: Format, written: Result<View, Failure>) -> ExitCode {
    match written {
        Err(error) => {
            terminal::warn(format_args!("error: {error}"));
            ExitCode::Undecided
        }
        Ok(view) => {
            format.tell_verdict(run, &view, folder.path(), exports);
            exit_code(run.verdict)
        }
    }
}

/// Writes all files of the report into `folder`; returns what they show.
pub fn write_report(run: &Run, folder: &mut Folder, exports: Exports) -> Result<View, Failure> {
    let printing = start_printing(exports)?;
    write_report_for(run, folder, exports, printing)
}

/// Starts the browser that prints, where that is asked for: it takes its time, in which the run is read and the report made.
pub fn start_printing(exports: Exports) -> Result<Option<Printing>, Failure> {
    Ok(exports.pdf.then(|| Browser::find()?.start()).transpose()?)
}

/// The same with a browser that has been started.
pub fn write_report_for(
    run: &Run,
    folder: &mut Folder,
    exports: Exports,
    printing: Option<Printing>,
) -> Result<View, Failure> {
    let mut view = View::of(run);
    if let Some(printing) = &printing {
        printing.print(for_paper(&mut view)?);
    }
    let files = files(run, &view, exports);
    // A report is not lost because it could not be printed as well.
    let printed = printing.map(Printing::take).transpose().unwrap_or_else(|error| {
        terminal::warn(format_args!(
            "warning: there is no {}: {error}; the rest of the report is written",
            printed::FILE
        ));
        None
    });
    let printed = printed.map(|pdf| ReportFile::new(printed::FILE, pdf));
    files.and_then(|files| put(folder, &files.into_iter().chain(printed).collect::<Vec<_>>())).map_err(|error| {
        Failure::from(format!("the report could not be written to {}: {error}", folder.path().display()))
    })?;
    Ok(view)
}

/// Writes files, and tells what of the user's they would have replaced.
pub fn put(folder: &mut Folder, files: &[ReportFile]) -> Result<(), Failure> {
    for [name, to] in folder.write(files)? {
        terminal::warn(format_args!(
            "note: {} was not written by this program; it is now {to}",
            folder.path().join(name).display()
        ));
    }
    Ok(())
}

/// Tells that a page which is made of many runs takes the place of another.
pub fn tell_of_replaced(folder: &Folder, kind: Kind) {
    if folder.holds_a_report() {
        terminal::warn(format_args!(
            "note: {} holds {} of before, whose place this one takes",
            folder.path().display(),
            kind.words()
        ));
    }
}

/// What the program ends with after a verdict.
pub fn exit_code(verdict: Verdict) -> ExitCode {
    match verdict {
        Verdict::Pass => ExitCode::Pass,
        Verdict::Fail => ExitCode::Fail,
        Verdict::Undecided => ExitCode::Undecided,
    }
}

/// The report as it is printed: without its replay, which no paper shows.
fn for_paper(view: &mut View) -> Result<String, Failure> {
    let replay = view.replay.take();
    let rendered = render(view).map_err(|error| error.to_string());
    view.replay = replay;
    Ok(rendered?.html)
}

fn files(run: &Run, view: &View, exports: Exports) -> Result<Vec<ReportFile>, Failure> {
    let rendered = render(view).map_err(|error| error.to_string())?;
    let mut files =
        vec![ReportFile::new("report.html", rendered.html), ReportFile::new("report.md", rendered.markdown)];
    if exports.xlsx {
        files.push(ReportFile::new(workbook::FILE, workbook::xlsx(run)?));
    }
    if exports.dxf {
        files.push(ReportFile::new(drawing::FILE, drawing::dxf(run)?));
    }
    files.extend(view.pictures().into_iter().map(|(name, text)| ReportFile::new(name, text)));
    if let Some(simulated) = &run.simulated {
        files.push(ReportFile::new(HISTORIES, series::csv(&simulated.histories)));
        files.push(ReportFile::new("histories.parquet", series::parquet(&simulated.histories)?));
    }
    if let Some(seen) = run.simulated.as_ref().filter(|_| exports.vtk) {
        let named = |file: ReportFile| ReportFile { name: format!("{}/{}", vtk::FOLDER, file.name), ..file };
        let film = &seen.histories.film;
        let ground = pieces(&run.file.design.channel, film.stretch());
        files.extend(vtk::files(film, &ground).into_iter().map(named));
    }
    files.push(ReportFile::new("design.yaml", run.file.text.clone()));
    for (name, bytes) in &run.file.attached {
        let name = Path::new(name).file_name().map(|name| format!("{ATTACHED}/{}", name.to_string_lossy()));
        files.extend(name.map(|name| ReportFile::new(name, bytes.clone())));
    }
    files.push(ReportFile::new(recording::FILE, recording::encode(run)?));
    files.push(ReportFile::new("result.json", serde_json::to_string_pretty(&ResultFile::of(run))? + "\n"));
    Ok(files)
}
