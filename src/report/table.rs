//! A table of the report with columns of its own.

use serde::Serialize;

#[derive(Debug, Default, Serialize)]
pub struct Table {
    pub columns: Vec<&'static str>,
    pub rows: Vec<Vec<String>>,
    /// What a reader should know of it.
    pub note: String,
}
