//! The files that other programs open: they hold what the report says, as readers that this program does not write with find it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use calamine::{Data, DataType, Reader, Xlsx, open_workbook};
use dxf::Drawing;
use dxf::entities::EntityType;
use serde_json::Value;

const PROGRAM: &str = env!("CARGO_BIN_EXE_barrier-check");
const DESIGNS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/designs");

fn fresh_folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("barrier-check-files-{}-{name}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    folder
}

/// Runs the program; its exit code.
fn run(arguments: &[&str], out: &Path) -> i32 {
    let output = Command::new(PROGRAM).args(arguments).arg("--out").arg(out).output().expect("the program starts");
    output.status.code().unwrap_or(-1)
}

fn result(folder: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(folder.join("result.json")).expect("a result")).expect("JSON")
}

/// What a unit of the spreadsheet is in SI.
fn in_si(unit: &str) -> f64 {
    if unit.starts_with('k') { 1e3 } else { 1.0 }
}

/// The rows of a sheet below its head, by the text in a column.
fn rows(book: &mut Xlsx<std::io::BufReader<std::fs::File>>, sheet: &str, by: usize) -> BTreeMap<String, Vec<Data>> {
    let range = book.worksheet_range(sheet).expect("a sheet");
    range.rows().map(|row| (row.get(by).map_or(String::new(), ToString::to_string), row.to_vec())).collect()
}

#[test]
fn a_spreadsheet_holds_what_the_result_says() {
    for design in ["site_a", "gully", "gravity_wall", "net_with_posts", "rigid_wall"] {
        let out = fresh_folder(&format!("xlsx-{design}"));
        assert!((0..=2).contains(&run(&["loads", &format!("{DESIGNS}/{design}.yaml"), "--xlsx"], &out)));
        let result = result(&out);
        let mut book: Xlsx<_> = open_workbook(out.join("tables.xlsx")).expect("a workbook");
        assert_eq!(book.sheet_names(), ["Summary", "Checks", "Load cases", "Histories"]);
        let checks = rows(&mut book, "Checks", 1);
        for check in result["checks"].as_array().expect("checks") {
            let row = &checks[check["id"].as_str().expect("an id")];
            let unit = in_si(&row[6].to_string());
            for (column, key) in
                [(2, "demand_guideline"), (3, "demand_simulation"), (4, "demand_characteristic"), (5, "capacity")]
            {
                let (found, told) = (row[column].as_f64().map(|value| value * unit), check[key].as_f64());
                let same = match (found, told) {
                    (Some(found), Some(told)) => (found - told).abs() <= 1e-9 * told.abs(),
                    (found, told) => found == told,
                };
                assert!(same, "{design}, {} {key}: {found:?} and {told:?}", check["id"]);
            }
            // What a reader sees without computing, and what the formula gives.
            let used = check["utilisation"].as_f64();
            assert!(
                used.is_none_or(|used| row[7].as_f64().is_some_and(|found| (found - used).abs() <= 1e-9 * used.abs())),
                "{design} {}",
                check["id"]
            );
            assert_eq!(row[8].to_string().to_lowercase(), check["verdict"].as_str().expect("a verdict"));
        }
        let formulas = book.worksheet_formula("Checks").expect("formulas");
        assert!(formulas.used_cells().any(|(_, _, formula)| formula.starts_with("MAX(C")), "{design}");
        let cases = rows(&mut book, "Load cases", 10);
        for case in result["guideline"]["cases"].as_array().expect("cases") {
            let row = &cases[case["id"].as_str().expect("an id")];
            for (column, key) in [(3, "pressure_static_pa"), (8, "force_n_per_m")] {
                let told = case[key].as_f64().expect("a number");
                let found = 1e3 * row[column].as_f64().expect("a number");
                assert!((found - told).abs() <= 1e-9 * told.abs().max(1.0), "{design} {key}: {found} and {told}");
            }
        }
        std::fs::remove_dir_all(out).expect("the folder");
    }
}

#[test]
fn the_time_series_of_a_spreadsheet_are_those_of_the_table() {
    let out = fresh_folder("histories");
    let tiny = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fixtures/tiny_wall.yaml");
    assert!((0..=2).contains(&run(&[tiny, "--xlsx"], &out)));
    let first = std::fs::read(out.join("tables.xlsx")).expect("a workbook");
    let mut book: Xlsx<_> = open_workbook(out.join("tables.xlsx")).expect("a workbook");
    let range = book.worksheet_range("Histories").expect("a sheet");
    let mut table = csv::Reader::from_path(out.join("histories.csv")).expect("a table");
    let heads: Vec<String> = table.headers().expect("heads").iter().map(str::to_string).collect();
    assert_eq!(
        range.rows().next().expect("a head")[..heads.len()],
        heads.iter().map(|head| Data::String(head.clone())).collect::<Vec<_>>()
    );
    let mut compared = 0;
    for (row, record) in range.rows().skip(1).zip(table.records()) {
        for (cell, text) in row.iter().zip(record.expect("a row").iter()) {
            let told: f64 = text.parse().expect("a number");
            assert!(
                cell.as_f64().map_or(!told.is_finite(), |found| (found - told).abs() <= 1e-12 * told.abs()),
                "{cell:?} and {told}"
            );
            compared += 1;
        }
    }
    assert!(compared > 1000, "{compared}");
    // Made again from what was recorded, it is the same file.
    let again = Command::new(PROGRAM).args(["report", "--xlsx"]).arg(&out).output().expect("the program starts");
    assert!(again.status.code().is_some_and(|code| code <= 2));
    assert_eq!(std::fs::read(out.join("tables.xlsx")).expect("a workbook"), first);
    std::fs::remove_dir_all(out).expect("the folder");
}

