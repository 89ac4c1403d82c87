//! One file per command. Only these and the report's writer touch files.

pub mod check;
pub mod compare;
pub mod engines;
pub mod explain;
pub(crate) mod input;
pub(crate) mod kept;
mod kept_simulations;
pub mod messages;
pub mod misspelt;
pub mod new;
mod one_page;
pub(crate) mod output;
mod printed;
pub mod progress;
mod random_name;
mod reliability;
pub mod report;
pub mod schema;
mod scratch;
pub mod serve;
pub(crate) mod signals;
mod size;
mod steps;
pub mod study;
mod sweep;
pub mod validate;

/// How the program ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ExitCode {
    /// All checks hold.
    Pass = 0,
    /// A check fails.
    Fail = 1,
    /// No decision: bad input, or a run that cannot be relied on.
    Undecided = 2,
}

/// Why a command could not do what it was asked for.
pub type Failure = Box<dyn std::error::Error + Send + Sync>;
