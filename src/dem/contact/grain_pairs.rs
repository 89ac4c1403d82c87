//! Contacts between grains: gather, apply the law to a batch, scatter.
//!
//! A block of grains owns the pairs whose first member it holds. Pairs inside the block load both grains; for pairs
//! across its border the load of the other grain goes to an outbox, which the other block empties in a fixed order. So no
//! two blocks ever write the same row and the result does not depend on how many threads run.

use std::cell::RefCell;
use std::ops::Range;

use crate::dem::contact::grain_batch::GrainBatch;
use crate::dem::contact::lanes::{LANES, LaneSums};
use crate::dem::contact::law::{LawConstants, Memory, add_scaled, dot};
use crate::dem::contact::pair_list::{PairList, Separation};
use crate::dem::ledger::ContactSums;
use crate::dem::neighbours::blocks::Outbox;
use crate::dem::neighbours::clocks::Clock;
use crate::dem::tables::grain_table::{GrainLoad, GrainTable, side};
use crate::dem::tables::grains::GrainShape;

thread_local! {
    // Each thread's batches stay where its cache has them.
    static SPHERES: RefCell<GrainBatch<false>> = RefCell::default();
    static CLUMPS: RefCell<GrainBatch<true>> = RefCell::default();
}

/// What the grain contacts of a run have in common.
#[derive(Clone, Copy, Debug)]
pub struct PairConstants {
    pub law: LawConstants,
    /// Contact modulus of the grains (Pa).
    pub modulus: f64,
    pub friction: f64,
}

/// Everything that [`load_inner`] and [`load_border`] read besides the list itself.
pub struct PairContext<'a> {
    pub grains: &'a GrainTable,
    pub constants: PairConstants,
    /// Closing distance since the lists were made (m).
    pub clock: Clock,
}

/// Loads both grains of every touching pair inside the block; `loads` holds the rows of `range`.
pub fn load_inner(
    list: &mut PairList,
    context: &PairContext,
    range: &Range<usize>,
    loads: &mut [GrainLoad],
) -> ContactSums {
    let start = range.start;
    let target = |row: usize, load: GrainLoad, loads: &mut [GrainLoad]| loads[row - start].join(&load);
    load(list, context, start, loads, target)
}

/// Loads the first grain of every touching pair across the block's border, and posts the load of the second.
pub fn load_border(
    list: &mut PairList,
    context: &PairContext,
    range: &Range<usize>,
    loads: &mut [GrainLoad],
    outbox: &mut Outbox,
) -> ContactSums {
    let target = |row: usize, load: GrainLoad, _: &mut [GrainLoad]| outbox.post(row, load);
    load(list, context, range.start, loads, target)
}

fn load(
    list: &mut PairList,
    context: &PairContext,
    start: usize,
    loads: &mut [GrainLoad],
    second: impl FnMut(usize, GrainLoad, &mut [GrainLoad]),
) -> ContactSums {
    match context.grains.shape {
        GrainShape::Sphere => SPHERES.with_borrow_mut(|batch| load_widest(list, context, batch, start, loads, second)),
        GrainShape::Clump => CLUMPS.with_borrow_mut(|batch| load_widest(list, context, batch, start, loads, second)),
    }
}

/// With the widest vectors this processor has.
fn load_widest<const CLUMPS: bool>(
    list: &mut PairList,
    context: &PairContext,
    batch: &mut GrainBatch<CLUMPS>,
    start: usize,
    loads: &mut [GrainLoad],
    second: impl FnMut(usize, GrainLoad, &mut [GrainLoad]),
) -> ContactSums {
    #[cfg(target_arch = "x86_64")]
    {
        if std::arch::is_x86_feature_detected!("avx512f") && std::arch::is_x86_feature_detected!("avx512vl") {
            // SAFETY: the processor was just asked for these features.
            return unsafe { load_avx512(list, context, batch, start, loads, second) };
        }
        if std::arch::is_x86_feature_detected!("avx2") {
            // SAFETY: as above.
            return unsafe { load_avx2(list, context, batch, start, loads, second) };
        }
    }
    load_batches(list, context, batch, start, loads, second)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl")]
fn load_avx512<const CLUMPS: bool>(
    list: &mut PairList,
    context: &PairContext,
    batch: &mut GrainBatch<CLUMPS>,
    start: usize,
    loads: &mut [GrainLoad],
    second: impl FnMut(usize, GrainLoad, &mut [GrainLoad]),
) -> ContactSums {
    load_batches(list, context, batch, start, loads, second)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn load_avx2<const CLUMPS: bool>(
    list: &mut PairList,
    context: &PairContext,
    batch: &mut GrainBatch<CLUMPS>,
    start: usize,
    loads: &mut [GrainLoad],
    second: impl FnMut(usize, GrainLoad, &mut [GrainLoad]),
) -> ContactSums {
    load_batches(list, context, batch, start, loads, second)
}

#[inline(always)]
fn load_batches<const CLUMPS: bool>(
    list: &mut PairList,
    context: &PairContext,
    batch: &mut GrainBatch<CLUMPS>,
    start: usize,
    loads: &mut [GrainLoad],
    mut second: impl FnMut(usize, GrainLoad, &mut [GrainLoad]),
) -> ContactSums {
    let row = |member: u32| if CLUMPS { member as usize / 2 } else { member as usize };
    list.sort_near(&context.clock, &Spheres::<CLUMPS>(context.grains));
    let mut sums = LaneSums::default();
    let PairList { touching, memory, ended, .. } = list;
    let batches = touching.chunks(LANES).zip(memory.chunks_mut(LANES)).enumerate();
    for (number, (pairs, memory)) in batches {
        for (lane, (pair, memory)) in pairs.iter().zip(&*memory).enumerate() {
            batch.gather(lane, context.grains, *pair);
            batch.old.rows[lane] = memory.quad();
        }
        for lane in pairs.len()..LANES {
            batch.clear(lane);
        }
        batch.evaluate(&context.constants, &mut sums);
        for (lane, ([a, b], memory)) in pairs.iter().zip(memory).enumerate() {
            let [on_first, on_second] = batch.loads(lane);
            *memory = Memory::from_quad(batch.new.rows[lane]);
            loads[row(*a) - start].join(&on_first);
            second(row(*b), on_second, loads);
            if batch.overlap[lane] <= 0.0 {
                ended.push((number * LANES + lane) as u32);
            }
        }
    }
    list.end_contacts();
    sums.total()
}

/// The member spheres of a table of spheres (`CLUMPS` false) or of clumps.
struct Spheres<'a, const CLUMPS: bool>(&'a GrainTable);

impl<const CLUMPS: bool> Separation for Spheres<'_, CLUMPS> {
    #[inline(always)]
    fn of(&self, [first, second]: [u32; 2]) -> (f64, f64) {
        let (a, r1) = centre::<CLUMPS>(self.0, first);
        let (b, r2) = centre::<CLUMPS>(self.0, second);
        let between = add_scaled(b, -1.0, a);
        (dot(between, between), r1 + r2)
    }
}

/// The member spheres of any table.
pub struct Members<'a>(pub &'a GrainTable);

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
fn centre<const CLUMPS: bool>(grains: &GrainTable, member: u32) -> ([f64; 3], f64) {
    let row = if CLUMPS { member as usize / 2 } else { member as usize };
    let place = &grains.place[row].0;
    let centre = [place[0], place[1], place[2]];
    if !CLUMPS {
        return (centre, place[3]);
    }
    let axis = &grains.axis[row].0;
    let length = side(member) * grains.spin[row].0[3];
    (add_scaled(centre, length, [axis[0], axis[1], axis[2]]), place[3])
}
