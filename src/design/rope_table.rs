//! Wire ropes by name: a table that comes with the program, and one that a design may name.

use std::sync::LazyLock;

use crate::design::table_file::{Wrong, factor, name_and_unit, reader, together, without_unit};
use crate::problem::harmless;
use crate::units::Dimension;

/// A rope of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct Listed {
    pub name: String,
    /// m
    pub diameter: f64,
    /// N
    pub breaking_load: f64,
    /// On the full circle of the diameter (Pa).
    pub modulus: f64,
    /// What else the table says: mass and source.
    pub remark: String,
    /// The file of the table; nothing for that of the program.
    pub table: Option<String>,
}

/// What a rope may be: diameter (m), breaking load (N) and modulus (Pa), as where they are typed.
pub const DIAMETERS: [f64; 2] = [1e-4, 0.3];
pub const BREAKING_LOADS: [f64; 2] = [1.0, 1e9];
pub const MODULI: [f64; 2] = [1e7, 4e11];

/// Ropes at the most.
const MOST_ROPES: usize = 2000;
/// What a good table looks like.
const EXAMPLE: &str = "the file is a table like `name,diameter (mm),breaking_load (kN),modulus (GPa),source` / `top rope,22,305,60,certificate 17`, with the modulus on the full circle";

/// The table that comes with the program, parsed once.
pub fn built_in() -> &'static [Listed] {
    static ROPES: LazyLock<Vec<Listed>> = LazyLock::new(|| parse(include_bytes!("ropes.csv")).unwrap_or_default());
    &ROPES
}

