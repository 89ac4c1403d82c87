//! Cost against error: every knob a line through its values, what is cheap to the left, what is right below.

use std::fmt::Write;

use crate::report::plots::escape;

/// A knob turned through some values.
pub struct Line {
    pub label: String,
    /// Cost over the default's, error (share), and the value in words; in order of the values, the default among them.
    pub points: Vec<(f64, f64, String)>,
}

pub struct Pareto {
    pub title: String,
    pub lines: Vec<Line>,
    /// Cost and error of the model as it is.
    pub default: (f64, f64),
    /// Scatter of a single start, below which no error can be told.
    pub floor: f64,
}

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 430.0;
const LEFT: f64 = 60.0;
const RIGHT: f64 = 200.0;
const TOP: f64 = 14.0;
const BOTTOM: f64 = 46.0;
/// Errors below this are drawn at it.
const LEAST_ERROR: f64 = 0.001;

impl Pareto {
    /// The chart as an SVG element; both axes are logarithmic.
    pub fn svg(&self) -> String {
        let points = || self.lines.iter().flat_map(|line| &line.points);
        let costs = || points().map(|point| point.0).chain([self.default.0]).filter(|cost| *cost > 0.0);
        let (cheap, dear) = (costs().fold(f64::INFINITY, f64::min), costs().fold(0.0, f64::max));
        let (cheap, dear) = (0.8 * cheap, 1.25 * dear);
        let worst = points().map(|point| point.1).chain([self.default.1, self.floor]).fold(0.01, f64::max) * 1.3;
        let share = |value: f64, low: f64, high: f64| (value / low).ln() / (high / low).ln();
        let x = |cost: f64| LEFT + (WIDTH - LEFT - RIGHT) * share(cost.max(cheap), cheap, dear);
        let y =
            |error: f64| HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * share(error.max(LEAST_ERROR), LEAST_ERROR, worst);
        let mut out =
            format!(r#"<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{}">"#, escape(&self.title));
        let (end, bottom) = (WIDTH - RIGHT, HEIGHT - BOTTOM);
        for cost in ticks(cheap, dear) {
            let at = x(cost);
            let _ = write!(out, r#"<line class="grid" x1="{at:.1}" x2="{at:.1}" y1="{TOP}" y2="{bottom}"/>"#);
            let _ = write!(
                out,
                r#"<text class="tick" text-anchor="middle" x="{at:.1}" y="{}">{cost}</text>"#,
                bottom + 16.0
            );
        }
        for error in ticks(LEAST_ERROR, worst) {
            let at = y(error);
            let _ = write!(out, r#"<line class="grid" x1="{LEFT}" x2="{end}" y1="{at:.1}" y2="{at:.1}"/>"#);
            let _ = write!(
                out,
                r#"<text class="tick" text-anchor="end" x="{}" y="{:.1}">{} %</text>"#,
                LEFT - 6.0,
                at + 4.0,
                // Two digits below a percent.
                (1e4 * error).round() / 100.0
            );
        }
        let floor = y(self.floor);
        let _ = write!(out, r#"<line class="level" x1="{LEFT}" x2="{end}" y1="{floor:.1}" y2="{floor:.1}"/>"#);
        let _ =
            write!(out, r#"<text class="tick" x="{}" y="{:.1}">scatter of one start</text>"#, LEFT + 4.0, floor - 4.0);
        for (colour, line) in self.lines.iter().enumerate() {
            let colour = colour % 6;
            let path: Vec<String> =
                line.points.iter().map(|(cost, error, _)| format!("{:.1},{:.1}", x(*cost), y(*error))).collect();
            let _ = write!(out, r#"<polyline class="series c{colour}" points="{}"/>"#, path.join(" "));
            for (cost, error, word) in &line.points {
                let (at, up) = (x(*cost), y(*error));
                let _ = write!(out, r#"<circle class="dot c{colour}" cx="{at:.1}" cy="{up:.1}" r="3"/>"#);
                let _ = write!(
                    out,
                    r#"<text class="tick c{colour}" x="{:.1}" y="{:.1}">{}</text>"#,
                    at + 5.0,
                    up - 4.0,
                    escape(word)
                );
            }
            let _ = write!(
                out,
                r#"<text class="label c{colour}" x="{}" y="{:.1}">{}</text>"#,
                end + 10.0,
                TOP + 18.0 + 18.0 * colour as f64,
                escape(&line.label)
            );
        }
        let (at, up) = (x(self.default.0), y(self.default.1));
        let _ = write!(out, r#"<circle class="default" cx="{at:.1}" cy="{up:.1}" r="7"/>"#);
        let _ = write!(out, r#"<text class="label" x="{}" y="{}">○ as it is</text>"#, end + 10.0, bottom);
        let _ = write!(
            out,
            r#"<text class="axis" text-anchor="middle" x="{}" y="{}">cost over that of the model as it is</text>"#,
            0.5 * (LEFT + end),
            HEIGHT - 8.0
        );
        let middle = 0.5 * (TOP + bottom);
        let _ = write!(
            out,
            r#"<text class="axis" text-anchor="middle" transform="translate(13 {middle}) rotate(-90)">largest error of the observables</text></svg>"#
        );
        out
    }
}

/// 1, 2 and 5 times the powers of ten between two values.
fn ticks(low: f64, high: f64) -> Vec<f64> {
    let from = low.log10().floor() as i32;
    let powers = from..=high.log10().ceil() as i32;
    let values = powers.flat_map(|power| [1.0, 2.0, 5.0].map(|first| first * 10_f64.powi(power)));
    values.filter(|value| (low..=high).contains(value)).map(|value| (value * 1e6).round() / 1e6).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round() {
        assert_eq!(ticks(0.3, 6.0), [0.5, 1.0, 2.0, 5.0]);
    }
}
