//! Runs that are killed, stopped, damaged or starved of disk, and resumed: the result is that of a run that was left alone, or
//! there is none, with the reason.
#![cfg(unix)]

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

const DESIGN: &str = "tests/fixtures/tiny.yaml";
const SURGES: &str = "tests/fixtures/tiny_surges.yaml";
const WET: &str = "tests/fixtures/tiny_wet.yaml";
const BOULDERS: &str = "tests/fixtures/tiny_boulders.yaml";
const RINGS: &str = "tests/fixtures/tiny_rings.yaml";
const INLET: &str = "tests/fixtures/tiny_inlet.yaml";

fn program() -> Command {
    Command::new(env!("CARGO_BIN_EXE_barrier-check"))
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("resume").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    folder
}

fn run(arguments: &[&str]) -> Output {
    program().args(arguments).output().expect("the program starts")
}

fn error(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// All numbers of a result but those that tell of times and speeds of the machine; time series.
fn numbers(folder: &Path) -> (serde_json::Value, Vec<u8>) {
    let text = std::fs::read_to_string(folder.join("result.json")).expect("a result");
    let mut result: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    result.as_object_mut().expect("an object").remove("provenance");
    strip(&mut result);
    (result, std::fs::read(folder.join("histories.csv")).expect("histories"))
}

fn strip(value: &mut serde_json::Value) {
    match value {
        serde_json::Value::Object(map) => {
            let of_the_machine = ["wall_clock", "threads", "simulated_at", "per_s"];
            map.retain(|key, _| !of_the_machine.iter().any(|word| key.contains(word)));
            map.values_mut().for_each(strip);
        }
        serde_json::Value::Array(list) => list.iter_mut().for_each(strip),
        _ => {}
    }
}

/// The run that nobody disturbs, with the given further arguments.
fn undisturbed(design: &str, name: &str, more: &[&str]) -> (serde_json::Value, Vec<u8>) {
    let out = folder(name);
    let output = run(&[&[design, "--out", &out.display().to_string()], more].concat());
    assert!(matches!(output.status.code(), Some(0..=2)), "{}", error(&output));
    assert!(!out.join("checkpoint").exists());
    numbers(&out)
}

/// Starts a run that is kept at every stop.
fn start(design: &str, out: &Path, more: &[&str]) -> Child {
    let out = out.display().to_string();
    let first = [design, "--out", &out, "--keep-every", "0"];
    program().args(first).args(more).stderr(Stdio::null()).stdout(Stdio::null()).spawn().expect("the program starts")
}

/// Waits until the run is kept; false if it was done before.
fn wait_until_kept(child: &mut Child, out: &Path) -> bool {
    let kept = || {
        let files = std::fs::read_dir(out.join("checkpoint")).into_iter().flatten().flatten();
        files.map(|file| file.path()).any(|path| path.extension().is_some_and(|end| end == "before"))
    };
    let started = Instant::now();
    while started.elapsed() < Duration::from_secs(60) {
        if kept() {
            return true;
        }
        if child.try_wait().expect("a child").is_some() {
            return false;
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    panic!("nothing is kept");
}

fn signal(child: &Child, name: &str) {
    let sent = Command::new("kill").args([name, &child.id().to_string()]).status().expect("kill");
    assert!(sent.success());
}

/// Kills and resumes a run `times` over, on changing numbers of threads, and lets it end.
fn kill_and_resume(design: &str, name: &str, times: u64, more: &[&str], seed: u64) {
    let out = folder(name);
    let path = out.display().to_string();
    let mut random = fastrand::Rng::with_seed(seed);
    let mut child = start(design, &out, more);
    for time in 0..times {
        if !wait_until_kept(&mut child, &out) {
            break;
        }
        std::thread::sleep(Duration::from_millis(random.u64(0..80)));
        let _ = child.kill();
        let _ = child.wait();
        if !out.join("checkpoint/request.bin").exists() {
            break; // It was done just before.
        }
        let threads = ["1", "2", "3"][time as usize % 3];
        let resume = ["resume", &path, "--keep-every", "0", "--threads", threads];
        child = program().args(resume).stderr(Stdio::null()).stdout(Stdio::null()).spawn().expect("the program starts");
    }
    let code = child.wait().expect("an end").code();
    if out.join("checkpoint").exists() {
        let last = run(&["resume", &path]);
        assert!(matches!(last.status.code(), Some(0..=2)), "{}", error(&last));
    } else {
        assert!(matches!(code, Some(0..=2)), "{code:?}");
    }
    assert!(!out.join("checkpoint").exists());
}

#[test]
fn a_run_that_is_killed_and_resumed_ends_with_the_same_bits() {
    let whole = undisturbed(DESIGN, "whole", &[]);
    kill_and_resume(DESIGN, "killed", 4, &[], 1);
    assert_eq!(whole, numbers(&folder_of("killed")));
}

/// Between surges and while they come.
#[test]
fn surges_that_are_killed_and_resumed_end_with_the_same_bits() {
    let whole = undisturbed(SURGES, "whole_surges", &[]);
    kill_and_resume(SURGES, "surges_killed", 6, &[], 3);
    assert_eq!(whole, numbers(&folder_of("surges_killed")));
    assert_eq!(whole.0["surges"].as_array().map(Vec::len), Some(3));
}

/// While its pores drain.
#[test]
fn a_wet_flow_that_is_killed_and_resumed_ends_with_the_same_bits() {
    let whole = undisturbed(WET, "whole_wet", &[]);
    kill_and_resume(WET, "wet_killed", 4, &[], 4);
    assert_eq!(whole, numbers(&folder_of("wet_killed")));
}

/// While grains come in.
#[test]
fn a_flow_by_its_hydrograph_that_is_killed_and_resumed_ends_with_the_same_bits() {
    let whole = undisturbed(INLET, "whole_inlet", &[]);
    kill_and_resume(INLET, "inlet_killed", 4, &[], 5);
    assert_eq!(whole, numbers(&folder_of("inlet_killed")));
}

/// Boulders at the front and among the grains, and dissipators by a curve.
#[test]
fn boulders_that_are_killed_and_resumed_end_with_the_same_bits() {
    let whole = undisturbed(BOULDERS, "whole_boulders", &[]);
    kill_and_resume(BOULDERS, "boulders_killed", 4, &[], 6);
    assert_eq!(whole, numbers(&folder_of("boulders_killed")));
}

/// A ring net that is cut to its banks, ropes side by side and by name.
#[test]
fn a_ring_net_that_is_killed_and_resumed_ends_with_the_same_bits() {
    let whole = undisturbed(RINGS, "whole_rings", &[]);
    kill_and_resume(RINGS, "rings_killed", 4, &[], 6);
    assert_eq!(whole, numbers(&folder_of("rings_killed")));
}

/// Several starts side by side, and a barrier of cylinders.
#[test]
fn several_starts_that_are_killed_end_with_the_same_bits() {
    let whole = undisturbed(DESIGN, "whole_of_three", &["--seeds", "3"]);
    kill_and_resume(DESIGN, "three_killed", 3, &["--seeds", "3"], 2);
    assert_eq!(whole, numbers(&folder_of("three_killed")));
}

/// Fifty kills at random moments: `cargo test --release --test resume -- --ignored`.
#[test]
#[ignore = "takes minutes"]
fn fifty_kills() {
    let whole = undisturbed(DESIGN, "whole_of_fifty", &["--seeds", "2"]);
    for round in 0..10 {
        let name = format!("killed_{round}");
        kill_and_resume(DESIGN, &name, 5, &["--seeds", "2"], 100 + round);
        assert_eq!(whole, numbers(&folder_of(&name)), "round {round}");
    }
}

fn folder_of(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("resume").join(name)
}

/// A run that is asked to end keeps all its starts, ends with 2 and says how to go on.
#[test]
fn a_run_that_is_asked_to_end_can_be_resumed() {
    let whole = undisturbed(DESIGN, "whole_of_two", &["--seeds", "2"]);
    let out = folder("asked");
    let path = out.display().to_string();
    let mut child = program()
        .args([DESIGN, "--out", &path, "--keep-every", "0", "--seeds", "2"])
        .stderr(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .expect("the program starts");
    assert!(wait_until_kept(&mut child, &out));
    signal(&child, "-TERM");
    let output = child.wait_with_output().expect("an end");
    assert_eq!(output.status.code(), Some(2), "{}", error(&output));
    assert!(error(&output).contains(&format!("barrier-check resume {path}")), "{}", error(&output));
    assert!(!out.join("result.json").exists());
    let resumed = run(&["resume", &path]);
    assert!(matches!(resumed.status.code(), Some(0..=2)), "{}", error(&resumed));
    assert_eq!(whole, numbers(&out));
}

/// A run that is begun anew over one that was kept, and is stopped at once, leaves that one.
#[test]
fn a_short_run_does_not_take_the_place_of_the_one_that_was_kept() {
    let out = folder("before");
    let path = out.display().to_string();
    let mut child = start(DESIGN, &out, &[]);
    assert!(wait_until_kept(&mut child, &out));
    let _ = child.kill();
    let _ = child.wait();
    let kept = || {
        let entries = std::fs::read_dir(out.join("checkpoint")).expect("a folder").flatten();
        let mut files: Vec<(String, Vec<u8>)> = entries
            .map(|entry| {
                (entry.file_name().to_string_lossy().into_owned(), std::fs::read(entry.path()).expect("a file"))
            })
            .collect();
        files.sort();
        files
    };
    let before = kept();
    let child = program()
        .args([DESIGN, "--out", &path, "--keep-every", "60"])
        .stderr(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .expect("the program starts");
    std::thread::sleep(std::time::Duration::from_millis(300));
    signal(&child, "-TERM");
    let output = child.wait_with_output().expect("an end");
    // A machine that finishes the run within that time has nothing to keep.
    if output.status.code() == Some(2) && error(&output).contains("too short") {
        assert_eq!(kept(), before);
    }
}

/// A folder with the report of one design, in which a run of another is interrupted and resumed, holds the report of the other.
#[test]
fn what_is_resumed_takes_its_place_under_its_own_name() {
    let out = folder("owner");
    let path = out.display().to_string();
    run(&["loads", "tests/fixtures/tiny_wall.yaml", "--out", &path]);
    let source = || {
        let manifest = std::fs::read_to_string(out.join("manifest.json")).expect("a manifest");
        let manifest: serde_json::Value = serde_json::from_str(&manifest).expect("JSON");
        manifest["source"].to_string()
    };
    let first = source();
    let mut child = start(DESIGN, &out, &[]);
    assert!(wait_until_kept(&mut child, &out));
    let _ = child.kill();
    let _ = child.wait();
    assert_eq!(source(), first);
    // Neither a run of a third nor a validation takes its place.
    let refused = run(&["designs/site_a.yaml", "--out", &path]);
    assert_eq!(refused.status.code(), Some(2));
    let told = format!(
        "an interrupted run of another design file is kept (tiny): go on with it (`barrier-check resume {path}`)"
    );
    assert!(error(&refused).contains(&told), "{}", error(&refused));
    let refused = run(&["validate", "A1", "--out", &path]);
    assert!(error(&refused).contains("an interrupted run is kept"), "{}", error(&refused));
    let resumed = run(&["resume", &path]);
    assert!(matches!(resumed.status.code(), Some(0..=2)), "{}", error(&resumed));
    let second = source();
    assert!(second != first && second != "null", "{second}");
    // That of the design itself, which may go on there.
    let other = folder("owner_by_itself");
    run(&[DESIGN, "--out", &other.display().to_string()]);
    let manifest = std::fs::read_to_string(other.join("manifest.json")).expect("a manifest");
    let manifest: serde_json::Value = serde_json::from_str(&manifest).expect("JSON");
    assert_eq!(manifest["source"].to_string(), second);
    let report = std::fs::read_to_string(out.join("design.yaml")).expect("a design");
    assert_eq!(report, std::fs::read_to_string(DESIGN).expect("a design"));
}

/// Killed, with what was kept spoilt on purpose before it is resumed.
fn spoilt(name: &str, spoil: impl Fn(&Path)) -> (PathBuf, Output) {
    let out = folder(name);
    let mut child = start(DESIGN, &out, &[]);
    assert!(wait_until_kept(&mut child, &out));
    let _ = child.kill();
    let _ = child.wait();
    end_the_exchange(&out.join("checkpoint"));
    spoil(&out.join("checkpoint"));
    let output = run(&["resume", &out.display().to_string()]);
    (out, output)
}

/// A program that is killed between the two renames of a file leaves the new one under its temporary name; here it takes its place.
fn end_the_exchange(kept: &Path) {
    let (bin, new) = (simulation_in(kept, "bin"), simulation_in(kept, "tmp"));
    if !bin.exists() && new.exists() {
        std::fs::rename(&new, new.with_extension("bin")).expect("renamed");
    }
}

fn simulation_in(kept: &Path, end: &str) -> PathBuf {
    let files = std::fs::read_dir(kept).expect("a folder").flatten().map(|file| file.path());
    let mut ours =
        files.filter(|path| path.extension().is_some_and(|has| has == end) && !path.ends_with("request.bin"));
    ours.next().unwrap_or_else(|| kept.join(format!("none.{end}")))
}

fn flip_a_bit(path: &Path) {
    let mut bytes = std::fs::read(path).expect("a file");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 4;
    std::fs::write(path, bytes).expect("written");
}

fn cut_short(path: &Path) {
    let bytes = std::fs::read(path).expect("a file");
    std::fs::write(path, &bytes[..bytes.len() / 3]).expect("written");
}

#[test]
fn what_is_spoilt_is_told_and_the_one_before_is_used() {
    let whole = undisturbed(DESIGN, "whole_of_spoilt", &[]);
    let (out, output) = spoilt("bit", |kept| flip_a_bit(&simulation_in(kept, "bin")));
    assert!(error(&output).contains("damaged: its checksum is wrong; the one before it is used"), "{}", error(&output));
    assert_eq!(whole, numbers(&out));
    let (out, output) = spoilt("cut", |kept| cut_short(&simulation_in(kept, "bin")));
    assert!(error(&output).contains("the one before it is used"), "{}", error(&output));
    assert_eq!(whole, numbers(&out));
    let (out, output) = spoilt("both", |kept| {
        flip_a_bit(&simulation_in(kept, "bin"));
        cut_short(&simulation_in(kept, "before"));
    });
    assert!(error(&output).contains("this simulation begins anew"), "{}", error(&output));
    assert_eq!(whole, numbers(&out));
    // Kept by a run of another design, under the name of this one's.
    let (out, output) = spoilt("foreign", |kept| {
        let other = folder("other");
        let text = std::fs::read_to_string(DESIGN).expect("a design").replace("1.2 m3", "1.3 m3");
        let design = other.with_extension("yaml");
        std::fs::write(&design, text).expect("a design");
        let arguments = [&design.display().to_string(), "--out", &other.display().to_string()];
        let mut child = program().args(arguments).args(["--keep-every", "0"]).spawn().expect("the program starts");
        assert!(wait_until_kept(&mut child, &other));
        let _ = child.kill();
        let _ = child.wait();
        std::fs::copy(simulation_in(&other.join("checkpoint"), "before"), simulation_in(kept, "bin")).expect("copied");
    });
    assert!(
        error(&output).contains("belongs to another design or simulation; the one before it is used"),
        "{}",
        error(&output)
    );
    assert_eq!(whole, numbers(&out));
    // Without the order nobody knows what to go on with.
    let (out, output) = spoilt("order", |kept| flip_a_bit(&kept.join("request.bin")));
    assert_eq!(output.status.code(), Some(2));
    assert!(error(&output).contains("cannot be resumed"), "{}", error(&output));
    assert!(!out.join("result.json").exists());
}

#[test]
fn where_nothing_is_kept_there_is_nothing_to_resume() {
    let output = run(&["resume", "/nowhere/at/all"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(error(&output).contains("no interrupted run is kept there"), "{}", error(&output));
}

/// No room on the disk, played by a limit on the size of files: the result of before stays, bit for bit, and the reason is told.
#[test]
fn a_full_disk_spoils_nothing() {
    let out = folder("full");
    let path = out.display().to_string();
    assert!(matches!(run(&[DESIGN, "--out", &path]).status.code(), Some(0..=2)));
    let all = || -> Vec<(PathBuf, Vec<u8>)> {
        let mut files: Vec<PathBuf> =
            std::fs::read_dir(&out).expect("a folder").map(|file| file.expect("a file").path()).collect();
        // The manifest tells whose run was on its way.
        files.retain(|file| !file.ends_with("manifest.json"));
        files.sort();
        files.into_iter().map(|file| (file.clone(), std::fs::read(&file).unwrap_or_default())).collect()
    };
    let before = all();
    let shell = format!(
        "trap '' XFSZ; ulimit -f 16; exec '{}' {DESIGN} --out '{path}' --keep-every 0",
        env!("CARGO_BIN_EXE_barrier-check")
    );
    let output = Command::new("sh").args(["-c", &shell]).output().expect("a shell");
    assert_eq!(output.status.code(), Some(2), "{}", error(&output));
    let told = error(&output);
    assert!(told.contains("the run could not be kept") && told.contains("the report could not be written"), "{told}");
    assert!(told.contains("still holds the report of an earlier run"), "{told}");
    let _ = std::fs::remove_dir_all(out.join("checkpoint"));
    assert!(before == all(), "the result of before has changed");
    // A folder that cannot be is told before the run.
    let output = run(&[DESIGN, "--out", "/proc/nothing/here"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(error(&output).contains("could not be written"), "{}", error(&output));
}

/// A link in the place of a folder or a file of ours is not followed out of the folder of the report.
#[test]
fn links_do_not_lead_out_of_the_folder() {
    let (out, elsewhere) = (folder("linked"), folder("elsewhere"));
    let path = out.display().to_string();
    run(&["loads", DESIGN, "--out", &path]);
    std::fs::create_dir_all(&elsewhere).expect("a folder");
    std::fs::write(elsewhere.join("precious"), "as it was").expect("a file");
    std::fs::remove_file(out.join("report.html")).expect("a report");
    std::os::unix::fs::symlink(elsewhere.join("precious"), out.join("report.html")).expect("a link");
    let output = run(&[DESIGN, "--out", &path]);
    assert!(error(&output).contains("have been changed since (report.html)"), "{}", error(&output));
    std::fs::remove_file(out.join("report.html")).expect("a link");
    std::os::unix::fs::symlink(&elsewhere, out.join("checkpoint")).expect("a link");
    let output = run(&[DESIGN, "--out", &path, "--keep-every", "0"]);
    assert!(matches!(output.status.code(), Some(0..=2)), "{}", error(&output));
    assert!(error(&output).contains("it is a link; a folder is wanted"), "{}", error(&output));
    assert_eq!(std::fs::read_to_string(elsewhere.join("precious")).expect("a file"), "as it was");
    assert_eq!(std::fs::read_dir(&elsewhere).expect("a folder").count(), 1);
    std::os::unix::fs::symlink(&elsewhere, out.join("vtk")).expect("a link");
    let output = run(&["report", &path, "--vtk"]);
    assert_eq!(output.status.code(), Some(2), "{}", error(&output));
    assert_eq!(std::fs::read_dir(&elsewhere).expect("a folder").count(), 1);
}

/// What one start has kept is not taken for another's, though both are of one design.
#[test]
fn simulations_of_one_run_are_not_taken_for_each_other() {
    let whole = undisturbed(DESIGN, "whole_of_swapped", &["--seeds", "3"]);
    let out = folder("swapped");
    let mut child = start(DESIGN, &out, &["--seeds", "3", "--threads", "1"]);
    assert!(wait_until_kept(&mut child, &out));
    let kept = out.join("checkpoint");
    let files = || -> Vec<PathBuf> {
        let files = std::fs::read_dir(&kept).into_iter().flatten().flatten().map(|file| file.path());
        files
            .filter(|path| path.extension().is_some_and(|end| end == "bin") && !path.ends_with("request.bin"))
            .collect()
    };
    while files().len() < 2 {
        std::thread::sleep(Duration::from_millis(5));
    }
    let _ = child.kill();
    let _ = child.wait();
    let files = files();
    let [one, two] = [&files[0], &files[1]].map(|file| std::fs::read(file).expect("bytes"));
    std::fs::write(&files[0], two).expect("written");
    std::fs::write(&files[1], one).expect("written");
    let output = run(&["resume", &out.display().to_string()]);
    assert!(error(&output).contains("another design or simulation"), "{}", error(&output));
    assert_eq!(whole, numbers(&out));
}

/// Several starts side by side are all kept, without a word; files that are not ours stay, whatever their names end in.
#[test]
fn starts_side_by_side_are_kept_without_a_word() {
    let out = folder("quiet");
    let kept = out.join("checkpoint");
    let path = out.display().to_string();
    run(&["loads", DESIGN, "--out", &path]);
    std::fs::create_dir_all(&kept).expect("a folder");
    std::fs::write(kept.join("pytorch_model.bin"), "mine").expect("a file");
    let output = run(&[DESIGN, "--out", &path, "--keep-every", "0", "--seeds", "4", "--threads", "4"]);
    assert!(matches!(output.status.code(), Some(0..=2)));
    // On a busy machine it takes longer than the ten seconds after which progress is told.
    let told = error(&output);
    let warned: Vec<&str> = told.lines().filter(|line| !line.contains(" s: simulated ")).collect();
    assert!(warned.is_empty(), "{told}");
    assert_eq!(std::fs::read_to_string(kept.join("pytorch_model.bin")).expect("a file"), "mine");
    assert_eq!(std::fs::read_dir(&kept).expect("a folder").count(), 1);
}

/// A design that is refused, or dies at once, takes nothing of what an earlier run has kept.
#[test]
fn what_is_kept_stays_until_something_takes_its_place() {
    let whole = undisturbed(DESIGN, "whole_of_kept", &[]);
    let out = folder("kept");
    let mut child = start(DESIGN, &out, &[]);
    assert!(wait_until_kept(&mut child, &out));
    let _ = child.kill();
    let _ = child.wait();
    let path = out.display().to_string();
    let refused = run(&["designs/site_a.yaml", "--out", &path]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(error(&refused).contains("of another design file is kept"), "{}", error(&refused));
    let mut child =
        program().args([DESIGN, "--out", &path]).stderr(Stdio::null()).stdout(Stdio::null()).spawn().expect("a start");
    std::thread::sleep(Duration::from_millis(40));
    let _ = child.kill();
    let _ = child.wait();
    let resumed = run(&["resume", &path]);
    assert!(matches!(resumed.status.code(), Some(0..=2)), "{}", error(&resumed));
    assert_eq!(whole, numbers(&out));
}

/// Asked to end while the flow still settles, of which nothing is kept, a run ends soon.
#[test]
fn a_run_that_settles_ends_when_it_is_asked_to() {
    let out = folder("settling");
    std::fs::create_dir_all(&out).expect("a folder");
    let design = out.join("stiff.yaml");
    let text = std::fs::read_to_string("designs/site_a.yaml").expect("a design");
    let text = text.replace("contact_modulus: 0.1 GPa", "contact_modulus: 100 GPa");
    let text = text.replace("fidelity: standard", "fidelity: fine");
    std::fs::write(&design, text).expect("a design");
    let arguments = [&design.display().to_string(), "--out", &out.join("report").display().to_string()];
    let mut child = program().args(arguments).stderr(Stdio::piped()).stdout(Stdio::null()).spawn().expect("a start");
    std::thread::sleep(Duration::from_secs(2));
    assert!(child.try_wait().expect("a child").is_none(), "it was done before it was asked to end");
    signal(&child, "-TERM");
    let asked = Instant::now();
    while child.try_wait().expect("a child").is_none() && asked.elapsed() < Duration::from_secs(5) {
        std::thread::sleep(Duration::from_millis(20));
    }
    let ended = child.try_wait().expect("a child").and_then(|status| status.code());
    let _ = child.kill();
    let output = child.wait_with_output().expect("an end");
    assert_eq!(ended, Some(2), "it goes on");
    assert!(error(&output).contains("interrupted") && error(&output).contains("goes on where"), "{}", error(&output));
}
