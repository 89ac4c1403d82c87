//! A hydrograph as a table: time, depth or discharge, and velocity, under a head that names them.
//!
//! DebrisFrame writes `timestep,thickness,velocity`, RAMMS a table of t and Q; what has no unit in the head is in s, m, m/s and m³/s.

use crate::design::table_file::{TableFormat, Wrong, factor, name_and_unit, without_unit};
use crate::units::Dimension;

/// Rows at the most.
const MOST_ROWS: usize = 100_000;
/// What a good file looks like.
const EXAMPLE: &str = "the file is a table like `time (s),depth (m),velocity (m/s)` / `0,0.2,3` / `4,1.1,6`; a discharge (m3/s) may stand in the place of the depth, or of the velocity";

/// What a column may hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    Time,
    Depth,
    Discharge,
    Velocity,
}

/// Names of the columns, in small letters, with the dimension and the unit of each that has none.
const COLUMNS: [(Column, &[&str], Dimension, &str); 4] = [
    (Column::Time, &["time", "timestep", "time step", "t"], Dimension::Time, "s"),
    (
        Column::Depth,
        &["depth", "thickness", "height", "flow depth", "flow height", "flow thickness", "h"],
        Dimension::Length,
        "m",
    ),
    (Column::Discharge, &["discharge", "flow rate", "q"], Dimension::Discharge, "m3/s"),
    (Column::Velocity, &["velocity", "speed", "flow velocity", "v"], Dimension::Velocity, "m/s"),
];

/// The columns that the file has, each with its values in SI.
pub type Columns = Vec<(Column, Vec<f64>)>;

/// Time and one or two of the others.
pub fn parse(bytes: &[u8]) -> Result<Columns, Wrong> {
    let too_many = "thin the table: some hundreds of rows tell a hydrograph";
    let mut kinds = Vec::new();
    let rows = TableFormat { most_rows: MOST_ROWS, example: EXAMPLE, too_many }.rows(bytes, |head| {
        let columns = head.iter().map(|name| column(name)).collect::<Result<Vec<_>, _>>()?;
        for (index, (kind, _)) in columns.iter().enumerate() {
            if columns[..index].iter().any(|(before, _)| before == kind) {
                let found = format!("whose column `{}` stands for the same as one before it", head[index]);
                return Err((found, EXAMPLE.to_string()));
            }
        }
        let has = |kind: Column| columns.iter().any(|(known, _)| *known == kind);
        if !has(Column::Time) || columns.len() < 2 || columns.len() > 3 {
            let found = format!("whose head is `{}`", head.join(","));
            return Err((found, EXAMPLE.to_string()));
        }
        kinds = columns.iter().map(|(kind, _)| *kind).collect();
        Ok(columns.into_iter().map(|(_, factor)| factor).collect())
    })?;
    let values = |index: usize| rows.iter().map(|row| row[index]).collect();
    Ok(kinds.into_iter().enumerate().map(|(index, kind)| (kind, values(index))).collect())
}

/// What a column holds, and the SI value of its unit.
fn column(text: &str) -> Result<(Column, f64), Wrong> {
    let find = |name: &str| {
        let name = name.to_lowercase();
        COLUMNS.iter().find(|(_, names, _, _)| names.contains(&name.as_str()))
    };
    // A name may have a space of its own.
    if let Some((kind, _, dimension, unit)) = find(text.trim()) {
        let own = factor(unit, *dimension).unwrap_or(1.0);
        return Ok((*kind, own));
    }
    let (name, unit) = name_and_unit(text);
    let Some((kind, _, dimension, example)) = find(name) else {
        let found = format!("whose column `{text}` is not known");
        return Err((found, EXAMPLE.to_string()));
    };
    let own = unit.and_then(|unit| factor(unit, *dimension));
    own.map(|own| (*kind, own)).ok_or_else(|| without_unit(name, example, *dimension))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_of_other_programs_are_read_as_they_are() {
        let debris_frame = parse(b"timestep,thickness,velocity\n40,10.328,8.3\n160,3.805,6.0\n").unwrap();
        assert_eq!(
            debris_frame,
            vec![
                (Column::Time, vec![40.0, 160.0]),
                (Column::Depth, vec![10.328, 3.805]),
                (Column::Velocity, vec![8.3, 6.0])
            ]
        );
        let of_discharge = parse("t (min);Q [l/s]\n0;0\n2;1500\n".as_bytes()).unwrap();
        assert_eq!(of_discharge, vec![(Column::Time, vec![0.0, 120.0]), (Column::Discharge, vec![0.0, 1.5])]);
        let mixed = parse("Velocity_m/s\tFlow height (cm)\tTime (s)\n3\t20\t0\n".as_bytes()).unwrap();
        assert_eq!(mixed[1], (Column::Depth, vec![0.2]));
    }

    #[test]
    fn what_is_wrong_with_a_table_is_told() {
        for (text, found) in [
            ("time,depth,colour\n0,1,2\n", "whose column `colour` is not known"),
            ("time,depth,h\n0,1,2\n", "whose column `h` stands for the same as one before it"),
            ("time\n0\n", "whose head is `time`"),
            ("depth,velocity\n0,1\n", "whose head is `depth,velocity`"),
            ("time (m),depth,velocity\n0,1,2\n", "whose column `time` names no unit of time"),
            ("time,depth,velocity\n0,1\n", "whose line 2 has 2 value(s), not three"),
            ("time,depth,velocity\n0,1,x\n", "whose line 2 holds `x`, which is not a number"),
        ] {
            assert_eq!(parse(text.as_bytes()).unwrap_err().0, found, "{text}");
        }
    }
}
