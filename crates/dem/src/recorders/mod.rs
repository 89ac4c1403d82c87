//! What is written down while a model runs.

pub mod across;
pub(crate) mod body;
pub(crate) mod bolts;
pub mod channels;
pub(crate) mod dead_zone;
pub(crate) mod deposit;
pub mod film;
pub mod gauge;
pub mod histories;
pub mod of_anchors;
pub mod of_boulders;
pub mod of_dissipators;
pub mod of_level;
pub mod of_posts;
pub mod of_ropes;
pub mod of_wall;
pub mod passage;
pub mod recorder;
pub mod setup;
pub mod snapshots;

use self::channels::Channel;

/// All channels, in the order of the columns of tables.
pub const CHANNELS: &[&Channel] = &[
    &of_level::LEVEL,
    &of_wall::MOMENT,
    &of_wall::SEGMENTS,
    &of_wall::METRE_FORCE,
    &of_wall::METRE_MOMENT,
    &of_ropes::MEAN,
    &of_ropes::LARGEST,
    &of_anchors::LOAD,
    &of_ropes::EXTENSION,
    &of_dissipators::STROKE,
    &of_dissipators::MEAN_STROKE,
    &of_dissipators::TENSION,
    &of_ropes::LATERAL,
    &of_anchors::BED,
    &of_anchors::BOLT,
    &of_anchors::BOLT_LIFT,
    &of_ropes::NET,
    &of_ropes::BROKEN,
    &of_ropes::DRAWN_OUT,
    &of_ropes::TOP_HEIGHT,
    &of_boulders::FORCE,
    &of_boulders::NET,
    &of_posts::COMPRESSION,
    &of_posts::MOMENT,
    &of_posts::FOOT[0],
    &of_posts::FOOT[1],
    &of_posts::FOOT[2],
    &of_posts::RETAINING,
    &of_posts::STROKE,
    &of_anchors::EACH[0],
    &of_anchors::EACH[1],
    &of_anchors::EACH[2],
    &of_ropes::LARGEST_AT_ONCE,
    &of_ropes::NET_AT_ONCE,
    &of_ropes::LATERAL_AT_ONCE,
    &of_anchors::LOAD_AT_ONCE,
    &of_anchors::BOLT_AT_ONCE,
    &of_anchors::SPACE,
    &of_anchors::SPACE_AT_ONCE,
    &of_posts::COMPRESSION_AT_ONCE,
    &of_posts::RETAINING_AT_ONCE,
];
