//! The CPU levels of `tess-simd` that this machine must be tested at.

/// A list of levels for the tests: they fail if one of them is not compared.
pub(crate) const VARIABLE: &str = "TESS_REQUIRE_LEVELS";

/// The levels that this processor has, found without asking `tess-simd`, which might be wrong.
#[cfg(target_arch = "x86_64")]
pub(crate) fn required() -> Vec<&'static str> {
    let has_avx512 = is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512bw")
        && is_x86_feature_detected!("avx512cd")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl")
        && is_x86_feature_detected!("avx512bitalg")
        && is_x86_feature_detected!("avx512ifma")
        && is_x86_feature_detected!("avx512vbmi")
        && is_x86_feature_detected!("avx512vbmi2")
        && is_x86_feature_detected!("avx512vnni")
        && is_x86_feature_detected!("avx512vpopcntdq")
        && is_x86_feature_detected!("gfni")
        && is_x86_feature_detected!("vaes")
        && is_x86_feature_detected!("vpclmulqdq");
    let levels =
        [("baseline", true), ("avx2", is_x86_feature_detected!("avx2")), ("avx512", has_avx512)];
    levels.into_iter().filter_map(|(name, is_there)| is_there.then_some(name)).collect()
}

/// Processors other than x86-64 have one level.
#[cfg(not(target_arch = "x86_64"))]
pub(crate) fn required() -> Vec<&'static str> {
    vec!["baseline"]
}
