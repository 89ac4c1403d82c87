//! Which vector instructions this processor has. All of them come with fused multiply-add, which the law is written in: where
//! a processor lacks it the same results come out, slowly.

/// Eight numbers at a time.
#[cfg(target_arch = "x86_64")]
pub fn has_avx512() -> bool {
    std::arch::is_x86_feature_detected!("avx512f") && std::arch::is_x86_feature_detected!("avx512vl") && has_avx2()
}

/// Four numbers at a time.
#[cfg(target_arch = "x86_64")]
pub fn has_avx2() -> bool {
    std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma")
}
