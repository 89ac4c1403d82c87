//! `barrier-check study FILE`: many runs of a few scenes, kept so that only what changed runs again.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::commands::ExitCode;
use crate::commands::Failure;
use crate::commands::check::load;
use crate::commands::engines::{Engine, Mode};
use crate::commands::input::{self, LONGEST_TEXT};
use crate::commands::kept::KeptResults;
use crate::commands::output::{put, tell_of_replaced};
use crate::commands::reliability::reliability;
use crate::commands::signals::{listen, stop};
use crate::commands::size::size;
use crate::commands::steps::Steps;
use crate::commands::sweep::sweep;
use crate::design::read::DesignFile;
use crate::problem::Problems;
use crate::report::folder::{Folder, Named, Refusal, folder_name};
use crate::report::kind::Kind;
use crate::report::stability_map::files as map_files;
use crate::report::study::{Scene, files};
use crate::scene::event::RunControl;
use crate::simulated::RunError;
use crate::starts::side_by_side;
use crate::studies::knobs::Knob;
use crate::studies::plan::{Plan, StabilityPlan, Study};
use crate::studies::speed_accuracy::{Point, Setting, Task, make, tasks};
use crate::studies::stability::{Mapped, map};
use crate::studies::stability_scenes::SCENES;
use crate::terminal;

/// Runs what is not kept yet, and writes the page below `out`.
pub fn study(path: &Path, out: Option<&Path>, mode: &Mode) -> ExitCode {
    match run(path, out, mode) {
        Ok((page, code)) => {
            if let Some(page) = page {
                terminal::say(format_args!("study: {}", page.display()));
            }
            code
        }
        Err(error) => {
            match error.downcast_ref::<Problems>() {
                // Each of them says that it is an error.
                Some(problems) => terminal::warn(problems.to_string().trim_end()),
                None => terminal::warn(format_args!("error: {error}")),
            };
            ExitCode::Undecided
        }
    }
}

/// The page, and what the study ends with.
fn run(path: &Path, out: Option<&Path>, mode: &Mode) -> Result<(Option<PathBuf>, ExitCode), Failure> {
    let bytes = input::read(path, LONGEST_TEXT, b"").map_err(|error| format!("{}: {error}", path.display()))?;
    let text = String::from_utf8(bytes).map_err(|_| format!("{}: it is not text in UTF-8", path.display()))?;
    let beside = path.parent().unwrap_or(Path::new("."));
    let exists = |design: &Path| beside.join(design).is_file();
    let study = Study::read(&text, &exists).map_err(|list| Problems { file: path.display().to_string(), list })?;
    let place_of =
        |name: &str| out.map_or_else(|| Path::new("out").join("studies").join(folder_name(name)), PathBuf::from);
    let folder_of = |name: &str| {
        let named = if out.is_some() { Named::Explicitly } else { Named::ByDefault };
        let folder = Folder::claim(&place_of(name), Some(path), named)?.for_kind(Kind::Study)?;
        tell_of_replaced(&folder, Kind::Study);
        Ok::<_, Refusal>(folder)
    };
    if !matches!(study, Study::Sweep(_)) && *mode != Mode::On(Engine::Local) {
        return Err(
            "only the runs of a study of the kind sweep are known beforehand: the others decide on their next runs by the last ones, and run here"
                .into(),
        );
    }
    let page = |(page, code)| (Some(page), code);
    let plan = match study {
        Study::SpeedAccuracy(plan) => plan,
        Study::Stability(plan) => return Ok((Some(stability_map(&plan, folder_of(&plan.name)?)?), ExitCode::Pass)),
        Study::Size(plan) => return size(&plan, beside, folder_of(&plan.name)?).map(page),
        Study::Reliability(plan) => return reliability(&plan, beside, folder_of(&plan.name)?).map(page),
        Study::Sweep(plan) => {
            return sweep(&plan, path, &place_of(&plan.name), mode, || Ok(folder_of(&plan.name)?));
        }
    };
    let scenes = plan
        .scenes
        .iter()
        .map(|scene| load(&beside.join(scene)).map_err(|problems| format!("a scene cannot be read\n{problems}")));
    let scenes = scenes.collect::<Result<Vec<DesignFile>, String>>()?;
    let mut folder = folder_of(&plan.name)?;
    let kept = KeptResults::within(folder.path())?;
    let points = all_points(&tasks(&plan, &scenes), &scenes, &kept)?;
    put(&mut folder, &files(&plan.name, &gather(&plan, &scenes, points)).map_err(|error| error.to_string())?)?;
    Ok((Some(folder.path().join("study.html")), ExitCode::Pass))
}

