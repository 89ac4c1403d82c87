//! A surveyed section as a table: two columns under a head that names their units.

use crate::design::table_file::{TableFormat, Wrong, factor, name_and_unit, without_unit};
use crate::units::Dimension;

/// Points at the most.
const MOST_POINTS: usize = 10_000;
/// What a good file looks like.
const EXAMPLE: &str = "the file is a table like `distance (m),height (m)` / `-9.0,5.2` / `-3.0,0.1`, from the left to the right looking downstream";

/// Points of distance and height (m).
pub fn parse(bytes: &[u8]) -> Result<Vec<[f64; 2]>, Wrong> {
    let too_many = "thin the survey: some dozens of points tell a section";
    let rows = TableFormat { most_rows: MOST_POINTS, example: EXAMPLE, too_many }.rows(bytes, |head| {
        if head.len() != 2 {
            return Err((format!("whose head has {} column(s), not two", head.len()), EXAMPLE.to_string()));
        }
        head.iter().map(|name| length_in(name)).collect()
    })?;
    Ok(rows.iter().map(|row| [row[0], row[1]]).collect())
}

/// SI value of the unit of length that a head names.
fn length_in(column: &str) -> Result<f64, Wrong> {
    let (_, unit) = name_and_unit(column);
    unit.and_then(|unit| factor(unit, Dimension::Length)).ok_or_else(|| without_unit(column, "m", Dimension::Length))
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
            (
                "a (m),b (m)\n1,x\n2\n",
                "whose line 2 holds `x`, which is not a number; whose line 3 has 1 value(s), not two",
            ),
        ] {
            assert_eq!(parse(text.as_bytes()).unwrap_err().0, found, "{text}");
        }
        let (found, hint) = parse(format!("a (m),b (m)\n{}", "1,x\n".repeat(9)).as_bytes()).unwrap_err();
        assert!(found.contains("line 6 holds") && found.ends_with("; and 4 more line(s) like these"), "{found}");
        assert_eq!(hint, EXAMPLE, "each hint is given once");
        assert!(parse(&[0xff, 0xfe]).unwrap_err().0.contains("UTF-8"));
        let long = "a (m),b (m)\n".to_string() + &"1,2\n".repeat(MOST_POINTS + 1);
        assert!(parse(long.as_bytes()).is_err());
    }
}
