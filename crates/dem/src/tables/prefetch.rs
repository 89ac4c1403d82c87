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

/// The same for a line that will be written, which other threads may have read meanwhile.
#[inline(always)]
pub fn prefetch_to_write<T>(place: *const T) {
    #[cfg(target_arch = "x86_64")]
    // SAFETY: this reads and writes nothing, whatever the address; processors that have no such instruction pass it over.
    unsafe {
        std::arch::asm!("prefetchw [{}]", in(reg) place, options(nostack, preserves_flags, readonly));
    };
    #[cfg(not(target_arch = "x86_64"))]
    let _ = place;
}
