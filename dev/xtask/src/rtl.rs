//! The circuit in `rtl`, whose rig is a workspace of its own.

use crate::command::{self, workspace};
use crate::setup;
use std::process::Command;

/// Passes these words on to the rig; without words it runs everything that a change of the circuit
/// must pass.
///
/// # Errors
/// The rig fails, which has said why.
pub(crate) fn run(words: &[&str]) -> Result<(), String> {
    let mut rig = Command::new("sh");
    rig.arg("rtl/dv/rig/run").args(setup::option()).args(words);
    command::run(rig.current_dir(workspace()))
}
