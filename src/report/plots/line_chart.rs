//! A line chart: some series over time, with level lines drawn in.

use std::fmt::Write;

use crate::report::plots::escape;

/// One curve.
pub struct Series<'a> {
    pub label: String,
    pub values: &'a [f64],
    /// Number of the colour, which the page's style sheet sets.
    pub colour: usize,
}

/// A horizontal line at a value of interest.
pub struct Level {
    pub label: String,
    pub value: f64,
}

pub struct LineChart<'a> {
    pub title: &'a str,
    pub unit: &'a str,
    /// Factor from the series' unit to the shown unit.
    pub factor: f64,
    /// What runs along the chart, with its unit, and its values.
    pub along: &'a str,
    pub time: &'a [f64],
    pub series: Vec<Series<'a>>,
    pub levels: Vec<Level>,
    /// Least and largest value over several starts, drawn behind the curves.
    pub band: Option<[Vec<f64>; 2]>,
}

/// One curve for each main rope that moves, from rows of values by rope.
pub fn rope_series(rows: &[Vec<f64>]) -> Vec<Series<'_>> {
    let moving = rows.iter().enumerate().filter(|(_, row)| row.iter().any(|value| *value > 0.0));
    moving.map(|(index, row)| Series { label: format!("rope {}", index + 1), values: row, colour: index % 6 }).collect()
}

/// Of charts over time.
pub const TIME: &str = "time since release (s)";

/// So small that the text is read in half a page's width.
const WIDTH: f64 = 500.0;
const HEIGHT: f64 = 250.0;
const LEFT: f64 = 56.0;
const RIGHT: f64 = 140.0;
const TOP: f64 = 16.0;
const BOTTOM: f64 = 42.0;
/// Columns into which the time axis is cut; in each the least and the largest value are drawn.
const COLUMNS: usize = 400;
/// Length of the line that leads from a curve's end to its label.
const LEADER: f64 = 14.0;
/// Least distance between two labels at the right edge.
const LABEL_STEP: f64 = 14.0;

/// Scales of one chart.
struct Frame {
    last_time: f64,
    low: f64,
    high: f64,
}

impl Frame {
    fn x(&self, time: f64) -> f64 {
        LEFT + (WIDTH - LEFT - RIGHT) * time / self.last_time
    }

    fn y(&self, value: f64) -> f64 {
        HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * (value - self.low) / (self.high - self.low)
    }
}

