//! The same bits on machines with and without fused multiplication: nothing that a result depends on goes through the system's
//! mathematical library, which computes the last bits of sines and exponentials otherwise on each.

#![cfg(all(target_os = "linux", target_env = "gnu", target_arch = "x86_64"))]

use std::path::{Path, PathBuf};
use std::process::Command;

/// Makes the C library take the code that it has for old machines.
const OLD_MACHINE: &str = "glibc.cpu.hwcaps=-FMA,-AVX2,-FMA4";

/// All that a run of two packings says, without what the clock says.
fn what_it_says(design: &Path, out: &Path, tunables: Option<&str>) -> [String; 2] {
    let mut command = Command::new(env!("CARGO_BIN_EXE_barrier-check"));
    command.arg(design).args(["--seeds", "2", "--out"]).arg(out);
    command.env_remove("GLIBC_TUNABLES");
    if let Some(tunables) = tunables {
        command.env("GLIBC_TUNABLES", tunables);
    }
    let ran = command.output().expect("the program");
    assert!(ran.status.code().is_some_and(|code| code <= 2), "{ran:?}");
    let read = |name: &str| std::fs::read_to_string(out.join(name)).expect(name);
    let result = read("result.json");
    let timeless = result.lines().filter(|line| !line.contains("wall_clock_s") && !line.contains("sphere_steps_per_s"));
    [timeless.collect::<Vec<_>>().join("\n"), read("histories.csv")]
}

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("machines_{name}"))
}

#[test]
fn a_machine_without_fused_multiplication_gives_the_same_bits() {
    let net = include_str!("fixtures/tiny.yaml");
    // Cylinders take long: their first second tells enough.
    let cylinders = net
        .replace("barrier_model: sliding_ropes", "barrier_model: cylinders")
        .replace("longest: 20 s", "longest: 1 s");
    assert!(cylinders.contains("cylinders") && cylinders.contains("longest: 1 s"), "the fixture names both");
    let wall = include_str!("fixtures/tiny_wall.yaml");
    for (name, text) in [("net", net), ("cylinders", &cylinders), ("wall", wall)] {
        let here = folder(name);
        std::fs::create_dir_all(&here).expect("a folder");
        let design = here.join("design_file.yaml");
        std::fs::write(&design, text).expect("a file");
        let [new, old] = [("new", None), ("old", Some(OLD_MACHINE))]
            .map(|(machine, tunables)| what_it_says(&design, &here.join(machine), tunables));
        assert!(new == old, "{name}: the results differ, see {}", here.display());
    }
}