/// A name as it is compared: small letters and single spaces.
pub fn plain(name: &str) -> String {
    name.to_lowercase().split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Column {
    Name,
    Diameter(f64),
    BreakingLoad(f64),
    Modulus(f64),
    /// Told with its own head.
    Other,
}

fn column(head: &str) -> Result<Column, Wrong> {
    let (name, unit) = name_and_unit(head);
    // The hint names the column without the unit that is none.
    let bare = if head.contains(['(', '[']) { name } else { head };
    let quantity = |dimension: Dimension, example: &str| {
        unit.and_then(|unit| factor(unit, dimension)).ok_or_else(|| without_unit(bare, example, dimension))
    };
    Ok(match name.to_lowercase().replace(' ', "_").as_str() {
        "name" | "rope" => Column::Name,
        "diameter" => Column::Diameter(quantity(Dimension::Length, "mm")?),
        "breaking_load" => Column::BreakingLoad(quantity(Dimension::Force, "kN")?),
        "modulus" => Column::Modulus(quantity(Dimension::Pressure, "GPa")?),
        // A unit may have been taken for the end of a name.
        _ if head.to_lowercase().replace(' ', "_") == "breaking_load" => {
            return Err(without_unit(head, "kN", Dimension::Force));
        }
        _ => Column::Other,
    })
}

/// The ropes of a table.
///
/// # Errors
/// What is wrong, with its line, and what would be right.
pub fn parse(bytes: &[u8]) -> Result<Vec<Listed>, Wrong> {
    let wrong = |found: String| (found, EXAMPLE.to_string());
    let (mut table, _) = reader(bytes, false).map_err(wrong)?;
    let heads: Vec<String> = match table.headers() {
        Ok(heads) => heads.iter().map(String::from).collect(),
        Err(error) => return Err(wrong(format!("whose head cannot be read: {error}"))),
    };
    let columns = heads.iter().map(|head| column(head)).collect::<Result<Vec<_>, _>>()?;
    let same = |a: &Column, b: &Column| *a != Column::Other && std::mem::discriminant(a) == std::mem::discriminant(b);
    for (number, column) in columns.iter().enumerate() {
        if let Some(twice) = columns[..number].iter().position(|other| same(other, column)) {
            return Err(wrong(format!("whose columns `{}` and `{}` tell the same", heads[twice], heads[number])));
        }
    }
    for (wanted, there) in [
        ("name", columns.contains(&Column::Name)),
        ("diameter", columns.iter().any(|column| matches!(column, Column::Diameter(_)))),
        ("breaking_load", columns.iter().any(|column| matches!(column, Column::BreakingLoad(_)))),
        ("modulus", columns.iter().any(|column| matches!(column, Column::Modulus(_)))),
    ] {
        if !there {
            return Err(wrong(format!("which has no column `{wanted}`")));
        }
    }
    let mut ropes: Vec<Listed> = Vec::new();
    let mut faults = Vec::new();
    for row in table.records() {
        let row = row.map_err(|error| wrong(format!("which cannot be read: {error}")))?;
        let line = row.position().map_or(0, csv::Position::line);
        match listed(&row, &columns, &heads) {
            Err((head, why, hint)) => faults.push((format!("line {line} holds {why} in the column `{head}`"), hint)),
            Ok(rope) if ropes.iter().any(|other| plain(&other.name) == plain(&rope.name)) => {
                faults.push((format!("line {line} has the name `{}` again", rope.name), EXAMPLE.to_string()));
            }
            Ok(rope) => ropes.push(rope),
        }
        if ropes.len() > MOST_ROPES {
            return Err(wrong(format!("of more than {MOST_ROPES} ropes")));
        }
    }
    if faults.is_empty() { Ok(ropes) } else { Err(together(&faults)) }
}

/// A row as a rope, or the head of a column, what is wrong with its value and what would be right.
fn listed(row: &csv::StringRecord, columns: &[Column], heads: &[String]) -> Result<Listed, (String, String, String)> {
    let mut rope = Listed {
        name: String::new(),
        diameter: 0.0,
        breaking_load: 0.0,
        modulus: 0.0,
        remark: String::new(),
        table: None,
    };
    let mut remarks = Vec::new();
    for ((text, column), head) in row.iter().zip(columns).zip(heads) {
        let number = |factor: f64, [low, high]: [f64; 2]| match text.parse::<f64>() {
            Ok(number) if (low..=high).contains(&(number * factor)) => Ok(number * factor),
            Ok(_) => {
                let [low, high] = [low, high].map(|bound| (bound / factor * 1e6).round() / 1e6);
                let hint = format!("{low} to {high} is allowed there; check the unit in the head of the column");
                Err((head.clone(), format!("`{text}`, which no rope has"), hint))
            }
            Err(_) => {
                let hint = if text.contains(',') { "numbers have a decimal point" } else { EXAMPLE };
                Err((head.clone(), format!("`{text}`, which is no number"), hint.to_string()))
            }
        };
        match column {
            Column::Name if text.is_empty() => {
                return Err((head.clone(), "no name".into(), EXAMPLE.to_string()));
            }
            Column::Name => rope.name = harmless(text),
            Column::Diameter(factor) => rope.diameter = number(*factor, DIAMETERS)?,
            Column::BreakingLoad(factor) => rope.breaking_load = number(*factor, BREAKING_LOADS)?,
            Column::Modulus(factor) => rope.modulus = number(*factor, MODULI)?,
            Column::Other if text.is_empty() => {}
            Column::Other if head == "source" => remarks.push(harmless(text)),
            Column::Other => remarks.push(harmless(&format!("{head} {text}"))),
        }
    }
    rope.remark = remarks.join("; ");
    Ok(rope)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// 0.356 × 22² × 1770 N/mm² = 305.0 kN; every rope of the table is one that the rules of ropes let pass.
    #[test]
    fn the_table_of_the_program_is_sound() {
        let ropes = built_in();
        assert!(ropes.len() > 50);
        let rope = ropes.iter().find(|rope| plain(&rope.name) == "6x36-iwrc 22 mm 1770").expect("a rope");
        assert_relative_eq!(rope.breaking_load, 305.0e3, max_relative = 1e-3);
        assert_relative_eq!(rope.diameter, 0.022, max_relative = 1e-12);
        assert!(rope.remark.contains("kg/m") && rope.remark.contains("EN 12385-4"));
        for rope in ropes {
            let stress = rope.breaking_load / (std::f64::consts::FRAC_PI_4 * rope.diameter.powi(2));
            assert!((0.5e9..1.3e9).contains(&stress), "{}", rope.name);
        }
    }

    /// All lines at once, each with its own hint; and nothing of a table steers a terminal or a page.
    #[test]
    fn all_lines_of_a_table_are_told() {
        let head = "name,diameter (mm),breaking_load (kN),modulus (GPa),source\n";
        let (found, hint) =
            parse(format!("{head}a,28x,305,60,\nb,22,3e12,60,\nc,22,305,60,\n").as_bytes()).unwrap_err();
        assert!(
            found.starts_with("whose line 2 holds `28x`") && found.contains("; whose line 3 holds `3e12`"),
            "{found}"
        );
        assert!(hint.contains("0.001 to 1000000 is allowed there"), "{hint}");
        let ropes = parse(format!("{head}a\u{1b}[31m,28,305,60,x\u{202e}y\n").as_bytes()).expect("ropes");
        assert_eq!([&ropes[0].name, &ropes[0].remark], ["a\u{fffd}[31m", "x\u{fffd}y"]);
    }

    #[test]
    fn what_is_wrong_with_a_table_is_told() {
        for (text, found) in [
            ("name,diameter (mm),breaking_load (kN)\na,22,305\n", "which has no column `modulus`"),
            (
                "name,diameter (mm),breaking_load (kN),Breaking load (N),modulus (GPa)\na,22,305,9,60\n",
                "whose columns `breaking_load (kN)` and `Breaking load (N)` tell the same",
            ),
            (
                "name,diameter (mm),breaking_load (kN),modulus (GPa)\n,22,305,60\n",
                "whose line 2 holds no name in the column `name`",
            ),
            (
                "name,diameter,breaking_load (kN),modulus (GPa)\na,22,305,60\n",
                "whose column `diameter` names no unit of length",
            ),
            (
                "name,diameter (mm),breaking_load,modulus (GPa)\na,22,305,60\n",
                "whose column `breaking_load` names no unit of force",
            ),
            (
                "name,diameter (mm),breaking_load (kN),modulus (GPa)\na,22,x,60\n",
                "whose line 2 holds `x`, which is no number in the column `breaking_load (kN)`",
            ),
            (
                "name,diameter (mm),breaking_load (kN),modulus (GPa)\na,22,305,55000\n",
                "whose line 2 holds `55000`, which no rope has in the column `modulus (GPa)`",
            ),
            (
                "name,diameter (mm),breaking_load (t),modulus (GPa)\na,22,31,60\n",
                "whose column `breaking_load` names no unit of force",
            ),
            (
                "name,diameter (mm),breaking_load (kN),modulus (GPa)\na,22,1,60\nA,22,1,60\n",
                "whose line 3 has the name `A` again",
            ),
        ] {
            assert_eq!(parse(text.as_bytes()).unwrap_err().0, found, "{text}");
        }
    }
}
