//! Numbers as a person writes them: rounding and units.

pub fn percent(share: Option<f64>) -> String {
    match share {
        None => "–".to_string(),
        Some(share) if share.is_nan() => "not known".to_string(),
        Some(share) if share > 10.0 => "> 1000 %".to_string(),
        // Near the limit a digit more, so that nothing at 100 % fails.
        Some(share) if (share - 1.0).abs() < 0.05 => format!("{:.1} %", 100.0 * share),
        Some(share) => format!("{:.0} %", 100.0 * share),
    }
}

/// Text as a field of a CSV file.
pub fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

/// A value with the unit a person would use.
pub fn with_unit(value: f64, unit: &str) -> String {
    match unit {
        _ if value.is_nan() => "not known".to_string(),
        "-" | "count" if value.is_infinite() => figures(value),
        "N" if value.abs() < 2000.0 => format!("{value:.0} N"),
        "N" => format!("{} kN", figures(value / 1e3)),
        "N/m" if value.abs() < 2000.0 => format!("{value:.0} N/m"),
        "N/m" => format!("{} kN/m", figures(value / 1e3)),
        "Pa" if value.abs() < 2000.0 => format!("{value:.0} Pa"),
        "Pa" => format!("{} kPa", figures(value / 1e3)),
        "N m" if value.abs() < 2000.0 => format!("{value:.1} N m"),
        "N m" => format!("{} kN m", figures(value / 1e3)),
        "N m/m" if value.abs() < 2000.0 => format!("{value:.1} N m/m"),
        "N m/m" => format!("{} kN m/m", figures(value / 1e3)),
        "kg" if value.abs() < 2000.0 => format!("{} kg", figures(value)),
        "kg" => format!("{} t", figures(value / 1e3)),
        // No distance in this trade is known to less than a millimetre.
        "m" if value == 0.0 => "0 m".to_string(),
        "m" if value.abs() < 0.1 => format!("{value:.3} m"),
        "" => figures(value),
        "count" => format!("{value:.0}"),
        // What rounds to nothing has no sign.
        "-" if value.abs() < 0.0005 => "0.0 %".to_string(),
        "-" => format!("{:.1} %", 100.0 * value),
        unit => format!("{} {unit}", figures(value)),
    }
}

/// A mean and its standard deviation, both in the unit that suits the mean.
pub fn with_scatter(mean: f64, deviation: f64, unit: &str) -> String {
    match unit {
        "-" => format!("{:.1} ± {:.1} %", 100.0 * mean, 100.0 * deviation),
        "N" | "N/m" | "Pa" | "N m" | "N m/m" if mean.abs() >= 2000.0 => {
            format!("{} k{unit}", alike(mean / 1e3, deviation / 1e3))
        }
        unit => format!("{} {unit}", alike(mean, deviation)).trim_end().to_string(),
    }
}

/// A mean and its scatter with the same number of decimals: those of the mean, and more where the scatter would read as none.
fn alike(mean: f64, deviation: f64) -> String {
    if !(mean.is_finite() && deviation.is_finite()) {
        return format!("{} ± {}", figures(mean), figures(deviation));
    }
    let of_mean = figures(mean).split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let shows = |decimals: &usize| deviation == 0.0 || deviation.abs() >= 0.5 * 0.1_f64.powi(*decimals as i32);
    let decimals = (of_mean..=4).find(shows).unwrap_or(of_mean);
    format!("{mean:.decimals$} ± {deviation:.decimals$}")
}

/// Three significant figures, whole numbers from 100 on.
pub fn figures(value: f64) -> String {
    match value.abs() {
        size if size.is_infinite() => if value > 0.0 { "∞" } else { "−∞" }.to_string(),
        size if size >= 100.0 => format!("{value:.0}"),
        size if size >= 10.0 => format!("{value:.1}"),
        size if size >= 0.1 || size == 0.0 => format!("{value:.2}"),
        _ => format!("{value:.4}"),
    }
}

/// Main ropes by their numbers from the bottom, given from 0: "main rope 2", "main ropes 1 and 3".
pub fn rope_numbers(levels: &[usize]) -> String {
    let numbers: Vec<String> = levels.iter().map(|level| (level + 1).to_string()).collect();
    match numbers.split_last() {
        Some((last, [])) => format!("main rope {last}"),
        Some((last, others)) => format!("main ropes {} and {last}", others.join(", ")),
        None => "no main rope".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scatter_has_the_decimals_of_its_mean() {
        for (mean, deviation, text) in [
            (0.77, 0.051, "0.77 ± 0.05 m"),
            (0.77, 0.003, "0.770 ± 0.003 m"),
            (119.2, 8.84, "119 ± 9 m"),
            (119.2, 0.3, "119.2 ± 0.3 m"),
            (12.34, 0.0, "12.3 ± 0.0 m"),
            (2.0, 0.00001, "2.00 ± 0.00 m"),
        ] {
            assert_eq!(with_scatter(mean, deviation, "m"), text);
        }
    }

    #[test]
    fn what_is_beyond_all_bounds_has_a_sign_for_it() {
        for (unit, text) in [("Pa", "∞ kPa"), ("N", "∞ kN"), ("m", "∞ m"), ("-", "∞"), ("", "∞")] {
            assert_eq!(with_unit(f64::INFINITY, unit), text);
        }
        assert_eq!(with_unit(f64::NEG_INFINITY, "m"), "−∞ m");
        assert_eq!(with_unit(152e3, "Pa"), "152 kPa");
    }
}
