//! Designs over grids of values: the same results as runs by hand, wherever they are made.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const TINY: &str = include_str!("fixtures/tiny.yaml");
const PLAN: &str = "kind: sweep
name: grid
designs: [tiny.yaml, other.yaml]
by: equations
vary:
  - key: flow.arrival.surge.velocity
    values: [3 m/s, 4.6 m/s, 6 m/s]
  - key: factors.load
    values: [1, 1.5]
";

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("sweep").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join("tiny.yaml"), TINY).expect("a design");
    std::fs::write(folder.join("other.yaml"), TINY.replace("bulk_density: 1400", "bulk_density: 1500"))
        .expect("a design");
    std::fs::write(folder.join("plan.yaml"), PLAN).expect("a plan");
    folder
}

fn barrier_check(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_barrier-check")).args(arguments).current_dir(folder).output().expect("it runs")
}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).expect(name)
}

fn json(text: &str) -> serde_json::Value {
    serde_json::from_str(text).expect("JSON")
}

#[test]
fn every_run_is_that_of_the_design_with_its_values() {
    let here = folder("by_hand");
    assert!(TINY.contains("bulk_density: 1400") && TINY.contains("velocity: 4.6 m/s"));
    let ran = barrier_check(&here, &["study", "plan.yaml", "--out", "found"]);
    assert_eq!(ran.status.code(), Some(0), "{}", String::from_utf8_lossy(&ran.stderr));
    let found = json(&read(&here, "found/sweep.json"));
    let runs = found["runs"].as_array().expect("runs");
    assert_eq!(runs.len(), 12);
    let schema = json(&String::from_utf8_lossy(&barrier_check(&here, &["schema", "sweep"]).stdout));
    let valid = jsonschema::validator_for(&schema).expect("a schema");
    valid.validate(&found).unwrap_or_else(|error| panic!("{error}"));
    // The last one by hand: the denser flow with 6 m/s and a factor of 1.5.
    let by_hand = read(&here, "other.yaml").replace("velocity: 4.6 m/s", "velocity: 6 m/s");
    let with_factor = by_hand.replace("load: 1.0", "load: 1.5");
    assert_ne!(by_hand, with_factor);
    std::fs::write(here.join("one.yaml"), with_factor).expect("a design");
    barrier_check(&here, &["loads", "one.yaml", "--out", "one"]);
    let one = json(&read(&here, "one/result.json"));
    for check in one["checks"].as_array().expect("checks") {
        let checks = runs[11]["checks"].as_array().expect("checks");
        let same = checks.iter().find(|other| other["id"] == check["id"]).expect("the check");
        assert_eq!(same["utilisation"], check["utilisation"], "{}", check["id"]);
    }
    assert_eq!((&runs[11]["design"], &runs[11]["values"]), (&"other".into(), &serde_json::json!(["6 m/s", "1.5"])));
    let table = read(&here, "found/sweep.csv");
    assert_eq!(table.lines().count(), 13);
    assert!(table.starts_with("design,flow_arrival_surge_velocity,factors_load,verdict,"), "{table}");
    assert!(read(&here, "found/sweep.html").contains("one line for each design"));
}

/// Listed, made by commands of their own, one of them twice, and gathered: nothing is made again, and the results are those made here.
#[test]
fn runs_that_are_made_elsewhere_are_gathered() {
    let here = folder("elsewhere");
    barrier_check(&here, &["study", "plan.yaml", "--out", "here"]);
    let list = |out: &str| {
        let ran = barrier_check(&here, &["study", "plan.yaml", "--out", out, "--list"]);
        String::from_utf8(ran.stdout).expect("text").lines().map(String::from).collect::<Vec<_>>()
    };
    assert_eq!(list("here").len(), 0);
    let lines = list("there");
    assert_eq!(lines.len(), 12);
    let make = |line: &String| Command::new("sh").args(["-c", line]).current_dir("/").status().expect("a shell");
    lines[..5].iter().chain(&lines[..1]).for_each(|line| assert!(make(line).success()));
    // Some are missing: the page says so, and the study has not ended well.
    let part = barrier_check(&here, &["study", "plan.yaml", "--out", "there", "--collect"]);
    let told = String::from_utf8_lossy(&part.stderr).into_owned();
    assert!(part.status.code() == Some(2) && told.contains("7 of 12 runs are missing"), "{told}");
    assert_eq!(list("there").len(), 7);
    lines[5..].iter().for_each(|line| assert!(make(line).success()));
    assert_eq!(barrier_check(&here, &["study", "plan.yaml", "--out", "there", "--collect"]).status.code(), Some(0));
    assert_eq!(read(&here, "there/sweep.csv"), read(&here, "here/sweep.csv"));
    // A run of a study that has changed since is refused.
    std::fs::write(here.join("plan.yaml"), PLAN.replace("3 m/s", "3.1 m/s")).expect("a plan");
    assert!(!make(&lines[0]).success());
    // What does not change is not made again.
    assert_eq!(list("there").len(), 4);
}

