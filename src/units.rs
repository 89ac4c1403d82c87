//! Quantities as engineers type them: a number and a unit, turned into SI.

/// Gravity (m/s²) as the sources of the verification cases use it.
pub const GRAVITY: f64 = 9.81;

/// What kind of quantity a value is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    Length,
    Volume,
    Mass,
    Density,
    Force,
    Pressure,
    Stiffness,
    Angle,
    Velocity,
    Time,
    /// A share of a whole, written in percent.
    Share,
}

/// Symbol, dimension, SI value of one unit.
const UNITS: &[(&str, Dimension, f64)] = &[
    ("mm", Dimension::Length, 1e-3),
    ("cm", Dimension::Length, 1e-2),
    ("m", Dimension::Length, 1.0),
    ("km", Dimension::Length, 1e3),
    ("m3", Dimension::Volume, 1.0),
    ("kg", Dimension::Mass, 1.0),
    ("t", Dimension::Mass, 1e3),
    ("kg/m3", Dimension::Density, 1.0),
    ("t/m3", Dimension::Density, 1e3),
    ("g/cm3", Dimension::Density, 1e3),
    ("N", Dimension::Force, 1.0),
    ("kN", Dimension::Force, 1e3),
    ("MN", Dimension::Force, 1e6),
    ("Pa", Dimension::Pressure, 1.0),
    ("kPa", Dimension::Pressure, 1e3),
    ("MPa", Dimension::Pressure, 1e6),
    ("GPa", Dimension::Pressure, 1e9),
    ("kN/m2", Dimension::Pressure, 1e3),
    ("N/mm2", Dimension::Pressure, 1e6),
    ("N/m", Dimension::Stiffness, 1.0),
    ("kN/m", Dimension::Stiffness, 1e3),
    ("MN/m", Dimension::Stiffness, 1e6),
    ("deg", Dimension::Angle, std::f64::consts::PI / 180.0),
    ("rad", Dimension::Angle, 1.0),
    ("m/s", Dimension::Velocity, 1.0),
    ("km/h", Dimension::Velocity, 1.0 / 3.6),
    ("s", Dimension::Time, 1.0),
    ("ms", Dimension::Time, 1e-3),
    ("min", Dimension::Time, 60.0),
    ("%", Dimension::Share, 0.01),
];

/// Why a text is not the wanted quantity: what it is taken for, and what would help.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotAQuantity {
    pub found: String,
    pub hint: Option<String>,
}

impl Dimension {
    pub fn name(self) -> &'static str {
        match self {
            Self::Length => "a length",
            Self::Volume => "a volume",
            Self::Mass => "a mass",
            Self::Density => "a density",
            Self::Force => "a force",
            Self::Pressure => "a pressure or modulus",
            Self::Stiffness => "a stiffness",
            Self::Angle => "an angle",
            Self::Velocity => "a velocity",
            Self::Time => "a time",
            Self::Share => "a share in percent",
        }
    }

    /// Symbols of this dimension, the first being the one used in examples.
    pub fn symbols(self) -> Vec<&'static str> {
        UNITS.iter().filter(|(_, dimension, _)| *dimension == self).map(|(symbol, _, _)| *symbol).collect()
    }

    /// The unit in which values of this dimension are shown.
    pub fn display_symbol(self) -> &'static str {
        match self {
            Self::Length => "m",
            Self::Volume => "m3",
            Self::Mass => "kg",
            Self::Density => "kg/m3",
            Self::Force => "kN",
            Self::Pressure => "GPa",
            Self::Stiffness => "MN/m",
            Self::Angle => "deg",
            Self::Velocity => "m/s",
            Self::Time => "s",
            Self::Share => "%",
        }
    }

    /// A value in SI written in this dimension's display unit, such as `15.2 m`.
    pub fn show(self, si: f64) -> String {
        let symbol = match (self, si.abs()) {
            (Self::Pressure, size) if size > 0.0 && size < 1e3 => "Pa",
            (Self::Pressure, size) if size > 0.0 && size < 1e6 => "kPa",
            (Self::Pressure, size) if size > 0.0 && size < 1e9 => "MPa",
            _ => self.display_symbol(),
        };
        let factor = factor_of(symbol).map_or(1.0, |(_, factor)| factor);
        let value = si / factor;
        let shown = if value != 0.0 && (value.abs() >= 1e5 || value.abs() < 1e-3) {
            format!("{value:.2e}")
        } else {
            trim_zeros(&format!("{value:.4}"))
        };
        format!("{shown} {symbol}")
    }
}

fn trim_zeros(number: &str) -> String {
    if number.contains('.') {
        number.trim_end_matches('0').trim_end_matches('.').to_string()
    } else {
        number.to_string()
    }
}

fn factor_of(symbol: &str) -> Option<(Dimension, f64)> {
    UNITS.iter().find(|(known, _, _)| *known == symbol).map(|(_, dimension, factor)| (*dimension, *factor))
}

