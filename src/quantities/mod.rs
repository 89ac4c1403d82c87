//! What is measured of a run: a file for each quantity, or for a few that are read alike, and one list.
//!
//! Recordings, `result.json` and its schema, mean and scatter over the packings, the comparison of designs and the demands that checks are
//! made of go by this list. A check names a quantity and holds it against a capacity.

pub mod anchor_load;
pub mod bed;
pub mod boulder;
pub mod coefficients;
pub mod counts;
pub mod dissipator;
pub mod earth_pressure;
pub mod height;
pub mod incoming;
pub mod mass;
pub mod observed;
pub mod other_ropes;
pub mod posts;
pub mod quantity;
pub mod reading;
pub mod rope_damage;
pub mod rope_tension;
pub mod run_up;
pub mod total_force;
pub mod wall;

use self::quantity::Quantity;

/// All quantities, in the order of the fields of `result.json`.
pub const QUANTITIES: &[&Quantity] = &[
    &total_force::PEAK,
    &total_force::PEAK_TIME,
    &total_force::PEAK_SAMPLED,
    &total_force::RESIDUAL,
    &total_force::PUSH,
    &total_force::PUSH_RESIDUAL,
    &total_force::ON_A_METRE,
    &mass::VELOCITY,
    &mass::VELOCITY_TIME,
    &mass::RETAINED,
    &mass::STOPPED_UPSTREAM,
    &mass::LOST_THROUGH,
    &mass::LOST_UNDER,
    &mass::LOST_BESIDE,
    &mass::LOST_OVER,
    &height::TOP_ROPE,
    &height::RESIDUAL,
    &run_up::LEVEL,
    &rope_tension::PEAK,
    &rope_tension::AT_ONCE,
    &rope_tension::MEAN_PEAK,
    &rope_tension::MEAN_RESIDUAL,
    &anchor_load::PEAK,
    &anchor_load::AT_ONCE,
    &rope_tension::DEFLECTION,
    &dissipator::STROKE,
    &dissipator::MEAN_STROKE,
    &dissipator::TENSION,
    &other_ropes::LATERAL,
    &other_ropes::LATERAL_AT_ONCE,
    &bed::FORCE,
    &bed::BOLT,
    &bed::BOLT_AT_ONCE,
    &bed::BOLT_LIFT,
    &bed::SPACE,
    &bed::SPACE_AT_ONCE,
    &other_ropes::NET,
    &other_ropes::NET_AT_ONCE,
    &other_ropes::NET_RESIDUAL,
    &rope_damage::BROKEN,
    &rope_damage::FIRST_BREAK,
    &rope_damage::DRAWN_OUT,
    &wall::SEGMENT,
    &wall::SEGMENT_RESIDUAL,
    &wall::MOMENT,
    &wall::MOMENT_SAMPLED,
    &wall::SLIDING,
    &wall::OVERTURNING,
    &wall::PRESS,
    &incoming::DEPTH,
    &incoming::VELOCITY,
    &incoming::FRONT,
    &incoming::ON_DEPOSIT,
    &incoming::FLUX_ON_DEPOSIT,
    &incoming::THICKNESS_AT_PEAK,
    &incoming::VELOCITY_AT_PEAK,
    &incoming::DEPOSIT,
    &earth_pressure::AT_REST,
    &earth_pressure::OF_ANY_DEPTH,
    &earth_pressure::DYNAMIC,
    &earth_pressure::K_SPLIT,
    &earth_pressure::LAMBDA_UPSTREAM,
    &earth_pressure::LAMBDA_MEAN,
    &boulder::FORCE,
    &boulder::NET,
    &posts::COMPRESSION,
    &posts::UPLIFT,
    &posts::MOMENT,
    &posts::FOOT,
    &posts::FOOT_ALONG,
    &posts::FOOT_ACROSS,
    &posts::FOOT_UP,
    &posts::RETAINING,
    &posts::STROKE,
    &posts::COMPRESSION_AT_ONCE,
    &posts::RETAINING_AT_ONCE,
    &anchor_load::EACH,
    &anchor_load::ALONG,
    &anchor_load::ACROSS,
    &anchor_load::UP,
];
