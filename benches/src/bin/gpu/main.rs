//! Measures the GPU backend on the first adapter that has timestamps, for `docs/performance.md`,
//! `docs/experiments.md` and `docs/study.md`; `tess bench --backend gpu` is for users.
//!
//! ```text
//! cargo run --release -p tess-benches --features gpu --bin gpu -- crossover
//! cargo run --release -p tess-benches --features gpu --bin gpu -- groups
//! cargo run --release -p tess-benches --features gpu --bin gpu -- evaluated
//! cargo run --release -p tess-benches --features gpu --bin gpu -- first
//! cargo run --release -p tess-benches --features gpu --bin gpu -- study
//! cargo run --release -p tess-benches --features gpu --bin gpu -- ablation benches/edits uniform-16 character
//! ```
//!
//! `ablation` runs workloads of `tess bench` (1 GiB of output) with edited shaders. It reads a list
//! of faults, in which the edits of one name are one variant. Results are compared with the model's
//! digest; most variants are wrong on purpose, and their lines show it. With `--patches 256
//! --repeats 1` the workloads are short batches.
#![expect(clippy::print_stdout, reason = "a program that prints what it measured")]

mod ablation;
mod crossover;
mod digest;
mod evaluated;
mod first;
mod groups;
mod study;
mod timing;

use clap::{Parser, Subcommand};

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Measures the GPU backend on the first adapter with timestamps
#[derive(Debug, Parser)]
#[command(name = "gpu")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Compare the device with one CPU thread, for batches of 1 to 4096 patches
    Crossover,
    /// Compare `Points::Evaluated` with `Points::Stored`, by vertex size, factor, length of
    /// `domain` and passes
    Evaluated,
    /// Time the first frames of a tessellation stage on the host
    First,
    /// Compare many meshes in one batch with as many batches
    Groups,
    /// Time the inputs of the study of 2015, as one patch and as 4096
    Study(study::StudyArguments),
    /// Time each stage with parts of the shaders changed or left out
    Ablation(ablation::AblationArguments),
}

fn main() -> Result<()> {
    match Arguments::parse().command {
        Command::Crossover => crossover::run(),
        Command::Evaluated => evaluated::run(),
        Command::First => first::run(),
        Command::Groups => groups::run(),
        Command::Study(arguments) => study::run(&arguments),
        Command::Ablation(arguments) => ablation::run(&arguments),
    }
}
