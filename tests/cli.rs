//! The program as a user meets it.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_barrier-check")).args(arguments).output().expect("program starts")
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    folder
}

fn result(folder: &Path) -> serde_json::Value {
    let text = std::fs::read_to_string(folder.join("result.json")).expect("result is written");
    serde_json::from_str(&text).expect("result is JSON")
}

#[test]
fn a_small_design_gives_a_whole_report_and_repeats_bit_for_bit() {
    let [one, two] = [("one", "1"), ("two", "2")].map(|(name, threads)| {
        let out = folder(name);
        let started = std::time::Instant::now();
        let path = out.to_str().expect("path");
        let output = run(&["designs/small_net.yaml", "--seeds", "5", "--threads", threads, "--out", path]);
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        // One line every ten seconds, where a busy machine takes so long.
        let lines = String::from_utf8_lossy(&output.stderr).lines().count() as u64;
        assert!(lines <= started.elapsed().as_secs() / 10, "progress must be quiet when not a terminal");
        out
    });
    for name in ["report.html", "report.md", "result.json", "histories.csv"] {
        assert!(one.join(name).is_file(), "{name} is missing");
    }
    let csv = |folder: &Path| std::fs::read(folder.join("histories.csv")).expect("histories");
    assert_eq!(csv(&one), csv(&two), "the result depends on the number of threads");
    // What the grains at rest and the moving ones push adds up to the force: at rest, where nothing changes from step to step.
    let text = String::from_utf8(csv(&one)).expect("text");
    let last = |name: &str| -> f64 {
        let column = text.lines().next().and_then(|head| head.split(',').position(|column| column == name));
        let value = text.lines().last().and_then(|row| row.split(',').nth(column.expect(name)));
        value.expect("a value").parse().expect("a number")
    };
    let [force, at_rest, moving] = ["force_x_n", "touch_of_grains_at_rest_n", "touch_of_grains_moving_n"].map(last);
    assert!(at_rest > 0.9 * force && ((at_rest + moving) / force - 1.0).abs() < 0.02, "{force} {at_rest} {moving}");
    let html = std::fs::read_to_string(one.join("report.html")).expect("report");
    assert!(!html.contains("http://") && !html.contains("https://"), "the report must open offline");
    let mut result = result(&one);
    assert_eq!(result["verdict"], "pass");
    assert!(result["numerics"]["energy_error_relative"].as_f64().expect("number").abs() < 0.001);
    // The contract: names of all fields, down to the arrays.
    insta::assert_json_snapshot!(shape(&mut result));
}

/// The barrier of cylinders takes several steps in one of the grains' and ends with much the same loads; a run cut short before the
/// flow is at rest is no pass, and repeats bit for bit.
#[test]
fn a_barrier_of_cylinders_repeats_bit_for_bit_and_is_no_pass_when_cut_short() {
    let text = std::fs::read_to_string("designs/small_net.yaml").expect("design");
    let text = text.replace("barrier_model: sliding_ropes", "barrier_model: cylinders");
    let (head, tail) = text.split_once("longest: ").expect("a longest time");
    let (_, tail) = tail.split_once(" s").expect("with its unit");
    let design = folder("cylinders").with_extension("yaml");
    std::fs::write(&design, format!("{head}longest: 1.1 s{tail}")).expect("design is written");
    let [one, two] = [("cylinders_one", "1"), ("cylinders_two", "2")].map(|(name, threads)| {
        let out = folder(name);
        let paths = [&design, &out].map(|path| path.to_str().expect("path"));
        let output = run(&[paths[0], "--threads", threads, "--out", paths[1]]);
        assert_eq!(output.status.code(), Some(2), "{}", String::from_utf8_lossy(&output.stdout));
        out
    });
    let csv = |folder: &Path| std::fs::read(folder.join("histories.csv")).expect("histories");
    assert_eq!(csv(&one), csv(&two), "the result depends on the number of threads");
    let result = result(&one);
    assert_eq!(result["verdict"], "undecided");
    let numerics = &result["numerics"];
    assert!(numerics["barrier_steps_per_step"].as_u64().expect("number") > 1);
    assert_eq!(numerics["rope_crossings"], 0);
    assert!(numerics["energy_error_relative"].as_f64().expect("number").abs() < 0.005);
    let peak = result["simulation"]["force_total_peak_n"].as_f64().expect("number");
    // Ropes that slide give 119 kN, give or take 20 kN from packing to packing.
    assert!((0.9e5..1.6e5).contains(&peak), "{peak}");
}

