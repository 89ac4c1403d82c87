//! Contacts between grains: gather, apply the law to a batch, scatter.
//!
//! A block of grains owns the pairs whose first member it holds. Pairs inside the block load both grains; for pairs
//! across its border the load of the other grain is left with the loads that this block has for others, which the other block takes in a fixed order. So no
//! two blocks ever write the same row and the result does not depend on how many threads run.

use std::ops::Range;

use crate::contact::grain_touch::{GrainTouch, PairConstants};
use crate::contact::lane_sums::LaneSums;
use crate::contact::law::{Response, respond};
use crate::contact::pair_list::{EightPairs, PairList, Separation};
use crate::ledger::ContactSums;
use crate::neighbours::blocks::{OutgoingLoads, RemoteLoad};
use crate::neighbours::clocks::Clock;
use crate::simd::eight::{Eight, Row, each_lane};
use crate::simd::real::{add_scaled, dot, minus};
use crate::simd::widest::{Work, with_widest};
use crate::tables::grain_rows::{GrainRows, Prefetcher};
use crate::tables::grain_table::{GrainLoad, side};
use crate::tables::grains::GrainShape;

/// Everything that [`load_inner`] and [`load_border`] read besides the list itself.
pub struct PairContext<'a> {
    pub grains: GrainRows<'a>,
    pub constants: PairConstants<'a>,
    /// Closing distance since the lists were made (m).
    pub clock: Clock,
}

/// Loads both grains of every touching pair inside the block; `loads` holds the rows of `range`. Meanwhile goes on
/// with `prefetcher`.
pub fn load_inner<'b>(
    list: &mut PairList,
    context: &PairContext<'b>,
    range: &Range<usize>,
    loads: &mut [GrainLoad],
    prefetcher: &mut Prefetcher<'b>,
) -> ContactSums {
    load(list, context, loads, range.start, prefetcher, Here(range.start))
}

/// Loads the first grain of every touching pair across the block's border, and leaves the load of the second to its own block.
pub fn load_border(
    list: &mut PairList,
    context: &PairContext,
    range: &Range<usize>,
    loads: &mut [GrainLoad],
    outgoing: &mut OutgoingLoads,
) -> ContactSums {
    load(list, context, loads, range.start, &mut Prefetcher::none(context.grains), outgoing)
}

fn load<'b>(
    list: &mut PairList,
    context: &PairContext<'b>,
    loads: &mut [GrainLoad],
    start: usize,
    prefetcher: &mut Prefetcher<'b>,
    target: impl Target,
) -> ContactSums {
    match context.grains.shape {
        GrainShape::Sphere => with_widest(LoadPairs::<false, _> { list, context, loads, start, prefetcher, target }),
        GrainShape::Clump => with_widest(LoadPairs::<true, _> { list, context, loads, start, prefetcher, target }),
    }
}

/// Where the loads of the second grains go.
trait Target {
    fn take<R: Row>(&mut self, loads: &mut [GrainLoad], row: usize, force: R, torque: R);
}

/// To the same block, whose rows begin at the given one.
struct Here(usize);

impl Target for Here {
    #[inline(always)]
    fn take<R: Row>(&mut self, loads: &mut [GrainLoad], row: usize, force: R, torque: R) {
        add(&mut loads[row - self.0], force, torque);
    }
}

impl Target for &mut OutgoingLoads {
    #[inline(always)]
    fn take<R: Row>(&mut self, _: &mut [GrainLoad], row: usize, force: R, torque: R) {
        let mut load = RemoteLoad { row: row as u32, ..RemoteLoad::default() };
        force.store(&mut load.force);
        torque.store(&mut load.torque);
        self.push(load);
    }
}

#[inline(always)]
fn add<R: Row>(load: &mut GrainLoad, force: R, torque: R) {
    (R::load(&load.force) + force).store(&mut load.force);
    (R::load(&load.torque) + torque).store(&mut load.torque);
}

/// The pairs of one list, to be loaded.
struct LoadPairs<'a, 'b, const CLUMPS: bool, T> {
    list: &'a mut PairList,
    context: &'a PairContext<'b>,
    loads: &'a mut [GrainLoad],
    start: usize,
    prefetcher: &'a mut Prefetcher<'b>,
    target: T,
}

impl<const CLUMPS: bool, T: Target> Work for LoadPairs<'_, '_, CLUMPS, T> {
    type Output = ContactSums;

    #[inline(always)]
    fn run<E: Eight>(mut self) -> ContactSums {
        let context = self.context;
        self.list.sort_near(&context.clock, &Spheres::<CLUMPS>(context.grains));
        let mut sums = LaneSums::<E>::default();
        let mut last = None;
        while let Some(eight) = self.list.eight_after(last) {
            let touch = GrainTouch::<E, CLUMPS>::of(context.grains, &eight, &context.constants);
            let response = respond(&touch.point, &self.list.memory_of(&eight), &context.constants.law);
            sums.count(&response, touch.point.overlap * touch.inverse_radius);
            self.scatter(&eight, &touch, &response);
            self.list.remember(&eight, &response.memory, touch.point.overlap);
            self.prefetcher.go_on();
            last = Some(eight);
        }
        self.list.end_contacts();
        sums.total()
    }
}

impl<const CLUMPS: bool, T: Target> LoadPairs<'_, '_, CLUMPS, T> {
    #[inline(always)]
    fn scatter<E: Eight>(&mut self, eight: &EightPairs, touch: &GrainTouch<E, CLUMPS>, response: &Response<E>) {
        let (force, [torque1, torque2]) = touch.loads(response);
        let back = E::Row::all(-1.0);
        each_lane!(|lane| {
            if lane < eight.count {
                let [a, b] = eight.pairs[lane].map(|member| if CLUMPS { member as usize / 2 } else { member as usize });
                add(&mut self.loads[a - self.start], force[lane], torque1[lane]);
                self.target.take(self.loads, b, force[lane] * back, torque2[lane]);
            }
        });
    }
}

/// The member spheres of a table of spheres (`CLUMPS` false) or of clumps.
struct Spheres<'a, const CLUMPS: bool>(GrainRows<'a>);

impl<const CLUMPS: bool> Separation for Spheres<'_, CLUMPS> {
    #[inline(always)]
    fn of(&self, [first, second]: [u32; 2]) -> (f64, f64) {
        let (a, r1) = centre::<CLUMPS>(self.0, first);
        let (b, r2) = centre::<CLUMPS>(self.0, second);
        let between = minus(b, a);
        (dot(between, between), r1 + r2)
    }
}

/// The member spheres of any table.
pub struct Members<'a>(pub GrainRows<'a>);

impl Separation for Members<'_> {
    fn of(&self, pair: [u32; 2]) -> (f64, f64) {
        match self.0.shape {
            GrainShape::Sphere => Spheres::<false>(self.0).of(pair),
            GrainShape::Clump => Spheres::<true>(self.0).of(pair),
        }
    }
}

/// Centre and radius of a member sphere.
#[inline(always)]
fn centre<const CLUMPS: bool>(grains: GrainRows, member: u32) -> ([f64; 3], f64) {
    let row = if CLUMPS { member as usize / 2 } else { member as usize };
    let place = grains.place(row).0;
    let centre = [place[0], place[1], place[2]];
    if !CLUMPS {
        return (centre, place[3]);
    }
    let axis = grains.axis(row).0;
    let length = side(member) * grains.spin(row).0[3];
    (add_scaled(centre, length, [axis[0], axis[1], axis[2]]), place[3])
}
