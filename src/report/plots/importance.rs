//! Importance of inputs: what each brings to the variance alone and with all others, or its squared weight at the design point, as bars.

use std::fmt::Write;

use crate::report::numbers::percent;
use crate::report::plots::escape;

/// One input.
pub struct Row {
    pub label: String,
    /// Shares, with the class of the style sheet and the word for each.
    pub shares: Vec<f64>,
}

/// What the bars of a row are.
pub struct Importance {
    pub of: Vec<&'static str>,
    pub rows: Vec<Row>,
}

const WIDTH: f64 = 560.0;
const LABEL: f64 = 170.0;
const RIGHT: f64 = 60.0;
const BAR: f64 = 11.0;
const GAP: f64 = 9.0;
const TOP: f64 = 26.0;

impl Importance {
    /// The bars as an SVG element.
    pub fn svg(&self) -> String {
        let row = BAR * self.of.len() as f64 + GAP;
        let height = TOP + row * self.rows.len() as f64;
        let mut out = format!(r#"<svg viewBox="0 0 {WIDTH} {height}" role="img" aria-label="">"#);
        let mut along = 8.0;
        for (number, word) in self.of.iter().enumerate() {
            let _ = write!(out, r#"<rect class="share s{number}" x="{along}" y="6" width="10" height="10"/>"#);
            let _ = write!(out, r#"<text class="tick" x="{}" y="15">{}</text>"#, along + 15.0, escape(word));
            along += 30.0 + 6.3 * word.chars().count() as f64;
        }
        for (number, input) in self.rows.iter().enumerate() {
            let top = TOP + row * number as f64;
            let middle = top + 0.5 * (row - GAP) + 4.0;
            let label = escape(&input.label);
            let _ = write!(
                out,
                r#"<text class="tick" text-anchor="end" x="{}" y="{middle:.1}">{label}</text>"#,
                LABEL - 8.0
            );
            for (bar, share) in input.shares.iter().enumerate() {
                let (y, wide) = (top + BAR * bar as f64, (WIDTH - LABEL - RIGHT) * share.clamp(0.0, 1.0));
                let _ = write!(
                    out,
                    r#"<rect class="share s{bar}" x="{LABEL}" y="{y:.1}" width="{wide:.1}" height="{}"/>"#,
                    BAR - 2.0
                );
                let shown = percent(Some(share.max(0.0)));
                let _ = write!(
                    out,
                    r#"<text class="tick" x="{:.1}" y="{:.1}">{shown}</text>"#,
                    LABEL + wide + 5.0,
                    y + BAR - 2.0
                );
            }
        }
        out + "</svg>"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_are_as_long_as_their_shares() {
        let row = |label: &str, shares: [f64; 2]| Row { label: label.into(), shares: shares.to_vec() };
        let drawn =
            Importance { of: vec!["alone", "in all"], rows: vec![row("a<b", [0.25, 0.5]), row("c", [-0.01, 1.3])] };
        let svg = drawn.svg();
        let full = WIDTH - LABEL - RIGHT;
        for part in [format!(r#"width="{:.1}""#, 0.25 * full), format!(r#"width="{full:.1}""#), "a&lt;b".into()] {
            assert!(svg.contains(&part), "{part}: {svg}");
        }
        assert!(svg.contains(r#"width="0.0""#));
    }
}
