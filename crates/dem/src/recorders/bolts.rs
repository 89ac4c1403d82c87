//! The bolts that hold the lowest main rope to the bed.

use crate::Vec3;

/// Force (N) on each bolt of a rope with so many `spaces` between bolts, `from` one place across the channel `to` another (m). `knots` gives where across the channel each held
/// knot is (m), and the pull of the net on it (N): the bolts beside a knot share that by lever.
pub fn share_between_bolts(knots: impl Iterator<Item = (f64, Vec3)>, spaces: usize, [from, to]: [f64; 2]) -> Vec<Vec3> {
    let mut loads = vec![Vec3::zeros(); spaces + 1];
    if spaces == 0 {
        return loads;
    }
    for (across, force) in knots {
        let place = ((across - from) / (to - from)).clamp(0.0, 1.0) * spaces as f64;
        let before = (place as usize).min(spaces - 1);
        let share = place - before as f64;
        loads[before] += force * (1.0 - share);
        loads[before + 1] += force * share;
    }
    loads
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bolts_beside_a_knot_share_its_force_by_lever() {
        let force = Vec3::new(8.0, 0.0, -4.0);
        let shared = |across: f64| share_between_bolts([(across, force)].into_iter(), 4, [0.0, 2.0]);
        // Bolts at 0, 0.5, 1, 1.5 and 2 m.
        assert_eq!(shared(0.625), [Vec3::zeros(), force * 0.75, force * 0.25, Vec3::zeros(), Vec3::zeros()]);
        assert_eq!(shared(1.0)[2], force);
        // At the ends, and beyond them, the last bolt alone.
        assert_eq!(shared(2.0)[4], force);
        assert_eq!(shared(2.3)[4], force);
        assert_eq!(shared(-0.1)[0], force);
        // A rope that begins elsewhere.
        let moved = share_between_bolts([(3.625, force)].into_iter(), 4, [3.0, 5.0]);
        assert_eq!(moved, shared(0.625));
    }

    #[test]
    fn no_force_is_lost_between_bolts() {
        let knots = (0..40).map(|knot| (0.05 * f64::from(knot), Vec3::new(1.0, f64::from(knot), 2.0)));
        let all: Vec3 = knots.clone().map(|(_, force)| force).sum();
        let shared: Vec3 = share_between_bolts(knots, 7, [0.0, 2.0]).into_iter().sum();
        approx::assert_relative_eq!(shared, all, max_relative = 1e-12);
    }
}
