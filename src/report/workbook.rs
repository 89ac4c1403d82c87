//! `tables.xlsx`: checks, load cases and time series for a spreadsheet program. Values are those of `result.json` and `histories.csv` in the
//! units that engineers use; what follows from cells beside it is a formula, with its value.

use rust_xlsxwriter::{
    Chart, ChartType, DocProperties, ExcelDateTime, Format, FormatAlign, Formula, Workbook, Worksheet, XlsxError,
};

use crate::checks::outcome::Outcome;
use crate::loads::cases::load_case::LoadCase;
use crate::pipeline::Run;
use crate::program::PROGRAM;
use crate::report::row::worst_first;
use crate::report::series;

/// Name of the file.
pub const FILE: &str = "tables.xlsx";

/// Rows of a sheet at the most, as spreadsheet programs have them.
const MOST_ROWS: usize = 1_048_576;

/// A unit of engineers for one of SI, and how many of the latter it is.
fn usual(unit: &str) -> (&str, f64) {
    match unit {
        "N" => ("kN", 1e3),
        "N/m" => ("kN/m", 1e3),
        "N m" => ("kN m", 1e3),
        "N m/m" => ("kN m/m", 1e3),
        "Pa" => ("kPa", 1e3),
        // Shares of a whole and plain numbers stay.
        other => (other, 1.0),
    }
}

/// How cells look.
struct Looks {
    head: Format,
    wrapped: Format,
    percent: Format,
    title: Format,
    number: Format,
}

impl Looks {
    fn new() -> Self {
        Self {
            head: Format::new().set_bold().set_text_wrap().set_align(FormatAlign::Top).set_background_color("#E8EDF1"),
            wrapped: Format::new().set_text_wrap().set_align(FormatAlign::Top),
            percent: Format::new().set_num_format("0.0 %").set_align(FormatAlign::Top),
            title: Format::new().set_bold().set_font_size(14),
            number: Format::new().set_num_format("0.000").set_align(FormatAlign::Top),
        }
    }
}

/// The bytes of the file.
pub fn xlsx(run: &Run) -> Result<Vec<u8>, XlsxError> {
    let mut book = Workbook::new();
    book.set_properties(&properties(run)?);
    let looks = Looks::new();
    summary(book.add_worksheet(), run, &looks)?;
    checks(book.add_worksheet(), run, &looks)?;
    load_cases(book.add_worksheet(), run, &looks)?;
    histories(book.add_worksheet(), run, &looks)?;
    book.save_to_buffer()
}

/// Dated by when the simulation began, so that a report which is made again is the same.
fn properties(run: &Run) -> Result<DocProperties, XlsxError> {
    let began = run.simulated.as_ref().map_or(0, |simulated| simulated.facts.began);
    Ok(DocProperties::new()
        .set_title(format!("{}: {}", run.file.design.project.name, run.file.design.project.barrier))
        .set_author(PROGRAM)
        .set_creation_datetime(&ExcelDateTime::from_timestamp(began)?))
}

fn summary(sheet: &mut Worksheet, run: &Run, looks: &Looks) -> Result<(), XlsxError> {
    sheet.set_name("Summary")?.set_column_width(0, 26)?.set_column_width(1, 100)?;
    let project = &run.file.design.project;
    sheet.write_with_format(0, 0, format!("{}: {}", project.name, project.barrier), &looks.title)?;
    let mut rows = vec![
        ("Verdict", run.verdict.word().to_uppercase()),
        ("Design file", run.file.name.clone()),
        ("SHA-256 of the design file", crate::design::read::sha256(&run.file.text)),
        ("Revision", project.revision.clone()),
        ("Program", PROGRAM.to_string()),
        ("What this is", "An extract of the report beside it, which tells what is assumed, what is not checked and what a reviewer should know. Loads carry partial factors unless a head says otherwise.".to_string()),
    ];
    rows.extend(run.doubts.iter().map(|doubt| ("Why it cannot be relied on", doubt.clone())));
    for (row, (name, value)) in (2..).zip(rows) {
        sheet.write_with_format(row, 0, name, &looks.head)?.write_with_format(row, 1, value, &looks.wrapped)?;
    }
    Ok(())
}

/// Columns of the checks by their letters in formulas.
const BY_EQUATIONS: u16 = 2;
const BY_SIMULATION: u16 = 3;
const CAPACITY: u16 = 5;

