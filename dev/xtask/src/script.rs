//! Commands implemented as Python scripts.

use crate::command::{self, workspace};
use crate::setup::{self, PYTHON};

/// Generates tables and charts from recorded measurements.
pub(crate) const RECORDS: &str = "benches/records.py";

/// Checks that the recorded measurements are of the present code.
pub(crate) const FRESH: &str = "benches/fresh.py";

/// Takes the measurements.
pub(crate) const MEASURE: &str = "benches/measure.py";

/// Checks of texts.
pub(crate) const CHECKS: &str = "dev/checks.py";

/// Runs a script with these words.
///
/// # Errors
/// The script fails, or Python cannot be installed.
pub(crate) fn run(script: &str, words: &[&str]) -> Result<(), String> {
    setup::provide(&[PYTHON])?;
    command::run(command::python().arg("-BE").arg(workspace().join(script)).args(words))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_see_the_faults_that_they_must() {
        for tests in [
            "benches/records_test.py",
            "dev/checks_test.py",
            "dev/links_test.py",
            "dev/modules_test.py",
            "dev/xtask/src/dist/try_readme_test.py",
            "integrations/mesa/compare_test.py",
        ] {
            assert_eq!(run(tests, &[]), Ok(()), "{tests}");
        }
    }

    #[test]
    fn every_sentence_has_what_sees_a_violation() {
        assert_eq!(run(CHECKS, &["traceability"]), Ok(()), "docs/traceability.md");
    }

    #[test]
    fn every_link_leads_somewhere() {
        assert_eq!(run("dev/links.py", &[]), Ok(()), "links of documents");
    }

    #[test]
    fn modules_import_each_other_in_one_direction() {
        assert_eq!(run("dev/modules.py", &[]), Ok(()), "imports of modules");
    }

    #[test]
    fn every_public_item_has_a_user() {
        assert_eq!(run(CHECKS, &["public"]), Ok(()), "public items");
    }

    #[test]
    fn documents_and_charts_are_those_of_the_records() {
        assert_eq!(
            run(RECORDS, &["check"]),
            Ok(()),
            "`cargo xtask performance` brings them up to date"
        );
    }
}
