//! A cell list, to hold the tree of the broad phase against.

use dem::Vec3;
use dem::tables::grains::Grain;

/// Pairs of spheres whose centres are nearer than `reach` (m); cells have that edge.
pub fn pairs(grains: &[Grain], reach: f64) -> Vec<[u32; 2]> {
    let low = grains.iter().fold(Vec3::repeat(f64::INFINITY), |low, grain| low.inf(&grain.position));
    let high = grains.iter().fold(Vec3::repeat(f64::NEG_INFINITY), |high, grain| high.sup(&grain.position));
    let counts = ((high - low) / reach).map(|cells| cells as usize + 1);
    let cell_of = |grain: &Grain| {
        let place = ((grain.position - low) / reach).map(|cell| cell as usize);
        place.x + counts.x * (place.y + counts.y * place.z)
    };
    // Grains in the order of their cells, by counting.
    let mut starts = vec![0_u32; counts.product() + 1];
    for grain in grains {
        starts[cell_of(grain) + 1] += 1;
    }
    for cell in 1..starts.len() {
        starts[cell] += starts[cell - 1];
    }
    let mut next = starts.clone();
    let mut order = vec![0_u32; grains.len()];
    for (number, grain) in grains.iter().enumerate() {
        let place = &mut next[cell_of(grain)];
        order[*place as usize] = number as u32;
        *place += 1;
    }
    let inside = |cell: usize| &order[starts[cell] as usize..starts[cell + 1] as usize];
    let mut found = Vec::new();
    let mut compare = |a: u32, b: u32| {
        if (grains[a as usize].position - grains[b as usize].position).norm_squared() < reach * reach {
            found.push([a.min(b), a.max(b)]);
        }
    };
    for z in 0..counts.z {
        for y in 0..counts.y {
            for x in 0..counts.x {
                let here = x + counts.x * (y + counts.y * z);
                let own = inside(here);
                for (index, &a) in own.iter().enumerate() {
                    own[index + 1..].iter().for_each(|&b| compare(a, b));
                }
                // Half of the 26 neighbours; the other half looks this way.
                for [dx, dy, dz] in HALF {
                    let [nx, ny, nz] = [x as i64 + dx, y as i64 + dy, z as i64 + dz];
                    let within = |n: i64, count: usize| (0..count as i64).contains(&n);
                    if within(nx, counts.x) && within(ny, counts.y) && within(nz, counts.z) {
                        let there = nx as usize + counts.x * (ny as usize + counts.y * nz as usize);
                        for &a in own {
                            inside(there).iter().for_each(|&b| compare(a, b));
                        }
                    }
                }
            }
        }
    }
    found
}

const HALF: [[i64; 3]; 13] = [
    [1, 0, 0],
    [-1, 1, 0],
    [0, 1, 0],
    [1, 1, 0],
    [-1, -1, 1],
    [0, -1, 1],
    [1, -1, 1],
    [-1, 0, 1],
    [0, 0, 1],
    [1, 0, 1],
    [-1, 1, 1],
    [0, 1, 1],
    [1, 1, 1],
];
