//! The report of a recorded run: its words by snapshot, its page in a browser.
//!
//! `fixtures/recorded.bin` is the recording of `fixtures/recorded.yaml`, a design with a factor on loads that fails some checks and leaves
//! others open. When the format of recordings changes, make it anew:
//! `cargo run --release -- tests/fixtures/recorded.yaml --seeds 2 --threads 1 --out out/recorded; cp out/recorded/recording.bin tests/fixtures/recorded.bin`

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::Instant;

use barrier_check::validation::scenes::{cloud, free_model};
use dem::recorders::film::Film;
use dem::simulation::Simulation;
use dem::tables::grains::GrainShape;

fn program(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_barrier-check")).args(arguments).output().expect("the program starts")
}

/// A folder with the recording and the report made from it.
fn reported(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::copy("tests/fixtures/recorded.bin", folder.join("recording.bin")).expect("the fixture");
    let started = Instant::now();
    let output = program(&["report", &folder.display().to_string()]);
    // The code of its verdict: it fails.
    assert_eq!(output.status.code(), Some(1), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(started.elapsed().as_secs_f64() < 1.0, "a report takes more than a second");
    folder
}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).expect(name)
}

/// What changes from build to build, and what is no word, taken out.
fn words(text: &str) -> String {
    let mut words = String::new();
    let mut rest = text;
    // Pictures, programs, styles and the packed film.
    let bulky = [("<svg", "</svg>"), ("<script", "</script>"), ("<style", "</style>")];
    while let Some((start, open, close)) =
        bulky.iter().filter_map(|(open, close)| Some((rest.find(open)?, *open, *close))).min_by_key(|found| found.0)
    {
        let end = rest[start..].find(close).map_or(rest.len(), |end| start + end + close.len());
        words.push_str(&rest[..start]);
        words.push_str(&format!("[{}]", &open[1..]));
        rest = &rest[end..];
    }
    words.push_str(rest);
    let is_commit = |letter: char| letter.is_ascii_hexdigit() || "-dirtyunkow".contains(letter);
    let mut parts = words.split("commit ");
    let first = parts.next().unwrap_or_default().to_string();
    parts.fold(first, |text, part| text + "commit [commit]" + part.trim_start_matches(is_commit))
}

#[test]
fn the_words_of_the_report_are_as_they_were() {
    let folder = reported("words");
    insta::assert_snapshot!("html", words(&read(&folder, "report.html")));
    insta::assert_snapshot!("markdown", words(&read(&folder, "report.md")));
}