fn checks(sheet: &mut Worksheet, run: &Run, looks: &Looks) -> Result<(), XlsxError> {
    sheet.set_name("Checks")?.set_freeze_panes(1, 1)?;
    let heads = [
        ("Check", 44.0),
        ("Id", 24.0),
        ("Demand by the equations", 14.0),
        ("Demand by the simulation", 14.0),
        ("Of it without partial factors", 14.0),
        ("Capacity", 14.0),
        ("Unit", 9.0),
        ("Used", 10.0),
        ("Verdict", 10.0),
        ("Why it is open", 60.0),
        ("Source of the capacity", 60.0),
    ];
    head(sheet, &heads, looks)?;
    for (row, outcome) in (1..).zip(worst_first(run)) {
        let (unit, of) = usual(outcome.unit.symbol());
        sheet.write_with_format(row, 0, &outcome.title, &looks.wrapped)?.write_with_format(
            row,
            1,
            &outcome.id,
            &looks.wrapped,
        )?;
        let values = [
            (BY_EQUATIONS, outcome.demand.guideline),
            (BY_SIMULATION, outcome.demand.simulation),
            (4, outcome.demand.characteristic),
            (CAPACITY, outcome.capacity),
        ];
        for (column, value) in values {
            number(sheet, row, column, value.map(|value| value / of), &looks.number)?;
        }
        sheet.write_with_format(row, 6, unit, &looks.wrapped)?;
        used(sheet, row, outcome, looks)?;
        let open = outcome.open.as_ref().map_or(String::new(), |open| open.words().to_string());
        sheet
            .write_with_format(row, 8, outcome.verdict.word().to_uppercase(), &looks.wrapped)?
            .write_with_format(row, 9, open, &looks.wrapped)?
            .write_with_format(row, 10, outcome.source, &looks.wrapped)?;
    }
    Ok(())
}

/// What is used of a capacity: a formula where it is the larger demand over it.
fn used(sheet: &mut Worksheet, row: u32, outcome: &Outcome, looks: &Looks) -> Result<(), XlsxError> {
    let Some(used) = outcome.utilisation else { return Ok(()) };
    let demands = [outcome.demand.guideline, outcome.demand.simulation];
    let larger = demands.into_iter().flatten().fold(f64::NEG_INFINITY, f64::max);
    let is_ratio = outcome.capacity.is_some_and(|capacity| (larger / capacity - used).abs() <= 1e-9 * used.abs());
    if !is_ratio {
        return number(sheet, row, 7, Some(used), &looks.percent);
    }
    let formula = Formula::new(format!("=MAX(C{0}:D{0})/F{0}", row + 1)).set_result(used.to_string());
    sheet.write_formula_with_format(row, 7, formula, &looks.percent)?;
    Ok(())
}

/// Where the inputs of the load cases stand in their sheet.
const DENSITY: &str = "$B$2";
const GRAVITY: &str = "$B$3";
const K: &str = "$B$4";
const LAMBDA: &str = "$B$5";
const WOOD: &str = "$B$6";
const VELOCITY: &str = "$B$8";
/// Row of their heads.
const CASES: u32 = 11;

fn load_cases(sheet: &mut Worksheet, run: &Run, looks: &Looks) -> Result<(), XlsxError> {
    sheet.set_name("Load cases")?;
    let input = &run.guideline.input;
    let inputs = [
        ("Bulk density ρ", input.density, "kg/m³"),
        ("g cos α", input.gravity_normal, "m/s²"),
        ("K", input.earth_pressure, ""),
        ("λ", input.dynamic_pressure, ""),
        ("Factor for wood f_w", input.wood, ""),
        ("Depth of the flow h", input.depth, "m"),
        ("Velocity v", input.velocity, "m/s"),
        ("Height of the barrier, normal to the bed", input.barrier_height, "m"),
    ];
    sheet.write_with_format(0, 0, "Inputs, without partial factors", &looks.head)?;
    for (row, (name, value, unit)) in (1..).zip(inputs) {
        sheet.write(row, 0, name)?.write_with_format(row, 1, value, &looks.number)?.write(row, 2, unit)?;
    }
    let heads = [
        ("Load case", 46.0),
        ("Surface over the bed (m)", 12.0),
        ("Loaded up to (m)", 12.0),
        ("Static pressure at the bed (kPa)", 12.0),
        ("Dynamic pressure (kPa)", 12.0),
        ("from (m)", 10.0),
        ("to (m)", 10.0),
        ("Drag on the top that counts (kN/m)", 12.0),
        ("Force per width (kN/m)", 12.0),
        ("Force in all (kN)", 12.0),
        ("Id", 18.0),
        ("Formula", 60.0),
        ("Source", 60.0),
    ];
    for (column, (name, width)) in (0..).zip(heads) {
        sheet.write_with_format(CASES, column, name, &looks.head)?.set_column_width(column, width)?;
    }
    for (row, case) in (CASES + 1..).zip(&run.guideline.cases) {
        load_case(sheet, row, case, run, looks)?;
    }
    Ok(())
}