/// Replaces every number by 0 and keeps one element of each list: what remains is the contract.
fn shape(value: &mut serde_json::Value) -> serde_json::Value {
    use serde_json::Value;
    match value {
        Value::Object(map) => Value::Object(map.iter_mut().map(|(key, value)| (key.clone(), shape(value))).collect()),
        Value::Array(items) => Value::Array(items.iter_mut().take(1).map(shape).collect()),
        Value::Number(_) => Value::from(0),
        Value::String(_) => Value::from("text"),
        other => other.clone(),
    }
}

#[test]
fn the_equations_alone_take_no_time_and_judge_what_they_can() {
    let out = folder("loads");
    let started = std::time::Instant::now();
    let output = run(&["loads", "designs/small_net.yaml", "--out", out.to_str().expect("path")]);
    assert!(started.elapsed().as_secs_f64() < 0.5, "{:?}", started.elapsed());
    // What the equations cannot judge is open, and so is the design.
    assert_eq!(output.status.code(), Some(2), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    let result = result(&out);
    assert!(result["simulation"].is_null() && !out.join("histories.csv").exists());
    let checks = result["checks"].as_array().expect("checks");
    assert!(checks.iter().all(|check| check["demand_simulation"].is_null()));
    let verdict = |id: &str| checks.iter().find(|check| check["id"] == id).expect("a check")["verdict"].clone();
    assert_eq!(verdict("rope_2_tension"), "pass");
    for id in ["net_tension", "lateral_tension", "bed_bolts", "retained_mass", "residual_height"] {
        assert_eq!(verdict(id), "open", "{id}");
    }
    // A wall without resistance leaves nothing to judge: that is no pass.
    let out = folder("loads_wall");
    let text = std::fs::read_to_string("designs/rigid_wall.yaml").expect("design");
    let bare: Vec<&str> = text.lines().filter(|line| !line.trim_start().starts_with("resistance:")).collect();
    let design = out.with_extension("yaml");
    std::fs::write(&design, bare.join("\n")).expect("design is written");
    let [design, out] = [&design, &out].map(|path| path.to_str().expect("path"));
    let output = run(&["loads", design, "--out", out]);
    assert_eq!(output.status.code(), Some(2));
}

/// The equations of the report, worked out again from its own text: what stands before the last `=` gives what stands after it.
#[test]
fn every_load_case_is_worked_out_to_the_force_it_tells() {
    let exports = "\nloads:\n  overflow_depth: 0.5 m\n  overflow_friction: 25 deg\n  overflow_length: 1 m\n  snow_pressure: 3 kPa\n  point_load:\n    force: 20 kN\n    height: 1 m\n  drained:\n    earth_pressure_k: 0.5\n    density: 1300 kg/m3\n";
    let text = std::fs::read_to_string("designs/small_net.yaml").expect("design") + exports;
    let out = folder("workings");
    let design = out.with_extension("yaml");
    std::fs::write(&design, text).expect("design is written");
    let [path, to] = [&design, &out].map(|path| path.to_str().expect("path"));
    run(&["loads", path, "--out", to]);
    let report = std::fs::read_to_string(out.join("report.md")).expect("report");
    let result = result(&out);
    let cases = result["guideline"]["cases"].as_array().expect("cases");
    let lines: Vec<&str> = report.lines().filter(|line| line.contains(" R = ") && line.contains("Source:")).collect();
    assert_eq!(lines.len(), cases.len());
    assert!(cases.len() >= 7, "{}", cases.len());
    for (line, case) in lines.iter().zip(cases) {
        let (_, equation) = line.rsplit_once("R = ").expect("an equation");
        let (body, _) = equation.split_once(" = ").expect("its result");
        let force = case["force_n_per_m"].as_f64().expect("number") / 1e3;
        assert!((worked_out(body) - force).abs() < 0.01 * force, "{line}: {} {force}", worked_out(body));
    }
}

/// Value of a sum of products as the report writes them: `½ · 1.2 · (3² + 2 · 3 · 0.5) + 4.0 · 0.5 (words)`.
fn worked_out(text: &str) -> f64 {
    let mut depth = 0;
    let mut terms = vec![(1.0, String::new())];
    for letter in text.chars() {
        depth += i32::from(letter == '(') - i32::from(letter == ')');
        match letter {
            '+' if depth == 0 => terms.push((1.0, String::new())),
            '−' if depth == 0 => terms.push((-1.0, String::new())),
            _ => terms.last_mut().expect("a term").1.push(letter),
        }
    }
    terms.iter().map(|(sign, term)| sign * product(term)).sum()
}

fn product(term: &str) -> f64 {
    let mut value = 1.0;
    let mut rest = term.trim();
    while !rest.is_empty() {
        if let Some(inner) = rest.strip_prefix('(') {
            let end = inner.find(')').expect("a closing bracket");
            if inner[..end].chars().all(|letter| !letter.is_alphabetic()) {
                value *= worked_out(&inner[..end]);
            }
            rest = &inner[end + 1..];
        } else {
            let (factor, more) = rest.split_once([' ', '·']).unwrap_or((rest, ""));
            let squared = factor.ends_with('²');
            let number = factor.trim_end_matches('²');
            let number: f64 = if number == "½" { 0.5 } else { number.parse().expect("a number") };
            value *= if squared { number * number } else { number };
            rest = more;
        }
        rest = rest.trim_start_matches([' ', '·']);
    }
    value
}

/// Several starts give their mean and scatter, side by side or one after the other, and their scatter enters the demand.
#[test]
fn the_scatter_of_several_starts_enters_the_verdict() {
    let [one, two] = [("starts_one", "1"), ("starts_two", "2")].map(|(name, threads)| {
        let out = folder(name);
        let path = out.to_str().expect("path");
        run(&["designs/small_net.yaml", "--seeds", "3", "--threads", threads, "--out", path]);
        result(&out)
    });
    assert_eq!(one["checks"], two["checks"]);
    assert_eq!(one["starts"], two["starts"]);
    let of = |list: &str, id: &str| {
        one[list].as_array().expect("list").iter().find(|item| item["id"] == id).expect("item").clone()
    };
    let number = |value: &serde_json::Value| value.as_f64().expect("number");
    let (spread, check) = (of("starts", "net_tension"), of("checks", "net_tension"));
    // k_n of EN 1990, annex D, for three values; small_net has no factor on loads.
    let expected = number(&spread["mean"]) + 3.372 * number(&spread["deviation"]);
    let demand = number(&check["demand_simulation"]);
    assert!((demand / expected - 1.0).abs() < 1e-3, "{demand} {expected}");
}

#[test]
fn bad_input_ends_with_two_and_writes_nothing() {
    let out = folder("bad");
    let output = run(&["tests/bad_designs/several_at_once.yaml", "--out", out.to_str().expect("path")]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("3 problems"));
    assert!(!out.exists());
    assert_eq!(run(&["designs/no_such_file.yaml"]).status.code(), Some(2));
    assert_eq!(run(&["designs"]).status.code(), Some(2));
    assert_eq!(run(&["--no-such-option"]).status.code(), Some(2));
}

#[test]
fn a_run_that_cannot_finish_is_undecided() {
    let design =
        std::fs::read_to_string("designs/small_net.yaml").expect("design").replace("longest: 20 s", "longest: 0.3 s");
    let out = folder("unfinished");
    let path = out.with_extension("yaml");
    std::fs::write(&path, design).expect("design is written");
    let output = run(&[path.to_str().expect("path"), "--out", out.to_str().expect("path")]);
    assert_eq!(output.status.code(), Some(2));
    let result = result(&out);
    assert_eq!(result["verdict"], "undecided");
    assert!(result["doubts"][0].as_str().expect("text").contains("longest simulated time"));
}

#[test]
fn schemas_are_valid_json_and_know_the_contract() {
    for (of, key) in [("design", "channel"), ("result", "numerics")] {
        let output = run(&["schema", of]);
        assert!(output.status.success());
        let schema: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert!(schema["properties"][key].is_object(), "{of} has no {key}");
    }
}

#[test]
fn one_two_and_seven_threads_give_the_same_numbers() {
    let numbers = |design: &str, threads: &str| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("threads_{design}_{threads}"));
        let out = folder.display().to_string();
        run(&[&format!("tests/fixtures/{design}.yaml"), "--threads", threads, "--seeds", "2", "--out", &out]);
        let result = result(&folder);
        let csv = std::fs::read(folder.join("histories.csv")).expect("histories");
        (
            result["simulation"].clone(),
            result["starts"].clone(),
            result["checks"].clone(),
            result["surges"].clone(),
            csv,
        )
    };
    for design in ["tiny", "tiny_surges", "tiny_wet", "tiny_inlet", "tiny_boulders", "tiny_rings"] {
        let one = numbers(design, "1");
        assert!(
            one == numbers(design, "2") && one == numbers(design, "7"),
            "the result of {design} depends on the number of threads"
        );
    }
}

#[test]
fn a_dry_run_tells_and_runs_nothing() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("dry");
    let _ = std::fs::remove_dir_all(&folder);
    let out = folder.display().to_string();
    let told = run(&["designs/site_a.yaml", "--dry-run", "--out", &out]);
    let text = String::from_utf8_lossy(&told.stdout).into_owned();
    assert_eq!(told.status.code(), Some(0), "{text}");
    assert!(text.contains("grains            2646 of 5291 spheres") && text.contains("memory"), "{text}");
    assert!(!folder.exists());
}
