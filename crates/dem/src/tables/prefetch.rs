//! Tells the processor what will be wanted soon.

#![allow(unsafe_code)]

/// Asks for the line at `place` to be brought near, into the second-level cache. Nothing is read, so the address may be any
/// and it does not matter who else writes there. Does nothing where the processor has no such instruction.
#[inline(always)]
pub fn prefetch<T>(place: *const T) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T1, _mm_prefetch};
        // SAFETY: a prefetch reads nothing, whatever the address.
        unsafe { _mm_prefetch::<_MM_HINT_T1>(place.cast::<i8>()) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = place;
}
