//! The curve of a dissipator as a table: stroke or travel and force, under a head that names them and their units.

use crate::design::table_file::{TableFormat, Wrong, factor, name_and_unit, without_unit};
use crate::units::Dimension;

/// Points at the most.
const MOST_POINTS: usize = 1000;
/// What a good file looks like.
const EXAMPLE: &str = "the file is a table like `stroke (mm),force (kN)` / `0,60` / `900,140`; `stroke` is what is left after unloading, `travel` what was measured under the force";

/// Whether the first column is a stroke after unloading or a travel under load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    Stroke,
    Travel,
}

/// Names of the first column, in small letters.
const WAYS: [(Way, &[&str]); 2] =
    [(Way::Stroke, &["stroke"]), (Way::Travel, &["travel", "displacement", "elongation", "extension"])];

/// Points of travel (m) and force (N).
pub fn parse(bytes: &[u8]) -> Result<(Way, Vec<[f64; 2]>), Wrong> {
    let too_many = "thin the test's record: some dozens of points tell a curve";
    let mut way = Way::Stroke;
    let rows = TableFormat { most_rows: MOST_POINTS, example: EXAMPLE, too_many }.rows(bytes, |head| {
        let [first, second] = head else {
            return Err((format!("whose head has {} column(s), not two", head.len()), EXAMPLE.to_string()));
        };
        let known = |name: &str| WAYS.iter().find(|(_, names)| names.contains(&name.to_lowercase().as_str()));
        let (name, unit) = name_and_unit(first);
        let Some((found, _)) = known(name) else {
            return Err((format!("whose column `{first}` is not known"), EXAMPLE.to_string()));
        };
        way = *found;
        let length = unit.and_then(|unit| factor(unit, Dimension::Length));
        let length = length.ok_or_else(|| without_unit(first, "mm", Dimension::Length))?;
        let (name, unit) = name_and_unit(second);
        if !["force", "load", "tension"].contains(&name.to_lowercase().as_str()) {
            return Err((format!("whose column `{second}` is not known"), EXAMPLE.to_string()));
        }
        let force = unit.and_then(|unit| factor(unit, Dimension::Force));
        Ok(vec![length, force.ok_or_else(|| without_unit(second, "kN", Dimension::Force))?])
    })?;
    Ok((way, rows.iter().map(|row| [row[0], row[1]]).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_head_tells_how_the_way_was_measured() {
        let by_hand = vec![[0.0, 60e3], [0.9, 140e3]];
        let read = |text: &str| parse(text.as_bytes()).unwrap();
        assert_eq!(read("stroke (mm),force (kN)\n0,60\n900,140\n"), (Way::Stroke, by_hand.clone()));
        assert_eq!(read("Travel_m;Load_N\n0;60000\n0.9;140000\n"), (Way::Travel, by_hand));
    }

    #[test]
    fn what_is_wrong_is_told() {
        for (text, found) in [
            ("time (s),force (kN)\n0,1\n", "whose column `time (s)` is not known"),
            ("stroke,force (kN)\n0,1\n", "whose column `stroke` names no unit of length"),
            ("stroke (mm),force\n0,1\n", "whose column `force` names no unit of force"),
            ("stroke (mm),temperature (K)\n0,1\n", "whose column `temperature (K)` is not known"),
            ("stroke (mm)\n0\n", "whose head has 1 column(s), not two"),
            ("stroke (mm),force (kN)\n0,x\n", "whose line 2 holds `x`, which is not a number"),
        ] {
            assert_eq!(parse(text.as_bytes()).unwrap_err().0, found, "{text}");
        }
    }
}
