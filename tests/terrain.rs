//! The ground of facets: how long a sphere may be left alone before it touches one.

use dem::Vec3;
use dem::tables::surfaces::SurfaceRole;
use dem::tables::terrain::{Patch, Terrain};
use proptest::prelude::*;

/// Cells of the ground along either side, each of two triangles with a side of 1 m.
const CELLS: usize = 4;

fn ground(heights: &[f64]) -> Terrain {
    let row = CELLS + 1;
    let corner = |index: usize| Vec3::new((index % row) as f64, (index / row) as f64, heights[index]);
    let cells = (0..CELLS).flat_map(|y| (0..CELLS).map(move |x| (y * row + x) as u32));
    let halves = cells.flat_map(|low| {
        let high = low + row as u32;
        [vec![low, low + 1, high + 1], vec![low, high + 1, high]]
    });
    let patch = |corners| Patch { corners, role: SurfaceRole::Base, friction: 0.5 };
    Terrain::new((0..row * row).map(corner).collect(), &halves.map(patch).collect::<Vec<_>>())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    /// A sphere that goes less far than it is told to be from a facet does not touch it, on level, hollow and rough ground.
    #[test]
    fn no_facet_is_touched_sooner_than_it_is_told(
        rough in prop::sample::select(vec![0.0, 0.05, 0.6]),
        bumps in prop::collection::vec(-1.0..1.0_f64, (CELLS + 1) * (CELLS + 1)),
        bowl in prop::sample::select(vec![0.0, 0.1]),
        place in [0.2..3.8_f64, 0.2..3.8, 0.001..0.7],
        ways in prop::collection::vec([-1.0..1.0_f64, -1.0..1.0, -1.0..1.0], 30),
    ) {
        let row = CELLS + 1;
        let middle = 0.5 * CELLS as f64;
        let height = |index: usize| {
            let (x, y) = ((index % row) as f64 - middle, (index / row) as f64 - middle);
            rough * bumps[index] + bowl * (x * x + y * y)
        };
        let terrain = ground(&(0..row * row).map(height).collect::<Vec<_>>());
        let radius = 0.3;
        let touches = |facet: u32, centre: &Vec3| {
            terrain.place(facet, centre).is_some_and(|place| place.height < radius * (1.0 - 1e-9))
        };
        // A run is given up long before a centre goes through the ground: none that is below a corner of its cell counts.
        let top = |x: f64, y: f64| {
            let cell = |place: f64| (place.max(0.0) as usize).min(CELLS - 1);
            let low = cell(y) * row + cell(x);
            [low, low + 1, low + row, low + row + 1].into_iter().map(height).fold(f64::NEG_INFINITY, f64::max)
        };
        let above = |centre: &Vec3| centre.z > top(centre.x, centre.y);
        let centre = Vec3::new(place[0], place[1], top(place[0], place[1]) + place[2]);
        for facet in 0..terrain.facets().len() as u32 {
            let gap = terrain.separation(facet, &centre, radius).sqrt() - radius;
            if gap < 0.0 {
                continue;
            }
            prop_assert!(!touches(facet, &centre));
            for way in &ways {
                let way = Vec3::from(*way);
                let moved = centre + way.normalize() * (gap * way.norm().min(1.0) * (1.0 - 1e-9));
                prop_assert!(!above(&moved) || !touches(facet, &moved), "facet {facet}, gap {gap}, at {moved:?}");
            }
        }
    }
}
