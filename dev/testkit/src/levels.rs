//! The CPU levels at which comparisons run.

use tess_level::Level;

/// The environment variable that names the required levels.
const VARIABLE: &str = "TESS_REQUIRE_LEVELS";

/// The levels to compare at: all of this machine's. A level that it lacks is reported, and fails
/// the test if the environment variable `TESS_REQUIRE_LEVELS` asks for it.
///
/// # Panics
/// The variable asks for a level that this machine lacks, or names no level.
#[must_use]
pub fn levels() -> Vec<Level> {
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
///
/// # Errors
/// A name that no level has.
pub fn required_levels(value: &str) -> Result<Vec<Level>, String> {
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
