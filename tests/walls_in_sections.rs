//! A rigid wall across a surveyed section or a raster: what its segments and its deepest metre take.

use std::sync::atomic::AtomicBool;

use approx::assert_relative_eq;
use barrier_check::design::entries::Purpose;
use barrier_check::design::read::{DesignFile, read_design_for};
use barrier_check::guideline::guideline;
use barrier_check::pipeline::{Run, run};
use barrier_check::quantities::{mass, total_force, wall};
use barrier_check::scene::event::RunControl;
use dem::recorders::histories::tail_mean;
use dem::recorders::of_wall::{METRE_FORCE, METRE_MOMENT, MOMENT, SEGMENTS};

const WALL: &str =
    "barrier:\n  rigid_wall:\n    height: 2 m\n    resistance: 1000 kN\n    moment_resistance: 500 kN m/m\n\n";

/// An example with a wall in the place of its net.
fn with_a_wall(name: &str) -> String {
    let text = std::fs::read_to_string(format!("designs/{name}")).expect("a design");
    let (before, rest) = text.split_once("barrier:\n  flexible_net:").expect("a net");
    let (_, after) = rest.split_once("limits:").expect("limits");
    let without_nets = |line: &&str| {
        !["residual_height", "utilisation", "dissipator_overstrength", "barrier_model"]
            .iter()
            .any(|key| line.contains(key))
    };
    let text = format!("{before}{WALL}limits:{after}");
    text.lines().filter(without_nets).collect::<Vec<_>>().join("\n")
}

fn read(text: &str) -> DesignFile {
    let open = |other: &str| std::fs::read(format!("designs/{other}")).map_err(|error| error.to_string());
    read_design_for(Purpose::Simulation, "wall.yaml", text.as_bytes(), &open)
        .unwrap_or_else(|problems| panic!("{problems}"))
}

fn simulated(file: DesignFile) -> Run {
    let watch = RunControl { progress: &|_| (), stop: &AtomicBool::new(false), store: None };
    let run = run(file, 1, &watch).expect("a run");
    // How much of its momentum the surge brings to the wall is none of these tests' matter.
    assert!(run.doubts.iter().all(|doubt| doubt.contains("simulated flow arrives")), "{:?}", run.doubts);
    run
}

/// Between vertical walls given as points the deepest metre takes the mean over the width, sample by sample.
#[test]
fn in_a_rectangle_of_points_every_metre_takes_the_mean() {
    let text = with_a_wall("gully.yaml");
    let (before, rest) = text.split_once("    trapezoid:").expect("a trapezoid");
    let (_, after) = rest.split_once("  base_friction").expect("friction");
    let points = "[[-1 m, 4 m], [-1 m, 0 m], [1 m, 0 m], [1 m, 4 m]]";
    let run = simulated(read(&format!("{before}    points: {points}\n  base_friction{after}")));
    let histories = &run.simulated.as_ref().expect("a simulation").histories;
    let segments = histories.barrier.rows(&SEGMENTS);
    let mut compared = 0;
    for (sample, metre) in histories.barrier.series(&METRE_FORCE).iter().enumerate() {
        let whole: f64 = segments.iter().map(|row| row[sample]).sum();
        assert_relative_eq!(*metre, whole / 2.0, max_relative = 1e-3);
        assert_relative_eq!(
            histories.barrier.series(&METRE_MOMENT)[sample],
            histories.barrier.series(&MOMENT)[sample] / 2.0,
            max_relative = 1e-3
        );
        compared += usize::from(whole > 0.0);
    }
    assert!(compared > 100, "{compared}");
}

