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

const SMALL_NET: &str = include_str!("../designs/small_net.yaml");

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
