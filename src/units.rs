//! Quantities as engineers type them: a number and a unit, turned into SI.

/// Gravity (m/s²) as the sources of the verification cases use it.
pub const GRAVITY: f64 = 9.81;

/// What kind of quantity a value is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    Length,
    Area,
    Volume,
    Mass,
    Density,
    Force,
    Pressure,
    Stiffness,
    Moment,
    /// A moment per metre of width.
    MomentPerWidth,
    Angle,
    Velocity,
    /// Volume in a time.
    Discharge,
    Time,
    /// A share of a whole, written in percent.
    Share,
}

/// Symbol, dimension, SI value of one unit. Of each dimension the first is the one used in examples.
const UNITS: &[(&str, Dimension, f64)] = &[
    ("mm", Dimension::Length, 1e-3),
    ("cm", Dimension::Length, 1e-2),
    ("dm", Dimension::Length, 1e-1),
    ("m", Dimension::Length, 1.0),
    ("km", Dimension::Length, 1e3),
    ("cm2", Dimension::Area, 1e-4),
    ("mm2", Dimension::Area, 1e-6),
    ("m2", Dimension::Area, 1.0),
    ("m3", Dimension::Volume, 1.0),
    ("dm3", Dimension::Volume, 1e-3),
    ("l", Dimension::Volume, 1e-3),
    ("cm3", Dimension::Volume, 1e-6),
    ("kg", Dimension::Mass, 1.0),
    ("g", Dimension::Mass, 1e-3),
    ("t", Dimension::Mass, 1e3),
    ("Mg", Dimension::Mass, 1e3),
    ("kt", Dimension::Mass, 1e6),
    ("kg/m3", Dimension::Density, 1.0),
    ("t/m3", Dimension::Density, 1e3),
    ("Mg/m3", Dimension::Density, 1e3),
    ("g/cm3", Dimension::Density, 1e3),
    ("kg/dm3", Dimension::Density, 1e3),
    ("kg/l", Dimension::Density, 1e3),
    ("N", Dimension::Force, 1.0),
    ("daN", Dimension::Force, 1e1),
    ("kN", Dimension::Force, 1e3),
    ("MN", Dimension::Force, 1e6),
    ("Pa", Dimension::Pressure, 1.0),
    ("hPa", Dimension::Pressure, 1e2),
    ("kPa", Dimension::Pressure, 1e3),
    ("MPa", Dimension::Pressure, 1e6),
    ("GPa", Dimension::Pressure, 1e9),
    ("N/m2", Dimension::Pressure, 1.0),
    ("kN/m2", Dimension::Pressure, 1e3),
    ("MN/m2", Dimension::Pressure, 1e6),
    ("GN/m2", Dimension::Pressure, 1e9),
    ("N/cm2", Dimension::Pressure, 1e4),
    ("kN/cm2", Dimension::Pressure, 1e7),
    ("N/mm2", Dimension::Pressure, 1e6),
    ("kN/mm2", Dimension::Pressure, 1e9),
    ("bar", Dimension::Pressure, 1e5),
    ("N/m", Dimension::Stiffness, 1.0),
    ("kN/m", Dimension::Stiffness, 1e3),
    ("MN/m", Dimension::Stiffness, 1e6),
    ("N/cm", Dimension::Stiffness, 1e2),
    ("kN/cm", Dimension::Stiffness, 1e5),
    ("N/mm", Dimension::Stiffness, 1e3),
    ("kN/mm", Dimension::Stiffness, 1e6),
    ("kN m", Dimension::Moment, 1e3),
    ("kNm", Dimension::Moment, 1e3),
    ("N m", Dimension::Moment, 1.0),
    ("Nm", Dimension::Moment, 1.0),
    ("MN m", Dimension::Moment, 1e6),
    ("MNm", Dimension::Moment, 1e6),
    ("kN m/m", Dimension::MomentPerWidth, 1e3),
    ("kNm/m", Dimension::MomentPerWidth, 1e3),
    ("N m/m", Dimension::MomentPerWidth, 1.0),
    ("Nm/m", Dimension::MomentPerWidth, 1.0),
    ("MN m/m", Dimension::MomentPerWidth, 1e6),
    ("MNm/m", Dimension::MomentPerWidth, 1e6),
    ("deg", Dimension::Angle, std::f64::consts::PI / 180.0),
    ("rad", Dimension::Angle, 1.0),
    ("gon", Dimension::Angle, std::f64::consts::PI / 200.0),
    ("m/s", Dimension::Velocity, 1.0),
    ("cm/s", Dimension::Velocity, 1e-2),
    ("km/h", Dimension::Velocity, 1.0 / 3.6),
    ("m3/s", Dimension::Discharge, 1.0),
    ("l/s", Dimension::Discharge, 1e-3),
    ("s", Dimension::Time, 1.0),
    ("ms", Dimension::Time, 1e-3),
    ("min", Dimension::Time, 60.0),
    ("h", Dimension::Time, 3600.0),
    ("%", Dimension::Share, 0.01),
    ("‰", Dimension::Share, 0.001),
];

