//! `tess patch`: tessellates one patch, or the cases of a file.

use crate::args::{PatchArgs, note_large_factors};
use crate::backends::BackendArgs;
use crate::failure::{Exit, Failure};
use crate::formats::{Format, OnePatch};
use crate::input;
use crate::output::{OutputArgs, Role, form, refuse_shared};
use std::io;
use std::path::{Path, PathBuf};
use tess_verify::Case;
use tess_verify::vectors::{Header, Kind, VectorError};

/// Tessellate one patch, or the cases of a file
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  tess patch quad --outer 3,4,5,6 --inner 4,7
  tess patch tri --outer 2.5,nan,0x40490fdb --inner 3 --partitioning fractional_odd --format json
  tess patch isoline --outer 4,8 -o lines.obj
  tess patch --cases failing.txt -o right.txt
  echo case isoline integer line ruler 40000000 40400000 | tess patch --cases -")]
pub(crate) struct PatchCommand {
    #[command(flatten)]
    patch: Option<PatchArgs>,
    /// Instead of one patch: the cases of a vector file, or lines that begin with `case`; - is
    /// stdin
    #[arg(long, value_name = "FILE", conflicts_with = "PatchArgs")]
    cases: Option<PathBuf>,
    #[command(flatten)]
    backend: BackendArgs,
    /// Format of the result [default: from the file's name, else text]
    #[arg(long, value_name = "NAME")]
    format: Option<Format>,
    #[command(flatten)]
    output: OutputArgs,
}

/// The command, changed so that it needs a patch only if no file of cases is given.
pub(crate) fn without_patch_if_cases(command: clap::Command) -> clap::Command {
    ["domain", "outer"].into_iter().fold(command, |command, name| {
        command.mut_arg(name, |arg| arg.required(false).required_unless_present("cases"))
    })
}

/// Runs the command. Errors: a wrong number of factors; cases that cannot be read; an unavailable
/// backend; an output that cannot be written.
pub(crate) fn run(args: &PatchCommand) -> Result<Exit, Failure> {
    let format = form::choose(args.format, &args.output.file)?;
    let patch = match (&args.cases, &args.patch) {
        (Some(cases), _) => return args.run_cases(cases, format),
        (None, Some(patch)) => patch,
        (None, None) => return Err(Failure::bad_input("give a patch, or --cases FILE")),
    };
    let case = patch.case()?;
    if format == Format::Png {
        args.output.refuse_terminal("a PNG picture")?;
    }
    note_large_factors(&case);
    let mut backend = args.backend.select()?;
    let patch = OnePatch::tessellate(backend.as_mut(), case)?;
    args.output.write(&format.render(&patch)?)?;
    Ok(Exit::Done)
}

impl PatchCommand {
    /// Tessellates the cases one after another into one file of listings. Their number is not known
    /// in advance, so the header has no count, and the file marks its end.
    fn run_cases(&self, path: &Path, format: Format) -> Result<Exit, Failure> {
        if format != Format::Text {
            return Err(Failure::bad_input("--cases writes listings, --format text"));
        }
        refuse_shared(&[Role::input("--cases", path), self.output.role()])?;
        let mut cases = input::cases(path)?;
        let mut backend = self.backend.select()?;
        let source = format!("tess-{}", backend.name());
        let header = Header { kind: Kind::Listings, count: None, source, notes: Vec::new() };
        let mut listing = |case: Result<Case, VectorError>| {
            let case = case.map_err(Failure::bad_input)?;
            OnePatch::tessellate(backend.as_mut(), case).map(|patch| patch.listing)
        };
        let mut failed = None;
        let written = self.output.stream(|out| {
            writeln!(out, "{header}")?;
            for case in &mut cases {
                match listing(case) {
                    Ok(listing) => write!(out, "{listing}")?,
                    Err(failure) => {
                        failed = Some(failure);
                        return Err(io::Error::other("the cases end early"));
                    }
                }
            }
            writeln!(out, "# end")
        });
        failed.map_or(written, Err).map(|()| Exit::Done)
    }
}
