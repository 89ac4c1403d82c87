//! Tables for programs: columns of numbers and texts, as CSV and as Parquet.

use std::fmt::Write;
use std::sync::Arc;

use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;

use crate::report::numbers::quoted;

/// The values of a column, all columns being of one length.
#[derive(Clone, Debug, PartialEq)]
pub enum Column {
    Numbers(Vec<f64>),
    /// Numbers that may be missing.
    Known(Vec<Option<f64>>),
    Texts(Vec<String>),
}

impl Column {
    /// Its numbers; none of a column that has others.
    pub fn numbers(&self) -> &[f64] {
        if let Self::Numbers(values) = self { values } else { &[] }
    }

    fn rows(&self) -> usize {
        match self {
            Self::Numbers(values) => values.len(),
            Self::Known(values) => values.len(),
            Self::Texts(values) => values.len(),
        }
    }
}

/// The columns as a text, their names first.
pub fn csv(columns: &[(String, Column)]) -> String {
    let mut out = columns.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(",");
    out.push('\n');
    for row in 0..columns.first().map_or(0, |(_, column)| column.rows()) {
        for (index, (_, column)) in columns.iter().enumerate() {
            if index > 0 {
                out.push(',');
            }
            // With a point even where the value is whole: readers take the type of a column from what they see.
            let _ = match column {
                Column::Numbers(values) => write!(out, "{:?}", values[row]),
                Column::Known(values) => values[row].map_or(Ok(()), |value| write!(out, "{value:?}")),
                Column::Texts(values) => write!(out, "{}", quoted(&values[row])),
            };
        }
        out.push('\n');
    }
    out
}

/// The columns as a file of Parquet: doubles and texts.
pub fn parquet(name: &str, columns: &[(String, Column)]) -> Result<Vec<u8>, ParquetError> {
    let field = |(name, column): &(String, Column)| match column {
        Column::Numbers(_) => format!("REQUIRED DOUBLE {name};\n"),
        Column::Known(_) => format!("OPTIONAL DOUBLE {name};\n"),
        Column::Texts(_) => format!("REQUIRED BINARY {name} (UTF8);\n"),
    };
    let fields: String = columns.iter().map(field).collect();
    let schema = Arc::new(parse_message_type(&format!("message {name} {{\n{fields}}}"))?);
    let mut bytes = Vec::new();
    let mut writer = SerializedFileWriter::new(&mut bytes, schema, Arc::new(WriterProperties::builder().build()))?;
    let mut rows = writer.next_row_group()?;
    for (_, column) in columns {
        let Some(mut to) = rows.next_column()? else { continue };
        match column {
            Column::Numbers(values) => {
                to.typed::<DoubleType>().write_batch(values, None, None)?;
            }
            Column::Known(values) => {
                let known: Vec<f64> = values.iter().flatten().copied().collect();
                let there: Vec<i16> = values.iter().map(|value| i16::from(value.is_some())).collect();
                to.typed::<DoubleType>().write_batch(&known, Some(&there), None)?;
            }
            Column::Texts(values) => {
                let texts: Vec<ByteArray> = values.iter().map(|text| ByteArray::from(text.as_str())).collect();
                to.typed::<ByteArrayType>().write_batch(&texts, None, None)?;
            }
        }
        to.close()?;
    }
    rows.close()?;
    writer.close()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_has_a_line_for_each_row_and_nothing_where_nothing_is_known() {
        let columns = [
            ("a".to_string(), Column::Numbers(vec![1.0, 2.5])),
            ("b".to_string(), Column::Known(vec![None, Some(3.0)])),
            ("c".to_string(), Column::Texts(vec!["x, \"y\"".into(), String::new()])),
        ];
        assert_eq!(csv(&columns), "a,b,c\n1.0,,\"x, \"\"y\"\"\"\n2.5,3.0,\"\"\n");
        assert!(parquet("t", &columns).is_ok_and(|bytes| bytes.starts_with(b"PAR1")));
    }
}
