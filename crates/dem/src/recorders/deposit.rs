//! What lies upstream at the end and never leant on the barrier.

use crate::recorders::gauge::GaugeWindow;

/// Length of a stretch in which a gap is sought, in grains, and depth below which it is one, in grains.
const STRETCH: f64 = 2.0;
const THIN: f64 = 0.25;
/// Stretches that are told apart; what lies farther lies in the last.
const FARTHEST: usize = 1 << 16;

/// How far upstream the first gap in the deposit begins (m): a stretch of two grains' length that is less than a quarter of a grain deep, at
/// least `near` (m) upstream; beyond all grains where there is none. `grains` gives how far upstream of the barrier each lies (m), and its mass
/// (kg).
pub fn first_gap(grains: impl Iterator<Item = (f64, f64)>, window: &GaugeWindow, near: f64) -> f64 {
    let cell = STRETCH * window.mean_diameter;
    let mut cells: Vec<f64> = Vec::new();
    for (upstream, mass) in grains {
        let place = ((upstream / cell).max(0.0) as usize).min(FARTHEST);
        cells.resize(cells.len().max(place + 1), 0.0);
        cells[place] += mass;
    }
    let thin = window.across.mass_at(THIN * window.mean_diameter, window.bulk_density, cell);
    let first = (near / cell).ceil() as usize;
    let gap = (first.min(cells.len())..cells.len()).find(|&place| cells[place] < thin).unwrap_or(cells.len());
    gap as f64 * cell
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recorders::across::Across;
    use approx::assert_relative_eq;

    /// Stretches of 1 m that are thin below 250 kg.
    const WINDOW: GaugeWindow =
        GaugeWindow { near: 0.0, far: 1.0, across: Across::Even(1.0), bulk_density: 2000.0, mean_diameter: 0.5 };

    fn beyond(masses: &[f64], near: f64) -> f64 {
        let grains = || masses.iter().enumerate().map(|(place, mass)| (place as f64 + 0.5, *mass));
        let gap = first_gap(grains(), &WINDOW, near);
        grains().filter(|(upstream, _)| *upstream >= gap).map(|(_, mass)| mass).sum()
    }

    #[test]
    fn what_leans_on_the_barrier_without_a_gap_has_arrived_and_what_lies_beyond_one_has_not() {
        assert_relative_eq!(beyond(&[900.0, 800.0, 700.0, 600.0], 1.0), 0.0);
        // The gap itself holds 100 kg.
        assert_relative_eq!(beyond(&[900.0, 800.0, 100.0, 600.0], 1.0), 700.0);
        // A gap that is nearer to the barrier than what counts as arrived anyway.
        assert_relative_eq!(beyond(&[900.0, 100.0, 700.0, 600.0], 2.0), 0.0);
        // Nothing has come.
        assert_relative_eq!(beyond(&[0.0, 0.0, 0.0, 600.0], 1.0), 600.0);
    }
}