/// Maps every scene that is not kept, side by side, and writes the page.
fn stability_map(plan: &StabilityPlan, mut folder: Folder) -> Result<PathBuf, Failure> {
    let kept = KeptResults::within(folder.path())?;
    let threads = rayon::current_num_threads();
    let mapped = side_by_side(threads, SCENES.len(), |index| -> Result<Mapped, String> {
        let scene = &SCENES[index];
        let asked = format!("{:?} {}", plan.shares, plan.steps);
        let of = [scene.name.as_bytes(), asked.as_bytes()];
        let limits = kept.get(&of).map_or_else(
            || {
                let limits = map(scene, &plan.shares, plan.steps);
                kept.put(&of, &limits).map(|()| limits).map_err(|error| error.to_string())
            },
            Ok,
        )?;
        Ok(Mapped::new(scene, limits))
    });
    let mapped = mapped.into_iter().collect::<Result<Vec<_>, _>>()?;
    put(&mut folder, &map_files(&plan.name, &mapped).map_err(|error| error.to_string())?)?;
    for scene in &mapped {
        let caught = if scene.all_caught() { "all caught" } else { "NOT ALL CAUGHT" };
        terminal::say(format_args!(
            "{:<22} estimate over true limit {:.2}: {}; {caught}",
            scene.name,
            scene.sharpness(),
            scene.word()
        ));
    }
    Ok(folder.path().join("stability.html"))
}

/// Every task with its result, kept or made; nothing where the scene cannot be prepared with that setting.
fn all_points(
    tasks: &[Task],
    scenes: &[DesignFile],
    kept: &KeptResults,
) -> Result<Vec<(Task, Option<Point>)>, Failure> {
    listen();
    let steps = Steps::begin(tasks.len());
    let found = AtomicUsize::new(0);
    let threads = rayon::current_num_threads();
    let results = side_by_side(threads, tasks.len(), |index| -> Result<Option<Point>, String> {
        let task = &tasks[index];
        let scene = &scenes[task.scene];
        let turned = format!("{:?} {}", task.setting, task.seed);
        let attached = scene.attached.values().map(Vec::as_slice);
        let of: Vec<&[u8]> = [&scene.text[..], turned.as_bytes()].into_iter().chain(attached).collect();
        if let Some(point) = kept.get(&of) {
            found.fetch_add(1, Ordering::Relaxed);
            steps.done("kept from before");
            return Ok(Some(point));
        }
        let what = format!("{}, {}", scene.name, task.setting.word());
        steps.next(&what);
        let watch = RunControl { progress: &|_| (), stop: stop(), store: None };
        let point = match make(task, &scene.design, &watch) {
            Ok(point) => point,
            Err(RunError::Preparation(_)) => return Ok(None),
            Err(error) => return Err(error.to_string()),
        };
        kept.put(&of, &point).map_err(|error| error.to_string())?;
        steps.done(&what);
        Ok(Some(point))
    });
    steps.end();
    terminal::warn(format_args!("{} runs, {} of them kept from before", tasks.len(), found.load(Ordering::Relaxed)));
    let points = results.into_iter().collect::<Result<Vec<_>, _>>()?;
    Ok(tasks.iter().cloned().zip(points).collect())
}

fn gather(plan: &Plan, files: &[DesignFile], points: Vec<(Task, Option<Point>)>) -> Vec<Scene> {
    let defaults = |file: &DesignFile| -> Vec<(Knob, f64)> {
        plan.knobs.keys().map(|knob| (*knob, knob.default_of(&file.design))).collect()
    };
    let mut scenes: Vec<Scene> = files
        .iter()
        .map(|file| Scene { name: file.name.clone(), defaults: defaults(file), runs: Vec::new() })
        .collect();
    for (task, point) in points {
        let runs: &mut Vec<(Setting, Vec<Point>)> = &mut scenes[task.scene].runs;
        match runs.iter_mut().find(|(setting, _)| *setting == task.setting) {
            Some((_, points)) => points.extend(point),
            None => runs.push((task.setting, point.into_iter().collect())),
        }
    }
    scenes
}
