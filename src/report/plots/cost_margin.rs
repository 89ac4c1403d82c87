//! Price against the largest share that a check uses: what is cheap to the left, what has margin below.

use std::fmt::Write;

use crate::report::plots::escape;

/// What a dot came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    Pass,
    Open,
    Fail,
    /// Failed by the equations.
    Refuted,
}

impl Mark {
    const ALL: [Self; 4] = [Self::Pass, Self::Open, Self::Fail, Self::Refuted];

    fn class(self) -> &'static str {
        match self {
            Self::Pass => "dot-pass",
            Self::Open => "dot-open",
            Self::Fail => "dot-fail",
            Self::Refuted => "dot-refuted",
        }
    }

    fn words(self) -> &'static str {
        match self {
            Self::Pass => "passes",
            Self::Open => "undecided",
            Self::Fail => "fails by simulation",
            Self::Refuted => "fails by equations",
        }
    }
}

pub struct Dot {
    pub price: f64,
    pub used: f64,
    pub mark: Mark,
}

pub struct CostMargin {
    pub dots: Vec<Dot>,
    /// Price of the cheapest, and the share that its checks may use.
    pub front: Vec<[f64; 2]>,
    /// Share that a check may use.
    pub limit: f64,
    pub currency: String,
}

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 360.0;
const LEFT: f64 = 60.0;
const END: f64 = WIDTH - 170.0;
const TOP: f64 = 14.0;
const FOOT: f64 = HEIGHT - 46.0;
/// Share at the top of the chart.
const MOST: f64 = 2.0;

impl CostMargin {
    pub fn svg(&self) -> String {
        let prices = || self.dots.iter().map(|dot| dot.price);
        let [low, high] = [prices().fold(f64::INFINITY, f64::min), prices().fold(0.0, f64::max)];
        let room = (0.05 * (high - low)).max(0.01 * high).max(1e-9);
        let (low, high) = ((low - room).max(0.0), high + room);
        let x = |price: f64| LEFT + (END - LEFT) * (price - low) / (high - low);
        let y = |used: f64| FOOT - (FOOT - TOP) * used.clamp(0.0, MOST) / MOST;
        let mut out = format!(r#"<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="">"#);
        for percent in [0, 50, 100, 150, 200] {
            let at = y(f64::from(percent) / 100.0);
            let _ = write!(out, r#"<line class="grid" x1="{LEFT}" x2="{END}" y1="{at:.1}" y2="{at:.1}"/>"#);
            let _ = write!(
                out,
                r#"<text class="tick" x="{:.1}" y="{:.1}" text-anchor="end">{percent} %</text>"#,
                LEFT - 6.0,
                at + 4.0
            );
        }
        for step in 0..=4 {
            let price = low + (high - low) * f64::from(step) / 4.0;
            let _ = write!(
                out,
                r#"<text class="tick" x="{:.1}" y="{:.1}" text-anchor="middle">{}</text>"#,
                x(price),
                FOOT + 18.0,
                crate::report::numbers::figures(price)
            );
        }
        let middle = 0.5 * (LEFT + END);
        let _ = write!(
            out,
            r#"<text class="label" x="{middle:.1}" y="{:.1}" text-anchor="middle">price ({})</text>"#,
            HEIGHT - 6.0,
            escape(&self.currency)
        );
        let limit = y(self.limit);
        let _ = write!(out, r#"<line class="limit" x1="{LEFT}" x2="{END}" y1="{limit:.1}" y2="{limit:.1}"/>"#);
        let _ = write!(out, r#"<text class="label" x="{:.1}" y="{:.1}">limit</text>"#, END + 8.0, limit + 4.0);
        if self.front.len() > 1 {
            let points: Vec<String> =
                self.front.iter().map(|[price, used]| format!("{:.1},{:.1}", x(*price), y(*used))).collect();
            let _ = write!(out, r#"<polyline class="front" points="{}"/>"#, points.join(" "));
        }
        // What passes on top of all else.
        for mark in Mark::ALL.into_iter().rev() {
            for dot in self.dots.iter().filter(|dot| dot.mark == mark) {
                let (at, up) = (x(dot.price), y(dot.used));
                let _ = write!(out, r#"<circle class="{}" cx="{at:.1}" cy="{up:.1}" r="4"/>"#, mark.class());
            }
        }
        let told = Mark::ALL.into_iter().filter(|mark| self.dots.iter().any(|dot| dot.mark == *mark));
        for (row, mark) in told.enumerate() {
            let up = TOP + 12.0 + 20.0 * row as f64;
            let _ = write!(out, r#"<circle class="{}" cx="{:.1}" cy="{up:.1}" r="4"/>"#, mark.class(), END + 14.0);
            let _ =
                write!(out, r#"<text class="label" x="{:.1}" y="{:.1}">{}</text>"#, END + 24.0, up + 4.0, mark.words());
        }
        out + "</svg>"
    }
}
