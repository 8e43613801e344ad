//! The bench of the circuit in Verilator: `rtl/dv/run`, the script that users of the circuit run,
//! builds it.

use crate::tools::{build_folder, output, run, said, sources};
use crate::verdict::BenchVerdict;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use tess_commands::command::{self, cargo, in_file, target};
use tess_verify::Case;

/// The arguments of `cargo` that build the library that benches link. Benches call no batches,
/// whose kernels would take half of the build's time if they were optimised.
const LIBRARY: &str =
    "build --package tess-capi --lib --config profile.dev.package.tess-simd.opt-level=0";

/// The library that benches link, built once.
///
/// # Errors
/// It does not compile.
pub(crate) fn library() -> Result<PathBuf, String> {
    static BUILT: OnceLock<Result<(), String>> = OnceLock::new();
    BUILT.get_or_init(|| command::run(&mut cargo(LIBRARY))).clone()?;
    Ok(target().join("debug/libtess_capi.a"))
}

/// `rtl/dv/run`, which lints the design and builds a bench below this folder.
///
/// # Errors
/// As for [`library`].
pub(crate) fn script(folder: &Path) -> Result<Command, String> {
    let mut script = Command::new(sources().join("dv/run"));
    script.env("TESS_LIBRARY", library()?).env("TESS_VERILOG_BUILD", folder);
    Ok(script)
}

/// The folder of all benches of the circuit.
pub(crate) fn folder() -> PathBuf {
    build_folder().join("rtl")
}

/// The circuit as it is, and with what its parameters add.
#[derive(Clone, Copy)]
pub(crate) enum Variant {
    Plain,
    /// Register stages at the ports (`BUFFERED`), padded AXI4-Stream words (`PADDED`), and tags and
    /// numbered points (`TAG`, `BASE`).
    Buffered,
    /// Two points per clock (`POINTS`).
    Two,
    /// Four, and all of `Buffered`.
    Four,
}

impl Variant {
    pub(crate) fn options(self) -> &'static [&'static str] {
        match self {
            Self::Plain => &[],
            Self::Buffered => &["--buffered"],
            Self::Two => &["--points", "2"],
            Self::Four => &["--buffered", "--points", "4"],
        }
    }

    /// The folder of its bench, below that of all benches.
    pub(crate) fn folder(self) -> &'static str {
        match self {
            Self::Plain => "",
            Self::Buffered => "buffered/bench",
            Self::Two => "points-2/bench",
            Self::Four => "buffered/bench/points-4/bench",
        }
    }
}

/// Lints the design and builds a variant's bench, once.
pub(crate) fn bench(variant: Variant) -> Result<PathBuf, String> {
    static BUILT: [OnceLock<Result<PathBuf, String>>; 4] = [const { OnceLock::new() }; 4];
    BUILT[variant as usize].get_or_init(|| build(variant)).clone()
}

fn build(variant: Variant) -> Result<PathBuf, String> {
    let folder = folder();
    let said = run(script(&folder)?.args(variant.options()).args(["+random=100", "+resets=10"]))?;
    BenchVerdict::read(&said, 100)?;
    Ok(folder.join(variant.folder()).join("Vtb_tess"))
}

/// Writes patches to a file of this name, one a line; the argument that has the bench read it.
///
/// # Errors
/// The file cannot be written.
pub(crate) fn stimuli(name: &str, cases: &[Case]) -> Result<String, String> {
    let mut lines = String::new();
    for case in cases {
        let line = case.to_string();
        // Writing to a String does not fail.
        _ = writeln!(lines, "{}", line.strip_prefix("case ").unwrap_or(&line));
    }
    let file = build_folder().join(format!("rtl-{name}.txt"));
    std::fs::write(&file, lines).map_err(|error| in_file(&file, &error))?;
    Ok(format!("+stimuli={}", file.display()))
}

/// Runs a bench, which must find everything equal in at least `patches` patches; what it counted,
/// and its output.
///
/// # Errors
/// Something differs; the error has the bench's output.
pub(crate) fn compare(
    bench: &Path,
    arguments: &[&str],
    patches: usize,
) -> Result<(BenchVerdict, String), String> {
    let output = output(Command::new(bench).args(arguments))?;
    let said = said(&output);
    match BenchVerdict::read(&said, patches as u64) {
        Ok(verdict) if output.status.success() => Ok((verdict, said)),
        _ => Err(format!("`{}` {}:\n{said}", bench.display(), arguments.join(" "))),
    }
}
