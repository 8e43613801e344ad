//! The program `tess`.

use std::process::ExitCode;

fn main() -> ExitCode {
    tess_program::main()
}