/// Horizontal lengths and heights of the lines of a layer.
fn lines(drawing: &Drawing, layer: &str) -> Vec<[f64; 2]> {
    let of = |entity: &dxf::entities::Entity| match &entity.specific {
        EntityType::Line(line) if entity.common.layer == layer => {
            Some([(line.p2.x - line.p1.x).abs(), line.p1.y.max(line.p2.y)])
        }
        _ => None,
    };
    drawing.entities().filter_map(of).collect()
}

#[test]
fn a_drawing_has_the_lengths_of_the_design() {
    let drawn = |design: &str| {
        let out = fresh_folder(&format!("dxf-{design}"));
        assert!((0..=2).contains(&run(&["loads", &format!("{DESIGNS}/{design}.yaml"), "--dxf"], &out)));
        let drawing = Drawing::load_file(out.join("drawing.dxf")).expect("a drawing");
        std::fs::remove_dir_all(out).expect("the folder");
        assert_eq!(drawing.header.default_drawing_units, dxf::enums::Units::Meters);
        drawing
    };
    let close = |found: f64, wanted: f64| (found - wanted).abs() < 1e-9 * wanted.abs().max(1.0);
    // Five ropes from wall to wall of a channel 15.2 m wide; the uppermost as high as the net, 5.5 m plumb on a slope of 40°.
    let ropes = lines(&drawn("site_a"), "ROPES");
    assert_eq!(ropes.len(), 5);
    assert!(ropes.iter().all(|[length, _]| close(*length, 15.2)), "{ropes:?}");
    assert!(close(ropes.iter().map(|[_, height]| *height).fold(0.0, f64::max), 5.5), "{ropes:?}");
    // In a trapezoid each rope is as long as the section is wide at its height.
    let out = fresh_folder("gully");
    assert!((0..=2).contains(&run(&["loads", &format!("{DESIGNS}/gully.yaml")], &out)));
    let report = std::fs::read_to_string(out.join("report.md")).expect("a report");
    std::fs::remove_dir_all(out).expect("the folder");
    for [length, _] in lines(&drawn("gully"), "ROPES") {
        let words = format!("{length:.2} m");
        assert!(report.contains(&words) || length == 0.0, "{words} is not in the report");
    }
    // Posts stand from the ground to the height of the uppermost rope.
    let with_posts = drawn("net_with_posts");
    let (posts, ropes) = (lines(&with_posts, "POSTS"), lines(&with_posts, "ROPES"));
    let top = ropes.iter().map(|[_, height]| *height).fold(0.0, f64::max);
    assert!(!posts.is_empty() && posts.iter().all(|[_, height]| close(*height, top)), "{posts:?} {top}");
    // Every drawing has a ground, the barrier twice, and names in plain letters.
    for design in ["rigid_wall", "ring_net", "gully_terrain", "site_railway"] {
        let drawing = drawn(design);
        let on = |layer: &str| drawing.entities().filter(|entity| entity.common.layer == layer).count();
        assert_eq!((on("GROUND"), on("BARRIER")), (2, 2), "{design}");
        for entity in drawing.entities() {
            if let EntityType::Text(text) = &entity.specific {
                assert!(text.value.is_ascii(), "{design}: {}", text.value);
            }
        }
    }
}

#[test]
fn a_report_is_printed_where_there_is_a_browser_and_refused_before_the_run_where_there_is_none() {
    let out = fresh_folder("pdf");
    let design = format!("{DESIGNS}/site_a.yaml");
    let none = Command::new(PROGRAM)
        .args([&design, "--pdf", "--out"])
        .arg(&out)
        .env("PATH", "")
        .env_remove("CHROMIUM")
        .output()
        .expect("the program starts");
    let told = String::from_utf8_lossy(&none.stderr).into_owned();
    let elsewhere = Path::new("/Applications").exists() || cfg!(windows);
    assert!(
        elsewhere || (none.status.code() == Some(2) && told.contains("--pdf needs a browser") && !out.exists()),
        "{told}"
    );
    let broken = Command::new(PROGRAM)
        .args(["loads", &design, "--pdf", "--out"])
        .arg(&out)
        .env("CHROMIUM", "no-such-browser")
        .output()
        .expect("the program starts");
    // The report is not lost because it could not be printed as well.
    let told = String::from_utf8_lossy(&broken.stderr).into_owned();
    assert!(broken.status.code() == Some(1) && told.contains("there is no report.pdf"), "{told}");
    assert!(out.join("report.html").exists() && !out.join("report.pdf").exists());
    let path = std::env::var_os("PATH").unwrap_or_default();
    if !std::env::split_paths(&path).any(|folder| folder.join("chromium").is_file()) {
        return;
    }
    assert!((0..=2).contains(&run(&["loads", &design, "--pdf"], &out)));
    let pdf = std::fs::read(out.join("report.pdf")).expect("a file");
    assert!(pdf.starts_with(b"%PDF-") && pdf.len() > 100_000, "{}", pdf.len());
    std::fs::remove_dir_all(out).expect("the folder");
}
