//! Where reports go: nothing of the user's is lost, nothing leaves its folder, two runs never mix.
#![cfg(unix)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const DESIGN: &str = include_str!("fixtures/tiny.yaml");

const SNOW: &str = "\nloads:\n  snow_pressure: 1 kPa\n";

/// A new folder with a design in it, in which a user works.
fn workplace(name: &str) -> PathBuf {
    let place = Path::new(env!("CARGO_TARGET_TMPDIR")).join("folders").join(name);
    let _ = std::fs::remove_dir_all(&place);
    std::fs::create_dir_all(&place).expect("a folder");
    std::fs::write(place.join("net.yaml"), DESIGN).expect("a design");
    place
}

fn command(place: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_barrier-check"));
    command.current_dir(place).args(arguments);
    command
}

fn run(place: &Path, arguments: &[&str]) -> Output {
    command(place, arguments).output().expect("the program starts")
}

fn error(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// All files below a folder, with their content.
fn all_below(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("entry").path();
        if path.is_dir() {
            files.extend(all_below(&path));
        } else {
            let content = std::fs::read(&path).unwrap_or_default();
            files.push((path, content));
        }
    }
    files.sort();
    files
}

#[test]
fn files_of_the_user_are_never_replaced() {
    let place = workplace("mine");
    std::fs::write(place.join("design.yaml"), "mine").expect("a file");
    std::fs::write(place.join("report.md"), "mine").expect("a file");
    let before = all_below(&place);
    for arguments in [
        &["loads", "net.yaml", "--out", "."][..],
        &["net.yaml", "--out", "."],
        &["compare", "net.yaml", "net.yaml", "--out", "."],
        &["validate", "A1", "--out", "."],
    ] {
        let refused = run(&place, arguments);
        assert_eq!(refused.status.code(), Some(2), "{arguments:?}");
        assert!(error(&refused).contains("has not written (design.yaml, net.yaml, report.md)"), "{}", error(&refused));
        assert_eq!(all_below(&place), before, "{arguments:?}");
    }
    // Remarks that somebody wrote into a report are as much his.
    assert_eq!(run(&place, &["loads", "net.yaml"]).status.code(), Some(2));
    std::fs::write(place.join("out/net_loads/report.md"), "with remarks").expect("a file");
    let refused = run(&place, &["loads", "net.yaml"]);
    assert!(error(&refused).contains("have been changed since (report.md)"), "{}", error(&refused));
    assert_eq!(std::fs::read(place.join("out/net_loads/report.md")).expect("a file"), b"with remarks");
}

#[test]
fn names_stay_below_the_folder_of_reports() {
    let place = workplace("names");
    for name in ["...yaml", "javascript:alert(1).yaml", "Net Steg #2.yaml"] {
        std::fs::write(place.join(name), DESIGN).expect("a design");
        run(&place, &["loads", name]);
    }
    let mut names: Vec<String> = std::fs::read_dir(place.join("out"))
        .expect("reports")
        .map(|entry| entry.expect("entry").file_name().into_string().expect("text"))
        .collect();
    names.sort();
    assert_eq!(names, ["Net Steg _2_loads", "design_loads", "javascript_alert(1)_loads"]);
    assert!(!place.join("result.json").exists() && !place.parent().expect("above").join("result.json").exists());
    // Links in the comparison lead to the reports that are there.
    run(&place, &["compare", "out/Net Steg _2_loads", "out/design_loads", "--out", "cmp"]);
    let page = std::fs::read_to_string(place.join("cmp/compare.md")).expect("a page");
    assert!(page.contains("](Net%20Steg%20_2/report.md)"), "{page}");
    assert!(place.join("cmp/Net Steg _2/report.html").is_file());
}

