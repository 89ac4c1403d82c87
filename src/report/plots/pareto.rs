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

/// Logarithmic scales of one chart: costs and errors from end to end.
struct Scales {
    costs: [f64; 2],
    worst: f64,
}

const END: f64 = WIDTH - RIGHT;
const FOOT: f64 = HEIGHT - BOTTOM;

impl Scales {
    fn x(&self, cost: f64) -> f64 {
        let [cheap, dear] = self.costs;
        LEFT + (END - LEFT) * share(cost.max(cheap), cheap, dear)
    }

    fn y(&self, error: f64) -> f64 {
        FOOT - (FOOT - TOP) * share(error.max(LEAST_ERROR), LEAST_ERROR, self.worst)
    }
}

/// Where a value lies between two others on a logarithmic scale.
fn share(value: f64, low: f64, high: f64) -> f64 {
    libm::log(value / low) / libm::log(high / low)
}

impl Pareto {
    /// The chart as an SVG element; both axes are logarithmic.
    pub fn svg(&self) -> String {
        let scales = self.scales();
        let mut out =
            format!(r#"<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{}">"#, escape(&self.title));
        draw_axes(&scales, &mut out);
        self.draw_floor(&scales, &mut out);
        for (number, line) in self.lines.iter().enumerate() {
            draw_line(number, line, &scales, &mut out);
        }
        let (x, y) = (scales.x(self.default.0), scales.y(self.default.1));
        let _ = write!(out, r#"<circle class="default" cx="{x:.1}" cy="{y:.1}" r="7"/>"#);
        let _ = write!(out, r#"<text class="label" x="{}" y="{FOOT}">○ as it is</text></svg>"#, END + 10.0);
        out
    }

    fn scales(&self) -> Scales {
        let points = || self.lines.iter().flat_map(|line| &line.points);
        let costs = || points().map(|point| point.0).chain([self.default.0]).filter(|cost| *cost > 0.0);
        let (cheap, dear) = (costs().fold(f64::INFINITY, f64::min), costs().fold(0.0, f64::max));
        let errors = points().map(|point| point.1).chain([self.default.1, self.floor]);
        Scales { costs: [0.8 * cheap, 1.25 * dear], worst: 1.3 * errors.fold(0.01, f64::max) }
    }

    fn draw_floor(&self, scales: &Scales, out: &mut String) {
        let y = scales.y(self.floor);
        let _ = write!(out, r#"<line class="level" x1="{LEFT}" x2="{END}" y1="{y:.1}" y2="{y:.1}"/>"#);
        let (x, y) = (LEFT + 4.0, y - 4.0);
        let _ = write!(out, r#"<text class="tick" x="{x}" y="{y:.1}">scatter of one run</text>"#);
    }
}

fn draw_axes(scales: &Scales, out: &mut String) {
    let [cheap, dear] = scales.costs;
    for cost in ticks(cheap, dear) {
        let (x, y) = (scales.x(cost), FOOT + 16.0);
        let _ = write!(out, r#"<line class="grid" x1="{x:.1}" x2="{x:.1}" y1="{TOP}" y2="{FOOT}"/>"#);
        let _ = write!(out, r#"<text class="tick" text-anchor="middle" x="{x:.1}" y="{y}">{cost}</text>"#);
    }
    for error in ticks(LEAST_ERROR, scales.worst) {
        let (x, y) = (LEFT - 6.0, scales.y(error));
        let _ = write!(out, r#"<line class="grid" x1="{LEFT}" x2="{END}" y1="{y:.1}" y2="{y:.1}"/>"#);
        // Two digits below a percent.
        let (percent, y) = ((1e4 * error).round() / 100.0, y + 4.0);
        let _ = write!(out, r#"<text class="tick" text-anchor="end" x="{x}" y="{y:.1}">{percent} %</text>"#);
    }
    let (across, up, foot) = (0.5 * (LEFT + END), 0.5 * (TOP + FOOT), HEIGHT - 8.0);
    let labels = [
        (format!(r#"x="{across}" y="{foot}""#), "cost over that of the model as it is"),
        (format!(r#"transform="translate(13 {up}) rotate(-90)""#), "largest error of the observables"),
    ];
    for (place, label) in labels {
        let _ = write!(out, r#"<text class="axis" text-anchor="middle" {place}>{label}</text>"#);
    }
}

fn draw_line(number: usize, line: &Line, scales: &Scales, out: &mut String) {
    let colour = number % 6;
    let places = line.points.iter().map(|(cost, error, word)| (scales.x(*cost), scales.y(*error), word));
    let path: Vec<String> = places.clone().map(|(x, y, _)| format!("{x:.1},{y:.1}")).collect();
    let _ = write!(out, r#"<polyline class="series c{colour}" points="{}"/>"#, path.join(" "));
    for (x, y, word) in places {
        let _ = write!(out, r#"<circle class="dot c{colour}" cx="{x:.1}" cy="{y:.1}" r="3"/>"#);
        let (x, y, word) = (x + 5.0, y - 4.0, escape(word));
        let _ = write!(out, r#"<text class="tick c{colour}" x="{x:.1}" y="{y:.1}">{word}</text>"#);
    }
    let (x, y, label) = (END + 10.0, TOP + 18.0 * (number as f64 + 1.0), escape(&line.label));
    let _ = write!(out, r#"<text class="label c{colour}" x="{x}" y="{y:.1}">{label}</text>"#);
}

/// 1, 2 and 5 times the powers of ten between two values.
fn ticks(low: f64, high: f64) -> Vec<f64> {
    let from = libm::log10(low).floor() as i32;
    let powers = from..=libm::log10(high).ceil() as i32;
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