impl LineChart<'_> {
    /// The chart as an SVG element.
    pub fn svg(&self) -> String {
        let frame = self.frame();
        let mut out = String::new();
        let _ = write!(out, r#"<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{}">"#, escape(self.title));
        self.draw_axes(&frame, &mut out);
        if let Some(band) = &self.band {
            self.draw_band(band, &frame, &mut out);
        }
        let mut labels = Vec::new();
        for level in &self.levels {
            let y = frame.y(level.value * self.factor);
            let end = WIDTH - RIGHT;
            let _ = write!(out, r#"<line class="level" x1="{LEFT}" x2="{end}" y1="{y:.1}" y2="{y:.1}"/>"#);
            labels.push((y, level.label.clone(), "level".to_string()));
        }
        for series in &self.series {
            for points in self.stretches(series, &frame) {
                let _ = write!(out, r#"<polyline class="series c{}" points="{points}"/>"#, series.colour);
            }
            let known = series.values.iter().rev().find(|value| value.is_finite());
            let last = known.copied().unwrap_or(0.0) * self.factor;
            labels.push((frame.y(last), series.label.clone(), format!("c{}", series.colour)));
        }
        draw_labels(labels, &mut out);
        out.push_str("</svg>");
        out
    }

    /// The area between two curves, at as many moments as a curve has columns.
    fn draw_band(&self, [low, high]: &[Vec<f64>; 2], frame: &Frame, out: &mut String) {
        let count = self.time.len().min(low.len()).min(high.len());
        let moments: Vec<usize> = (0..count).step_by(count.div_ceil(COLUMNS).max(1)).collect();
        let place = |values: &[f64], moment: usize| {
            format!("{:.1},{:.1}", frame.x(self.time[moment]), frame.y(values[moment] * self.factor))
        };
        let there = moments.iter().map(|moment| place(high, *moment));
        let back = moments.iter().rev().map(|moment| place(low, *moment));
        let points: Vec<String> = there.chain(back).collect();
        let _ = write!(out, r#"<polygon class="band" points="{}"/>"#, points.join(" "));
    }

    fn frame(&self) -> Frame {
        let values = self.series.iter().flat_map(|series| series.values.iter().map(|value| value * self.factor));
        let band = self.band.iter().flatten().flatten().map(|value| value * self.factor);
        let (low, high) = values
            .chain(band)
            .chain(self.levels.iter().map(|level| level.value * self.factor))
            .filter(|value| value.is_finite())
            .fold((0.0_f64, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
        let high = if high > low { high } else { low + 1.0 };
        let step = nice_step(high - low);
        let last_time = self.time.last().copied().filter(|time| *time > 0.0).unwrap_or(1.0);
        Frame { last_time, low: (low / step).floor() * step, high: (high / step).ceil() * step }
    }

    fn draw_axes(&self, frame: &Frame, out: &mut String) {
        let (bottom, end) = (HEIGHT - BOTTOM, WIDTH - RIGHT);
        let step = nice_step(frame.high - frame.low);
        for value in ticks(frame.low, frame.high, step) {
            let y = frame.y(value);
            let _ = write!(out, r#"<line class="grid" x1="{LEFT}" x2="{end}" y1="{y:.1}" y2="{y:.1}"/>"#);
            let _ = write!(
                out,
                r#"<text class="tick" text-anchor="end" x="{}" y="{:.1}">{}</text>"#,
                LEFT - 6.0,
                y + 4.0,
                short(value)
            );
        }
        let step = nice_step(frame.last_time);
        for time in ticks(0.0, frame.last_time, step) {
            let x = frame.x(time);
            let _ = write!(out, r#"<line class="grid" x1="{x:.1}" x2="{x:.1}" y1="{TOP}" y2="{bottom}"/>"#);
            let _ = write!(
                out,
                r#"<text class="tick" text-anchor="middle" x="{x:.1}" y="{}">{}</text>"#,
                bottom + 16.0,
                short(time)
            );
        }
        let middle = 0.5 * (LEFT + end);
        let _ = write!(
            out,
            r#"<text class="axis" text-anchor="middle" x="{middle}" y="{}">{}</text>"#,
            HEIGHT - 6.0,
            escape(self.along)
        );
        let up = 0.5 * (TOP + bottom);
        let _ = write!(
            out,
            r#"<text class="axis" text-anchor="middle" transform="translate(14 {up}) rotate(-90)">{} ({})</text>"#,
            escape(self.title),
            escape(self.unit)
        );
    }

    /// Points of a curve, thinned so that every peak survives; it breaks off where no value is known.
    fn stretches(&self, series: &Series, frame: &Frame) -> Vec<String> {
        let count = self.time.len().min(series.values.len());
        let chunk = count.div_ceil(COLUMNS).max(1);
        let mut stretches = vec![String::new()];
        for start in (0..count).step_by(chunk) {
            let known = |index: &usize| series.values[*index].is_finite();
            let range = || (start..(start + chunk).min(count)).filter(known);
            let by_value = |a: &usize, b: &usize| series.values[*a].total_cmp(&series.values[*b]);
            let (Some(low), Some(high)) = (range().min_by(by_value), range().max_by(by_value)) else {
                stretches.push(String::new());
                continue;
            };
            let mut pair = [low, high];
            pair.sort_unstable();
            for index in if low == high { &pair[..1] } else { &pair[..] } {
                let (x, y) = (frame.x(self.time[*index]), frame.y(series.values[*index] * self.factor));
                if let Some(stretch) = stretches.last_mut() {
                    let _ = write!(stretch, "{x:.1},{y:.1} ");
                }
            }
        }
        stretches.retain(|stretch| !stretch.is_empty());
        stretches
    }
}

/// The series at other times, by straight lines; its last value beyond its end.
pub fn resampled(time: &[f64], values: &[f64], wanted: &[f64]) -> Vec<f64> {
    let at = |moment: &f64| {
        let after = time.partition_point(|time| time < moment);
        match (after.checked_sub(1), time.get(after)) {
            (Some(before), Some(next)) => {
                let share = (moment - time[before]) / (next - time[before]);
                values[before] + share * (values[after] - values[before])
            }
            (None, _) => values.first().copied().unwrap_or(0.0),
            (Some(last), None) => values[last],
        }
    };
    wanted.iter().map(at).collect()
}

/// Labels at the right edge, pushed apart where they would overlap.
fn draw_labels(mut labels: Vec<(f64, String, String)>, out: &mut String) {
    labels.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut lowest_free = TOP;
    for (y, label, class) in labels {
        let place = y.max(lowest_free);
        lowest_free = place + LABEL_STEP;
        // From the end of the curve to its label.
        let (from, to) = (WIDTH - RIGHT, WIDTH - RIGHT + LEADER);
        let _ = write!(out, r#"<polyline class="leader {class}" points="{from},{y:.1} {to},{place:.1}"/>"#);
        let _ = write!(
            out,
            r#"<text class="label {class}" x="{}" y="{:.1}">{}</text>"#,
            WIDTH - RIGHT + LEADER + 3.0,
            place + 4.0,
            escape(&label)
        );
    }
}

/// Values of the grid lines from `low` to `high`.
fn ticks(low: f64, high: f64, step: f64) -> impl Iterator<Item = f64> {
    let count = ((high - low) / step + 1e-9).floor() as usize;
    (0..=count).map(move |index| low + step * index as f64)
}

/// A step of 1, 2 or 5 times a power of ten that cuts `span` into four to ten parts.
fn nice_step(span: f64) -> f64 {
    let rough = span / 6.0;
    let power = libm::pow(10_f64, libm::log10(rough).floor());
    let choices = [1.0, 2.0, 5.0, 10.0];
    choices.into_iter().map(|choice| choice * power).find(|step| *step >= rough).unwrap_or(power)
}

fn short(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text.is_empty() || text == "-0" { "0".to_string() } else { text.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_one<'a>(time: &'a [f64], values: &'a [f64]) -> LineChart<'a> {
        let series = vec![Series { label: "a".into(), values, colour: 0 }];
        LineChart { title: "t", unit: "N", factor: 1.0, along: TIME, time, series, levels: Vec::new(), band: None }
    }

    #[test]
    fn peaks_survive_thinning() {
        let time: Vec<f64> = (0..10_000).map(f64::from).collect();
        let mut values = vec![0.0; 10_000];
        values[7_777] = 5.0;
        let chart = of_one(&time, &values);
        let frame = chart.frame();
        let top = format!("{:.1}", frame.y(5.0));
        assert!(chart.stretches(&chart.series[0], &frame)[0].contains(&top));
    }

    #[test]
    fn a_curve_breaks_off_where_nothing_is_known() {
        let values = [1.0, 2.0, f64::NAN, f64::NAN, 3.0, 4.0];
        let time = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0];
        let chart = of_one(&time, &values);
        assert_eq!(chart.stretches(&chart.series[0], &chart.frame()).len(), 2);
    }

    #[test]
    fn steps_are_round() {
        assert_eq!(nice_step(6.0), 1.0);
        assert_eq!(nice_step(2990.0), 500.0);
        assert_eq!(nice_step(0.7), 0.2);
    }

    #[test]
    fn curves_meet_on_common_times() {
        let curve = resampled(&[1.0, 2.0], &[10.0, 20.0], &[0.0, 1.5, 3.0]);
        assert_eq!(curve, [10.0, 15.0, 20.0]);
    }
}
