//! The bolts that hold the lowest main rope to the bed.

use crate::Vec3;

/// What a rope with so many spaces between its bolts bears.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BoltedRope {
    /// Force (N) on each bolt: the bolts beside a knot share its pull by lever.
    pub bolts: Vec<Vec3>,
    /// Force (N) on the rope in each space: all that its knots pull with.
    pub spaces: Vec<Vec3>,
}

impl BoltedRope {
    /// Of a rope `from` one place across the channel `to` another (m). `knots` gives where across the channel each held knot is (m), and the pull of the
    /// net on it (N).
    pub fn of(knots: impl Iterator<Item = (f64, Vec3)>, spaces: usize, [from, to]: [f64; 2]) -> Self {
        let mut rope = Self { bolts: vec![Vec3::zeros(); spaces + 1], spaces: vec![Vec3::zeros(); spaces] };
        if spaces == 0 {
            return rope;
        }
        for (across, force) in knots {
            let place = ((across - from) / (to - from)).clamp(0.0, 1.0) * spaces as f64;
            let before = (place as usize).min(spaces - 1);
            let share = place - before as f64;
            rope.bolts[before] += force * (1.0 - share);
            rope.bolts[before + 1] += force * share;
            rope.spaces[before] += force;
        }
        rope
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bolts_beside_a_knot_share_its_force_by_lever() {
        let force = Vec3::new(8.0, 0.0, -4.0);
        let shared = |across: f64| BoltedRope::of([(across, force)].into_iter(), 4, [0.0, 2.0]).bolts;
        // Bolts at 0, 0.5, 1, 1.5 and 2 m.
        assert_eq!(shared(0.625), [Vec3::zeros(), force * 0.75, force * 0.25, Vec3::zeros(), Vec3::zeros()]);
        assert_eq!(shared(1.0)[2], force);
        // At the ends, and beyond them, the last bolt alone.
        assert_eq!(shared(2.0)[4], force);
        assert_eq!(shared(2.3)[4], force);
        assert_eq!(shared(-0.1)[0], force);
        // A rope that begins elsewhere.
        let moved = BoltedRope::of([(3.625, force)].into_iter(), 4, [3.0, 5.0]).bolts;
        assert_eq!(moved, shared(0.625));
    }

    /// A knot in the middle of each space: each bolt holds the mean of its two knots, the rope in each space all of its own.
    #[test]
    fn the_rope_in_a_space_bears_all_that_its_knots_pull_with() {
        let pull = |force: f64| Vec3::new(force, 0.0, 0.0);
        let knots = [(0.25, pull(2.0)), (0.75, pull(8.0)), (1.25, pull(4.0)), (1.75, pull(1.0)), (1.8, pull(1.5))];
        let rope = BoltedRope::of(knots.into_iter(), 4, [0.0, 2.0]);
        assert_eq!(rope.spaces, [2.0, 8.0, 4.0, 2.5].map(pull));
        assert_eq!(rope.bolts[1..3], [5.0, 6.0].map(pull));
    }

    #[test]
    fn no_force_is_lost_between_bolts() {
        let knots = (0..40).map(|knot| (0.05 * f64::from(knot), Vec3::new(1.0, f64::from(knot), 2.0)));
        let all: Vec3 = knots.clone().map(|(_, force)| force).sum();
        let rope = BoltedRope::of(knots, 7, [0.0, 2.0]);
        for parts in [rope.bolts, rope.spaces] {
            approx::assert_relative_eq!(parts.into_iter().sum::<Vec3>(), all, max_relative = 1e-12);
        }
    }
}
