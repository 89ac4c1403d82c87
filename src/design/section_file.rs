//! A surveyed section as a table: two columns under a head that names their units.

use crate::units::{self, Dimension};

/// Points at the most.
const MOST_POINTS: usize = 10_000;
/// What a good file looks like.
const EXAMPLE: &str = "the file is a table like `distance (m),height (m)` / `-9.0,5.2` / `-3.0,0.1`, from the left to the right looking downstream";

/// What is wrong, and what would be right.
type Wrong = (String, String);

/// Points of distance and height (m).
pub fn parse(bytes: &[u8]) -> Result<Vec<[f64; 2]>, Wrong> {
    let wrong = |found: String| (found, EXAMPLE.to_string());
    let text = std::str::from_utf8(bytes).map_err(|_| wrong("which is not text in UTF-8".into()))?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let head = text.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#')).unwrap_or_default();
    let delimiter = [b';', b'\t'].into_iter().find(|mark| head.as_bytes().contains(mark)).unwrap_or(b',');
    let mut table = csv::ReaderBuilder::new()
        .delimiter(delimiter)
        .comment(Some(b'#'))
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let factors = {
        let head = table.headers().map_err(|error| wrong(format!("whose head cannot be read: {error}")))?;
        let names: Vec<&str> = head.iter().collect();
        let [distance, height] = names[..] else {
            return Err(wrong(format!("whose head has {} column(s), not two", names.len())));
        };
        [unit_of(distance)?, unit_of(height)?]
    };
    let mut points = Vec::new();
    for row in table.records() {
        let row = row.map_err(|error| wrong(format!("which cannot be read: {error}")))?;
        let line = row.position().map_or(0, csv::Position::line);
        if row.len() != 2 {
            let hint = match delimiter {
                b',' if row.len() > 2 => {
                    "numbers have a decimal point, and the columns are parted by a comma or a semicolon".into()
                }
                _ => EXAMPLE.to_string(),
            };
            return Err((format!("whose line {line} has {} value(s), not two", row.len()), hint));
        }
        let mut point = [0.0; 2];
        for (axis, text) in row.iter().enumerate() {
            point[axis] = match text.parse::<f64>() {
                Ok(number) if number.is_finite() => number * factors[axis],
                _ => {
                    let hint = if text.contains(',') {
                        "numbers have a decimal point".to_string()
                    } else {
                        EXAMPLE.to_string()
                    };
                    return Err((format!("whose line {line} holds `{text}`, which is not a number"), hint));
                }
            };
        }
        points.push(point);
        if points.len() > MOST_POINTS {
            return Err((
                format!("of more than {MOST_POINTS} points"),
                "thin the survey: some dozens of points tell a section".into(),
            ));
        }
    }
    Ok(points)
}

/// SI value of the unit that a head names: `height (m)`, `height [m]` or `height_m`.
fn unit_of(name: &str) -> Result<f64, Wrong> {
    let between = |open: char, close: char| Some(name.split_once(open)?.1.split_once(close)?.0);
    let last = || name.rsplit(['_', ' ']).next();
    let unit = between('(', ')').or_else(|| between('[', ']')).or_else(last).unwrap_or_default().trim();
    units::parse(&format!("1 {unit}"), Dimension::Length).map_err(|_| {
        let hint = format!("write it as `{name} (m)`; lengths are in {}", Dimension::Length.symbols().join(", "));
        (format!("whose column `{name}` names no unit of length"), hint)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_read_whatever_parts_the_columns() {
        let by_hand = vec![[-3.0, 2.5], [0.0, 0.0], [3.0, 2.0]];
        for text in [
            "distance (m),height (m)\n-3,2.5\n0,0\n3,2\n",
            "\u{feff}# surveyed in May\ny [m];z [cm]\r\n-3.0;250\r\n0;0\r\n3;200\r\n",
            "y_mm\tz_m\n-3000\t2.5\n0\t0\n3000\t2",
        ] {
            assert_eq!(parse(text.as_bytes()).unwrap(), by_hand, "{text}");
        }
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        for (text, found) in [
            ("distance,height\n1,2\n", "whose column `distance` names no unit of length"),
            ("a (m),b (m),c (m)\n1,2,3\n", "whose head has 3 column(s), not two"),
            ("a (m),b (m)\n1,2\n1,x\n", "whose line 3 holds `x`, which is not a number"),
            ("a (m);b (m)\n1,5;2\n", "whose line 2 holds `1,5`, which is not a number"),
            ("a (m),b (m)\n1,5,2,5\n", "whose line 2 has 4 value(s), not two"),
            ("a (m),b (m)\n1,nan\n", "whose line 2 holds `nan`, which is not a number"),
            ("", "whose head has 0 column(s), not two"),
        ] {
            assert_eq!(parse(text.as_bytes()).unwrap_err().0, found, "{text}");
        }
        assert!(parse(&[0xff, 0xfe]).unwrap_err().0.contains("UTF-8"));
        let long = "a (m),b (m)\n".to_string() + &"1,2\n".repeat(MOST_POINTS + 1);
        assert!(parse(long.as_bytes()).is_err());
    }
}
