//! Sheets to add up the loads of one block on, used again for block after block so that the cache keeps them.

use std::sync::{Mutex, PoisonError};

use crate::tables::grain_table::GrainLoad;

/// Blank sheets.
#[derive(Debug, Default)]
pub struct LoadSheets(Mutex<Vec<Vec<GrainLoad>>>);

impl LoadSheets {
    /// A sheet of `rows` loads, all zero.
    pub fn take(&self, rows: usize) -> Vec<GrainLoad> {
        let mut sheet = self.0.lock().unwrap_or_else(PoisonError::into_inner).pop().unwrap_or_default();
        sheet.resize(rows, GrainLoad::default());
        sheet
    }

    /// Takes back a sheet whose loads are all zero again.
    pub fn give_back(&self, sheet: Vec<GrainLoad>) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(sheet);
    }
}
