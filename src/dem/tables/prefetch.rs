//! Tells the processor which rows will be wanted soon.

/// Asks for `count` rows from `start` on to be brought near, into the second-level cache. A block's rows are read in the order of its pairs,
/// which the processor cannot foresee; asked for in one go they arrive while others are worked on. Does nothing where the
/// processor has no such instruction. Nothing is read, so it does not matter who else writes there.
pub fn prefetch<T>(start: *const T, count: usize) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T1, _mm_prefetch};
        const LINE: usize = 64;
        let start = start.cast::<i8>();
        for offset in (0..count * size_of::<T>()).step_by(LINE) {
            // SAFETY: a prefetch reads nothing, whatever the address.
            unsafe { _mm_prefetch::<_MM_HINT_T1>(start.wrapping_add(offset)) };
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (start, count);
}
