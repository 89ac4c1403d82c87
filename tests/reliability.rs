//! The probability that a barrier fails, through the whole program, against what can be worked out by hand.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const SMALL_NET: &str = include_str!("../designs/small_net.yaml");

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("reliability").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join("small_net.yaml"), SMALL_NET).expect("a design");
    folder
}

fn study(folder: &Path, plan: &str, threads: &str) -> Output {
    std::fs::write(folder.join("plan.yaml"), plan).expect("a plan");
    Command::new(env!("CARGO_BIN_EXE_barrier-check"))
        .args(["study", "plan.yaml", "--out", "found"])
        .env("RAYON_NUM_THREADS", threads)
        .current_dir(folder)
        .output()
        .expect("it runs")
}

fn json(folder: &Path) -> serde_json::Value {
    let text = std::fs::read_to_string(folder.join("found/reliability.json")).expect("a result");
    let json = serde_json::from_str(&text).expect("JSON");
    let schema =
        Command::new(env!("CARGO_BIN_EXE_barrier-check")).args(["schema", "reliability"]).output().expect("it runs");
    let schema = serde_json::from_slice(&schema.stdout).expect("a schema");
    let valid = jsonschema::validator_for(&schema).expect("a schema");
    valid.validate(&json).unwrap_or_else(|error| panic!("{error}"));
    json
}

fn said(ran: &Output) -> String {
    String::from_utf8_lossy(&ran.stdout).into_owned() + &String::from_utf8_lossy(&ran.stderr)
}

/// An anchor against the force of a yielding dissipator with an overstrength of 1.15, both lognormal: the probability is Φ(−β),
/// β = ln(m_R / 1.15 m_S) / √(σ_R² + σ_S²) with the medians m and the deviations σ of the logarithms.
const ANCHORS: &str = "kind: reliability
name: anchors
design: small_net.yaml
by: equations
checks: [anchor_plateau]
inputs:
  - key: barrier.flexible_net.dissipators.plateau_force
    lognormal: {mean: 150 kN, variation: 10 %}
    origin: a test
  - key: barrier.flexible_net.anchors.resistance
    lognormal: {mean: 250 kN, deviation: 37.5 kN}
";

fn exact() -> f64 {
    let logarithm = |mean: f64, variation: f64| {
        let variance = libm::log1p(variation * variation);
        (libm::log(mean) - 0.5 * variance, variance)
    };
    let ((load, load_variance), (strength, variance)) = (logarithm(150.0, 0.1), logarithm(250.0, 0.15));
    let beta = (strength - load - libm::log(1.15)) / (load_variance + variance).sqrt();
    0.5 * libm::erfc(beta / 2.0_f64.sqrt())
}

#[test]
fn the_probability_of_two_lognormal_numbers_is_that_of_the_closed_form() {
    let here = folder("closed");
    let ran = study(&here, &format!("{ANCHORS}accuracy: 5 %\n"), "2");
    // Without a target nothing is judged.
    assert_eq!(ran.status.code(), Some(0), "{}", said(&ran));
    let found = json(&here);
    let part = |name: &str| found["probability"][name].as_f64().expect("a number");
    let exact = exact();
    assert!(part("low") <= exact && exact <= part("high"), "{} {exact}", found["probability"]);
    let check = &found["checks"][0];
    // The limit is no plane in u, as the ratio of the two is asked of; the point itself is exact.
    let beta = check["form_index"].as_f64().expect("an index");
    assert!((0.5 * libm::erfc(beta / 2.0_f64.sqrt()) / exact - 1.0).abs() < 0.01, "{beta}");
    let [plateau, resistance] = [0, 1].map(|number| check["design_point"][number].as_f64().expect("a value"));
    assert!((1.15 * plateau / resistance - 1.0).abs() < 1e-3, "{plateau} kN, {resistance} kN");
    assert!(check["alpha"][0].as_f64() > Some(0.0) && check["alpha"][1].as_f64() < Some(0.0));
    // By the variances of the logarithms: 0.00995 and 0.02225.
    let total = |number: usize| found["inputs"][number]["sobol_total"].as_f64().expect("an index");
    assert!((total(0) - 0.31).abs() < 0.06 && (total(1) - 0.69).abs() < 0.08, "{} {}", total(0), total(1));
    let page = std::fs::read_to_string(here.join("found/reliability.md")).expect("a page");
    assert!(page.contains("No target is given") && page.contains("| not given |"), "{page}");
    // The same on one thread.
    std::fs::remove_file(here.join("found/reliability.json")).expect("a result");
    study(&here, &format!("{ANCHORS}accuracy: 5 %\n"), "1");
    assert_eq!(json(&here), found);
}

