//! How the kinds of barrier elements are numbered and drawn where a barrier is shown in three dimensions.

use dem::elements::segment::SegmentKind;

/// Half the width at which each kind is drawn in the replay (pixels), by [`code`].
pub const DRAWN_WIDTHS: [f32; 6] = [1.1, 2.6, 1.6, 0.8, 1.6, 3.6];

/// The number of a kind in files and in the replay: 0 net, 1 main rope, 2 lateral rope, 3 ring, 4 retaining rope, 5 post.
pub fn code(kind: &SegmentKind) -> u8 {
    match kind {
        SegmentKind::Net => 0,
        SegmentKind::Main(_) => 1,
        SegmentKind::Lateral => 2,
        SegmentKind::Ring => 3,
        SegmentKind::Retaining(_) => 4,
        SegmentKind::Post(_) => 5,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_a_number_and_a_width_of_its_own() {
        use SegmentKind::{Lateral, Main, Net, Post, Retaining, Ring};
        let codes = [Net, Main(0), Lateral, Ring, Retaining(0), Post(0)].map(|kind| usize::from(code(&kind)));
        assert_eq!(codes, [0, 1, 2, 3, 4, 5]);
        assert!(DRAWN_WIDTHS.get(codes[5]).is_some_and(|width| *width > 0.0));
    }
}
