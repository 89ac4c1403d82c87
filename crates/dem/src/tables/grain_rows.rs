//! Sight of the grain table, also while some of its rows are being moved.

#![allow(unsafe_code)]

use std::marker::PhantomData;
use std::ops::Range;

use crate::Vec3;
use crate::simd::quad::Quad;
use crate::tables::grain_table::{GrainLoad, GrainTable, side};
use crate::tables::grains::GrainShape;
use crate::tables::moving_rows::{Drifting, MovingRows};
use crate::tables::prefetch::prefetch;

/// The rows of a grain table, to be read one by one.
#[derive(Clone, Copy)]
pub struct GrainRows<'a> {
    pub shape: GrainShape,
    len: usize,
    /// Rows of the tables that only clumps have.
    clumps: usize,
    place: *const Quad,
    motion: *const Quad,
    spin: *const Quad,
    axis: *const Quad,
    /// Rows of the angular momenta, which copies need not have.
    momenta: usize,
    momentum: *const Quad,
    table: PhantomData<&'a GrainTable>,
}

// SAFETY: it only reads, by value; what is written at the same time is other rows (see `RowsInMotion::take`).
unsafe impl Send for GrainRows<'_> {}
// SAFETY: as above.
unsafe impl Sync for GrainRows<'_> {}

/// Rows of a table in one line of the cache.
const ROWS_IN_LINE: usize = 64 / size_of::<Quad>();

/// One member sphere of a grain, now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// Centre (m).
    pub centre: Vec3,
    /// m
    pub radius: f64,
    /// Velocity of the centre (m/s).
    pub velocity: Vec3,
    /// Angular velocity of the grain (rad/s).
    pub spin: Vec3,
    /// 1/mass of the whole grain (1/kg).
    pub inverse_mass: f64,
    /// From the grain's centre of mass to the member's centre (m).
    pub arm: Vec3,
}

impl Member {
    /// Velocity of the centre half a step before its arm was as it is (m/s).
    #[inline(always)]
    pub fn velocity_before(&self, half_step: f64) -> Vec3 {
        self.velocity - self.spin.cross(&self.spin.cross(&self.arm)) * half_step
    }
}

impl<'a> GrainRows<'a> {
    #[inline(always)]
    pub fn of(table: &'a GrainTable) -> Self {
        let len = table.place.len().min(table.motion.len()).min(table.spin.len());
        Self {
            shape: table.shape,
            len,
            clumps: table.axis.len().min(len),
            place: table.place.as_ptr(),
            motion: table.motion.as_ptr(),
            spin: table.spin.as_ptr(),
            axis: table.axis.as_ptr(),
            momenta: table.momentum.len().min(len),
            momentum: table.momentum.as_ptr(),
            table: PhantomData,
        }
    }

    /// Number of grains.
    pub fn len(&self) -> usize {
        self.len
    }

    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Centre of mass (m); radius of each member sphere (m).
    #[inline(always)]
    pub fn place(&self, row: usize) -> Quad {
        assert!(row < self.len);
        // SAFETY: the row is one of the table's, which is borrowed for 'a.
        unsafe { *self.place.add(row) }
    }

    /// Velocity of the centre (m/s); 1/mass (1/kg).
    #[inline(always)]
    pub fn motion(&self, row: usize) -> Quad {
        assert!(row < self.len);
        // SAFETY: as in `place`.
        unsafe { *self.motion.add(row) }
    }

    /// Angular velocity (rad/s); for spheres 1/I (1/(kg m²)), for clumps the distance of each member centre from the
    /// centre of mass (m).
    #[inline(always)]
    pub fn spin(&self, row: usize) -> Quad {
        assert!(row < self.len);
        // SAFETY: as in `place`.
        unsafe { *self.spin.add(row) }
    }

    /// Clumps only: unit vector along the member centres; 1/I across it.
    #[inline(always)]
    pub fn axis(&self, row: usize) -> Quad {
        assert!(row < self.clumps);
        // SAFETY: as in `place`.
        unsafe { *self.axis.add(row) }
    }

    /// Clumps only: angular momentum (kg m²/s); 1/I about the axis less 1/I across it.
    pub fn momentum(&self, row: usize) -> Quad {
        assert!(row < self.momenta);
        // SAFETY: as in `place`.
        unsafe { *self.momentum.add(row) }
    }

    /// Asks for the given rows to be brought near.
    #[inline(always)]
    fn prefetch_rows(&self, rows: Range<usize>) {
        for row in rows.step_by(ROWS_IN_LINE) {
            for table in [self.place, self.motion, self.spin] {
                prefetch(table.wrapping_add(row));
            }
            if self.clumps > 0 {
                prefetch(self.axis.wrapping_add(row));
            }
        }
    }