/// The whole interval below the target, above it, and around it: a probability may fail a barrier, and never passes one.
#[test]
fn a_probability_never_passes_a_barrier() {
    let here = folder("target");
    let code = |plan: &str| study(&here, plan, "2").status.code();
    let exact = exact();
    assert_eq!(code(&format!("{ANCHORS}target: {}\n", 1.5 * exact)), Some(2));
    assert_eq!(code(&format!("{ANCHORS}target: {}\n", 0.5 * exact)), Some(1));
    assert_eq!(code(&format!("{ANCHORS}target: {exact}\nsamples: 3000\n")), Some(2));
    let all = ANCHORS.replace("checks: [anchor_plateau]\n", "");
    assert_eq!(code(&format!("{all}target: 0.5\nsamples: 500\n")), Some(2));
    let page = std::fs::read_to_string(here.join("found/reliability.md")).expect("a page");
    assert!(page.contains("Not judged, and not in the probability:") && page.contains("UNDECIDED"), "{page}");
    // What parts are to each other is no failure in the event.
    assert!(!page.contains("| Anchors against the force of a yielding dissipator |"), "{page}");
    // A sample that is no design counts as failed.
    let beyond = ANCHORS.replace("lognormal: {mean: 150 kN, variation: 10 %}", "uniform: {from: -5 kN, to: 150 kN}");
    let ran = study(&here, &format!("{beyond}target: 1e-9\nsamples: 500\n"), "2");
    assert_eq!(ran.status.code(), Some(1), "{}", said(&ran));
    let found = json(&here);
    let [refused, failing] = [&found["refused"], &found["probability"]["value"]].map(|it| it.as_f64());
    assert!(refused.expect("a count") > 0.0 && failing.expect("a number") > 0.0, "{found}");
}

#[test]
fn a_fragility_rises_with_the_event_and_correlation_moves_the_probability() {
    let here = folder("fragility");
    let events = "fragility:
  key: barrier.flexible_net.dissipators.plateau_force
  values: [130 kN, 170 kN, 210 kN, 250 kN]
";
    study(&here, &format!("{ANCHORS}{events}"), "2");
    let found = json(&here);
    let at: Vec<f64> =
        (0..4).map(|n| found["fragility"][n]["probability"]["value"].as_f64().expect("a number")).collect();
    assert!(at.windows(2).all(|pair| pair[0] < pair[1]), "{at:?}");
    // Fixed plateau 170 kN: Φ((ln 1.15·170 − ln m_R)/σ_R) = 0.0648.
    assert!((at[1] - 0.0648).abs() < 0.015, "{at:?}");
    let free = found["probability"]["value"].as_f64().expect("a number");
    let together = "correlations:
  - between: [barrier.flexible_net.dissipators.plateau_force, barrier.flexible_net.anchors.resistance]
    rank: 0.8
";
    study(&here, &format!("{ANCHORS}{together}"), "2");
    let found = json(&here);
    assert!(found["probability"]["value"].as_f64().expect("a number") < 0.3 * free, "{}", found["probability"]);
    assert!(found["inputs"][0]["sobol_total"].is_null());
}

#[test]
fn a_plan_that_is_wrong_is_told_with_all_that_is_wrong() {
    let here = folder("wrong");
    let wrong = ANCHORS
        .replace("{mean: 150 kN, variation: 10 %}", "{mean: 150 kN}")
        .replace("lognormal: {mean: 250 kN, deviation: 37.5 kN}", "normal: {mean: 250 kN, deviation: 37.5 N}");
    let ran = study(&here, &format!("{wrong}target: 7\nsamples: 3\nset: {{project.name: x}}\n"), "2");
    let told = said(&ran);
    assert_eq!(ran.status.code(), Some(2));
    for part in [
        ": inputs.0\n  found:   a mean without its scatter",
        ": inputs.1\n  found:   37.5 N\n  allowed: the unit of the values before it, kN\n",
        ": target\n  found:   7\n",
        ": samples\n  found:   3\n  allowed: 100 to 100000000\n",
    ] {
        assert!(told.contains(part), "{part}: {told}");
    }
    for (from, to, part) in [
        ("plateau_force\n", "plateau\n", "plateau"),
        ("[anchor_plateau]", "[anchor]", "found anchor, which is no check of this design"),
        ("150 kN", "150 bananas", "bananas"),
    ] {
        let ran = study(&here, &ANCHORS.replace(from, to), "2");
        let told = said(&ran);
        assert!(ran.status.code() == Some(2) && told.contains(part), "{part}: {told}");
    }
    assert!(!here.join("found/reliability.json").exists());
    let pair = "{between: [barrier.flexible_net.dissipators.plateau_force, barrier.flexible_net.anchors.resistance], rank: 0.5}";
    let ran = study(&here, &format!("{ANCHORS}correlations: [{pair}, {pair}]\n"), "2");
    assert!(ran.status.code() == Some(2) && said(&ran).contains("found:   a pair again"), "{}", said(&ran));
}

/// A factor that the study gives stays, though all others are 1.
#[test]
fn a_factor_that_the_study_gives_stays() {
    let here = folder("factor");
    let used = |set: &str| {
        study(&here, &format!("{ANCHORS}samples: 100\n{set}"), "2");
        json(&here)["checks"][0]["utilisation_at_medians"].as_f64().expect("a number")
    };
    let (free, with_factor) = (used(""), used("set: {factors.anchor: 2}\n"));
    assert!((with_factor / free - 2.0).abs() < 1e-9, "{free} {with_factor}");
}
