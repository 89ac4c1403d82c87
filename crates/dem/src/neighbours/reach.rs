//! How far the lists of each grain reach.
//!
//! With one reach for all, a few grains that fly off would make the lists of all expire. So each grain gets a reach of its own for the way that
//! its members are likely to go off the drift while the lists live: r = r₀ + (w + ½ S d) T, with w its speed off the drift, or the mean of all
//! if that is larger, since grains are hit; S the steepness of the drift about it, and d the largest distance of grains in each other's reach.
//! T is the time in which the fastest comes to the largest reach, or to the largest for its whole way, against surfaces and ropes. A pair of members is listed if its gap is less than r_i + r_j. The lists hold
//! while no member has used up its reach, δ_i + ½ S_i d τ < r_i; and for grains so far apart that the drift between them may be steeper than about
//! either, while 2 δ + S τ (2 r + 2 o + g) < g with the largest δ and S, and g the least gap of such a pair.

use crate::neighbours::drift::Drift;
use crate::simd::quad::Quad;
use crate::tables::grain_table::GrainTable;
use crate::tables::grains::GrainShape;
use crate::tables::moving_rows::Drifting;
use crate::workers;
use crate::{Vec3, larger_or_nan};

/// Reach of a grain that rests, and the largest, over the reach of a pair that is given.
const AT_REST: f64 = 0.25;
const LARGEST: f64 = 1.25;
/// The largest for the way of a grain in all.
const LARGEST_FIXED: f64 = 3.0;

/// Grains that are handled in one go.
const GRAINS_IN_PART: usize = 2048;

/// Members that are looked at in one go.
const MEMBERS_IN_PART: usize = 2048;

/// What one grain has.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reach {
    /// m
    pub reach: f64,
    /// How fast the drift uses it up: ½ S d (m/s).
    pub drawing: f64,
    /// Of the lists of surfaces and ropes, for which the whole motion of the grain counts, and that of the nodes (m).
    pub fixed: f64,
}

/// What bounds the life of the lists, besides the reach of each grain.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reaches {
    /// Of a grain that rests, and the largest that any may have (m).
    pub least: f64,
    pub largest: f64,
    /// Largest of the lists of surfaces and ropes (m).
    pub fixed: f64,
    /// Sum of the largest radii and offsets of two grains (m).
    pub touching: f64,
    /// Largest speed of a member (m/s).
    pub fastest: f64,
    /// Steepest drift (1/s), and the gap from which grains may have it between them though not about either (m).
    steepest: f64,
    far: f64,
}

impl Reaches {
    /// Gives every grain its reach. `skin` is what a pair gets on the whole, `nodes` the way that the nodes of the barrier may go (m).
    pub fn choose(grains: &GrainTable, drift: &Drift, skin: f64, nodes: f64, reaches: &mut Vec<Reach>) -> Self {
        let widest = grains.bodies.iter().map(|body| body.radius + body.offset).fold(0.0, f64::max);
        let touching = 2.0 * widest;
        let [least, largest] = [AT_REST, LARGEST].map(|share| share * skin);
        reaches.resize(grains.len(), Reach::default());
        // Speeds stand in the place of reaches at first.
        let sums = workers::map(reaches.chunks_mut(GRAINS_IN_PART), |part, reaches| {
            let mut sum = 0.0;
            for (row, of) in (part * GRAINS_IN_PART..).zip(reaches) {
                let x = grains.place[row].0[0];
                let [reach, fixed] = speeds(grains, drift, row);
                *of = Reach { reach, fixed, drawing: 0.5 * drift.steepness_about(x) * (touching + 2.0 * largest) };
                sum += of.reach;
            }
            sum
        });
        let mean = sums.iter().sum::<f64>() / grains.len().max(1) as f64;
        let of_all = |of: &Reach| of.reach.max(mean) + of.drawing;
        let fastest = reaches.iter().map(of_all).fold(0.0, f64::max);
        let fastest_of_all = reaches.iter().map(|of| of.fixed).fold(0.0, f64::max);
        let fastest_in_all = reaches.iter().map(|of| of.fixed.max(mean)).fold(0.0, f64::max);
        let time = |way: f64, speed: f64| if speed > 0.0 { way / speed } else { f64::MAX };
        let lifetime = time(largest - least, fastest).min(time(LARGEST_FIXED * skin, fastest_in_all));
        let mut fixed = 0.0_f64;
        for of in reaches.iter_mut() {
            of.fixed = least + of.fixed.max(mean) * lifetime + nodes;
            of.reach = least + of_all(of) * lifetime;
            fixed = fixed.max(of.fixed);
        }
        let far = drift.reaches_over() - touching;
        Self { least, largest, fixed, touching, fastest: fastest_of_all, steepest: drift.steepness, far }
    }