#[test]
fn lists_go_together_and_values_that_make_no_design_are_told() {
    let here = folder("list");
    let plan = PLAN.replace("values: [1, 1.5]", "values: [1, 1.5, 99]") + "combine: list\n";
    std::fs::write(here.join("plan.yaml"), &plan).expect("a plan");
    assert_eq!(barrier_check(&here, &["study", "plan.yaml", "--out", "found"]).status.code(), Some(2));
    let found = json(&read(&here, "found/sweep.json"));
    let runs = found["runs"].as_array().expect("runs");
    assert_eq!(runs.len(), 6);
    assert_eq!(runs[1]["values"], serde_json::json!(["4.6 m/s", "1.5"]));
    let why = runs[2]["why"].as_str().expect("a reason");
    assert!(runs[2]["verdict"] == "invalid" && why.contains("factors.load: found `99`"), "{why}");
    std::fs::write(here.join("plan.yaml"), PLAN.to_string() + "combine: list\n").expect("a plan");
    let ran = barrier_check(&here, &["study", "plan.yaml", "--out", "uneven"]);
    let told = String::from_utf8_lossy(&ran.stderr).into_owned();
    assert!(
        ran.status.code() == Some(2)
            && told.contains("combine\n  found:   lists of [3, 2] values\n  allowed: as many in each"),
        "{told}"
    );
    // Of other kinds the runs are not known beforehand.
    let other = "kind: stability\nname: x\nshares: [0.5]\nsteps: 100\n";
    std::fs::write(here.join("other_kind.yaml"), other).expect("a plan");
    let ran = barrier_check(&here, &["study", "other_kind.yaml", "--list"]);
    let told = String::from_utf8_lossy(&ran.stderr).into_owned();
    assert!(ran.status.code() == Some(2) && told.contains("of the kind sweep"), "{told}");
}

/// A scheduler that makes the runs at once, as Slurm would, and tells in `squeue` what the test wants. Returns the PATH with it in front.
#[cfg(unix)]
fn scheduler(here: &Path, squeue: &str) -> String {
    use std::os::unix::fs::PermissionsExt;
    let sbatch = "while [ \"${1#-}\" != \"$1\" ]; do shift; done
task=0
while [ $task -lt $3 ]; do SLURM_ARRAY_TASK_ID=$task sh \"$1\" \"$2\" \"$3\" >/dev/null 2>&1; task=$((task + 1)); done
echo '7;here'";
    for (name, text) in [("sbatch", sbatch), ("squeue", squeue)] {
        let place = here.join(name);
        std::fs::write(&place, format!("#!/bin/sh\n{text}\n")).expect("a script");
        std::fs::set_permissions(&place, std::fs::Permissions::from_mode(0o755)).expect("it may be run");
    }
    format!("{}:{}", here.display(), std::env::var("PATH").expect("a path"))
}

#[cfg(unix)]
#[test]
fn slurm_is_asked_until_it_knows_of_no_task() {
    let here = folder("slurm");
    barrier_check(&here, &["study", "plan.yaml", "--out", "here"]);
    // A task is left twice, then the job is forgotten.
    let path = scheduler(
        &here,
        "echo \"$3\" >>asked; [ $(wc -l <asked) -gt 2 ] && { echo 'slurm_load_jobs error: Invalid job id specified' >&2; exit 1; }; echo 7_1",
    );
    let program = || Command::new(env!("CARGO_BIN_EXE_barrier-check"));
    let arguments = ["study", "plan.yaml", "--out", "there", "--on", "slurm"];
    let ran = program().args(arguments).current_dir(&here).env("PATH", &path).output().expect("it runs");
    assert_eq!(ran.status.code(), Some(0), "{}", String::from_utf8_lossy(&ran.stderr));
    assert_eq!(read(&here, "asked"), "7\n7\n7\n");
    assert_eq!(read(&here, "there/sweep.csv"), read(&here, "here/sweep.csv"));
}

/// Who interrupts the program need not wait for the scheduler.
#[cfg(unix)]
#[test]
fn waiting_for_slurm_can_be_interrupted() {
    let here = folder("interrupted");
    let path = scheduler(&here, "echo asked >>asked; echo 7_1");
    let program = Command::new(env!("CARGO_BIN_EXE_barrier-check"))
        .args(["study", "plan.yaml", "--out", "there", "--on", "slurm"])
        .current_dir(&here)
        .env("PATH", &path)
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("it runs");
    while !here.join("asked").exists() {
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    let killed = Command::new("kill").args(["-TERM", &program.id().to_string()]).status().expect("kill");
    assert!(killed.success());
    let ended = program.wait_with_output().expect("it ends");
    let told = String::from_utf8_lossy(&ended.stderr);
    assert!(ended.status.code() == Some(2) && told.contains("interrupted; job 7 goes on"), "{told}");
}
