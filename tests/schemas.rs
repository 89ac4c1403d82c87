//! The JSON Schemas hold what the program takes and gives, and refuse what it refuses.

use std::path::Path;
use std::process::Command;

use serde_json::{Value, json};

fn schema(of: &str) -> Value {
    let output = Command::new(env!("CARGO_BIN_EXE_barrier-check")).args(["schema", of]).output().expect("the program");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn validator(of: &str) -> jsonschema::Validator {
    jsonschema::validator_for(&schema(of)).expect("a schema")
}

fn design(text: &str) -> Value {
    serde_yaml::from_str(text).expect("YAML")
}

const SMALL_NET: &str = include_str!("fixtures/even_net.yaml");

#[test]
fn what_the_program_takes_is_valid() {
    let validator = validator("design");
    for entry in std::fs::read_dir("designs").expect("designs") {
        let path = entry.expect("entry").path();
        if path.extension().is_some_and(|extension| extension == "yaml") {
            let text = std::fs::read_to_string(&path).expect("a design");
            validator.validate(&design(&text)).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        }
    }
    for (from, to) in [
        ("slope: 25 deg", "slope: 25°"),
        ("1400 kg/m3", "1400 kg/m³"),
        ("1400 kg/m3", "1.4e3 kg/m^3"),
        ("volume: 5 m3", "mass: 7 t"),
        ("count: 3   ", "heights: [0 m, 0.9 m, 1.8 m] "),
        ("revision: A  ", "revision: 1.10  "),
        ("mesh_opening: 200 mm", "mesh_opening: D30"),
        ("mesh_opening: 200 mm", "mesh_opening: 0.9 D30"),
    ] {
        let text = SMALL_NET.replacen(from, to, 1);
        assert_ne!(text, SMALL_NET, "{from}");
        barrier_check::design::read::read_design("x", text.as_bytes())
            .unwrap_or_else(|problems| panic!("{to}: {problems}"));
        validator.validate(&design(&text)).unwrap_or_else(|error| panic!("{to}: {error}"));
    }
}

#[test]
fn what_the_program_refuses_is_not() {
    let validator = validator("design");
    for (from, to) in [
        ("volume: 5 m3", "mass: 7 t\n  volume: 5 m3"),
        ("volume: 5 m3 ", ""),
        ("count: 3 ", "heights: [0 m, 1.8 m]\n      count: 3 "),
        ("width: 3 m", "width: 3"),
        ("width: 3 m", "width: 3 kN"),
        ("width: 3 m", "breadth: 3 m"),
        ("rope: 1.5", "rope: 0.5"),
    ] {
        let text = SMALL_NET.replacen(from, to, 1);
        assert_ne!(text, SMALL_NET, "{from}");
        assert!(barrier_check::design::read::read_design("x", text.as_bytes()).is_err(), "{to:?}");
        assert!(!validator.is_valid(&design(&text)), "{to:?}");
    }
}

/// Results with and without simulation, and one whose numbers are not all finite.
#[test]
fn a_study_that_the_program_takes_is_valid_and_one_with_a_wrong_key_is_not() {
    let validator = validator("study");
    let mut seen = 0;
    for entry in std::fs::read_dir("designs/studies").expect("the folder").flatten() {
        if entry.path().extension().is_none_or(|ending| ending != "yaml") {
            continue;
        }
        let study = design(&std::fs::read_to_string(entry.path()).expect("a study"));
        let wrong: Vec<String> = validator.iter_errors(&study).map(|error| error.to_string()).collect();
        assert!(wrong.is_empty(), "{}: {wrong:#?}", entry.path().display());
        let mut spoilt = study;
        spoilt["nam"] = "x".into();
        assert!(!validator.is_valid(&spoilt), "{}", entry.path().display());
        seen += 1;
    }
    assert!(seen >= 8);
}

#[test]
fn what_the_program_gives_is_valid() {
    let validator = validator("result");
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("schemas");
    let _ = std::fs::remove_dir_all(&out);
    let missed = include_str!("fixtures/tiny_wall.yaml")
        .replace("slope: 25 deg", "slope: 0 deg")
        .replace("velocity: 4.6 m/s", "velocity: 0.05 m/s")
        .replace("longest: 20 s", "longest: 0.5 s");
    std::fs::create_dir_all(&out).expect("a folder");
    std::fs::write(out.join("missed.yaml"), missed).expect("a design");
    let missed = out.join("missed.yaml");
    for (name, arguments) in [
        ("net", vec!["tests/fixtures/tiny.yaml"]),
        ("loads", vec!["loads", "tests/fixtures/tiny.yaml"]),
        ("missed", vec![missed.to_str().expect("text")]),
    ] {
        let folder = out.join(name);
        let mut command = Command::new(env!("CARGO_BIN_EXE_barrier-check"));
        command.args(arguments).arg("--out").arg(&folder).output().expect("the program");
        let text = std::fs::read_to_string(folder.join("result.json")).expect("a result");
        let result: Value = serde_json::from_str(&text).expect("JSON");
        validator.validate(&result).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}

/// Defaults have the type of what they stand for, and nothing needs more than the draft that every validator knows.
#[test]
fn the_schemas_are_plain() {
    fn walk(schema: &Value, seen: &mut dyn FnMut(&serde_json::Map<String, Value>)) {
        match schema {
            Value::Object(map) => {
                seen(map);
                map.values().for_each(|inner| walk(inner, seen));
            }
            Value::Array(items) => items.iter().for_each(|inner| walk(inner, seen)),
            _ => {}
        }
    }
    for of in ["design", "result", "size", "reliability", "sweep"] {
        let schema = schema(of);
        assert_eq!(schema["$schema"], json!("http://json-schema.org/draft-07/schema#"));
        walk(&schema, &mut |map| {
            assert!(!map.get("format").is_some_and(Value::is_string), "{map:?}");
            if let (Some(default), Some(kind)) = (map.get("default"), map.get("type")) {
                let number = kind == "number" || kind == "integer";
                assert_eq!(default.is_number(), number, "{map:?}");
            }
        });
    }
}

/// What editors and scripts are told: a design on standard input, right or wrong, gives one document that its schema holds.
#[test]
fn what_a_command_tells_in_json_is_valid() {
    let told = |text: &str, arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_barrier-check"));
        let mut child = command
            .args(arguments)
            .stdin(std::process::Stdio::piped())
            .stdout(std::process::Stdio::piped())
            .stderr(std::process::Stdio::piped())
            .spawn()
            .expect("the program");
        std::io::Write::write_all(&mut child.stdin.take().expect("input"), text.as_bytes()).expect("written");
        let output = child.wait_with_output().expect("an end");
        let told: Value = serde_json::from_slice(&output.stdout).expect("one JSON document");
        validator("messages").validate(&told).unwrap_or_else(|error| panic!("{error}: {told}"));
        (output.status.code(), told)
    };
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("told");
    let out = out.to_str().expect("a path");
    let loads = ["loads", "-", "--format", "json", "--out", out];

    let (code, wrong) =
        told(&SMALL_NET.replacen("width: 3 m", "width: 3", 1).replacen("revision", "revison", 1), &loads);
    assert_eq!((code, &wrong["verdict"], &wrong["design"]), (Some(2), &Value::Null, &json!("stdin")));
    let problem = |path: &str| {
        let list = wrong["problems"].as_array().expect("problems");
        list.iter().find(|problem| problem["path"] == path).expect(path).clone()
    };
    let line = 1 + SMALL_NET.lines().position(|line| line.contains("width: 3 m")).expect("a width");
    assert_eq!(problem("channel.width")["line"], line);
    assert_eq!(problem("project.revison")["hint"], "did you mean `revision`?");

    let (code, right) = told(SMALL_NET, &loads);
    assert_eq!((code, &right["verdict"], &right["report"]), (Some(2), &json!("undecided"), &json!(out)));
    assert_eq!(right["problems"], json!([]));

    let (code, estimated) = told(SMALL_NET, &["-", "--dry-run", "--format", "json"]);
    assert_eq!((code, &estimated["estimate"]["simulations"]), (Some(0), &json!(1)));
    assert!(estimated["estimate"]["grains"].as_f64().expect("a number") > 300.0);
}
