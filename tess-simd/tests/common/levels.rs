//! The levels that comparisons run at.

use tess_simd::Level;

/// The environment variable that names the levels that must be there.
const VARIABLE: &str = "TESS_REQUIRE_LEVELS";

/// The levels to compare at: every one of this machine. One that it lacks is reported, and fails the
/// test if the environment variable `TESS_REQUIRE_LEVELS` asks for it.
pub(crate) fn levels() -> Vec<Level> {
    let required = std::env::var(VARIABLE).unwrap_or_default();
    let required = required_levels(&required).unwrap_or_else(|error| panic!("{VARIABLE}: {error}"));
    let (available, missing): (Vec<_>, Vec<_>) =
        Level::ALL.into_iter().partition(|level| level.is_available());
    for level in &missing {
        assert!(!required.contains(level), "{VARIABLE} asks for {level}, which is not here");
    }
    if !missing.is_empty() {
        use std::io::Write as _;
        let _ = writeln!(std::io::stderr(), "NOT COMPARED, not on this machine: {missing:?}");
    }
    available
}

/// The levels that a value asks for: `all`, or names with commas between them.
fn required_levels(value: &str) -> Result<Vec<Level>, String> {
    if value == "all" {
        return Ok(Level::ALL.to_vec());
    }
    let names = value.split(',').map(str::trim).filter(|name| !name.is_empty());
    names
        .map(|name| {
            let level = Level::ALL.into_iter().find(|level| level.name() == name);
            level.ok_or_else(|| {
                format!("there is no level {name}; names are {:?}", Level::ALL.map(Level::name))
            })
        })
        .collect()
}

#[test]
fn the_variable_names_levels() {
    let of = |value| required_levels(value);
    assert_eq!(of(""), Ok(vec![]), "not set");
    assert_eq!(of("all"), Ok(Level::ALL.to_vec()), "all");
    assert_eq!(of("avx2, baseline"), Ok(vec![Level::Avx2, Level::Baseline]), "names");
    let error = of("avx2,neon").expect_err("no such level");
    assert!(error.contains("neon") && error.contains("avx512"), "{error}");
}
