//! The checks of this crate: format, lints and tests, most of which read the design and its
//! document.

use tess_commands::command;

/// Checks this crate, as continuous integration checks the product.
///
/// # Errors
/// A file has another format, a lint warns, or a test fails.
pub(crate) fn run() -> Result<(), String> {
    for arguments in ["fmt --check", "clippy --all-targets -- -D warnings", "test --quiet"] {
        let mut cargo = command::cargo(arguments);
        command::run(cargo.current_dir(env!("CARGO_MANIFEST_DIR")))?;
    }
    Ok(())
}