#[test]
fn a_recording_that_is_none_is_refused() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("refused");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    let good = std::fs::read("tests/fixtures/recorded.bin").expect("the fixture");
    let middle = good.len() / 2;
    let mut flipped = good.clone();
    flipped[middle] ^= 1;
    let mut newer = good.clone();
    newer[8] = 99;
    let cases: [(&[u8], &str); 5] = [
        (&flipped, "checksum"),
        (&good[..middle], "checksum"),
        (&newer, "format 99"),
        (b"PK\x03\x04 something else altogether", "not a recording"),
        (b"", "not a recording"),
    ];
    for (bytes, told) in cases {
        std::fs::write(folder.join("recording.bin"), bytes).expect("a file");
        let output = program(&["report", &folder.display().to_string()]);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(told), "{error}");
        assert!(!folder.join("report.html").exists());
    }
    let output = program(&["report", "/nowhere/at/all"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn recorded_runs_are_held_side_by_side() {
    let [one, two, out] = ["side_one", "side_two", "side_out"].map(|name| match name {
        "side_out" => {
            let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
            let _ = std::fs::remove_dir_all(&folder);
            folder
        }
        name => reported(name),
    });
    let paths = [&one, &two, &out].map(|path| path.display().to_string());
    let output = program(&["compare", &paths[0], &paths[1], "--out", &paths[2]]);
    // The code of its verdict: it fails.
    assert_eq!(output.status.code(), Some(1), "{}", String::from_utf8_lossy(&output.stderr));
    let page = read(&out, "compare.html");
    // Alike in everything: nothing is marked, and no input differs.
    assert!(!page.contains("class=\"number differs\"") && !page.contains("What differs in the designs"));
    assert!(out.join("recorded/report.html").exists() && out.join("recorded_2/report.html").exists());
    insta::assert_snapshot!("compared", words(&read(&out, "compare.md")));
}

#[test]
fn files_for_paraview_hold_every_frame() {
    let folder = reported("paraview");
    let output = program(&["report", &folder.display().to_string(), "--vtk"]);
    assert_eq!(output.status.code(), Some(1));
    for series in ["grains", "barrier"] {
        let collection = read(&folder.join("vtk"), &format!("{series}.pvd"));
        let files: Vec<&str> = collection.split("file=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
        assert!(files.len() > 60);
        assert!(files.iter().all(|file| folder.join("vtk").join(file).exists()));
    }
}

/// Script that looks at the page from inside, and writes down what it sees.
const PROBE: &str = r##"<script>
(async () => {
  const seen = {};
  const wait = time => new Promise(done => setTimeout(done, time));
  await new Promise(done => addEventListener("load", done));
  seen.load = performance.getEntriesByType("navigation")[0].loadEventStart;
  const box = document.getElementById("replay"), canvas = box.querySelector("canvas");
  for (let tries = 0; box.hidden && tries < 100; tries++) await wait(50);
  seen.shown = !box.hidden;
  const before = canvas.toDataURL();
  box.querySelector("button").click();
  // Frames come when the browser draws, whatever its clock says.
  const frame = () => Promise.race([new Promise(requestAnimationFrame), wait(500)]);
  for (let tries = 0; canvas.toDataURL() === before && tries < 30; tries++) await frame();
  seen.plays = canvas.toDataURL() !== before;
  seen.resources = performance.getEntriesByType("resource").length;
  // As it prints.
  const printed = [...document.styleSheets].flatMap(sheet => [...sheet.cssRules]).filter(rule => rule.media && rule.media.mediaText === "print");
  const style = document.createElement("style");
  style.textContent = printed.flatMap(rule => [...rule.cssRules].map(inner => inner.cssText)).join("\n");
  document.head.append(style);
  seen.print = printed.length;
  const right = document.body.getBoundingClientRect().right + 1;
  seen.cut = [...document.querySelectorAll("table, svg, figure")].filter(part => part.getBoundingClientRect().right > right).length;
  seen.which = [...document.querySelectorAll("table, svg, figure")].filter(part => part.getBoundingClientRect().right > right).map(part => part.textContent.trim().slice(0, 40));
  seen.unnamed = [...document.querySelectorAll("svg:not([aria-hidden])")].filter(part => !part.getAttribute("aria-label")).length;
  seen.headless = [...document.querySelectorAll("table")].filter(table => !table.querySelector("th")).length;
  const out = document.createElement("pre");
  out.id = "probe";
  out.textContent = JSON.stringify(seen);
  document.body.append(out);
})();
</script></body>"##;

fn browser() -> Option<&'static str> {
    let found = |name: &&str| Command::new(name).arg("--version").output().is_ok_and(|output| output.status.success());
    ["chromium", "chromium-browser", "google-chrome"].into_iter().find(found)
}

#[allow(clippy::print_stdout, reason = "who reads the log must know that nothing was looked at")]
#[test]
fn the_page_stands_alone_in_a_browser() {
    let Some(browser) = browser() else {
        println!("skipped: no Chromium here, so the page was not looked at");
        return;
    };
    let folder = reported("browser");
    let page = read(&folder, "report.html");
    assert!(page.len() < 4_000_000, "the page has {} bytes", page.len());
    std::fs::write(folder.join("probed.html"), page.replace("</body>", PROBE)).expect("a page");
    let look = |more: &[&str]| {
        let address = format!("file://{}", folder.join("probed.html").display());
        let fixed = ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader"];
        let output = Command::new(browser)
            .args(fixed)
            .args(["--enable-unsafe-swiftshader", "--enable-logging=stderr", "--host-resolver-rules=MAP * ~NOTFOUND"])
            .arg(format!("--user-data-dir={}", folder.join("profile").display()))
            .args(more)
            .arg(address)
            .output()
            .expect("the browser starts");
        (String::from_utf8_lossy(&output.stdout).into_owned(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    // As wide as the text of an A4 page.
    let (page, log) = look(&["--window-size=673,900", "--virtual-time-budget=20000", "--dump-dom"]);
    let complaints: Vec<&str> = log.lines().filter(|line| line.contains("CONSOLE")).collect();
    assert!(complaints.is_empty(), "{complaints:#?}");
    let probe = page.split("<pre id=\"probe\">").nth(1).and_then(|rest| rest.split("</pre>").next());
    let seen: serde_json::Value = serde_json::from_str(probe.expect("the probe's answer")).expect("JSON");
    for (what, wanted) in
        [("shown", 1), ("plays", 1), ("print", 1), ("resources", 0), ("cut", 0), ("unnamed", 0), ("headless", 0)]
    {
        let value = seen[what].as_i64().unwrap_or_else(|| i64::from(seen[what] == true));
        assert_eq!(value, wanted, "{what}: {seen}");
    }
    // A machine that does other things besides may be slow once.
    let load = |seen: &serde_json::Value| seen["load"].as_f64().unwrap_or(f64::INFINITY);
    let again = || {
        let (page, _) = look(&["--window-size=673,900", "--virtual-time-budget=20000", "--dump-dom"]);
        let probe =
            page.split("<pre id=\"probe\">").nth(1).and_then(|rest| rest.split("</pre>").next()).map(str::to_string);
        probe.and_then(|probe| serde_json::from_str(&probe).ok()).map_or(f64::INFINITY, |seen| load(&seen))
    };
    let least = (0..4).fold(load(&seen), |least, _| if least < 1000.0 { least } else { least.min(again()) });
    assert!(least < 1000.0, "{seen}");
    let pdf = folder.join("report.pdf");
    look(&[&format!("--print-to-pdf={}", pdf.display())]);
    assert!(std::fs::metadata(&pdf).is_ok_and(|file| file.len() > 50_000), "the page does not print");
}

#[test]
fn frames_of_a_long_event_are_thinned_evenly() {
    let grains = cloud(3, 1);
    let mut simulation = Simulation::new(free_model(grains.clone(), GrainShape::Clump), 1e-4, 0.01, 1e3);
    let mut film = Film::default();
    for sample in 0..1000 {
        simulation.time = f64::from(sample);
        film.take(&simulation, &grains);
    }
    film.finish(&simulation, &grains);
    let times: Vec<f64> = film.frames.iter().map(|frame| frame.time).collect();
    assert!((65..=129).contains(&times.len()), "{} frames", times.len());
    let gaps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    assert!(gaps[..gaps.len() - 1].iter().all(|gap| *gap == gaps[0]));
    assert_eq!(times.last(), Some(&999.0));
}

/// Recordings that somebody has changed and sealed anew: refused or shown, never a panic.
#[test]
fn a_forged_recording_is_refused_or_shown() {
    use barrier_check::container::{seal, unseal};
    use barrier_check::report::recording::{FORMAT, NAME, decode};
    use barrier_check::report::render::render;
    use barrier_check::report::view::View;
    let cases = std::env::var("HOSTILE_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(400_usize);
    let whole = std::fs::read("tests/fixtures/recorded.bin").expect("the fixture");
    let body = unseal(NAME, FORMAT, &whole).expect("sealed");
    let mut random = fastrand::Rng::with_seed(5);
    let mut shown = 0;
    for case in 0..cases {
        let mut forged = body.to_vec();
        // Most of the bytes are numbers of histories; what steers the reader stands between them, and at the end.
        for _ in 0..random.usize(1..4) {
            let place = match random.u8(0..3) {
                0 => random.usize(0..forged.len()),
                1 => random.usize(0..forged.len().min(6000)),
                _ => forged.len() - 1 - random.usize(0..forged.len().min(6000)),
            };
            match random.u8(0..4) {
                0 => forged[place] = random.u8(..),
                1 => forged[place] = forged[place].wrapping_add(1),
                2 => forged[place] = 0,
                _ => drop(forged.remove(place)),
            }
        }
        let told = std::panic::catch_unwind(|| {
            let Ok(run) = decode(&seal(NAME, FORMAT, &forged)) else { return false };
            render(&View::of(&run)).is_ok()
        });
        shown += usize::from(told.unwrap_or_else(|_| panic!("case {case} panics")));
    }
    assert!(shown > cases / 20, "hardly any forgery is read: {shown}");
}
