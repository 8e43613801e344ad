//! The CPU levels that this machine must be tested at.

/// The variable with the levels that tests must compare; they fail if one is not compared.
pub(crate) const VARIABLE: &str = "TESS_REQUIRE_LEVELS";

/// Every level, by its name in `tess-level`.
const ALL: [&str; 3] = ["baseline", "avx2", "avx512"];

/// The levels of this processor, detected without `tess-level`, which might be wrong.
#[cfg(target_arch = "x86_64")]
pub(crate) fn required() -> Vec<&'static str> {
    macro_rules! has {
        ($($feature:tt)*) => { $(is_x86_feature_detected!($feature))&&* };
    }
    let has_avx512 = has!(
        "avx512f" "avx512bw" "avx512cd" "avx512dq" "avx512vl" "avx512bitalg" "avx512ifma" "avx512vbmi" "avx512vbmi2"
        "avx512vnni" "avx512vpopcntdq" "gfni" "vaes" "vpclmulqdq"
    );
    let there = [true, has!("avx2"), has_avx512];
    ALL.into_iter().zip(there).filter_map(|(name, is_there)| is_there.then_some(name)).collect()
}

/// Processors other than x86-64 have one level.
#[cfg(not(target_arch = "x86_64"))]
pub(crate) fn required() -> Vec<&'static str> {
    vec!["baseline"]
}

/// A sentence about the levels that tests cannot compare on this processor; `None` if there are
/// none.
pub(crate) fn not_compared() -> Option<String> {
    sentence(&required())
}

/// The sentence if only these levels exist.
fn sentence(there: &[&str]) -> Option<String> {
    let missing: Vec<_> = ALL.into_iter().filter(|name| !there.contains(name)).collect();
    let names = missing.join(" and ");
    (!missing.is_empty())
        .then(|| format!("NOT COMPARED: tess-simd at {names}, which this processor lacks"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_is_said() {
        let says = |there: &[&str]| sentence(there).unwrap_or_default();
        assert_eq!(says(&ALL), "", "everything is there");
        let one = "NOT COMPARED: tess-simd at avx512, which this processor lacks";
        assert_eq!(says(&ALL[..2]), one, "one level is missing");
        let two = "NOT COMPARED: tess-simd at avx2 and avx512, which this processor lacks";
        assert_eq!(says(&ALL[..1]), two, "two are");
        let missing = ALL.len() - required().len();
        assert_eq!(not_compared().is_some(), missing > 0, "{missing} are missing here");
    }
}
