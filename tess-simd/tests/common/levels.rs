//! The levels that comparisons run at.

use tess_simd::Level;

/// The levels to compare at: every one of this machine. Set `TESS_REQUIRE_LEVELS` to fail where
/// one is missing; otherwise it is reported.
pub(crate) fn levels() -> Vec<Level> {
    let (available, missing): (Vec<_>, Vec<_>) =
        Level::ALL.into_iter().partition(|level| level.is_available());
    if !missing.is_empty() {
        let required = std::env::var_os("TESS_REQUIRE_LEVELS").is_some();
        assert!(!required, "this machine lacks the levels {missing:?}");
        use std::io::Write as _;
        let _ = writeln!(std::io::stderr(), "NOT COMPARED, not on this machine: {missing:?}");
    }
    available
}
