//! Designs that somebody wrote by mistake or in malice: thousands of changed files, read and, where they are accepted, carried
//! through the equations to the finished report. Nothing may panic, hang or let markup through.
//!
//! `HOSTILE_CASES=1000000 cargo test --release --test hostile` tries as many as that.

use std::time::{Duration, Instant};

use barrier_check::design::read::read_design;
use barrier_check::pipeline::by_equations;
use barrier_check::report::json::ResultFile;
use barrier_check::report::render::render;
use barrier_check::report::view::View;

/// What stands in for a value.
const NASTY: [&str; 36] = [
    "",
    "~",
    "null",
    "true",
    "-0",
    "0",
    "-1 m",
    "1e308 m",
    "1e400 m",
    "-1e308 kN",
    ".nan",
    ".inf",
    "-.inf",
    "nan m",
    "inf kN",
    "1e-300 m",
    "5.0e-324 m",
    "0x10",
    "1_000 m",
    "1,5 m",
    "１２ m",
    "١٢ m",
    "m",
    "m m",
    "1 m 2 m",
    "1 kN/m/m",
    "[]",
    "{}",
    "[1, 2, 3]",
    "{a: {b: {c: 1}}}",
    "\"<script>alert(1)</script>\"",
    "\"{{ 1 }} {% raw %}\"",
    "\"../../etc/passwd\"",
    "\"=cmd|' /C calc'!A0\"",
    "&a [*a]",
    "!!binary aGVsbG8=",
];

fn designs() -> Vec<String> {
    let mut designs = Vec::new();
    for entry in std::fs::read_dir("designs").expect("folder of designs") {
        let path = entry.expect("entry").path();
        if path.extension().is_some_and(|extension| extension == "yaml") {
            designs.push(std::fs::read_to_string(path).expect("a design"));
        }
    }
    designs.sort();
    designs
}

/// A design with a few lines changed.
fn changed(text: &str, random: &mut fastrand::Rng) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_string).collect();
    for _ in 0..random.usize(1..4) {
        let at = random.usize(0..lines.len());
        let line = lines[at].clone();
        let value = line.find(": ").map(|colon| (line[..colon + 2].to_string(), line[colon + 2..].to_string()));
        lines[at] = match (random.u8(0..10), value) {
            (0, _) => String::new(),
            (1, _) => format!("  {line}"),
            (2, _) => line.trim_start().to_string(),
            (3, _) => format!("{line}\r"),
            (4, _) => lines[random.usize(0..lines.len())].clone(),
            (5..=7, Some((key, old))) => format!("{key}{}", scaled(&old, random)),
            (_, Some((key, _))) => format!("{key}{}", NASTY[random.usize(0..NASTY.len())]),
            (_, None) => line.chars().rev().collect(),
        };
    }
    lines.join("\n")
}

/// The number at the front of a value times a wild factor.
fn scaled(value: &str, random: &mut fastrand::Rng) -> String {
    let end = value.find(|letter: char| !letter.is_ascii_digit() && letter != '.').unwrap_or(value.len());
    let Ok(number) = value[..end].parse::<f64>() else { return value.to_string() };
    let factor = match random.u8(0..4) {
        0 => libm::pow(10_f64, random.f64() * 12.0 - 6.0),
        1 => -1.0,
        _ => 0.3 + 2.0 * random.f64(),
    };
    format!("{}{}", number * factor, &value[end..])
}

#[test]
fn thousands_of_changed_designs_end_in_an_answer_or_an_error() {
    let cases = std::env::var("HOSTILE_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(8_000_usize);
    let designs = designs();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let accepted: Vec<usize> = std::thread::scope(|scope| {
        let share = |thread: usize| {
            let designs = &designs;
            scope.spawn(move || {
                let mut random = fastrand::Rng::with_seed(thread as u64);
                (0..cases / threads)
                    .filter(|_| try_one(&changed(&designs[random.usize(0..designs.len())], &mut random)))
                    .count()
            })
        };
        let shares: Vec<_> = (0..threads).map(share).collect();
        shares.into_iter().map(|share| share.join().expect("no panic")).collect()
    });
    let accepted: usize = accepted.iter().sum();
    assert!(accepted > cases / 100, "hardly any changed design is one: {accepted}");
}

/// Whether a line of the report repeats what was typed.
fn is_typed(line: &str) -> bool {
    let labels = ["Project", "Barrier", "Revision", "Author", "Checker", "Date", "Notes", "project."];
    line.starts_with('#') || labels.iter().any(|label| line.starts_with(&format!("| {label}")))
}

/// Whether the design is accepted; it must be read fast, and its report must be whole.
fn try_one(text: &str) -> bool {
    let started = Instant::now();
    let accepted = match read_design("hostile.yaml", text.as_bytes()) {
        Err(problems) => {
            assert!(!problems.to_string().is_empty());
            false
        }
        Ok(file) => {
            let run = by_equations(file);
            let rendered = render(&View::of(&run)).expect("a report");
            assert!(!rendered.html.contains("<script>alert"), "markup comes through:\n{text}");
            for word in ["NaN", "inf "] {
                let line = rendered.markdown.lines().filter(|line| !is_typed(line)).find(|line| line.contains(word));
                assert!(line.is_none(), "{word} in {line:?} of the report of:\n{text}");
            }
            assert!(serde_json::to_string(&ResultFile::of(&run)).is_ok());
            true
        }
    };
    assert!(started.elapsed() < Duration::from_secs(5), "took {:?}:\n{text}", started.elapsed());
    accepted
}

#[test]
fn windows_line_ends_and_names_in_any_script_are_read() {
    let text = std::fs::read_to_string("designs/small_net.yaml").expect("a design");
    let other = text.replace('\n', "\r\n").replace("name: Ditch at the forest road", "name: Wildbach 土石流 грунт 🪨");
    let file = read_design("unicode.yaml", other.as_bytes()).expect("a design");
    let rendered = render(&View::of(&by_equations(file))).expect("a report");
    assert!(rendered.html.contains("土石流") && rendered.markdown.contains("🪨"));
}

#[test]
fn deep_brackets_are_refused_at_once_and_nothing_steers_the_terminal() {
    let started = std::time::Instant::now();
    for deep in ["a: ".to_string() + &"[".repeat(400_000), "{a: ".repeat(200_000)] {
        assert!(read_design("deep", deep.as_bytes()).is_err());
    }
    assert!(started.elapsed().as_secs_f64() < 2.0, "{:?}", started.elapsed());
    let told = read_design("x", "\"\\e[31mevil\\u202e\": 1".as_bytes()).expect_err("bad").to_string();
    assert!(told.contains("evil") && !told.contains('\u{1b}') && !told.contains('\u{202e}'), "{told:?}");
}
