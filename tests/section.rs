//! A net in a surveyed section: loads by hand, the packed flow, and the run.

use std::sync::atomic::AtomicBool;

use approx::assert_relative_eq;
use barrier_check::design::Design;
use barrier_check::design::entries::Purpose;
use barrier_check::design::read::{DesignFile, read_design, read_design_for};
use barrier_check::fidelity::choose;
use barrier_check::guideline::{Surface, earth_pressure_by_weight, guideline, held_below, reservoir};
use barrier_check::pipeline::{Verdict, run};
use barrier_check::scene::build::build;
use barrier_check::scene::event::RunControl;
use barrier_check::section::Section;

const GULLY: &str = include_str!("../designs/gully.yaml");

fn design(text: &str) -> Design {
    read_design("gully.yaml", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")).design
}

/// The gully with another section, given as points.
fn with_points(points: &str) -> Design {
    let (before, rest) = GULLY.split_once("    trapezoid:").expect("a trapezoid");
    let (_, after) = rest.split_once("  base_friction").expect("friction");
    design(&format!("{before}    points: {points}\n  base_friction{after}"))
}

/// Points whose heights, plumb on the 16° of the gully, are these normal to its bed.
fn points(list: &[[f64; 2]]) -> String {
    let plumb = libm::cos(16_f64.to_radians());
    let list: Vec<String> = list.iter().map(|[y, z]| format!("[{y} m, {} m]", z / plumb)).collect();
    format!("[{}]", list.join(", "))
}

/// A bed of 2 m between banks of 45°, filled 1.5 m deep at rest: ρ g K ∫ (1.5 − z)(2 + 2 z) dz =
/// ρ g K (1.5² + 1.5³/3) = 3.375 ρ g K; in a groove of 45° ρ g K 1.5³/3.
#[test]
fn the_force_of_a_deposit_is_integrated_over_the_section() {
    let told = guideline(&with_points(&points(&[[-5.0, 4.0], [-1.0, 0.0], [1.0, 0.0], [5.0, 4.0]])));
    let unit = 2.4 * 1500.0 * 9.81 * libm::cos(16_f64.to_radians());
    let full = told.cases.iter().find(|case| case.id == "full").expect("full");
    let height = full.deposit;
    let by_hand = unit * (height.powi(2) + height.powi(3) / 3.0);
    assert_relative_eq!(full.total_force(&told.section), by_hand, max_relative = 1e-9);
    // λ ρ v² on what a depth of 0.6 m wets: 2 · 0.6 + 0.6².
    let first = told.cases.iter().find(|case| case.id == "first_surge").expect("a surge");
    let moves = 2.5 * 1500.0 * 16.0 * (1.2 + 0.36) + unit * (0.36 + 0.216 / 3.0);
    assert_relative_eq!(first.total_force(&told.section), moves, max_relative = 1e-9);
}

/// Each rope spans its own height; together they carry no less than all of the force.
#[test]
fn every_rope_has_its_own_span() {
    let told = guideline(&design(GULLY));
    let plumb = libm::cos(16_f64.to_radians());
    let bank = |height: f64| height / plumb * (1.0 / libm::tan(50_f64.to_radians()) + 0.7);
    for (rope, third) in told.ropes.iter().zip([0.0, 1.0, 2.0, 3.0]) {
        assert_relative_eq!(rope.span, 2.0 + bank(2.0 * plumb * third / 3.0), max_relative = 1e-9);
    }
    let carried: f64 = told.ropes.iter().map(|rope| rope.load * rope.span).sum();
    assert!(carried > told.largest_force, "{carried} of {}", told.largest_force);
    assert!(carried < 1.6 * told.largest_force, "{carried} of {}", told.largest_force);
}

/// Volumes that were summed over cells of 2 mm with numpy, for a deposit 3 m high on 20° behind a plumb net, its surface at 13° and level;
/// and 2.5 m high on 15° with a surface at 5° behind a face normal to the bed.
#[test]
fn the_storage_is_that_of_fine_sums() {
    let held = |points: &str, slope: f64, tilt: f64, height: f64, surface: f64| {
        let mut design = with_points(points);
        design.channel.slope = slope.to_radians();
        let barrier_check::design::BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        net.tilt = tilt.to_radians();
        design.loads.filled_height = height / barrier_check::guideline::height_over_bed(&design);
        held_below(&design, Surface::Plane(surface.to_radians())).expect("a deposit").volume
    };
    let trapezoid = points(&[[0.0, 4.0], [4.0, 0.0], [10.0, 0.0], [16.0, 4.0]]);
    assert_relative_eq!(held(&trapezoid, 20.0, 0.0, 3.0, 13.0), 325.443, max_relative = 5e-3);
    assert_relative_eq!(held(&trapezoid, 20.0, 0.0, 3.0, 0.0), 119.013, max_relative = 5e-3);
    let prism = points(&[[0.0, 9.0], [0.0, 0.0], [8.0, 0.0], [8.0, 9.0]]);
    assert_relative_eq!(held(&prism, 20.0, 0.0, 3.0, 13.0), 306.299, max_relative = 5e-3);
}

/// The flow starts with its mass in the section, its surface level at the depth that was asked for, and no two grains press on each other.
#[test]
fn the_flow_fills_the_section() {
    let design = design(GULLY);
    let scene = build(&design, &choose(&design), 1).expect("a scene");
    assert!(scene.packed_share > 0.97, "{}", scene.packed_share);
    let grains = scene.simulation.snapshot();
    let mass: f64 = grains.iter().map(|grain| grain.body.mass).sum();
    assert_relative_eq!(mass, design.flow.mass, max_relative = 0.01);
    let survey = design.channel.survey.as_ref().expect("a survey");
    let section = Section::Surveyed(survey.clone());
    for grain in &grains {
        for side in [-1.0, 1.0] {
            let centre = grain.position + grain.axis * (side * grain.body.offset);
            // No deeper in the ground than a hundredth of its radius, and below the surface.
            let over = centre.z - survey.ground(centre.y);
            assert!(over > 0.98 * grain.body.radius, "{centre:?}");
            assert!(centre.z < 0.6 - 0.98 * grain.body.radius, "{centre:?}");
        }
    }
    // In the body behind the nose, the mass of a metre stands at the depth of the flow.
    let back = grains.iter().map(|grain| grain.position.x).fold(f64::INFINITY, f64::min);
    let stretch = 1.2;
    let inside = grains.iter().filter(|grain| grain.position.x < back + stretch);
    let area = inside.map(|grain| grain.body.mass).sum::<f64>() / (1500.0 * stretch);
    assert!((0.85..1.05).contains(&(section.height_of_area(area) / 0.6)), "{}", section.height_of_area(area));
}

/// Nothing leaves through the ground, and all that is lost went past the barrier.
#[test]
fn the_gully_is_judged_from_end_to_end() {
    let file = read_design("gully.yaml", GULLY.as_bytes()).unwrap_or_else(|problems| panic!("{problems}"));
    let watch = RunControl { progress: &|_| (), stop: &AtomicBool::new(false), store: None };
    let run = run(file, 1, &watch).expect("a run");
    assert!(run.doubts.is_empty(), "{:?}", run.doubts);
    assert_ne!(run.verdict, Verdict::Fail);
    let seen = run.simulated.as_ref().expect("a simulation");
    assert_eq!(seen.numerics.escaped, 0);
    let lost: f64 = seen.histories.lost.last().copied().unwrap_or([1.0; 4]).iter().sum();
    assert!(lost < 0.05, "{lost}");
    let start = seen.histories.at_release;
    assert!(start.stored_contacts < 0.01 * start.kinetic, "{} of {}", start.stored_contacts, start.kinetic);
}

/// The gully with other reaches upstream, one break of which lies under the flow as it starts.
fn with_reaches() -> String {
    GULLY.replacen(
        "  section:",
        "  profile: {upstream: [[4 m, 22 deg], [6 m, 28 deg]], rounded_over: 1 m}\n  section:",
        1,
    )
}

/// A flow that starts over the breaks of its bed lies on it, moves along it, and no two grains press on each other.
#[test]
fn the_flow_follows_its_bed() {
    let design = design(&with_reaches());
    let scene = build(&design, &choose(&design), 1).expect("a scene");
    assert!(scene.packed_share > 0.97, "{}", scene.packed_share);
    let (profile, survey) =
        (design.channel.profile.as_ref().expect("reaches"), design.channel.survey.as_ref().expect("a survey"));
    let (sine, cosine) = libm::sincos(design.channel.slope);
    let [mut lowest, mut steepest] = [f64::INFINITY, 0.0_f64];
    for grain in scene.simulation.snapshot() {
        let place = grain.position;
        let (level, plumb) = (place.x * cosine + place.z * sine, place.z * cosine - place.x * sine);
        let over = (plumb - profile.elevation(level)) * cosine - survey.ground(place.y);
        lowest = lowest.min(over / grain.body.radius);
        // Down the reach on which it is, but for a bend of the bed.
        let falls = (grain.velocity.x * sine - grain.velocity.z * cosine)
            / (grain.velocity.x * cosine + grain.velocity.z * sine);
        assert!((falls - profile.falls(level)).abs() < 0.1, "{falls} at {level}");
        steepest = steepest.max(falls);
    }
    assert!(lowest > 0.9, "{lowest}");
    assert!(steepest > libm::tan(27.9_f64.to_radians()), "{steepest}");
    let file = read_design("gully.yaml", with_reaches().as_bytes()).unwrap_or_else(|problems| panic!("{problems}"));
    let watch = RunControl { progress: &|_| (), stop: &AtomicBool::new(false), store: None };
    let run = run(file, 1, &watch).expect("a run");
    assert!(run.doubts.is_empty(), "{:?}", run.doubts);
    let seen = run.simulated.as_ref().expect("a simulation");
    assert_eq!(seen.numerics.escaped, 0);
    let start = seen.histories.at_release;
    assert!(start.stored_contacts < 0.01 * start.kinetic, "{} of {}", start.stored_contacts, start.kinetic);
}

/// A section from a table is that of the same points; the report keeps the table, and the design goes on from there.
#[test]
fn a_section_is_read_from_its_table() {
    let folder = std::env::temp_dir().join(format!("barrier-check-{}-table", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let (before, rest) = GULLY.split_once("    trapezoid:").expect("a trapezoid");
    let (_, after) = rest.split_once("  base_friction").expect("friction");
    let text = format!("{before}    file: survey.csv\n  base_friction{after}");
    std::fs::write(folder.join("gully.yaml"), text).expect("a design");
    let table = "distance (m),height (m)\n-3.937,3.5\n-1,0\n1,0\n3.45,3.5\n";
    std::fs::write(folder.join("survey.csv"), table).expect("a table");
    let loads = |design: &str, out: &str| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_barrier-check"));
        command.arg("loads").arg(folder.join(design)).arg("--out").arg(folder.join(out));
        command.output().expect("the program starts")
    };
    let told = loads("gully.yaml", "first");
    assert_eq!(told.status.code(), Some(2), "{}", String::from_utf8_lossy(&told.stderr));
    assert_eq!(std::fs::read_to_string(folder.join("first/attached/survey.csv")).expect("a copy"), table);
    let report = std::fs::read_to_string(folder.join("first/report.md")).expect("a report");
    assert!(report.contains("SHA-256 of attached files") && report.contains("4 points of survey.csv"), "{report}");
    // From the copy of the design, with the table that lies beside it.
    let again = loads("first/design.yaml", "second");
    assert_eq!(again.status.code(), Some(2), "{}", String::from_utf8_lossy(&again.stderr));
    let totals = |out: &str| {
        let json: serde_json::Value =
            serde_json::from_slice(&std::fs::read(folder.join(out).join("result.json")).expect("a result"))
                .expect("JSON");
        json["guideline"].clone()
    };
    assert_eq!(totals("first"), totals("second"));
    std::fs::remove_dir_all(folder).expect("the folder");
}

/// Points far up the slopes change nothing of what hangs below them.
#[test]
fn a_wider_survey_gives_the_same_loads() {
    let near = points(&[[-5.0, 4.0], [-1.0, 0.0], [1.0, 0.0], [5.0, 4.0]]);
    let wide = points(&[[-550.0, 14.5], [-5.0, 4.0], [-1.0, 0.0], [1.0, 0.0], [5.0, 4.0], [550.0, 14.5]]);
    let [near, wide] = [near, wide].map(|points| guideline(&with_points(&points)));
    for (a, b) in near.ropes.iter().zip(&wide.ropes) {
        assert!(a.load > 0.0);
        assert_relative_eq!(a.load, b.load, max_relative = 1e-9);
    }
}

/// Whatever the section, the ropes together carry no less than the pressures of the fullest stage.
#[test]
fn the_ropes_carry_all_of_the_force() {
    let banks = [
        points(&[[-5.0, 4.0], [-1.0, 0.0], [1.0, 0.0], [5.0, 4.0]]),
        points(&[[-9.0, 4.0], [-1.0, 0.0], [1.0, 0.0], [9.0, 4.0]]),
        points(&[[-6.0, 4.0], [-4.0, 1.4], [-2.0, 1.3], [-1.0, 0.0], [1.0, 0.0], [2.0, 1.1], [5.0, 1.2], [6.0, 4.0]]),
    ];
    for bank in banks {
        for factors in ["", "to_the_top"] {
            let mut design = with_points(&bank);
            design.loads.to_the_top = !factors.is_empty();
            let told = guideline(&design);
            let carried: f64 = told.ropes.iter().map(|rope| rope.load * rope.span).sum();
            assert!(carried > 0.999 * told.largest_force, "{bank}: {carried} of {}", told.largest_force);
        }
    }
}

/// A flat reach upstream does not hold back what lies on the steep one at the barrier.
#[test]
fn a_flat_reach_does_not_pull_the_deposit_back() {
    let k = |reaches: &str| {
        let text = GULLY.replacen("  section:", &format!("  {reaches}\n  section:"), 1).replacen(
            "slope: 16 deg",
            "slope: 40 deg",
            1,
        );
        let design = design(&text);
        earth_pressure_by_weight(&design, &guideline(&design)).expect("a K")
    };
    let even = k("# one slope");
    let flat = k("profile: {upstream: [[3 m, 2 deg]]}");
    let level = k("profile: {upstream: [[3 m, 0 deg]]}");
    assert!(flat > 0.4 * even && flat < even, "{flat} of {even}");
    assert_relative_eq!(flat, level, max_relative = 0.02);
}

/// The design of the raster, with the files that lie beside it.
fn raster_gully() -> DesignFile {
    let open =
        |name: &str| std::fs::read(std::path::Path::new("designs").join(name)).map_err(|error| error.to_string());
    let text = include_bytes!("../designs/gully_terrain.yaml");
    read_design_for(Purpose::Simulation, "gully_terrain.yaml", text, &open)
        .unwrap_or_else(|problems| panic!("{problems}"))
}

/// Volumes under level surfaces 1, 1.6 and 2 m above the lowest ground between the barrier's ends, that were summed over squares of 5 cm of the
/// raster with numpy, from the plumb plane between the ends upstream.
#[test]
fn the_storage_of_a_raster_is_that_of_fine_sums() {
    let design = raster_gully().design;
    let reservoir = reservoir(&design);
    let plumb = libm::cos(design.channel.slope);
    for (height, volume) in [(1.0, 6.528), (1.6, 19.584), (2.0, 32.848)] {
        let stored = reservoir.stored(height * plumb, Surface::Plane(0.0), 0.0).expect("a deposit");
        assert_relative_eq!(stored.volume, volume, max_relative = 5e-3);
    }
    // It is found back.
    let found = reservoir.height(19.584 / design.channel.width, 0.0);
    assert_relative_eq!(found, 1.6 * plumb, max_relative = 3e-3);
    // Three free ropes of three different spans.
    let spans: Vec<f64> = guideline(&design).ropes.iter().map(|rope| rope.span).collect();
    assert!(spans.windows(2).all(|pair| pair[1] > pair[0] + 1.0), "{spans:?}");
}

/// On a raster the flow lies on the ground as it is, none of it goes through, and the net holds it.
#[test]
fn the_raster_is_judged_from_end_to_end() {
    let watch = RunControl { progress: &|_| (), stop: &AtomicBool::new(false), store: None };
    let run = run(raster_gully(), 1, &watch).expect("a run");
    assert!(run.doubts.is_empty(), "{:?}", run.doubts);
    assert_ne!(run.verdict, Verdict::Fail);
    let seen = run.simulated.as_ref().expect("a simulation");
    assert_eq!(seen.numerics.escaped, 0);
    let start = seen.histories.at_release;
    assert!(start.stored_contacts < 0.01 * start.kinetic, "{} of {}", start.stored_contacts, start.kinetic);
    let lost: f64 = seen.histories.lost.last().copied().unwrap_or([1.0; 4]).iter().sum();
    assert!(lost < 0.05, "{lost}");
}

/// A raster of a million cells is read in two seconds, within 200 MB.
#[test]
fn a_million_cells_are_read_soon() {
    let folder = std::env::temp_dir().join(format!("barrier-check-{}-cells", std::process::id()));
    std::fs::create_dir_all(folder.join("terrain")).expect("a folder");
    let small = include_str!("../designs/terrain/gully.asc");
    let (head, rows) = small.split_once("NODATA_value -9999\n").expect("a head");
    // The gully in the south-west corner of a plain.
    let mut text = head.replace("ncols 110", "ncols 1000").replace("nrows 90", "nrows 1000") + "NODATA_value -9999\n";
    text += &format!("{}\n", "850.00 ".repeat(1000)).repeat(910);
    for row in rows.lines() {
        text += row;
        text += &" 850.00".repeat(890);
        text.push('\n');
    }
    std::fs::write(folder.join("terrain/gully.asc"), text).expect("a raster");
    std::fs::write(folder.join("gully.yaml"), include_str!("../designs/gully_terrain.yaml")).expect("a design");
    let started = std::time::Instant::now();
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_barrier-check"));
    let told = command.arg("loads").arg(folder.join("gully.yaml")).arg("--out").arg(folder.join("out")).output();
    let told = told.expect("the program starts");
    assert_eq!(told.status.code(), Some(2), "{}", String::from_utf8_lossy(&told.stderr));
    assert!(started.elapsed().as_secs_f64() < 5.0, "{:?}", started.elapsed());
    std::fs::remove_dir_all(folder).expect("the folder");
}

/// A hollow of the same depth beside the gully, beyond a crest, takes none of the flow.
#[test]
fn the_flow_starts_in_the_gully_alone() {
    let grid = |second: bool| {
        let mut text = "ncols 60\nnrows 60\nxllcenter 0\nyllcenter 0\ncellsize 1\n".to_string();
        for row in 0..60 {
            let north = 59 - row;
            for column in 0..60 {
                let from = |middle: i32| f64::from(((column - middle).abs() - 2).max(0)) * 0.8;
                let beside = if second && north < 28 { from(42) } else { 9.0 };
                text += &format!("{:.2} ", 200.0 - 0.3 * f64::from(north) + from(30).min(beside).min(9.0));
            }
        }
        text
    };
    let text = include_str!("../designs/gully_terrain.yaml")
        .replace("left_end: [2600072.75 m, 1200044.76 m]", "left_end: [24.5 m, 30 m]")
        .replace("right_end: [2600067.25 m, 1200035.24 m]", "right_end: [35.5 m, 30 m]");
    let length = |second: bool| {
        let open = |_: &str| Ok(grid(second).into_bytes());
        let file = read_design_for(Purpose::Simulation, "x.yaml", text.as_bytes(), &open);
        let design = file.unwrap_or_else(|problems| panic!("{problems}")).design;
        barrier_check::scene::flow::release::Block::of(&design.flow, &design.channel, 0.0).length
    };
    let [alone, beside] = [false, true].map(length);
    assert_relative_eq!(alone, beside, max_relative = 0.02);
}
