//! Runs a piece of work with the widest vectors this processor has.

#![allow(unsafe_code)]

use std::sync::atomic::{AtomicU8, Ordering};

use crate::simd::eight::Eight;
use crate::simd::plain::Plain;
#[cfg(target_arch = "x86_64")]
use crate::simd::x86::{Avx2, Avx512};

/// Work that can be done with any vectors. `run` and all that it calls must be marked to be inlined always, or the compiler
/// does not use the vectors.
pub trait Work {
    type Output;

    fn run<E: Eight>(self) -> Self::Output;
}

/// Vectors, from the narrowest to the widest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub enum Vectors {
    /// What the compiler makes of plain numbers: on x86-64 those of SSE2.
    Plain,
    Avx2,
    Avx512,
}

/// No wider ones than these are used, as numbers of [`Vectors`].
static LIMIT: AtomicU8 = AtomicU8::new(Vectors::Avx512 as u8);

/// Uses no wider vectors from now on: a benchmark tells with it what the instructions give. The results stay the same.
pub fn limit(vectors: Vectors) {
    LIMIT.store(vectors as u8, Ordering::Relaxed);
}

#[inline(always)]
fn allows(vectors: Vectors) -> bool {
    LIMIT.load(Ordering::Relaxed) >= vectors as u8
}

/// The widest vectors that this processor has, and the limit allows.
#[inline(always)]
pub fn vectors() -> Vectors {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::is_x86_feature_detected as has;
        if allows(Vectors::Avx2) && has!("avx2") {
            let widest = allows(Vectors::Avx512) && has!("avx512f") && has!("avx512vl");
            return if widest { Vectors::Avx512 } else { Vectors::Avx2 };
        }
    }
    Vectors::Plain
}

/// Does the work. The result is the same, bit for bit, with any vectors.
#[inline(always)]
pub fn with_widest<W: Work>(work: W) -> W::Output {
    match vectors() {
        // SAFETY: the processor was just asked for these features.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx512 => unsafe { with_avx512(work) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx2 => unsafe { with_avx2(work) },
        _ => work.run::<Plain>(),
    }
}

/// The vectors that work is done with here, by their name.
pub fn instructions() -> &'static str {
    match vectors() {
        Vectors::Plain => "none",
        Vectors::Avx2 => "AVX2",
        Vectors::Avx512 => "AVX-512",
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx2")]
fn with_avx512<W: Work>(work: W) -> W::Output {
    work.run::<Avx512>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn with_avx2<W: Work>(work: W) -> W::Output {
    work.run::<Avx2>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::eight::Row;
    use crate::simd::quad::Quad;

    /// Does something with every operation.
    struct Everything([Quad; 8]);

    impl Work for Everything {
        type Output = ([Quad; 8], u8);

        #[inline(always)]
        fn run<E: Eight>(self) -> Self::Output {
            let row = |lane: usize| E::Row::load(&self.0[lane]);
            let rows = [row(0), row(1), row(2), row(3), row(4), row(5), row(6), row(7)];
            let [x, y, z, w] = E::columns(rows);
            let (bits, lanes) = ((x - y).above_zero(), (x * y + z).lanes());
            let columns = [
                (x - y) / w + 0.25 + E::default(),
                (y * y).root().or_larger(z),
                -z * 3.0 + E::from_lanes(lanes),
                x.if_above(E::all(f64::NAN), y, w),
            ];
            let turned = E::rows(columns);
            let mut out = [Quad::default(); 8];
            for (lane, row) in turned.into_iter().enumerate() {
                let short = E::Row::widened(&self.0[lane].0.map(|value| value as f32));
                let sum = row + rows[lane] * rows[lane] - short * E::Row::all(0.75);
                sum.with_fourth_of(rows[(lane + 1) % 8]).store(&mut out[lane]);
            }
            (out, bits)
        }
    }

    #[test]
    fn all_vectors_give_the_same_bits() {
        let mut random = fastrand::Rng::with_seed(3);
        for _ in 0..100 {
            let rows = [(); 8].map(|()| Quad([(); 4].map(|()| random.f64() - 0.5)));
            let plain = Everything(rows).run::<Plain>();
            assert_eq!(with_widest(Everything(rows)), plain);
            #[cfg(target_arch = "x86_64")]
            if std::arch::is_x86_feature_detected!("avx2") {
                // SAFETY: the processor was just asked.
                assert_eq!(unsafe { with_avx2(Everything(rows)) }, plain);
            }
        }
    }
}