    /// Centre (m) and radius (m) of member sphere `index`.
    #[inline(always)]
    pub fn sphere(&self, index: usize) -> (Vec3, f64) {
        let place = self.place(index / self.shape.members());
        (place.vector() + self.arm(index), place.fourth())
    }

    /// From the grain's centre to the centre of member `index` (m).
    #[inline(always)]
    pub fn arm(&self, index: usize) -> Vec3 {
        match self.shape {
            GrainShape::Sphere => Vec3::zeros(),
            GrainShape::Clump => self.axis(index / 2).vector() * (side(index as u32) * self.spin(index / 2).fourth()),
        }
    }

    #[inline(always)]
    pub fn member(&self, index: usize) -> Member {
        let row = index / self.shape.members();
        let (place, motion, spin) = (self.place(row), self.motion(row), self.spin(row).vector());
        let arm = self.arm(index);
        Member {
            centre: place.vector() + arm,
            radius: place.fourth(),
            velocity: motion.vector() + spin.cross(&arm),
            spin,
            inverse_mass: motion.fourth(),
            arm,
        }
    }
}

impl GrainTable {
    /// Its rows, to be read.
    #[inline(always)]
    pub fn rows(&self) -> GrainRows<'_> {
        GrainRows::of(self)
    }
}

/// Rows that will be wanted next, asked for little by little while other work goes on: all at once they would hold it up.
pub struct Prefetcher<'a> {
    rows: GrainRows<'a>,
    left: Range<usize>,
    /// Rows at a time.
    portion: usize,
}

impl<'a> Prefetcher<'a> {
    /// Asks for the rows of `wanted`, as far as there are such, in the given number of portions.
    pub fn of(rows: GrainRows<'a>, wanted: &Range<usize>, portions: usize) -> Self {
        let left = wanted.start.min(rows.len)..wanted.end.min(rows.len);
        let portion = left.len().div_ceil(portions.max(1)).next_multiple_of(ROWS_IN_LINE);
        Self { rows, left, portion }
    }

    /// Asks for nothing.
    pub fn none(rows: GrainRows<'a>) -> Self {
        Self { rows, left: 0..0, portion: 0 }
    }

    /// Asks for the next portion.
    #[inline(always)]
    pub fn go_on(&mut self) {
        let end = (self.left.start + self.portion).min(self.left.end);
        self.rows.prefetch_rows(self.left.start..end);
        self.left.start = end;
    }
}

/// The rows of a grain table of which some are moved while others are read.
pub struct RowsInMotion<'a> {
    seen: GrainRows<'a>,
    place: *mut Quad,
    motion: *mut Quad,
    spin: *mut Quad,
    axis: *mut Quad,
    momentum: *mut Quad,
    drift: &'a [Drifting],
}

// SAFETY: rows are handed out by `take` alone, whose caller sees to it that nobody else looks at them.
unsafe impl Sync for RowsInMotion<'_> {}

impl<'a> RowsInMotion<'a> {
    /// `drift` has one entry for each row.
    pub fn of(table: &'a mut GrainTable, drift: &'a [Drifting]) -> Self {
        let (place, motion, spin) = (table.place.as_mut_ptr(), table.motion.as_mut_ptr(), table.spin.as_mut_ptr());
        let (axis, momentum) = (table.axis.as_mut_ptr(), table.momentum.as_mut_ptr());
        let len = table.place.len().min(table.motion.len()).min(table.spin.len());
        let clumps = table.axis.len().min(table.momentum.len()).min(len);
        let momenta = table.momentum.len().min(len);
        let shape = table.shape;
        let seen = GrainRows { shape, len, clumps, place, motion, spin, axis, momenta, momentum, table: PhantomData };
        Self { seen, place, motion, spin, axis, momentum, drift }
    }

    /// The rows to be read.
    pub fn seen(&self) -> GrainRows<'a> {
        self.seen
    }

    /// The rows of `range`, to be moved under `loads`.
    ///
    /// # Safety
    /// While the result lives nobody else may read or take any of these rows.
    pub unsafe fn take<'b>(&'b self, range: &Range<usize>, loads: &'b mut [GrainLoad]) -> MovingRows<'b> {
        assert!(range.start <= range.end && range.end <= self.seen.len);
        let cut = |table: *mut Quad, rows: &Range<usize>| {
            // SAFETY: the rows are the table's, and the caller vouches that they are nobody else's now.
            unsafe { std::slice::from_raw_parts_mut(table.add(rows.start), rows.len()) }
        };
        let clumps = if self.seen.clumps == self.seen.len { range.clone() } else { 0..0 };
        MovingRows {
            place: cut(self.place, range),
            motion: cut(self.motion, range),
            spin: cut(self.spin, range),
            axis: cut(self.axis, &clumps),
            momentum: cut(self.momentum, &clumps),
            loads,
            drift: &self.drift[range.clone()],
        }
    }
}
