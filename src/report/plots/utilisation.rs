//! Utilisation of every judged check as a bar, with the limit at 100 %.

use std::fmt::Write;

use crate::report::numbers::percent;

/// One bar.
pub struct Bar {
    pub label: String,
    /// Share of the capacity that is used.
    pub used: f64,
    /// The same by guideline and by simulation alone, where both are told against one capacity.
    pub by: [Option<f64>; 2],
    /// What stands beside the bar instead of the share that is used.
    pub value: Option<String>,
    /// Class of the style sheet: pass, warn or fail.
    pub class: &'static str,
}

const WIDTH: f64 = 980.0;
const LABEL: f64 = 380.0;
const RIGHT: f64 = 84.0;
const ROW: f64 = 20.0;
const TOP: f64 = 18.0;
/// Utilisation at which bars are cut off.
const MOST: f64 = 2.0;

/// The bars as an SVG element.
pub fn utilisation(bars: &[Bar]) -> String {
    let longest = bars.iter().map(|bar| bar.used.min(MOST)).fold(1.2, f64::max);
    let x = |used: f64| LABEL + (WIDTH - LABEL - RIGHT) * used.clamp(0.0, MOST) / longest;
    let height = TOP + ROW * bars.len() as f64 + 4.0;
    let mut out = format!(r#"<svg viewBox="0 0 {WIDTH} {height}" role="img" aria-label="Utilisation of the checks">"#);
    for (index, bar) in bars.iter().enumerate() {
        let y = TOP + ROW * index as f64;
        let (middle, end) = (y + 0.5 * ROW + 4.0, x(bar.used));
        let label = super::escape(&bar.label);
        let _ = write!(out, r#"<text class="tick" text-anchor="end" x="{}" y="{middle}">{label}</text>"#, LABEL - 8.0);
        let wide = end - LABEL;
        let _ = write!(
            out,
            r#"<rect class="bar {}" x="{LABEL}" y="{}" width="{wide:.1}" height="{}"/>"#,
            bar.class,
            y + 3.0,
            ROW - 6.0
        );
        let up = y + 0.5 * ROW;
        if let Some(used) = bar.by[0] {
            let _ = write!(out, r#"<rect class="by" x="{:.1}" y="{}" width="6" height="6"/>"#, x(used) - 3.0, up - 3.0);
        }
        if let Some(used) = bar.by[1] {
            let _ = write!(out, r#"<circle class="by" cx="{:.1}" cy="{up}" r="3.2"/>"#, x(used));
        }
        // Beyond 1000 % the number says so itself.
        let more = if bar.used > MOST && bar.used <= 10.0 { "› " } else { "" };
        let used = match &bar.value {
            Some(value) => super::escape(value),
            None if bar.used.is_nan() => "not a number".into(),
            None => percent(Some(bar.used)),
        };
        let _ = write!(out, r#"<text class="label" x="{:.1}" y="{middle}">{more}{used}</text>"#, end + 6.0);
    }
    let limit = x(1.0);
    let _ = write!(out, r#"<line class="limit" x1="{limit:.1}" x2="{limit:.1}" y1="{}" y2="{height}"/>"#, TOP - 4.0);
    let _ = write!(out, r#"<text class="tick" text-anchor="middle" x="{limit:.1}" y="11">100 %</text></svg>"#);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_end_where_they_should_and_long_ones_are_cut() {
        let bar = |used| Bar { label: "a<b".into(), used, by: [Some(0.3), None], value: None, class: "pass" };
        let svg = utilisation(&[bar(0.5), bar(7.0), bar(f64::NAN)]);
        let full = WIDTH - LABEL - RIGHT;
        assert!(
            svg.contains(&format!(r#"width="{:.1}""#, full * 0.25)) && svg.contains(&format!(r#"width="{full:.1}""#))
        );
        assert!(
            utilisation(&[bar(f64::INFINITY)]).contains(">&gt; 1000 %<")
                || utilisation(&[bar(f64::INFINITY)]).contains("> 1000 %<")
        );
        assert!(svg.contains("› 700 %") && svg.contains("not a number") && svg.contains("a&lt;b"));
    }
}