/// Units that are not taken, because they are not metric, stand for several things or are no symbols: what is typed in them is told in
/// one that is. Symbol, dimension, SI value of one.
const FOREIGN: &[(&str, Dimension, f64)] = &[
    ("in", Dimension::Length, 0.0254),
    ("inch", Dimension::Length, 0.0254),
    ("ft", Dimension::Length, 0.3048),
    ("feet", Dimension::Length, 0.3048),
    ("yd", Dimension::Length, 0.9144),
    ("metre", Dimension::Length, 1.0),
    ("metres", Dimension::Length, 1.0),
    ("meter", Dimension::Length, 1.0),
    ("meters", Dimension::Length, 1.0),
    ("cbm", Dimension::Volume, 1.0),
    ("litre", Dimension::Volume, 1e-3),
    ("litres", Dimension::Volume, 1e-3),
    ("liter", Dimension::Volume, 1e-3),
    ("L", Dimension::Volume, 1e-3),
    ("yd3", Dimension::Volume, 0.764_554_857_984),
    ("ft3", Dimension::Volume, 0.028_316_846_592),
    ("lb", Dimension::Mass, 0.453_592_37),
    ("tonne", Dimension::Mass, 1e3),
    ("tonnes", Dimension::Mass, 1e3),
    ("to", Dimension::Mass, 1e3),
    ("pcf", Dimension::Density, 16.018_463_373_960_14),
    ("lb/ft3", Dimension::Density, 16.018_463_373_960_14),
    ("kgf", Dimension::Force, 9.806_65),
    ("kp", Dimension::Force, 9.806_65),
    ("tf", Dimension::Force, 9_806.65),
    ("lbf", Dimension::Force, 4.448_221_615_260_5),
    ("kip", Dimension::Force, 4_448.221_615_260_5),
    ("psi", Dimension::Pressure, 6_894.757_293_168),
    ("ksi", Dimension::Pressure, 6_894_757.293_168),
    ("psf", Dimension::Pressure, 47.880_258_980_34),
    ("kg/cm2", Dimension::Pressure, 98_066.5),
    ("degree", Dimension::Angle, std::f64::consts::PI / 180.0),
    ("degrees", Dimension::Angle, std::f64::consts::PI / 180.0),
    ("ft/s", Dimension::Velocity, 0.3048),
    ("mph", Dimension::Velocity, 0.447_04),
    ("kmh", Dimension::Velocity, 1.0 / 3.6),
    ("kph", Dimension::Velocity, 1.0 / 3.6),
    ("sec", Dimension::Time, 1.0),
    ("seconds", Dimension::Time, 1.0),
    ("minutes", Dimension::Time, 60.0),
    ("hours", Dimension::Time, 3600.0),
    ("percent", Dimension::Share, 0.01),
    ("pct", Dimension::Share, 0.01),
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
            Self::Area => "an area",
            Self::Volume => "a volume",
            Self::Mass => "a mass",
            Self::Density => "a density",
            Self::Force => "a force",
            Self::Pressure => "a pressure or modulus",
            Self::Stiffness => "a stiffness",
            Self::Moment => "a moment",
            Self::MomentPerWidth => "a moment per metre of width",
            Self::Angle => "an angle",
            Self::Velocity => "a velocity",
            Self::Discharge => "a discharge",
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
            Self::Area => "m2",
            Self::Volume => "m3",
            Self::Mass => "kg",
            Self::Density => "kg/m3",
            Self::Force => "kN",
            Self::Pressure => "GPa",
            Self::Stiffness => "MN/m",
            Self::Moment => "kN m",
            Self::MomentPerWidth => "kN m/m",
            Self::Angle => "deg",
            Self::Velocity => "m/s",
            Self::Discharge => "m3/s",
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

/// Signs that are typed or pasted for a minus.
const DASHES: &str = "\u{2010}\u{2011}\u{2012}\u{2013}\u{2014}\u{2212}";

/// Reads `text` as a quantity of the given dimension and returns its SI value.
///
/// Accepts `15.2 m`, `15.2m`, `1.35e3 kg/m3`, `kg/m^3`, `kg/m³`. A unit is required.
pub fn parse(text: &str, wanted: Dimension) -> Result<f64, NotAQuantity> {
    let trimmed = text.trim();
    let fail = |found: String, hint: Option<String>| Err(NotAQuantity { found, hint });
    if let Some((found, hint)) = separators(trimmed) {
        return fail(found, Some(hint));
    }
    let (number, unit) = split(trimmed);
    let Ok(value) = number.parse::<f64>() else {
        let plain: String = trimmed.chars().map(|letter| if DASHES.contains(letter) { '-' } else { letter }).collect();
        let hint = (plain != trimmed).then(|| format!("a negative number has a plain minus sign: `{plain}`"));
        return fail(format!("`{trimmed}`, which does not start with a number"), hint);
    };
    if let Some(run) = unit.strip_prefix(':').and_then(|run| run.trim().parse::<f64>().ok())
        && wanted == Dimension::Angle
    {
        let angle = libm::atan2(value, run).to_degrees();
        return fail(format!("`{trimmed}`, which is a ratio"), Some(format!("as a slope this is `{angle:.4} deg`")));
    }
    if unit.is_empty() {
        return fail(format!("`{trimmed}`, a number without a unit"), Some(with_a_unit(number, value, wanted)));
    }
    let symbol = unit.replace('^', "").replace('³', "3").replace('²', "2").replace('°', "deg");
    match factor_of(&symbol) {
        Some((dimension, factor)) if dimension == wanted && value.is_finite() => Ok(value * factor),
        Some((dimension, _)) if dimension == wanted => fail(format!("`{trimmed}`, which is not a finite number"), None),
        Some((Dimension::Share, factor)) if wanted == Dimension::Angle => {
            let angle = libm::atan(value * factor).to_degrees();
            fail(format!("`{trimmed}`, which is a share"), Some(format!("as a slope this is `{angle:.4} deg`")))
        }
        Some((dimension, _)) => fail(format!("`{trimmed}`, which is {}", dimension.name()), Some(units_of(wanted))),
        None => fail(format!("`{trimmed}`, whose unit `{unit}` is not known"), near_unit(&symbol, wanted, number)),
    }
}

/// One typed quantity over another of the same dimension, or one plain number over another; nothing where they cannot be compared.
pub fn ratio(one: &str, other: &str) -> Option<f64> {
    let si = |text: &str| {
        let text = text.trim();
        let end = text.find(|letter: char| !(letter.is_ascii_digit() || "+-.".contains(letter))).unwrap_or(text.len());
        let value: f64 = text[..end].parse().ok()?;
        let symbol = text[end..].trim().replace('^', "").replace('³', "3").replace('²', "2").replace('°', "deg");
        match symbol.as_str() {
            "" => Some((None, value)),
            symbol => factor_of(symbol).map(|(dimension, factor)| (Some(dimension), value * factor)),
        }
    };
    let ((of_one, one), (of_other, other)) = (si(one)?, si(other)?);
    (of_one == of_other && other != 0.0).then(|| one / other)
}

/// What is found and what to write where the digits of a number are separated by something else than one point, if they are.
pub fn separators(text: &str) -> Option<(String, String)> {
    const MARKS: [char; 5] = [',', '.', '\'', '’', '_'];
    const BLANKS: [char; 3] = [' ', '\u{a0}', '\u{202f}'];
    let apart = |letter: char| MARKS.contains(&letter) || BLANKS.contains(&letter);
    let inside = |letter: char| letter.is_ascii_digit() || apart(letter) || "+-".contains(letter);
    let end = text.find(|letter: char| !inside(letter)).unwrap_or(text.len());
    let number = text[..end].trim_end_matches(apart);
    let rest = &text[number.len()..];
    let between: Vec<char> = number.chars().filter(|letter| apart(*letter)).collect();
    match between[..] {
        [] | ['.'] => return None,
        _ => {}
    }
    let digits_of = |text: &str| text.chars().filter(|letter| !apart(*letter)).collect::<String>();
    // A blank beside a point or a comma is a slip: the number is what is left without it.
    if between.iter().any(|letter| BLANKS.contains(letter)) && between.iter().any(|letter| ".,".contains(*letter)) {
        let joined = format!("{}{rest}", number.replace(BLANKS, ""));
        let hint = separators(&joined).map_or_else(|| format!("write `{joined}`"), |(_, hint)| hint);
        return Some((found_of(text), hint));
    }
    let last = number.rfind(apart)?;
    let after = &number[last..].trim_start_matches(apart);
    let (whole, with_point) = (digits_of(number), format!("{}.{after}", digits_of(&number[..last])));
    let mark = number[last..].chars().next()?;
    let several = between.len() > 1;
    let same = between.iter().all(|letter| *letter == mark);
    let hint = match mark {
        // 1,200 is read as 1200 by some and as 1.2 by others.
        ',' | '.' if same && after.len() == 3 && (several || mark == ',') => match several {
            true => format!("write `{whole}{rest}`"),
            false => format!("write `{whole}{rest}` or `{with_point}{rest}`, whichever is meant"),
        },
        ',' | '.' if same && several => return Some((found_of(text), "a number has one point at the most".into())),
        ',' | '.' => format!("use a point as decimal separator, and none for thousands: `{with_point}{rest}`"),
        // Blanks part thousands only where three digits follow each.
        mark if BLANKS.contains(&mark) && !in_thousands(number, &BLANKS) => {
            "a number holds no blank: write one number and its unit".into()
        }
        _ => format!("write `{whole}{rest}`"),
    };
    Some((found_of(text), hint))
}

/// Whether a number has three digits behind each mark and one to three before the first.
fn in_thousands(number: &str, marks: &[char]) -> bool {
    let mut groups = number.split(marks).filter(|group| !group.is_empty());
    groups.next().is_some_and(|first| first.trim_start_matches(['+', '-']).len() <= 3)
        && groups.all(|group| group.len() == 3)
}

fn found_of(text: &str) -> String {
    format!("`{text}`, whose number holds a separator other than one point")
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

/// A number without a unit with one that brings it into a range (SI): the one that values of its kind are shown in, if it does.
pub fn with_a_unit_in(text: &str, wanted: Dimension, low: f64, high: f64) -> Option<String> {
    let value: f64 = text.trim().parse().ok()?;
    let usual = wanted.display_symbol();
    let units = UNITS.iter().filter(|(symbol, dimension, _)| *dimension == wanted && *symbol == usual);
    let others = UNITS.iter().filter(|(symbol, dimension, _)| *dimension == wanted && *symbol != usual);
    // Shares, pressures and coefficients of friction have hints of their own.
    let plain = !matches!(wanted, Dimension::Share | Dimension::Pressure) && !is_coefficient(value, wanted);
    let fits = |(_, _, factor): &&(&str, Dimension, f64)| (low..=high).contains(&(value * factor));
    units.chain(others).filter(|_| plain).find(fits).map(|(symbol, _, _)| format!("{} {symbol}", text.trim()))
}

/// Whether a number where an angle is wanted is rather its tangent.
fn is_coefficient(value: f64, wanted: Dimension) -> bool {
    wanted == Dimension::Angle && value > 0.0 && value < 1.5
}

/// What a number without a unit may have meant.
fn with_a_unit(number: &str, value: f64, wanted: Dimension) -> String {
    match wanted {
        Dimension::Share if value.abs() <= 1.0 => {
            format!("write for example `{} %`", trim_zeros(&format!("{:.4}", 100.0 * value)))
        }
        Dimension::Angle if is_coefficient(value, wanted) => {
            let angle = trim_zeros(&format!("{:.2}", libm::atan(value).to_degrees()));
            format!("an angle has a unit: a coefficient of friction, or a slope, of {number} is `{angle} deg`")
        }
        // Pressures of snow and moduli of steel are too far apart for an example to fit both.
        Dimension::Pressure => units_of(wanted),
        _ => example(number, wanted),
    }
}

fn units_of(wanted: Dimension) -> String {
    format!("write {} in {}", wanted.name(), wanted.symbols().join(", "))
}

/// What to write instead of an unknown unit: never what would be another size than was meant.
fn near_unit(symbol: &str, wanted: Dimension, number: &str) -> Option<String> {
    let Ok(value) = number.parse::<f64>() else { return Some(units_of(wanted)) };
    if wanted == Dimension::Density
        && let Some(factor) = [("n/m3", 1.0), ("kn/m3", 1e3), ("mn/m3", 1e6)]
            .into_iter()
            .find_map(|(weight, factor)| symbol.eq_ignore_ascii_case(weight).then_some(factor))
    {
        return Some(format!("a weight is not a density: write `{:.0} kg/m3`", factor * value / GRAVITY));
    }
    let foreign = FOREIGN.iter().find(|(known, dimension, _)| *dimension == wanted && *known == symbol);
    if let Some((_, _, factor)) = foreign {
        return Some(format!("write `{}`", plainly(value * factor, wanted)));
    }
    // The case of a prefix may make a milli of a mega: then only the list is safe.
    let prefix = |unit: &str| unit.chars().next().filter(|first| "mM".contains(*first) && unit.len() > 1);
    let same = wanted.symbols().into_iter().find(|known| known.eq_ignore_ascii_case(symbol));
    let same = same.filter(|known| prefix(known) == prefix(symbol));
    Some(match same {
        Some(known) => format!("did you mean `{number} {known}`? Units are case-sensitive"),
        None => units_of(wanted),
    })
}

/// A value in SI to nine digits, in the unit in which the dimension is shown.
fn plainly(si: f64, dimension: Dimension) -> String {
    let usual = dimension.display_symbol();
    let value_in = |factor: f64| si / factor;
    let usual = (usual, factor_of(usual).map_or(1.0, |(_, factor)| factor));
    // Another unit where the usual one would need many zeros.
    let readable = |value: f64| (0.1..1e5).contains(&value.abs());
    let others = UNITS.iter().filter(|(_, of, _)| *of == dimension).map(|(symbol, _, factor)| (*symbol, *factor));
    let fitting = std::iter::once(usual).chain(others).find(|(_, factor)| readable(value_in(*factor)));
    let (symbol, factor) = fitting.unwrap_or(usual);
    let value = value_in(factor);
    let digits = (8 - libm::log10(value.abs().max(1e-30)).floor() as i32).clamp(0, 30) as usize;
    format!("{} {symbol}", trim_zeros(&format!("{value:.digits$}")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn quantities_of_one_dimension_are_compared_in_any_unit() {
        assert!((ratio("4 km/h", "4 m/s").unwrap() - 1.0 / 3.6).abs() < 1e-12);
        assert_eq!(ratio("0.5", "2"), Some(0.25));
        assert_eq!((ratio("1 m", "1 kN"), ratio("1 m", "0 m"), ratio("1", "1 m")), (None, None, None));
    }

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

    /// The quantity that the hint in an error says to write, read as it says.
    fn followed(text: &str, dimension: Dimension) -> f64 {
        let hint = parse(text, dimension).unwrap_err().hint.unwrap();
        let written = hint.split('`').nth(1).unwrap_or_else(|| panic!("{text}: {hint}"));
        parse(written, dimension).unwrap_or_else(|error| panic!("{text}: {hint}: {error:?}"))
    }

    #[test]
    fn a_hint_that_is_followed_gives_what_was_meant() {
        for (symbol, dimension, factor) in FOREIGN {
            assert_relative_eq!(followed(&format!("3 {symbol}"), *dimension), 3.0 * factor, max_relative = 1e-7);
        }
        for (text, dimension, meant) in [
            ("250 kn", Dimension::Force, 250e3),
            ("250 KN", Dimension::Force, 250e3),
            ("2 KG", Dimension::Mass, 2.0),
            ("20 kN/m3", Dimension::Density, 20e3 / GRAVITY),
            ("4,5 m", Dimension::Length, 4.5),
            ("1,200 kN", Dimension::Force, 1200e3),
            ("1,200,000 N", Dimension::Force, 1200e3),
            ("1'200 kN", Dimension::Force, 1200e3),
            ("1 200 kN", Dimension::Force, 1200e3),
            ("1_200 kN", Dimension::Force, 1200e3),
            ("1.200,5 kN", Dimension::Force, 1200.5e3),
            ("1,200.5 kN", Dimension::Force, 1200.5e3),
            ("1.200.000 N", Dimension::Force, 1200e3),
            ("46 %", Dimension::Angle, libm::atan(0.46)),
            ("1:2", Dimension::Angle, libm::atan(0.5)),
        ] {
            assert_relative_eq!(followed(text, dimension), meant, max_relative = 1e-3);
        }
    }

    /// Every known symbol in a dimension that is not its own, or spelt with another case, is refused, and no hint names a value of
    /// another size.
    #[test]
    fn no_hint_changes_the_size_of_what_was_typed() {
        use Dimension as D;
        let all = [
            D::Length,
            D::Volume,
            D::Mass,
            D::Density,
            D::Force,
            D::Pressure,
            D::Stiffness,
            D::Angle,
            D::Velocity,
            D::Time,
        ];
        for (symbol, dimension, factor) in UNITS.iter().chain(FOREIGN) {
            for spelt in [symbol.to_uppercase(), symbol.to_lowercase()] {
                let text = format!("8 {spelt}");
                if factor_of(&spelt).is_some() {
                    continue;
                }
                let hint = parse(&text, *dimension).unwrap_err().hint.unwrap_or_default();
                if let Some(written) = hint.split('`').nth(1) {
                    assert_relative_eq!(parse(written, *dimension).unwrap(), 8.0 * factor, max_relative = 1e-6);
                }
            }
            for other in all.into_iter().filter(|other| other != dimension) {
                let Err(error) = parse(&format!("8 {symbol}"), other) else { panic!("{symbol} as {other:?}") };
                let hint = error.hint.unwrap_or_default();
                assert!(!hint.contains("did you mean") || factor_of(symbol).is_none(), "{symbol} as {other:?}: {hint}");
            }
        }
        for (text, dimension) in
            [("8 kN/mmm", D::Stiffness), ("5 mPa", D::Pressure), ("5 mn", D::Force), ("5 MM", D::Length)]
        {
            let hint = parse(text, dimension).unwrap_err().hint.unwrap();
            assert!(hint.starts_with("write a") && !hint.contains('`'), "{text}: {hint}");
        }
    }

    #[test]
    fn says_what_it_took_a_wrong_text_for() {
        let error = |text, dimension| parse(text, dimension).unwrap_err();
        assert_eq!(error("15.2", Dimension::Length).hint.unwrap(), "write for example `15.2 m`");
        for (text, hint) in [("4. 6 m/s", "write `4.6 m/s`"), ("1, 5 m", "`1.5 m`"), ("1 200.5 m", "write `1200.5 m`")]
        {
            let told = error(text, Dimension::Velocity).hint.unwrap();
            assert!(told.contains(hint), "{text}: {told}");
        }
        assert!(error("0.27", Dimension::Angle).hint.unwrap().contains("`15.11 deg`"));
        assert_eq!(with_a_unit_in("0.27", Dimension::Angle, 0.0, 1.0), None);
        assert_eq!(with_a_unit_in("15", Dimension::Angle, 0.0, 1.0).unwrap(), "15 deg");
        let fitting = |text, low, high| with_a_unit_in(text, Dimension::Length, low, high);
        assert_eq!(fitting("260", 1e-4, 10.0).unwrap(), "260 mm");
        assert_eq!(fitting("2.5", 0.1, 20.0).unwrap(), "2.5 m");
        assert_eq!(fitting("1e9", 0.1, 20.0), None);
        assert_eq!(error("25 t", Dimension::Force).found, "`25 t`, which is a mass");
        assert!(error("250 kn", Dimension::Force).hint.unwrap().contains("`250 kN`"));
        assert!(error("4,5 m", Dimension::Length).hint.is_some());
        assert!(error("nan m", Dimension::Length).found.contains("does not start with a number"));
        assert!(error("1e999 m", Dimension::Length).found.contains("not a finite"));
    }
}
