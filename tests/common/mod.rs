//! Small models that several tests share: those of the validation cases.
#![allow(unused_imports)] // each test binary uses its own share of these

pub use barrier_check::validation::scenes::{ball, cloud, floor, free_model, material};
