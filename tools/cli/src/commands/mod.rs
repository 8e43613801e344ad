//! The commands, one folder each.

mod bench;
mod check;
mod coverage;
mod draw;
mod explain;
mod r#gen;
mod merge;
mod mesh;
mod patch;
#[cfg(feature = "probe")]
mod probe;
#[cfg(feature = "shaders")]
mod shaders;
mod verify;

use crate::campaign::Invocation;
use crate::failure::{Exit, Failure};
use clap::Subcommand;
pub(crate) use patch::without_patch_if_cases;

/// The commands of the program.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Patch(patch::PatchCommand),
    Explain(explain::ExplainCommand),
    Draw(draw::DrawCommand),
    Check(check::CheckCommand),
    Coverage(coverage::CoverageCommand),
    Bench(bench::BenchCommand),
    Mesh(mesh::MeshCommand),
    Gen(r#gen::GenCommand),
    Merge(merge::MergeCommand),
    #[cfg(feature = "probe")]
    Probe(probe::ProbeCommand),
    #[cfg(not(feature = "probe"))]
    #[command(hide = true)]
    Probe(LeftOut),
    #[cfg(feature = "shaders")]
    Shaders(shaders::ShadersCommand),
    #[cfg(not(feature = "shaders"))]
    #[command(hide = true)]
    Shaders(LeftOut),
    Verify(verify::VerifyCommand),
}

/// A command that this build leaves out, whatever its arguments.
#[cfg(not(all(feature = "probe", feature = "shaders")))]
#[derive(Debug, clap::Args)]
#[command(disable_help_flag = true)]
pub(crate) struct LeftOut {
    #[arg(allow_hyphen_values = true, trailing_var_arg = true)]
    words: Vec<std::ffi::OsString>,
}

#[cfg(not(all(feature = "probe", feature = "shaders")))]
impl LeftOut {
    /// Names the feature that provides the command; both have the same name.
    fn run(&self, feature: &str) -> Failure {
        let asked =
            self.words.iter().map(|word| format!(" {}", word.display())).collect::<String>();
        Failure::unavailable(format!(
            "this build of tess leaves `{feature}` out, and so `tess {feature}{asked}`: build it with \
             --features {feature}, or without --no-default-features"
        ))
    }
}

/// Runs a command. Errors: those of the command.
pub(crate) fn run(command: &Command, invocation: &Invocation) -> Result<Exit, Failure> {
    match command {
        Command::Patch(args) => patch::run(args),
        Command::Explain(args) => explain::run(args),
        Command::Draw(args) => draw::run(args),
        Command::Check(args) => check::run(args, invocation),
        Command::Coverage(args) => coverage::run(args),
        Command::Bench(args) => bench::run(args),
        Command::Mesh(args) => mesh::run(args),
        Command::Gen(args) => r#gen::run(args, invocation),
        Command::Merge(args) => merge::run(args),
        #[cfg(feature = "probe")]
        Command::Probe(args) => probe::run(args, invocation),
        #[cfg(not(feature = "probe"))]
        Command::Probe(args) => Err(args.run("probe")),
        #[cfg(feature = "shaders")]
        Command::Shaders(args) => shaders::run(args),
        #[cfg(not(feature = "shaders"))]
        Command::Shaders(args) => Err(args.run("shaders")),
        Command::Verify(args) => verify::run(args, invocation),
    }
}
