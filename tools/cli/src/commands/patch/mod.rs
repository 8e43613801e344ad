//! `tess patch`: tessellates one patch.

use crate::args::{PatchArgs, note_large_factors};
use crate::backends::BackendArgs;
use crate::failure::{Exit, Failure};
use crate::formats::{Format, OnePatch};
use crate::output::{OutputArgs, form};

/// Tessellate one patch
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  tess patch quad --outer 3,4,5,6 --inner 4,7
  tess patch tri --outer 2.5,nan,0x40490fdb --inner 3 --partitioning fractional_odd --format json
  tess patch isoline --outer 4,8 -o lines.obj")]
pub(crate) struct Args {
    #[command(flatten)]
    patch: PatchArgs,
    #[command(flatten)]
    backend: BackendArgs,
    /// Form of the result [default: that of the file's name, else text]
    #[arg(long, value_name = "NAME")]
    format: Option<Format>,
    #[command(flatten)]
    output: OutputArgs,
}

/// Runs the command.
///
/// # Errors
/// Wrong number of factors, a backend that is not available, an output that cannot be written.
pub(crate) fn run(args: &Args) -> Result<Exit, Failure> {
    let case = args.patch.case()?;
    let format = form::choose(args.format, &args.output.file)?;
    if format == Format::Png {
        args.output.refuse_terminal("a PNG picture")?;
    }
    note_large_factors(&case);
    let mut backend = args.backend.select()?;
    let patch = OnePatch::tessellate(backend.as_mut(), case)?;
    args.output.write(&format.render(&patch)?)?;
    Ok(Exit::Done)
}
