//! Validation: scenes with known answers, each in its own file, run by `barrier-check validate`.
//!
//! The names A1, B4, C5 … are those of the project's list of verification cases.

pub mod barrier;
pub(crate) mod bulk;
pub mod case;
pub(crate) mod contact;
pub mod scenes;
pub(crate) mod wall;

use case::Case;

/// All cases, in the order in which they are run.
pub const CASES: &[&Case] = &[
    &contact::restitution::CASE,
    &contact::wall_restitution::CASE,
    &contact::transient::CASE,
    &contact::bounces::CASE,
    &contact::weight::CASE,
    &contact::rolling::SLIP,
    &contact::oblique::CLOSED_FORM,
    &contact::oblique::ALUMINIUM_OXIDE,
    &contact::oblique::SLIDING,
    &contact::oblique::SPINNING,
    &contact::coarse_steps::CASE,
    &contact::gears::CASE,
    &contact::neck::CASE,
    &contact::clump_body::BODY,
    &contact::rolling::SLOPE,
    &contact::clump_body::CONSERVED,
    &contact::energy::DRIFT,
    &contact::energy::LEDGER,
    &contact::cooling::CASE,
    &contact::energy::FRAME,
    &contact::chain::CASE,
    &contact::ground::PLANE,
    &contact::ground::SEAMS,
    &contact::ground::GROOVE,
    &contact::ground::FILLED,
    &barrier::section::RECTANGLE,
    &bulk::packing::CASE,
    &bulk::collapse::COLUMN,
    &bulk::collapse::FLOORS,
    &bulk::silo::CASE,
    &bulk::collapse::DAM,
    &wall::calibration::SLIDE,
    &wall::impulse::BALANCE,
    &wall::impulse::BEAM,
    &wall::impulse::IDENTITY,
    &wall::calibration::CASE,
    &wall::calibration::HEAP,
    &wall::variants::PREDICTION,
    &wall::variants::SHAPE,
    &wall::variants::RESTITUTION,
    &wall::variants::FLUCTUATION,
    &wall::slopes::CASE,
    &wall::surge::MODULUS,
    &wall::usgs_flume::CASE,
    &barrier::ropes::BAR,
    &barrier::beams::TIP_LOAD,
    &barrier::beams::ELASTICA,
    &barrier::beams::WEIGHT,
    &barrier::beams::TWIST,
    &barrier::beams::VIBRATION,
    &barrier::ropes::HANGING,
    &barrier::ropes::SWINGING,
    &barrier::ropes::POINT_LOAD,
    &barrier::ropes::BRAKED,
    &barrier::ropes::BLOCK,
    &barrier::contacts::NEAREST,
    &barrier::contacts::STIFFNESS,
    &barrier::dissipators::CYCLE,
    &barrier::dissipators::STOPPING,
    &barrier::punching::CASE,
    &barrier::pieces::CASE,
    &barrier::full_scale::BRAKED,
    &barrier::full_scale::UNBRAKED,
    &barrier::variations::SLOPE,
    &barrier::variations::OPENINGS,
    &barrier::variations::ORIENTATION,
    &barrier::variations::LATERAL,
    &barrier::variations::EXTENSION,
];
