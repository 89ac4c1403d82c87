//! The ground from above, downstream to the right: contours, the lowest line and the barrier.

use std::fmt::Write;

use crate::relief::Relief;

const WIDTH: f64 = 720.0;
const TALLEST: f64 = 420.0;
const MARGIN: f64 = 12.0;
const BELOW: f64 = 30.0;
/// Contours drawn, about, and how many thin ones there are to a bold one.
const CONTOURS: f64 = 24.0;
const BOLD: i64 = 5;

/// What is drawn over the contours; lengths in m.
pub struct Plan<'a> {
    pub relief: &'a Relief,
    /// Ends of the barrier across the channel, and its height over the lowest ground, plumb.
    pub barrier: [f64; 2],
    /// From where to where upstream the flow starts, level.
    pub release: Option<[f64; 2]>,
}

/// Interval between contours (m), round.
fn interval(range: f64) -> f64 {
    let rough = range / CONTOURS;
    let steps = [0.1, 0.2, 0.25, 0.5, 1.0, 2.0, 2.5, 5.0, 10.0, 20.0, 50.0];
    steps.into_iter().find(|step| *step >= rough).unwrap_or(rough.max(0.1))
}

pub fn plan(drawn: &Plan) -> String {
    let relief = drawn.relief;
    let [from, to] = relief.stretch();
    let across = relief.y(relief.columns() - 1) - relief.y(0);
    let scale = ((WIDTH - 2.0 * MARGIN) / (to - from)).min(TALLEST / across);
    let place = |x: f64, y: f64| [MARGIN + (x - from) * scale, MARGIN + (across - (y - relief.y(0))) * scale];
    let height = 2.0 * MARGIN + across * scale + BELOW;
    let mut svg =
        format!("<svg viewBox=\"0 0 {WIDTH} {height:.0}\" role=\"img\" aria-label=\"the ground from above\">");
    let corners =
        (0..relief.rows()).flat_map(|row| (0..relief.columns()).map(move |column| relief.corner(row, column)));
    let [low, high] = corners.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(z), high.max(z)]);
    let step = interval(high - low);
    for number in (low / step).ceil() as i64..=(high / step).floor() as i64 {
        let path = contour(relief, number as f64 * step, &place);
        let class = if number % BOLD == 0 { "contour bold" } else { "contour" };
        let _ = write!(svg, "<path class=\"{class}\" d=\"{path}\"/>");
    }
    let line: Vec<String> = relief
        .thalweg()
        .iter()
        .enumerate()
        .map(|(row, column)| {
            let [x, y] = place(relief.x(row), relief.y(*column));
            format!("{x:.1},{y:.1}")
        })
        .collect();
    let _ = write!(svg, "<polyline class=\"thalweg\" points=\"{}\"/>", line.join(" "));
    if let Some([near, far]) = drawn.release {
        let ([x1, y1], [x2, y2]) = (place(-far, relief.y(0) + across), place(-near, relief.y(0)));
        let _ = write!(
            svg,
            "<rect class=\"band\" x=\"{x1:.1}\" y=\"{y1:.1}\" width=\"{:.1}\" height=\"{:.1}\"/><text x=\"{:.1}\" y=\"{:.1}\">flow at its release</text>",
            x2 - x1,
            y2 - y1,
            x1 + 4.0,
            y1 + 14.0
        );
    }
    let ([x, y1], [_, y2]) = (place(0.0, drawn.barrier[0]), place(0.0, drawn.barrier[1]));
    let _ = write!(svg, "<line class=\"wall\" x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{y1:.1}\" y2=\"{y2:.1}\"/>");
    let _ = write!(
        svg,
        "<text x=\"{:.1}\" y=\"{:.1}\">contours every {step} m; downstream to the right</text>",
        MARGIN + 0.3 * WIDTH,
        height - 6.0
    );
    svg + &super::scale_bar(MARGIN, height - 10.0, scale, 0.2 * WIDTH) + "</svg>"
}

/// Pieces of a contour, one or two to a cell (marching squares).
fn contour(relief: &Relief, level: f64, place: &dyn Fn(f64, f64) -> [f64; 2]) -> String {
    let mut path = String::new();
    for row in 0..relief.rows() - 1 {
        for column in 0..relief.columns() - 1 {
            let corners = [(row, column), (row + 1, column), (row + 1, column + 1), (row, column + 1)];
            let mut cuts: Vec<[f64; 2]> = Vec::new();
            for side in 0..4 {
                let [a, b] = [corners[side], corners[(side + 1) % 4]];
                let [low, high] = [a, b].map(|(row, column)| relief.corner(row, column) - level);
                if (low > 0.0) != (high > 0.0) {
                    let share = low / (low - high);
                    let mix = |from: f64, to: f64| from + share * (to - from);
                    cuts.push(place(mix(relief.x(a.0), relief.x(b.0)), mix(relief.y(a.1), relief.y(b.1))));
                }
            }
            for pair in cuts.chunks_exact(2) {
                let _ = write!(path, "M{:.1} {:.1}L{:.1} {:.1}", pair[0][0], pair[0][1], pair[1][0], pair[1][1]);
            }
        }
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plane that rises by one in ten upstream: its contour at 1 m is a line across, 10 m upstream.
    #[test]
    fn a_contour_of_a_plane_is_a_line() {
        let relief = Relief::sample([-20.0, 0.0], 1.0, [31, 11], |x, _| Some(-0.1 * x)).unwrap();
        let path = contour(&relief, 1.05, &|x, y| [x, y]);
        let places: Vec<f64> = path
            .split(['M', 'L'])
            .filter(|pair| !pair.is_empty())
            .map(|pair| pair.split(' ').next().unwrap().parse().unwrap())
            .collect();
        assert_eq!(places.len(), 20);
        assert!(places.iter().all(|x| (x + 10.5).abs() < 0.051), "{places:?}");
        let drawn = plan(&Plan { relief: &relief, barrier: [2.0, 8.0], release: Some([3.0, 8.0]) });
        assert!(drawn.contains("contours every 0.2 m") && drawn.contains("flow at its release"));
    }
}
