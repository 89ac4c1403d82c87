//! Every rule of the design file has a fixture, and its message is a snapshot beside it.

use std::path::Path;
use std::time::{Duration, Instant};

use barrier_check::design::entries::Purpose;
use barrier_check::design::read::{read_design, read_design_for};

#[test]
fn every_bad_design_gets_its_message() {
    insta::glob!("bad_designs/*.yaml", |path| {
        let bytes = std::fs::read(path).expect("fixture is readable");
        let name = path.file_name().expect("fixture has a name").to_string_lossy().into_owned();
        let started = Instant::now();
        let folder = path.parent().expect("fixture has a folder");
        let open = |other: &str| std::fs::read(folder.join(other)).map_err(|_| "there is no such file".to_string());
        let problems =
            read_design_for(Purpose::Simulation, &name, &bytes, &open).expect_err("fixture is wrong on purpose");
        assert!(started.elapsed() < Duration::from_secs(1), "{name} took {:?}", started.elapsed());
        insta::assert_snapshot!(problems.to_string());
    });
}

#[test]
fn the_shipped_designs_are_good() {
    for entry in std::fs::read_dir("designs").expect("folder of designs") {
        let path = entry.expect("entry").path();
        if path.extension().is_some_and(|extension| extension == "yaml") {
            let bytes = std::fs::read(&path).expect("design is readable");
            let open = |other: &str| {
                std::fs::read(std::path::Path::new("designs").join(other)).map_err(|error| error.to_string())
            };
            if let Err(problems) = read_design_for(Purpose::Simulation, &path.display().to_string(), &bytes, &open) {
                panic!("{problems}");
            }
        }
    }
}

#[test]
fn the_design_of_the_readme_is_good() {
    let readme = include_str!("../README.md");
    let design = readme.split("```yaml\n").nth(1).and_then(|rest| rest.split("```").next()).expect("a design");
    if let Err(problems) = read_design("README.md", design.as_bytes()) {
        panic!("{problems}");
    }
}

#[test]
fn a_huge_file_and_a_byte_order_mark() {
    let huge = vec![b'#'; 3 << 20];
    let problems = read_design("huge.yaml", &huge).expect_err("too large");
    assert!(problems.to_string().contains("at most 1 MiB"), "{problems}");
    let mut marked = b"\xef\xbb\xbf".to_vec();
    marked.extend(std::fs::read(Path::new("designs/small_net.yaml")).expect("design is readable"));
    assert!(read_design("marked.yaml", &marked).is_ok());
}

/// Cutting a good design anywhere, or changing one byte, must give an error or a design, never a panic.
#[test]
fn no_cut_and_no_changed_byte_panics() {
    let bytes = std::fs::read("designs/small_net.yaml").expect("design is readable");
    for end in (0..bytes.len()).step_by(37) {
        let _ = read_design("cut.yaml", &bytes[..end]);
    }
    for place in (0..bytes.len()).step_by(23) {
        for byte in [0_u8, b':', b'-', b'&', 0xff] {
            let mut changed = bytes.clone();
            changed[place] = byte;
            let _ = read_design("changed.yaml", &changed);
        }
    }
}
