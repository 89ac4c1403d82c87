//! D23, D25: where cylinders touch, and how stiff such a contact is.

use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use dem::Vec3;
use dem::contact::law::contact_stiffness;
use dem::geometry::segment_segment::nearest_of_segments;

pub const NEAREST: Case = Case {
    id: "D23",
    suite: Suite::Rope,
    title: "Nearest points of two segments",
    source: "(0.25, 1/3, 0.3) for the tabulated pair; a search over both segments for random ones",
    tier: Tier::ClosedForm,
    weakness: "the search is as fine as its grid",
    cost: Cost::Quick,
    run: nearest,
};

pub const STIFFNESS: Case = Case {
    id: "D25",
    suite: Suite::Rope,
    title: "Stiffness of a grain on a rope, and of a ring on a rope",
    source: "k = 2 E₁r₁ E₂r₂/(E₁r₁ + E₂r₂)",
    tier: Tier::ClosedForm,
    weakness: "arithmetic only",
    cost: Cost::Quick,
    run: stiffness,
};

const PAIRS: usize = 200;
const GRID: usize = 60;

fn nearest() -> Result<Vec<Finding>, Broken> {
    let tabulated = nearest_of_segments(
        [&Vec3::zeros(), &Vec3::new(2.0, 0.0, 0.0)],
        [&Vec3::new(0.5, -1.0, 0.3), &Vec3::new(0.5, 2.0, 0.3)],
    );
    let mut random = fastrand::Rng::with_seed(2);
    // How far below the search the formula comes, and how far above: the first is the grid's, the second none.
    let (mut below, mut above) = (0.0_f64, 0.0_f64);
    for _ in 0..PAIRS {
        let points = [(); 4].map(|()| Vec3::from_fn(|_, _| random.f64()));
        let [a0, a1, b0, b1] = &points;
        let found = nearest_of_segments([a0, a1], [b0, b1]);
        let distance = (found.points[0] - found.points[1]).norm();
        let at = |from: &Vec3, to: &Vec3, number: usize| from + (to - from) * (number as f64 / GRID as f64);
        let grid = (0..=GRID).flat_map(|i| (0..=GRID).map(move |j| (i, j)));
        let searched = grid.map(|(i, j)| (at(a0, a1, i) - at(b0, b1, j)).norm()).fold(f64::INFINITY, f64::min);
        below = below.max(searched - distance);
        above = above.max(distance - searched);
    }
    Ok(vec![
        Finding::close("share on the first", tabulated.shares[0], 0.25, 1e-12),
        Finding::close("share on the second", tabulated.shares[1], 1.0 / 3.0, 1e-12),
        Finding::close("random pairs: above the search, at most", above, 0.0, 1e-12),
        Finding::between("random pairs: below the search, at most", below, 0.0, 1.0 / GRID as f64),
    ])
}

fn stiffness() -> Result<Vec<Finding>, Broken> {
    let grain = 1e8 * 0.189;
    Ok(vec![
        Finding::near("grain on a net rope (N/m)", contact_stiffness(grain, 4e9 * 0.008), 2.3764e7, 1e-4),
        Finding::near("grain on a main rope (N/m)", contact_stiffness(grain, 4e9 * 0.016), 2.9182e7, 1e-4),
        Finding::near("ring on a main rope (N/m)", contact_stiffness(8e9 * 0.008, 4e9 * 0.016), 6.4e7, 1e-9),
    ])
}