fn load_case(sheet: &mut Worksheet, row: u32, case: &LoadCase, run: &Run, looks: &Looks) -> Result<(), XlsxError> {
    let (input, diagram) = (&run.guideline.input, &case.diagram);
    let line = row + 1;
    let known = |formula: String, value: f64, by_formula: f64| {
        // Only what it gives.
        ((by_formula - value).abs() <= 1e-9 * value.abs().max(1.0))
            .then(|| Formula::new(formula).set_result((value / 1e3).to_string()))
    };
    sheet.write_with_format(row, 0, case.title, &looks.wrapped)?;
    for (column, value) in [(1, diagram.surface), (2, diagram.top), (5, diagram.block_from), (6, diagram.block_to)] {
        number(sheet, row, column, Some(value), &looks.number)?;
    }
    number(sheet, row, 7, Some((case.force_per_width() - diagram.force(0.0, f64::INFINITY)) / 1e3), &looks.number)?;
    let at_the_bed = case.pressure_static();
    let fixed =
        known(format!("={K}*{DENSITY}*{GRAVITY}*B{line}/1000"), at_the_bed, input.unit_pressure() * diagram.surface);
    write(sheet, row, 3, fixed, at_the_bed / 1e3, looks)?;
    let block = known(format!("={WOOD}*{LAMBDA}*{DENSITY}*{VELOCITY}^2/1000"), diagram.block, input.impact_pressure());
    write(sheet, row, 4, block, diagram.block / 1e3, looks)?;
    let force = case.force_per_width();
    let over = |height: f64| (diagram.surface - height).max(0.0);
    let triangle = 0.5 * diagram.unit * (over(0.0).powi(2) - over(diagram.top).powi(2));
    let strip = (diagram.block_to.min(diagram.top) - diagram.block_from.max(0.0)).max(0.0);
    let drag = force - diagram.force(0.0, f64::INFINITY);
    let formula = format!(
        "=IF(B{line}>0,D{line}/B{line}/2*(B{line}^2-MAX(B{line}-C{line},0)^2),0)+E{line}*MAX(MIN(G{line},C{line})-F{line},0)+H{line}"
    );
    let summed = known(formula, force, triangle + diagram.block * strip + drag);
    write(sheet, row, 8, summed, force / 1e3, looks)?;
    number(sheet, row, 9, Some(case.total_force(&run.guideline.section) / 1e3), &looks.number)?;
    sheet
        .write_with_format(row, 10, case.id, &looks.wrapped)?
        .write_with_format(row, 11, case.formula, &looks.wrapped)?
        .write_with_format(row, 12, format!("{}; {}", case.source, case.certainty.word()), &looks.wrapped)?;
    Ok(())
}

/// The first simulation's time series, sample by sample, with its force as a chart.
fn histories(sheet: &mut Worksheet, run: &Run, looks: &Looks) -> Result<(), XlsxError> {
    sheet.set_name("Histories")?.set_freeze_panes(1, 1)?;
    let Some(simulated) = &run.simulated else {
        sheet.write(0, 0, "Nothing was simulated: the design was checked by the equations alone.")?;
        return Ok(());
    };
    let columns = series::numbers(&simulated.histories);
    let mut rows = 0;
    for (column, (name, values)) in (0..).zip(&columns) {
        sheet.write_with_format(0, column, name, &looks.head)?.set_column_width(column, 13)?;
        let values = values.numbers();
        rows = values.len().min(MOST_ROWS - 1);
        for (row, value) in (1..).zip(&values[..rows]) {
            if value.is_finite() {
                sheet.write_number(row, column, *value)?;
            }
        }
    }
    if rows > 1
        && let Some(place) = (0..).zip(&columns).find(|(_, (name, _))| name == "force_x_n").map(|(place, _)| place)
    {
        let mut chart = Chart::new(ChartType::ScatterStraight);
        chart
            .add_series()
            .set_name("force along the bed (N)")
            .set_categories(("Histories", 1, 0, rows as u32, 0))
            .set_values(("Histories", 1, place, rows as u32, place));
        chart.x_axis().set_name("time (s)");
        chart.title().set_name("Force on the barrier, single samples");
        chart.set_width(760).set_height(360);
        sheet.insert_chart(2, columns.len() as u16 + 1, &chart)?;
    }
    Ok(())
}

fn head(sheet: &mut Worksheet, heads: &[(&str, f64)], looks: &Looks) -> Result<(), XlsxError> {
    for (column, (name, width)) in (0..).zip(heads) {
        sheet.write_with_format(0, column, *name, &looks.head)?.set_column_width(column, *width)?;
    }
    Ok(())
}

/// A formula where there is one, else the value.
fn write(
    sheet: &mut Worksheet,
    row: u32,
    column: u16,
    formula: Option<Formula>,
    value: f64,
    looks: &Looks,
) -> Result<(), XlsxError> {
    match formula {
        Some(formula) => {
            sheet.write_formula_with_format(row, column, formula, &looks.number)?;
            Ok(())
        }
        None => number(sheet, row, column, Some(value), &looks.number),
    }
}

/// A number, where it is one; a spreadsheet has no word for one that is not.
fn number(sheet: &mut Worksheet, row: u32, column: u16, value: Option<f64>, format: &Format) -> Result<(), XlsxError> {
    match value {
        Some(value) if value.is_finite() => sheet.write_with_format(row, column, value, format)?,
        Some(value) if value.is_infinite() => sheet.write_with_format(row, column, "unlimited", format)?,
        Some(_) => sheet.write_with_format(row, column, "not known", format)?,
        None => return Ok(()),
    };
    Ok(())
}