#[test]
fn two_designs_of_one_name_are_not_taken_for_each_other() {
    let place = workplace("one_name");
    std::fs::create_dir(place.join("b")).expect("a folder");
    std::fs::write(place.join("b/net.yaml"), DESIGN.replace("Small net", "Another net")).expect("a design");
    run(&place, &["loads", "net.yaml"]);
    let refused = run(&place, &["loads", "b/net.yaml"]);
    assert!(error(&refused).contains("holds a report of something else"), "{}", error(&refused));
    assert!(std::fs::read_to_string(place.join("out/net_loads/report.md")).expect("a report").contains("Small net"));
    run(&place, &["loads", "b/net.yaml", "--out", "out/net_loads"]);
    assert!(std::fs::read_to_string(place.join("out/net_loads/report.md")).expect("a report").contains("Another net"));
}

#[test]
fn of_two_runs_in_one_folder_one_is_told_to_wait() {
    let place = workplace("two_runs");
    let children: Vec<_> = (0..4)
        .map(|_| {
            let mut command = command(&place, &["net.yaml", "--threads", "1", "--out", "out"]);
            command.stdout(std::process::Stdio::null()).stderr(std::process::Stdio::piped()).spawn().expect("a run")
        })
        .collect();
    let told: Vec<String> = children.into_iter().map(|child| error(&child.wait_with_output().expect("ends"))).collect();
    let refused = told.iter().filter(|told| told.contains("another run is writing into out")).count();
    assert_eq!(refused, 3, "{told:?}");
    let manifest = std::fs::read_to_string(place.join("out/manifest.json")).expect("a manifest");
    let manifest: serde_json::Value = serde_json::from_str(&manifest).expect("JSON");
    for (name, digest) in manifest["files"].as_object().expect("files") {
        use sha2::Digest;
        let bytes = std::fs::read(place.join("out").join(name)).expect("a file");
        let found: String = sha2::Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect();
        assert_eq!(digest.as_str(), Some(found.as_str()), "{name}");
    }
    assert!(!place.join("out/.barrier-check.lock").exists());
}

#[test]
fn what_an_earlier_run_drew_and_this_one_does_not_is_gone() {
    let place = workplace("stale");
    std::fs::write(place.join("net.yaml"), DESIGN.to_string() + SNOW).expect("a design");
    run(&place, &["net.yaml", "--vtk", "--out", "out"]);
    assert!(place.join("out/vtk").is_dir() && place.join("out/histories.csv").is_file());
    std::fs::write(place.join("out/notes.txt"), "mine").expect("a file");
    // Without the snow that the first one had a picture of.
    let first = std::fs::read_to_string(place.join("net.yaml")).expect("a design");
    let snow = place.join("out/case_snow.svg");
    assert!(snow.is_file());
    std::fs::write(place.join("net.yaml"), first.replace(SNOW, "")).expect("a design");
    run(&place, &["net.yaml", "--out", "out"]);
    assert!(!place.join("out/vtk").exists() && !snow.exists());
    let page = std::fs::read_to_string(place.join("out/report.md")).expect("a report");
    for (path, _) in all_below(&place.join("out")) {
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        assert!(!name.ends_with(".svg") || page.contains(&name), "{name} is of the earlier run");
    }
    assert!(place.join("out/notes.txt").is_file());
}