/// In a trapezoid the deepest metre takes the pressure of every height: at rest the force of each segment over its own width, which is more
/// than the mean over the mean width.
#[test]
fn the_deepest_metre_takes_the_pressure_of_every_height() {
    let run = simulated(read(&with_a_wall("gully.yaml")));
    let (design, seen) = (&run.file.design, run.simulated.as_ref().expect("a simulation"));
    let observed = seen.first();
    let tail = 20;
    let channels = &seen.histories.barrier;
    let at_rest: Vec<f64> = channels.rows(&SEGMENTS).iter().map(|row| tail_mean(row, tail)).collect();
    let by_segments: f64 =
        at_rest.iter().enumerate().map(|(index, force)| force / wall::segment_width(design, index)).sum();
    let metre = tail_mean(channels.series(&METRE_FORCE), tail);
    assert!(metre > 0.0);
    assert_relative_eq!(metre, by_segments, max_relative = 0.06);
    let whole: f64 = at_rest.iter().sum();
    let mean = whole / guideline(design).width;
    assert!(metre > 1.05 * mean, "{metre} against {mean}");
    // Between widths of the bed and of the section at the wall's top.
    assert!((1.0 / 5.1..1.0 / 2.0).contains(&(metre / whole)), "{}", metre / whole);
    // The moment is that of the segments at their middles, to half of a segment.
    let moment = tail_mean(channels.series(&METRE_MOMENT), tail);
    let step = 2.0 / at_rest.len() as f64;
    let of_segments: f64 = at_rest
        .iter()
        .enumerate()
        .map(|(index, force)| force / wall::segment_width(design, index) * step * (index as f64 + 0.5))
        .sum();
    assert!((moment - of_segments).abs() < 0.5 * step * metre, "{moment} against {of_segments}");
    assert!(observed.one(&total_force::ON_A_METRE) >= metre);
    assert!(observed.one(&mass::LOST_BESIDE) == 0.0 && observed.one(&mass::LOST_UNDER) == 0.0);
}

/// Segments of a trapezoid with a bed of 2 m: areas between the heights, by hand.
#[test]
fn segments_have_their_true_widths() {
    let file = read(&with_a_wall("gully.yaml"));
    // Banks of 50° and 1 : 0.7, plumb; a wall normal to the bed.
    let plumb = libm::cos(16_f64.to_radians());
    let run_of_banks = (1.0 / libm::tan(50_f64.to_radians()) + 0.7) / plumb;
    for index in 0..6 {
        let middle = (index as f64 + 0.5) * 2.0 / 6.0;
        assert_relative_eq!(wall::segment_width(&file.design, index), 2.0 + run_of_banks * middle, max_relative = 1e-9);
    }
}

/// On a raster the wall closes the gully: nothing goes round it or under it.
#[test]
fn a_wall_closes_a_raster_gully() {
    let text = with_a_wall("gully_terrain.yaml").replace("height: 2 m", "height: 2.4 m").replace("0.05 GPa", "0.2 GPa");
    let run = simulated(read(&text));
    let observed = run.simulated.as_ref().expect("a simulation").first();
    let lost = [&mass::LOST_THROUGH, &mass::LOST_UNDER, &mass::LOST_BESIDE].map(|way| observed.one(way));
    assert_eq!(lost, [0.0; 3]);
    assert!(observed.one(&mass::RETAINED) > 0.9);
    assert!(observed.one(&total_force::RESIDUAL) > 0.0);
}

/// A boulder of 100 kN, 0.3 m over the lowest point of a groove of 1 : 1, hits a wall that is 0.6 m wide there, whatever the mean width is:
/// 167 kN on the metre.
#[test]
fn a_boulder_spreads_along_no_more_than_there_is_of_the_wall() {
    let text = with_a_wall("gully.yaml");
    let (before, rest) = text.split_once("    trapezoid:").expect("a trapezoid");
    let (_, after) = rest.split_once("  base_friction").expect("friction");
    let plumb = libm::cos(16_f64.to_radians());
    let points = format!("[[-4 m, {0} m], [0 m, 0 m], [4 m, {0} m]]", 4.0 / plumb);
    let text = format!("{before}    points: {points}\n  base_friction{after}");
    let with = |point: &str| {
        let text = text.replace("loads:\n", &format!("loads:\n{point}"));
        guideline(&read(&text).design)
    };
    let (alone, hit) = (with(""), with("  point_load: {force: 100 kN, height: 0.3 m}\n"));
    assert_relative_eq!(hit.metre_force - alone.metre_force, 100e3 / 0.6, max_relative = 1e-6);
}
