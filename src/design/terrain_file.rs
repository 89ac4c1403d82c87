//! A terrain raster in the place of a section and a profile: the ground around the barrier, in the barrier's directions.

use std::sync::{Arc, Mutex, PoisonError};

use crate::raster::{Raster, read};
use crate::relief::Relief;

/// What the design says of its terrain (m): ends of the barrier as (east, north), and lengths along the channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Asked {
    pub left: [f64; 2],
    pub right: [f64; 2],
    pub upstream: f64,
    pub downstream: f64,
}

/// What follows from it.
#[derive(Clone, Debug)]
pub struct Terrain {
    pub relief: Arc<Relief>,
    /// The section at the barrier: distance from its left end to the right, and plumb height over the lowest ground between the ends (m).
    pub section: Vec<[f64; 2]>,
    /// Mean slope of the lowest line at the barrier (rad).
    pub slope: f64,
}

/// The key that a fault belongs to, what was found, what would help.
pub type Wrong = (&'static str, String, String);

/// Ground beyond either end of the barrier, over its length.
const BESIDE: f64 = 0.3;
/// Points to a cell of the raster along a side, so that the grid, which is turned against it, says the same; the ground of the simulation has one.
pub const FINE: usize = 4;
/// Points of the grid at the most; a finer raster is taken in wider steps.
const MOST_POINTS: f64 = 400_000.0;
/// Stretch of the lowest line over which its slope at the barrier is the mean: upstream and downstream (m).
const MEAN_SLOPE: [f64; 2] = [10.0, 3.0];
/// Angle between the lowest line and the square to the barrier's line beyond which the section is none of the gully (rad): 25 degrees.
const MOST_TURNED: f64 = 0.436;
/// Rise of the ground over a metre beyond which it is no ground.
const STEEPEST_STEP: f64 = 15.0;
/// Length of a barrier (m).
const LENGTHS: [f64; 2] = [1.0, 200.0];

/// The last raster, what was asked of it, and what followed.
type Last = Option<(Vec<u8>, Asked, Terrain)>;

/// What follows from a raster. That of the last call is remembered: the samples of a study differ in other things.
pub fn terrain(bytes: &[u8], asked: &Asked) -> Result<Terrain, Wrong> {
    static LAST: Mutex<Last> = Mutex::new(None);
    let last = || LAST.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((.., terrain)) = last().as_ref().filter(|(known, of, _)| of == asked && known == bytes) {
        return Ok(terrain.clone());
    }
    let terrain = worked_out(bytes, asked)?;
    *last() = Some((bytes.to_vec(), *asked, terrain.clone()));
    Ok(terrain)
}

fn worked_out(bytes: &[u8], asked: &Asked) -> Result<Terrain, Wrong> {
    let raster = read(bytes).map_err(|(found, hint)| ("file", found, hint))?;
    ends_are_inside(&raster, asked)?;
    let [left, right] = [asked.left, asked.right];
    let span = libm::hypot(right[0] - left[0], right[1] - left[1]);
    if !(LENGTHS[0]..=LENGTHS[1]).contains(&span) {
        let found = format!("a barrier of {span:.2} m between its ends");
        return Err((
            "right_end",
            found,
            "its ends are from 1 m to 200 m apart: are both in the coordinates of the raster?".into(),
        ));
    }
    let rightwards = [(right[0] - left[0]) / span, (right[1] - left[1]) / span];
    let downstream = [-rightwards[1], rightwards[0]];
    let area = (asked.upstream + asked.downstream) * (1.0 + 2.0 * BESIDE) * span;
    let step = (raster.cell / FINE as f64).max((area / MOST_POINTS).sqrt());
    let beside = BESIDE * span;
    // Whole cells of the ground of the simulation, which takes every so many points.
    let cells = |length: f64| (length / (FINE as f64 * step)).ceil() as usize * FINE;
    let (before, after, across) = (cells(asked.upstream), cells(asked.downstream), cells(span + 2.0 * beside));
    let place = |x: f64, y: f64| {
        let to_the_right = span + beside - y;
        [0, 1].map(|axis| left[axis] + rightwards[axis] * to_the_right + downstream[axis] * x)
    };
    let height = |x: f64, y: f64| raster.height(place(x, y));
    let relief = Relief::sample([-step * before as f64, 0.0], step, [before + after + 1, across + 1], height);
    let relief = relief.map_err(|[x, y]| {
        let [east, north] = place(x, y);
        let where_it_is = match x {
            x if x < 0.0 => format!("{:.0} m upstream of the barrier", -x),
            x => format!("{x:.0} m downstream of the barrier"),
        };
        let [first, last] = [raster.first, raster.last()];
        (
            "file",
            format!("which has no height at {east:.1}, {north:.1}, {where_it_is} and {:.0} m from its left end to the right", span + beside - y),
            format!(
                "the raster goes from {:.1}, {:.1} to {:.1}, {:.1}: give a larger one without gaps, or shorter channel.terrain.upstream and downstream",
                first[0], first[1], last[0], last[1]
            ),
        )
    })?;
    let row = relief.row_of_the_barrier();
    let line = relief.thalweg();
    let to_the_right = |column: usize| span + beside - relief.y(column);
    let at = to_the_right(line[row]);
    if !(0.05 * span..=0.95 * span).contains(&at) {
        return Err((
            "left_end",
            format!(
                "ends with no gully between them: the lowest ground on their line is {at:.1} m from the left end of {span:.1} m"
            ),
            "give the places in the two banks where the barrier is anchored".into(),
        ));
    }
    let aside = turned(&relief, line);
    if aside.abs() > MOST_TURNED {
        return Err((
            "left_end",
            format!(
                "ends whose line is not square to the gully: just upstream its lowest line runs {:.0} degrees aside",
                aside.abs().to_degrees()
            ),
            "put the ends so that the line between them crosses the gully at a right angle".into(),
        ));
    }
    if let Some([x, rise]) = relief.steepest().filter(|[_, rise]| *rise > STEEPEST_STEP) {
        return Err((
            "file",
            format!("with a step of {rise:.0} m to a metre, {x:.0} m from the barrier along the gully"),
            "if a number in the file stands for missing heights, name it in the header as `NODATA_value`; otherwise take the step out".into(),
        ));
    }
    let section = section_at_the_barrier(&relief, span, to_the_right);
    let relief = relief.over(relief.corner(row, line[row]));
    let slope = slope_at_the_barrier(&relief);
    if slope <= 0.0 {
        return Err((
            "left_end",
            format!("a bed that falls by {:.1} degrees upstream", -slope.to_degrees()),
            "left and right are as one looks downstream: exchange the two ends".into(),
        ));
    }
    Ok(Terrain { relief: Arc::new(relief), section, slope })
}

/// The section on the line between the ends of a barrier, as [`Terrain::section`] has it.
///
/// Beyond the ends the ground is taken to go on rising: a hollow there is not part of the gully.
fn section_at_the_barrier(relief: &Relief, span: f64, to_the_right: impl Fn(usize) -> f64) -> Vec<[f64; 2]> {
    let row = relief.row_of_the_barrier();
    let lowest = relief.corner(row, relief.thalweg()[row]);
    let listed = |column: usize| [to_the_right(column), relief.corner(row, column) - lowest];
    let mut section: Vec<[f64; 2]> = (0..relief.columns()).rev().map(listed).collect();
    let end = |right: f64| section.iter().position(|point| point[0] >= right).unwrap_or(0);
    let (first, last) = (end(0.0), end(span));
    for index in (0..first).rev() {
        section[index][1] = section[index][1].max(section[index + 1][1]);
    }
    for index in last + 1..section.len() {
        section[index][1] = section[index][1].max(section[index - 1][1]);
    }
    section
}

/// Angle between the lowest line just upstream of the barrier and the square to its line (rad).
fn turned(relief: &Relief, line: &[usize]) -> f64 {
    let row = relief.row_of_the_barrier();
    let far = (0..row).find(|row| relief.x(*row) >= -MEAN_SLOPE[0]).unwrap_or(row);
    libm::atan2(relief.y(line[far]) - relief.y(line[row]), relief.x(row) - relief.x(far))
}

fn ends_are_inside(raster: &Raster, asked: &Asked) -> Result<(), Wrong> {
    for (key, end) in [("left_end", asked.left), ("right_end", asked.right)] {
        if raster.height(end).is_none() {
            let [first, last] = [raster.first, raster.last()];
            let found = format!("{:.2}, {:.2}, where the raster has no height", end[0], end[1]);
            let hint = format!(
                "it goes from {:.1}, {:.1} to {:.1}, {:.1} (east, north): are these its coordinates, east first?",
                first[0], first[1], last[0], last[1]
            );
            return Err((key, found, hint));
        }
    }
    Ok(())
}

/// Slope of a straight line through the lowest line (rad), least squares.
fn slope_at_the_barrier(relief: &Relief) -> f64 {
    let line = relief.thalweg();
    let near = |row: &usize| (-MEAN_SLOPE[0]..=MEAN_SLOPE[1]).contains(&relief.x(*row));
    let places: Vec<[f64; 2]> =
        (0..relief.rows()).filter(near).map(|row| [relief.x(row), relief.corner(row, line[row])]).collect();
    let count = places.len() as f64;
    let [x, z] = [0, 1].map(|axis| places.iter().map(|place| place[axis]).sum::<f64>() / count);
    let both: f64 = places.iter().map(|place| (place[0] - x) * (place[1] - z)).sum();
    let square: f64 = places.iter().map(|place| (place[0] - x).powi(2)).sum();
    if square > 0.0 { libm::atan(-both / square) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A gully that falls to the north by 20 %, its lowest line at east 50, banks of 45°; cells of 1 m, 100 by 100.
    fn grid() -> String {
        let mut text = "ncols 100\nnrows 100\nxllcenter 0\nyllcenter 1000\ncellsize 1\n".to_string();
        for row in 0..100 {
            let north = 99.0 - f64::from(row);
            for column in 0..100 {
                text += &format!("{:.3} ", 500.0 - 0.2 * north + (f64::from(column) - 50.0).abs());
            }
        }
        text
    }

    const ASKED: Asked = Asked { left: [44.0, 1050.0], right: [56.0, 1050.0], upstream: 30.0, downstream: 20.0 };

    #[test]
    fn a_raster_is_turned_into_the_directions_of_the_barrier() {
        let terrain = terrain(grid().as_bytes(), &ASKED).unwrap();
        assert!((terrain.slope - libm::atan(0.2)).abs() < 1e-6, "{}", terrain.slope);
        let lowest = terrain.section.iter().min_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
        assert!((lowest[0] - 6.0).abs() < 0.5 && lowest[1] == 0.0);
        assert!(terrain.section.windows(2).all(|pair| pair[1][0] > pair[0][0]));
        assert!(terrain.section[0][0] < -3.0 && terrain.section[0][1] > 9.0);
        // Upstream, to the south, it is higher.
        let line = terrain.relief.thalweg();
        assert!((terrain.relief.corner(0, line[0]) - 6.0).abs() < 0.51);
        assert_eq!(terrain.relief.stretch(), [-30.0, 20.0]);
    }

    #[test]
    fn what_does_not_fit_the_raster_is_told() {
        let grid = grid();
        let told = |asked: Asked| terrain(grid.as_bytes(), &asked).unwrap_err();
        assert_eq!(told(Asked { left: ASKED.right, right: ASKED.left, ..ASKED }).0, "left_end");
        assert!(told(Asked { left: ASKED.right, right: ASKED.left, ..ASKED }).2.contains("exchange the two ends"));
        assert!(told(Asked { left: [2e6, 1e6], ..ASKED }).1.contains("no height"));
        assert!(told(Asked { right: [44.2, 1050.0], ..ASKED }).1.contains("a barrier of 0.20 m"));
        assert!(told(Asked { upstream: 80.0, ..ASKED }).1.contains("upstream of the barrier"));
        assert!(told(Asked { left: [60.0, 1050.0], right: [70.0, 1050.0], ..ASKED }).1.contains("no gully"));
        let gap = grid.replacen("ncols", "NODATA_value 487.200\nncols", 1);
        assert!(terrain(gap.as_bytes(), &ASKED).unwrap_err().1.contains("no height at"));
    }
}