#[test]
fn a_folder_that_cannot_be_written_is_told_before_the_run() {
    let place = workplace("read_only");
    std::fs::write(place.join("file"), "").expect("a file");
    let refused = run(&place, &["net.yaml", "--out", "file"]);
    assert!(error(&refused).contains("file is a file; a folder is wanted"), "{}", error(&refused));
    let refused = run(&place, &["net.yaml", "--out", "/proc/1/x"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(error(&refused).contains("the report could not be written to /proc/1/x"), "{}", error(&refused));
}

#[test]
fn the_equations_alone_do_not_take_the_place_of_a_simulation() {
    let place = workplace("simulated");
    let recorded = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/recorded");
    std::fs::create_dir(place.join("run")).expect("a folder");
    std::fs::copy(recorded.with_extension("bin"), place.join("run/recording.bin")).expect("a recording");
    assert_eq!(run(&place, &["report", "run"]).status.code(), Some(1));
    let files = |place: &Path| {
        let mut files = all_below(place);
        files.retain(|(path, _)| !path.ends_with("manifest.json"));
        files
    };
    let mut before = files(&place);
    before.retain(|(path, _)| !path.ends_with("study.yaml"));
    let files = |place: &Path| {
        let mut files = files(place);
        files.retain(|(path, _)| !path.ends_with("study.yaml"));
        files
    };
    let refused = run(&place, &["loads", "net.yaml", "--out", "run"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(error(&refused).contains("holds the report of a simulated design"), "{}", error(&refused));
    std::fs::write(place.join("study.yaml"), "kind: stability\nname: x\nshares: [0.5]\nsteps: 100\n").expect("a study");
    let refused = run(&place, &["study", "study.yaml", "--out", "run"]);
    assert!(error(&refused).contains("holds the report of a simulated design"), "{}", error(&refused));
    assert!(before == files(&place), "something was changed");
}

#[test]
fn pipes_devices_and_long_files_are_refused_at_once() {
    let place = workplace("devices");
    let pipe = place.join("pipe.yaml");
    assert!(Command::new("mkfifo").arg(&pipe).status().expect("mkfifo").success());
    let long = std::fs::File::create(place.join("long.yaml")).expect("a file");
    long.set_len(1 << 40).expect("a sparse file");
    std::fs::create_dir(place.join("earlier")).expect("a folder");
    std::os::unix::fs::symlink("/dev/zero", place.join("earlier/recording.bin")).expect("a link");
    let started = std::time::Instant::now();
    for arguments in [
        &["pipe.yaml"][..],
        &["long.yaml"],
        &["/dev/zero"],
        &["study", "pipe.yaml"],
        &["study", "long.yaml"],
        &["study", "/dev/zero"],
        &["report", "earlier"],
        &["compare", "earlier", "net.yaml"],
    ] {
        let refused = run(&place, arguments);
        assert_eq!(refused.status.code(), Some(2), "{arguments:?}");
        assert!(!error(&refused).contains("panicked"), "{arguments:?}: {}", error(&refused));
    }
    assert!(started.elapsed().as_secs_f64() < 5.0, "{:?}", started.elapsed());
}

/// A recording that somebody brought is made a report of, and replaced by nothing else; nor is a run within a comparison.
#[test]
fn what_was_simulated_is_replaced_by_nothing_else() {
    let place = workplace("kinds");
    let made = run(&place, &["net.yaml", "--out", "run"]);
    assert!(matches!(made.status.code(), Some(0..=2)), "{}", error(&made));
    let recording = std::fs::read(place.join("run/recording.bin")).expect("a recording");
    std::fs::create_dir(place.join("brought")).expect("a folder");
    std::fs::write(place.join("brought/recording.bin"), &recording).expect("a recording");
    let compared = run(&place, &["compare", "run", "run", "--out", "side"]);
    assert!(matches!(compared.status.code(), Some(0..=2)), "{}", error(&compared));
    for folder in ["brought", "side/net"] {
        let before = std::fs::read(place.join(folder).join("recording.bin")).expect("a recording");
        for refused in [
            vec!["validate", "A1", "--out", folder],
            vec!["loads", "net.yaml", "--out", folder],
            vec!["compare", "run", "run", "--out", folder],
        ] {
            let refused_by = run(&place, &refused);
            assert_eq!(refused_by.status.code(), Some(2), "{refused:?}");
            assert!(error(&refused_by).contains("use "), "{}", error(&refused_by));
            assert_eq!(std::fs::read(place.join(folder).join("recording.bin")).expect("it stays"), before);
        }
    }
    // One that was cut short has a manifest and no page yet.
    for page in ["compare.html", "compare.md"] {
        std::fs::remove_file(place.join("side").join(page)).expect("a page");
    }
    let refused = run(&place, &["loads", "net.yaml", "--out", "side"]);
    assert!(error(&refused).contains("holds a comparison"), "{}", error(&refused));
    let crossed = run(&place, &["compare", "side/net_2", "side/net", "--out", "side"]);
    assert!(error(&crossed).contains("would be replaced by the report of another"), "{}", error(&crossed));
    let again = run(&place, &["report", "brought"]);
    assert!(matches!(again.status.code(), Some(0..=2)), "{}", error(&again));
    assert!(place.join("brought/report.html").is_file());
}
