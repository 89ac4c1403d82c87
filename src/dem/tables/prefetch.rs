//! Tells the processor which rows will be wanted soon.

/// Asks for `rows` to be brought near, into the second-level cache. A block's rows are read in the order of its pairs,
/// which the processor cannot foresee; asked for in one go they arrive while others are worked on. Does nothing where the
/// processor has no such instruction, and never changes a result.
pub fn prefetch<T>(rows: &[T]) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T1, _mm_prefetch};
        const LINE: usize = 64;
        let start = rows.as_ptr().cast::<i8>();
        for offset in (0..size_of_val(rows)).step_by(LINE) {
            // SAFETY: the address lies within `rows`; a prefetch reads nothing.
            unsafe { _mm_prefetch::<_MM_HINT_T1>(start.add(offset)) };
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = rows;
}
