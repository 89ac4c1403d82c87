//! Designs that the program writes: each is one that it reads, and that runs at once.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("new").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

fn barrier_check(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_barrier-check"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .expect("it runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn what_is_written_is_a_design_whatever_is_answered() {
    let here = folder("sound");
    for (number, barrier) in ["net", "rings", "wall"].into_iter().enumerate() {
        for (other, more) in [
            &[][..],
            &["--banks", "1:1", "--width", "4 m", "--slope", "12 deg", "--factors", "none"],
            &["--banks", "50 deg", "--density", "1500 kg/m3", "--volume", "12 m3", "--d90", "300 mm"],
        ]
        .into_iter()
        .enumerate()
        {
            let file = format!("{barrier}_{number}_{other}.yaml");
            let project = "Bach: \"oben\" \\ {1}";
            let arguments = [&["new", &file, "--barrier", barrier, "--project", project], more].concat();
            let ran = barrier_check(&here, &arguments);
            assert_eq!(ran.status.code(), Some(0), "{arguments:?}: {}", text(&ran.stderr));
            // It can be simulated, and the equations judge it.
            let dry = barrier_check(&here, &[&file, "--dry-run"]);
            assert_eq!(dry.status.code(), Some(0), "{}", text(&dry.stderr));
            let loads = barrier_check(&here, &["loads", &file, "--out", "loads"]);
            assert!(text(&loads.stdout).contains("report: "), "{}", text(&loads.stderr));
            let page = std::fs::read_to_string(here.join("loads/report.md")).expect("a report");
            assert!(page.contains("Bach: "), "{page}");
        }
    }
}

#[test]
fn a_file_is_never_replaced_and_what_is_wrong_is_told_at_once() {
    let here = folder("refused");
    std::fs::write(here.join("mine.yaml"), "mine").expect("a file");
    let ran = barrier_check(&here, &["new", "mine.yaml"]);
    assert_eq!(ran.status.code(), Some(2));
    assert_eq!(std::fs::read_to_string(here.join("mine.yaml")).expect("it"), "mine");

    let ran = barrier_check(
        &here,
        &["new", "x.yaml", "--width", "6", "--barrier", "dam", "--banks", "1:z", "--density", "heavy"],
    );
    let said = text(&ran.stderr);
    assert_eq!(ran.status.code(), Some(2));
    for told in ["--width", "`6`, a number without a unit", "net, rings or wall", "`1:z`", "--density"] {
        assert!(said.contains(told), "{told}: {said}");
    }
    // What each answer allows and all together do not is told as it is of any design.
    let ran = barrier_check(&here, &["new", "x.yaml", "--factors", "mine", "--kit", "none.yaml"]);
    let said = text(&ran.stderr);
    assert!(ran.status.code() == Some(2) && said.contains("No design was written"), "{said}");
    assert!(!here.join("x.yaml").exists());
}

#[test]
fn a_kit_supplies_the_barrier() {
    let here = folder("kit");
    std::fs::write(here.join("kit.yaml"), include_str!("../designs/kits/ring_net_4m.yaml")).expect("a kit");
    let ran = barrier_check(&here, &["new", "x.yaml", "--kit", "kit.yaml", "--banks", "1:1"]);
    assert_eq!(ran.status.code(), Some(0), "{}", text(&ran.stderr));
    assert!(std::fs::read_to_string(here.join("x.yaml")).expect("it").contains("kit: kit.yaml"));
}
