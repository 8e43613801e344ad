//! Debian's piglit: what its tests of tessellation say of a driver's OpenGL.

use super::{Place, Variant, debian};
use crate::command::{self, in_file};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::fs;
use std::process::Command;

/// piglit and what it runs on, save what every Debian with OpenGL has. Without `wflinfo`, of waffle-utils, it skips
/// most tests.
const PACKAGES: &[&str] = &["piglit", "libwaffle-1-0", "waffle-utils", "python3-six"];

/// The tests that are run, and those of them that are not: 1481 that compute built-in functions in both stages, each
/// with the same patch.
const TESTS: &str = "arb_tessellation_shader";
const LEFT_OUT: &str = "built-in-functions";

/// Where Debian's packages have their libraries.
const LIBRARIES: [&str; 2] = ["usr/lib/x86_64-linux-gnu", "usr/lib/x86_64-linux-gnu/piglit/lib"];

/// What each test gave, by its name: `pass`, `fail`, `crash`, `skip`, ...
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Results(BTreeMap<String, String>);

/// piglit's own report.
#[derive(Deserialize)]
struct PiglitReport {
    tests: BTreeMap<String, PiglitTest>,
}

#[derive(Deserialize)]
struct PiglitTest {
    result: String,
}

impl Results {
    pub(super) fn tests(&self) -> usize {
        self.0.len()
    }

    /// How many tests gave this.
    pub(super) fn count(&self, result: &str) -> usize {
        self.0.values().filter(|given| *given == result).count()
    }

    /// The tests that give something else in `other`, or are in one alone.
    pub(super) fn differing<'a>(&'a self, other: &'a Self) -> Vec<&'a str> {
        let names = self.0.keys().chain(other.0.keys().filter(|name| !self.0.contains_key(*name)));
        names.filter(|name| self.0.get(*name) != other.0.get(*name)).map(String::as_str).collect()
    }
}

/// Runs the tests on a variant's llvmpipe, without a window system.
///
/// # Errors
/// piglit cannot be had, or ends without a report; or it skips most tests.
pub(super) fn run(place: &Place, variant: Variant) -> Result<Results, String> {
    let root = place.root.join("piglit");
    if !root.exists() {
        debian::unpack(place, PACKAGES, &root)?;
    }
    let given = place.folder.join("piglit-results").join(variant.name());
    let libraries = LIBRARIES.map(|folder| root.join(folder).display().to_string()).join(":");
    // The system's interpreter has Mako, which Mesa's build needs too.
    let mut piglit = Command::new("/usr/bin/python3");
    piglit.arg(root.join("usr/bin/piglit")).args(["run", "--overwrite", "-l", "dummy"]);
    piglit.args(["-p", "surfaceless_egl", "-b", "json", "-t", TESTS, "-x", LEFT_OUT, "quick"]);
    piglit.arg(&given).envs(place.environment(variant)).env("LD_LIBRARY_PATH", libraries);
    piglit.env("PYTHONPATH", root.join("usr/lib/python3/dist-packages"));
    let path = std::env::var("PATH").unwrap_or_default();
    piglit.env("PATH", format!("{}:{path}", root.join("usr/bin").display()));
    piglit.env("PYTHONDONTWRITEBYTECODE", "1").env("PIGLIT_COMPRESSION", "none");
    command::run(&mut piglit)?;
    let path = given.join("results.json");
    let text = fs::read_to_string(&path).map_err(|error| in_file(&path, &error))?;
    let report: PiglitReport =
        serde_json::from_str(&text).map_err(|error| in_file(&path, &error))?;
    let tests = report.tests.into_iter();
    let results = Results(tests.map(|(name, test)| (name, test.result)).collect());
    if 2 * results.count("skip") > results.tests() {
        return Err(in_file(&path, &"piglit skipped most tests, so it found no driver"));
    }
    Ok(results)
}

#[cfg(test)]
impl Results {
    pub(super) fn of(tests: &[(&str, &str)]) -> Self {
        Self(tests.iter().map(|&(name, given)| (name.into(), given.into())).collect())
    }
}
