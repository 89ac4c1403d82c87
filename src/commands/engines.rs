//! Where the runs of a study are made: by this program side by side, by lines for a shell, or by a scheduler that exists. None of them is a
//! scheduler of its own: a run is a command that is safe to give twice, and its result is kept by what it hangs on.

use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use crate::commands::signals::stop;
use crate::report::folder::OF_ENGINES;

/// An engine by its name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Engine {
    /// This machine's cores
    #[default]
    Local,
    /// HyperQueue, by its Python client; a server that runs, or one of this machine
    #[value(name = "hyperqueue")]
    HyperQueue,
    /// Slurm, as an array of jobs
    Slurm,
}

/// What is done with the runs of a study.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Those that are not kept are made, and the page is written.
    On(Engine),
    /// A command for each that is not kept is printed.
    List,
    /// The page of those that are kept is written.
    Collect,
    /// Those with these names are made.
    Only(Vec<String>),
}

const HYPERQUEUE: &str = include_str!("../../templates/engines/on_hyperqueue.py");
const SLURM: &str = include_str!("../../templates/engines/on_slurm.sh");

/// Tasks of an array at the most: what Slurm allows without being told.
const LARGEST_ARRAY: usize = 1000;

/// Text as one word of a shell.
pub fn word(text: &str) -> String {
    let plain = |letter: char| letter.is_ascii_alphanumeric() || "/._-+=:,@%".contains(letter);
    if !text.is_empty() && text.chars().all(plain) {
        text.to_string()
    } else {
        format!("'{}'", text.replace('\'', "'\\''"))
    }
}

/// Gives the lines to an engine and waits until it has done with them. Which of them succeeded is told by what is kept.
pub fn give(engine: Engine, lines: &[String], folder: &Path) -> Result<(), String> {
    let [list, hyperqueue, slurm] = OF_ENGINES;
    let put = |name: &str, text: &str| -> io::Result<PathBuf> {
        let place = folder.join(name);
        std::fs::write(&place, text)?;
        Ok(place)
    };
    let failed = |error: io::Error| format!("the runs could not be given to the engine: {error}");
    let list = put(list, &(lines.join("\n") + "\n")).map_err(failed)?;
    let mut command = match engine {
        Engine::Local => return Ok(()),
        Engine::HyperQueue => {
            let mut command = Command::new("python3");
            command.arg(put(hyperqueue, HYPERQUEUE).map_err(failed)?).arg(&list);
            command
        }
        Engine::Slurm => {
            let tasks = lines.len().clamp(1, LARGEST_ARRAY);
            let mut command = Command::new("sbatch");
            let array = format!("--array=0-{}", tasks - 1);
            command.args(["--parsable", "--ntasks=1", "--cpus-per-task=1", "--output=/dev/null", &array]);
            command.arg(put(slurm, SLURM).map_err(failed)?).arg(&list).arg(tasks.to_string());
            command
        }
    };
    let program = command.get_program().to_string_lossy().into_owned();
    let not_started = |error: io::Error| format!("{program} could not be started: {error}");
    // A task that failed leaves nothing kept, which is told when results are gathered.
    let told = |status: ExitStatus| crate::terminal::warn(format_args!("note: {program} ended with {status}"));
    if engine == Engine::Slurm {
        let submitted = command.stderr(Stdio::inherit()).output().map_err(not_started)?;
        if !submitted.status.success() {
            told(submitted.status);
            return Ok(());
        }
        // The number of the job, and behind a semicolon the cluster.
        let job = String::from_utf8_lossy(&submitted.stdout);
        return wait_for_slurm(job.trim().split(';').next().unwrap_or_default());
    }
    let status = command.status().map_err(not_started)?;
    if !status.success() {
        told(status);
    }
    Ok(())
}

/// Times that a scheduler may fail to answer, one after another.
const UNANSWERED: usize = 10;

/// Waits until no task of an array is pending or running. The pause between two questions is a fiftieth of the time so far, from half a second
/// to 30 s, so that little time is lost at the end. (`sbatch --wait` asks after 2, 6, 12, 20 and 30 s.) A user who interrupts the program waits no
/// longer; the array goes on.
fn wait_for_slurm(job: &str) -> Result<(), String> {
    let began = Instant::now();
    let mut unanswered = 0;
    loop {
        let next = Instant::now() + (began.elapsed() / 50).clamp(Duration::from_millis(500), Duration::from_secs(30));
        while Instant::now() < next {
            if stop().load(Ordering::Relaxed) {
                return Err(format!(
                    "interrupted; job {job} goes on (scancel {job} ends it): once it has ended, gather the results with --collect"
                ));
            }
            std::thread::sleep(Duration::from_millis(100));
        }
        let asked = Command::new("squeue").args(["--noheader", "--jobs", job]).output();
        match asked {
            Ok(answer) if answer.status.success() && answer.stdout.is_empty() => return Ok(()),
            Ok(answer) if answer.status.success() => unanswered = 0,
            // What ended a while ago is forgotten.
            Ok(answer) if String::from_utf8_lossy(&answer.stderr).contains("Invalid job id") => return Ok(()),
            _ => unanswered += 1,
        }
        if unanswered == UNANSWERED {
            return Err(format!(
                "squeue has not answered {UNANSWERED} times about job {job}: once it has ended, gather the results with --collect"
            ));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_of_a_shell_stays_one() {
        assert_eq!(word("/a/b-c_1.yaml"), "/a/b-c_1.yaml");
        assert_eq!(word("a b"), "'a b'");
        assert_eq!(word("it's $HOME"), r"'it'\''s $HOME'");
        assert_eq!(word(""), "''");
    }
}
