//! The cheapest barrier that passes, as the program seeks it, against every way tried by hand.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("sizing").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

fn barrier_check(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_barrier-check")).args(arguments).current_dir(folder).output().expect("it runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

const SMALL_NET: &str = include_str!("../designs/small_net.yaml");
/// The first is refuted by the equations, the second is close to its limit, and the last is that of the example.
const ANCHORS: [&str; 4] = ["150 kN", "200 kN", "240 kN", "290 kN"];
const PLAN: &str = "kind: size
name: cheapest
design: small_net.yaml
packings: 5
choices:
  - key: barrier.flexible_net.anchors.resistance
    values: [150 kN, 200 kN, 240 kN, 290 kN]
prices:
  currency: CHF
  items:
    - {of: anchor_resistance, price: 2, origin: a test}
    - {of: steel_mass, price: 1}
";

#[test]
fn the_cheapest_net_is_that_of_trying_them_all() {
    let here = folder("net");
    std::fs::write(here.join("small_net.yaml"), SMALL_NET).expect("a design");
    std::fs::write(here.join("plan.yaml"), PLAN).expect("a plan");
    let started = std::time::Instant::now();
    let ran = barrier_check(&here, &["study", "plan.yaml", "--out", "found"]);
    let took = started.elapsed();
    let said = text(&ran.stdout) + &text(&ran.stderr);
    assert_eq!(ran.status.code(), Some(0), "{said}");
    let read = |name: &str| std::fs::read_to_string(here.join("found").join(name)).expect(name);
    let json: serde_json::Value = serde_json::from_str(&read("size.json")).expect("JSON");
    let number = json["cheapest"]["number"].as_u64().expect("a cheapest") as usize;
    assert_eq!(json["cheapest"]["fate"]["is"], "passes");
    assert_eq!(json["cheapest"]["fate"]["by"], "5 simulations");

    // By hand: it passes, and none that costs less does.
    let passes = |anchor: &str| {
        let changed = SMALL_NET.replace("resistance: 290 kN", &format!("resistance: {anchor}"));
        std::fs::write(here.join("one.yaml"), changed).expect("a design");
        barrier_check(&here, &["one.yaml", "--seeds", "5", "--out", "one"]).status.code() == Some(0)
    };
    assert!(number > 0, "a choice in which something fails\n{}", read("size.csv"));
    for cheaper in &ANCHORS[..number] {
        assert!(!passes(cheaper), "{cheaper}\n{}", read("size.csv"));
    }
    assert!(passes(ANCHORS[number]), "{}", read("size.csv"));

    // Four anchors at 2 CHF per kN, and the steel.
    let price = json["cheapest"]["price"].as_f64().expect("a price");
    let anchor: f64 = ANCHORS[number].trim_end_matches(" kN").parse().expect("a number");
    assert!((price - 8.0 * anchor - 124.46).abs() < 0.1, "{price}");

    // What is written as a design is that design: it costs and passes the same.
    let written = read("cheapest.yaml");
    assert!(written.contains(&format!("resistance: \"{}\"", ANCHORS[number])), "{written}");
    std::fs::write(here.join("cheapest.yaml"), written).expect("a design");
    let again = PLAN.replace("small_net.yaml", "cheapest.yaml").replace(&ANCHORS.join(", "), ANCHORS[number]);
    std::fs::write(here.join("again.yaml"), again).expect("a plan");
    assert_eq!(barrier_check(&here, &["study", "again.yaml", "--out", "again"]).status.code(), Some(0));
    let once = std::fs::read_to_string(here.join("again/size.json")).expect("a result");
    let once: serde_json::Value = serde_json::from_str(&once).expect("JSON");
    assert_eq!(once["cheapest"]["price"], json["cheapest"]["price"]);
    assert_eq!(once["cheapest"]["fate"], json["cheapest"]["fate"]);

    // Nothing is simulated twice: with what is kept the search takes a moment, and finds the same.
    let before = (read("size.csv"), read("size.json"));
    let started = std::time::Instant::now();
    let again = barrier_check(&here, &["study", "plan.yaml", "--out", "found"]);
    assert_eq!(again.status.code(), Some(0));
    // A simulation of this net takes seconds; six of them were kept.
    assert!(started.elapsed() < took / 3, "{:?} after {took:?}", started.elapsed());
    assert_eq!((read("size.csv"), read("size.json")), before);
    let page = read("size.html");
    assert!(page.contains("The cheapest barrier that passes costs") && page.contains("CHF"));
}

/// By the equations alone a net never passes, and the study does not say that one does.
#[test]
fn the_equations_alone_end_undecided() {
    let here = folder("equations");
    std::fs::write(here.join("small_net.yaml"), SMALL_NET).expect("a design");
    std::fs::write(here.join("plan.yaml"), PLAN.replace("packings: 5", "by: equations\nfront: [10 %, 99 %]"))
        .expect("a plan");
    let ran = barrier_check(&here, &["study", "plan.yaml", "--out", "found"]);
    assert_eq!(ran.status.code(), Some(2), "{}", text(&ran.stderr));
    let json = std::fs::read_to_string(here.join("found/size.json")).expect("a result");
    let schema = barrier_check(&here, &["schema", "size"]).stdout;
    let [json, schema] = [json.as_bytes(), &schema].map(|text| serde_json::from_slice(text).expect("JSON"));
    jsonschema::validator_for(&schema).expect("a schema").validate(&json).unwrap_or_else(|error| panic!("{error}"));
    let page = std::fs::read_to_string(here.join("found/size.md")).expect("a page");
    assert!(page.contains("that the equations do not refute"), "{page}");
    assert!(page.contains("| 99 % | none passes |"), "{page}");
}

#[test]
fn a_plan_that_is_wrong_is_told_with_all_that_is_wrong() {
    let here = folder("wrong");
    std::fs::write(here.join("small_net.yaml"), SMALL_NET).expect("a design");
    let wrong = PLAN
        .replace("packings: 5", "packings: 0\nmargin: much")
        .replace("values: [150 kN, 200 kN, 240 kN, 290 kN]", "from: 100 kN\n    to: 50 kN\n    step: 10 kN");
    std::fs::write(here.join("plan.yaml"), wrong).expect("a plan");
    let ran = barrier_check(&here, &["study", "plan.yaml", "--out", "found"]);
    let said = text(&ran.stderr);
    assert_eq!(ran.status.code(), Some(2));
    for told in [
        "plan.yaml:5:9: margin\n  found:   much\n  allowed: 0 % to 99 %\n",
        ": choices.0\n  found:   100 kN to 50 kN",
        ": packings\n  found:   0\n",
    ] {
        assert!(said.contains(told), "{told}: {said}");
    }
    // Where no value makes a design, that is an error with its reason.
    std::fs::write(here.join("plan.yaml"), PLAN.replace("150 kN, 200 kN, 240 kN, 290 kN", "2 bananas"))
        .expect("a plan");
    let ran = barrier_check(&here, &["study", "plan.yaml", "--out", "found"]);
    let said = text(&ran.stderr);
    assert!(ran.status.code() == Some(2) && said.contains("is a valid design") && said.contains("bananas"), "{said}");
    let twice = PLAN.replace("prices:", "  - {key: barrier.flexible_net.anchors.resistance, values: [1 kN]}\nprices:");
    std::fs::write(here.join("plan.yaml"), twice).expect("a plan");
    let ran = barrier_check(&here, &["study", "plan.yaml", "--out", "found"]);
    let said = text(&ran.stderr);
    assert!(ran.status.code() == Some(2) && said.contains("set by two of them"), "{said}");
}

/// Where nothing that is priced is part of the barriers, the first of the list would be as cheap as any: the mass of steel of a wall.
#[test]
fn barriers_that_cost_nothing_have_no_cheapest() {
    let here = folder("free");
    std::fs::write(here.join("wall.yaml"), include_str!("../designs/gravity_wall.yaml")).expect("a design");
    let plan = "kind: size
name: wall
design: wall.yaml
by: equations
choices:
  - {key: barrier.rigid_wall.stability.founding_depth, values: [1 m, 1.5 m, 2 m]}
";
    std::fs::write(here.join("plan.yaml"), plan).expect("a plan");
    let ran = barrier_check(&here, &["study", "plan.yaml", "--out", "found"]);
    let said = text(&ran.stderr);
    assert!(ran.status.code() == Some(2) && said.contains("foundation_volume"), "{said}");
    let priced =
        format!("{plan}prices: {{currency: EUR, items: [{{of: foundation_volume, price: 100, origin: a test}}]}}\n");
    std::fs::write(here.join("plan.yaml"), priced).expect("a plan");
    let ran = barrier_check(&here, &["study", "plan.yaml", "--out", "found"]);
    assert!(here.join("found/size.json").is_file(), "{}", text(&ran.stderr));
}