/// Reads `text` as a quantity of the given dimension and returns its SI value.
///
/// Accepts `15.2 m`, `15.2m`, `1.35e3 kg/m3`, `kg/m^3`, `kg/m³`. A unit is required.
pub fn parse(text: &str, wanted: Dimension) -> Result<f64, NotAQuantity> {
    let trimmed = text.trim();
    let fail = |found: String, hint: Option<String>| Err(NotAQuantity { found, hint });
    if comma_in_number(trimmed) {
        let hint = format!("use a point as decimal separator: `{}`", trimmed.replacen(',', ".", 1));
        return fail(format!("`{trimmed}`, with a comma in the number"), Some(hint));
    }
    let (number, unit) = split(trimmed);
    let Ok(value) = number.parse::<f64>() else {
        return fail(format!("`{trimmed}`, which does not start with a number"), None);
    };
    if unit.is_empty() {
        return fail(format!("`{trimmed}`, a number without a unit"), Some(with_a_unit(number, value, wanted)));
    }
    let symbol = unit.replace('^', "").replace('³', "3").replace('²', "2").replace('°', "deg");
    match factor_of(&symbol) {
        Some((dimension, factor)) if dimension == wanted && value.is_finite() => Ok(value * factor),
        Some((dimension, _)) if dimension == wanted => fail(format!("`{trimmed}`, which is not a finite number"), None),
        Some((dimension, _)) => fail(format!("`{trimmed}`, which is {}", dimension.name()), Some(units_of(wanted))),
        None => fail(format!("`{trimmed}`, whose unit `{unit}` is not known"), near_unit(&symbol, wanted, number)),
    }
}

/// Whether a comma stands right behind a digit and before another.
fn comma_in_number(text: &str) -> bool {
    text.as_bytes().windows(3).any(|three| three[0].is_ascii_digit() && three[1] == b',' && three[2].is_ascii_digit())
}

/// Splits `15.2 m` into number and unit.
fn split(text: &str) -> (&str, &str) {
    let bytes = text.as_bytes();
    let mut end = 0;
    while end < bytes.len() {
        let exponent = matches!(bytes[end], b'e' | b'E')
            && bytes.get(end + 1).is_some_and(|next| next.is_ascii_digit() || matches!(next, b'+' | b'-'));
        let sign = matches!(bytes[end], b'+' | b'-') && (end == 0 || matches!(bytes[end - 1], b'e' | b'E'));
        if !(bytes[end].is_ascii_digit() || bytes[end] == b'.' || exponent || sign) {
            break;
        }
        end += 1;
    }
    (&text[..end], text[end..].trim())
}

fn example(number: &str, wanted: Dimension) -> String {
    let number = if number.is_empty() { "1" } else { number };
    format!("write for example `{number} {}`", wanted.display_symbol())
}

/// What a number without a unit may have meant.
fn with_a_unit(number: &str, value: f64, wanted: Dimension) -> String {
    match wanted {
        Dimension::Share if value.abs() <= 1.0 => {
            format!("write for example `{} %`", trim_zeros(&format!("{:.4}", 100.0 * value)))
        }
        // Pressures of snow and moduli of steel are too far apart for an example to fit both.
        Dimension::Pressure => units_of(wanted),
        _ => example(number, wanted),
    }
}

fn units_of(wanted: Dimension) -> String {
    format!("write {} in {}", wanted.name(), wanted.symbols().join(", "))
}

fn near_unit(symbol: &str, wanted: Dimension, number: &str) -> Option<String> {
    if wanted == Dimension::Density
        && symbol.eq_ignore_ascii_case("kN/m3")
        && let Ok(weight) = number.parse::<f64>()
    {
        return Some(format!("a weight is not a density: write `{:.0} kg/m3`", 1e3 * weight / GRAVITY));
    }
    let same = wanted.symbols().into_iter().find(|known| known.eq_ignore_ascii_case(symbol));
    let near = same.or_else(|| crate::problem::nearest(symbol, wanted.symbols()));
    Some(match near {
        Some(near) => format!("did you mean `{number} {near}`? Units are case-sensitive"),
        None => example(number, wanted),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn every_unit_reads_as_its_si_value() {
        for (symbol, dimension, factor) in UNITS {
            assert_relative_eq!(parse(&format!("2 {symbol}"), *dimension).unwrap(), 2.0 * factor);
            assert_relative_eq!(parse(&format!("2{symbol}"), *dimension).unwrap(), 2.0 * factor);
        }
    }

    #[test]
    fn reads_what_engineers_type() {
        assert_relative_eq!(parse("1350 kg/m³", Dimension::Density).unwrap(), 1350.0);
        assert_relative_eq!(parse("1.35e3 kg/m^3", Dimension::Density).unwrap(), 1350.0);
        assert_relative_eq!(parse(" 40° ", Dimension::Angle).unwrap(), 40_f64.to_radians());
        assert_relative_eq!(parse("-20 deg", Dimension::Angle).unwrap(), -20_f64.to_radians());
    }

    #[test]
    fn says_what_it_took_a_wrong_text_for() {
        let error = |text, dimension| parse(text, dimension).unwrap_err();
        assert_eq!(error("15.2", Dimension::Length).hint.unwrap(), "write for example `15.2 m`");
        assert_eq!(error("25 t", Dimension::Force).found, "`25 t`, which is a mass");
        assert!(error("250 kn", Dimension::Force).hint.unwrap().contains("`250 kN`"));
        assert!(error("4,5 m", Dimension::Length).hint.is_some());
        assert!(error("nan m", Dimension::Length).found.contains("does not start with a number"));
        assert!(error("1e999 m", Dimension::Length).found.contains("not a finite"));
    }
}
