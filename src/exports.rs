//! Files beside the report, for other programs, that are written where they are asked for.

use serde::{Deserialize, Serialize};

/// Which of them are asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Exports {
    /// The course of the event for ParaView.
    pub vtk: bool,
    /// Checks, load cases and time series for a spreadsheet program.
    pub xlsx: bool,
    /// The barrier in its section and along the channel for a drawing program.
    pub dxf: bool,
    /// The report as it is printed.
    pub pdf: bool,
}
