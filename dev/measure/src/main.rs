//! Measures the GPU backend: see README.md beside this crate's Cargo.toml.
#![expect(clippy::print_stdout, reason = "a program that prints what it measured")]

mod ablation;
mod crossover;
mod groups;
mod orders;
mod timing;

use clap::{Parser, Subcommand};

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Measures the GPU backend on the first adapter with timestamps
#[derive(Debug, Parser)]
#[command(name = "tess-measure")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Compare the device with one CPU thread, for batches of 1 to 4096 patches
    Crossover,
    /// Compare many meshes in one batch with as many batches
    Groups,
    /// Draw the same triangles in several orders
    Orders,
    /// Time each stage with parts of the shaders changed or left out
    Ablation(ablation::Arguments),
}

fn main() -> Result<()> {
    match Arguments::parse().command {
        Command::Crossover => crossover::run(),
        Command::Groups => groups::run(),
        Command::Orders => orders::run(),
        Command::Ablation(arguments) => ablation::run(&arguments),
    }
}
