//! A table of numbers as a text file: columns under a head that names their units.

use crate::units::{self, Dimension};

/// What is wrong, and what would be right.
pub type Wrong = (String, String);

/// What a table must look like.
pub struct TableFormat<'a> {
    pub most_rows: usize,
    /// What a good file looks like.
    pub example: &'a str,
    /// Advice for a table with more rows.
    pub too_many: &'a str,
}

/// Numbers of columns in words.
const COUNTS: [&str; 7] = ["no", "one", "two", "three", "four", "five", "six"];
/// Lines with a fault that an error names.
const NAMED: usize = 5;

impl TableFormat<'_> {
    /// The rows, each value by the factor that `head` gives its column.
    ///
    /// # Errors
    /// What is wrong, with the lines, and what would be right.
    pub fn rows(
        &self,
        bytes: &[u8],
        head: impl FnOnce(&[&str]) -> Result<Vec<f64>, Wrong>,
    ) -> Result<Vec<Vec<f64>>, Wrong> {
        let wrong = |found: String| (found, self.example.to_string());
        let (mut table, delimiter) = reader(bytes, true).map_err(wrong)?;
        let factors = {
            let names = table.headers().map_err(|error| wrong(format!("whose head cannot be read: {error}")))?;
            head(&names.iter().collect::<Vec<_>>())?
        };
        let mut rows = Vec::new();
        let mut faults = Vec::new();
        for (number, row) in table.records().enumerate() {
            if number == self.most_rows {
                return Err((format!("of more than {} rows", self.most_rows), self.too_many.to_string()));
            }
            let row = row.map_err(|error| wrong(format!("which cannot be read: {error}")))?;
            let line = row.position().map_or(0, csv::Position::line);
            match self.values(&row, &factors, delimiter) {
                Ok(values) => rows.push(values),
                Err((found, hint)) => faults.push((format!("line {line} {found}"), hint)),
            }
        }
        if faults.is_empty() { Ok(rows) } else { Err(together(&faults)) }
    }

    fn values(&self, row: &csv::StringRecord, factors: &[f64], delimiter: u8) -> Result<Vec<f64>, Wrong> {
        if row.len() != factors.len() {
            let hint = match delimiter {
                b',' if row.len() > factors.len() => {
                    "numbers have a decimal point, and the columns are parted by a comma or a semicolon"
                }
                _ => self.example,
            };
            let columns = COUNTS.get(factors.len()).map_or(factors.len().to_string(), |word| (*word).to_string());
            return Err((format!("has {} value(s), not {columns}", row.len()), hint.to_string()));
        }
        let value = |(text, factor): (&str, &f64)| match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number * factor),
            _ => {
                let hint = if text.contains(',') { "numbers have a decimal point" } else { self.example };
                Err((format!("holds `{text}`, which is not a number"), hint.to_string()))
            }
        };
        row.iter().zip(factors).map(value).collect()
    }
}

/// Faults of lines as one, with the hints that they have, each once.
pub fn together(faults: &[Wrong]) -> Wrong {
    let named = &faults[..faults.len().min(NAMED)];
    let found: Vec<&str> = named.iter().map(|(found, _)| found.as_str()).collect();
    let mut hints: Vec<&str> = Vec::new();
    for (_, hint) in named {
        if !hints.contains(&hint.as_str()) {
            hints.push(hint);
        }
    }
    let more = match faults.len() - named.len() {
        0 => String::new(),
        more => format!("; and {more} more line(s) like these"),
    };
    (format!("whose {}{more}", found.join("; whose ")), hints.join("; "))
}

/// Reads a table whose columns are parted by a semicolon, a tab or a comma, and which of them it is; `flexible` takes rows of any length.
pub fn reader(bytes: &[u8], flexible: bool) -> Result<(csv::Reader<&[u8]>, u8), String> {
    let text = std::str::from_utf8(bytes).map_err(|_| "which is not text in UTF-8".to_string())?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let first = text.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#')).unwrap_or_default();
    let delimiter = [b';', b'\t'].into_iter().find(|mark| first.as_bytes().contains(mark)).unwrap_or(b',');
    let table = csv::ReaderBuilder::new()
        .delimiter(delimiter)
        .comment(Some(b'#'))
        .flexible(flexible)
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    Ok((table, delimiter))
}

/// The name of a column without its unit, and the unit if it names one: `height (m)`, `height [m]`, `height_m`.
pub fn name_and_unit(column: &str) -> (&str, Option<&str>) {
    for (open, close) in [('(', ')'), ('[', ']')] {
        if let Some((name, rest)) = column.split_once(open)
            && let Some((unit, _)) = rest.split_once(close)
        {
            return (name.trim(), Some(unit.trim()));
        }
    }
    match column.rsplit_once(['_', ' ']) {
        Some((name, unit)) => (name.trim(), Some(unit.trim())),
        None => (column.trim(), None),
    }
}

/// SI value of a unit.
pub fn factor(unit: &str, dimension: Dimension) -> Option<f64> {
    units::parse(&format!("1 {unit}"), dimension).ok()
}

/// A column whose unit is none of a dimension's.
pub fn without_unit(column: &str, example: &str, dimension: Dimension) -> Wrong {
    let (_, noun) = dimension.name().split_once(' ').unwrap_or_default();
    let plural = noun.strip_suffix('y').map_or(format!("{noun}s"), |stem| format!("{stem}ies"));
    let hint = format!("write it as `{column} ({example})`; {plural} are in {}", dimension.symbols().join(", "));
    (format!("whose column `{column}` names no unit of {noun}"), hint)
}