    /// Largest distance of two grains in each other's reach (m).
    pub fn span(&self) -> f64 {
        self.touching + 2.0 * self.largest
    }

    /// How much closer any pair outside the lists may still come (m), after `elapsed` (s).
    pub fn left(&self, strayed: &Strayed, elapsed: f64) -> f64 {
        let drawn = self.steepest * elapsed * (self.touching + self.far);
        // The clock runs at what the drift does over the span of the lists, which may be less.
        let slower = (self.span() / (self.touching + self.far)).min(1.0);
        let far_left = slower * (self.far - 2.0 * strayed.strayed - drawn);
        if far_left > 0.0 { far_left.min(-2.0 * strayed.over) } else { f64::NEG_INFINITY }
    }
}

/// Speeds of a grain's members off the drift and in all, at most (m/s); zero for what is not finite, which is seen elsewhere.
fn speeds(grains: &GrainTable, drift: &Drift, row: usize) -> [f64; 2] {
    let [x, y, z, _] = drift.at(grains.place[row].0[0]).map(f64::from);
    let velocity = grains.motion[row].vector();
    let turning = match grains.shape {
        GrainShape::Sphere => 0.0,
        GrainShape::Clump => grains.spin[row].vector().norm() * Quad::fourth(&grains.spin[row]),
    };
    let speeds = [velocity - Vec3::new(x, y, z), velocity].map(|velocity| velocity.norm() + turning);
    speeds.map(|speed| if speed.is_finite() { speed } else { 0.0 })
}

/// How far members have gone since their lists were made.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Strayed {
    /// Largest excess of the way of a member over the reach of its grain's lists of surfaces and ropes (m); negative while there is some left.
    pub moved_over: f64,
    /// Largest displacement from the drift (m).
    pub strayed: f64,
    /// Largest excess of what a member has used over the reach of its grain (m); negative while there is some left.
    pub over: f64,
}

/// How far members with the given reference places have gone after `elapsed` (s); NaN if one is nowhere.
pub fn strayed(
    references: &[Vec3],
    grains: &GrainTable,
    drift: &[Drifting],
    reaches: &[Reach],
    elapsed: f64,
) -> Strayed {
    let rows = grains.rows();
    let per_grain = grains.shape.members();
    let parts = workers::map(references.chunks(MEMBERS_IN_PART), |part, references| {
        let mut most = NOWHERE;
        for (index, reference) in (part * MEMBERS_IN_PART..).zip(references) {
            let gone = rows.sphere(index).0 - reference;
            let [x, y, z, _] = drift[index / per_grain].map(f64::from);
            let off = gone - Vec3::new(x, y, z) * elapsed;
            let Reach { reach, drawing, fixed } = reaches[index / per_grain];
            let strayed = off.norm();
            let over = strayed + drawing * elapsed - reach;
            most = most.or_larger(&Strayed { moved_over: gone.norm() - fixed, strayed, over });
        }
        most
    });
    parts.iter().fold(NOWHERE, |most, part| most.or_larger(part))
}

/// Of no member at all.
const NOWHERE: Strayed = Strayed { moved_over: f64::NEG_INFINITY, strayed: 0.0, over: f64::NEG_INFINITY };

impl Strayed {
    fn or_larger(&self, other: &Self) -> Self {
        Self {
            moved_over: larger_or_nan(self.moved_over, other.moved_over),
            strayed: larger_or_nan(self.strayed, other.strayed),
            over: larger_or_nan(self.over, other.over),
        }
    }
}
