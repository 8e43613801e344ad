//! The implementations that commands run, chosen by `--backend`.
//!
//! Each one has an adapter here that implements the verification kit's [`Backend`].

#[cfg(feature = "gpu")]
pub(crate) mod gpu;
pub(crate) mod simd;
#[cfg(test)]
mod tests;

use crate::args::{Choices, choice};
use crate::failure::Failure;
use crate::threads::start_pool;
use clap::ValueEnum;
use simd::Simd;
use tess_simd::{Level, LevelUnavailableError};
use tess_verify::{Backend, CoreBackend};
use tess_workloads::IndexWidth;

/// The names that `--backend` accepts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum BackendName {
    /// The golden model
    Core,
    /// Batches on the CPU, one patch per lane
    Simd,
    /// Compute shaders
    Gpu,
}

/// The options that select a backend.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct BackendArgs {
    /// Implementation to run
    #[arg(long, value_name = "NAME", default_value = "core")]
    pub(crate) backend: BackendName,
    /// How it runs.
    #[command(flatten)]
    pub(crate) options: BackendOptions,
}

/// How a backend runs.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct BackendOptions {
    /// CPU level of the simd backend: baseline, avx2 or avx512 [default: the best of this machine]
    #[arg(long, value_name = "NAME", value_parser = cpu_level)]
    pub(crate) cpu_level: Option<Level>,
    /// Width of the indices that simd and gpu write
    #[arg(long, value_name = "TYPE", default_value = "u32", value_parser = choice(INDEX_WIDTHS))]
    pub(crate) index_type: IndexWidth,
}

/// The widths of indices.
pub(crate) const INDEX_WIDTHS: Choices<IndexWidth> =
    &[("u16", IndexWidth::U16, "16 bits"), ("u32", IndexWidth::U32, "32 bits")];

fn cpu_level(name: &str) -> Result<Level, String> {
    let known = Level::ALL.into_iter().find(|level| level.name() == name);
    known.ok_or_else(|| "the levels are baseline, avx2 and avx512".to_owned())
}

impl BackendArgs {
    /// Makes the selected backend ready. Errors: exit code 2 if it does not have these options; 3,
    /// with the next step, if this build or this machine does not have it.
    pub(crate) fn select(self) -> Result<Box<dyn Backend>, Failure> {
        self.options.fit(&[self.backend])?;
        self.options.select(self.backend)
    }
}

impl BackendOptions {
    /// Refuses options that none of the backends in use has. Errors: exit code 2 if a CPU level is
    /// given without the simd backend, or 16-bit indices without a backend that supports them.
    pub(crate) fn fit(self, backends: &[BackendName]) -> Result<(), Failure> {
        let has = |name: BackendName| backends.contains(&name);
        if self.cpu_level.is_some() && !has(BackendName::Simd) {
            return Err(Failure::bad_input("--cpu-level goes with --backend simd"));
        }
        if self.index_type == IndexWidth::U16 && !has(BackendName::Simd) && !has(BackendName::Gpu) {
            return Err(Failure::bad_input(
                "--index-type u16 goes with --backend simd or gpu; core only has 32-bit indices",
            ));
        }
        Ok(())
    }

    /// The CPU level at which to run the simd backend. Errors: exit code 3 if this machine cannot
    /// run the requested one.
    pub(crate) fn level(self) -> Result<Level, Failure> {
        let level = self.cpu_level.unwrap_or_else(Level::detect);
        level.require().map_err(unavailable)?;
        Ok(level)
    }

    /// Makes a backend ready with those of the options that apply to it. Errors: exit code 3, with
    /// the next step, if this build or this machine does not have it.
    pub(crate) fn select(self, name: BackendName) -> Result<Box<dyn Backend>, Failure> {
        match name {
            BackendName::Core => Ok(Box::new(CoreBackend)),
            BackendName::Simd => self.simd(),
            #[cfg(feature = "gpu")]
            BackendName::Gpu => Ok(Box::new(gpu::GpuBackend::open(self.index_type)?)),
            #[cfg(not(feature = "gpu"))]
            BackendName::Gpu => Err(not_built_in("gpu")),
        }
    }

    /// The words on a command line that select this backend with these options.
    pub(crate) fn words(self, backend: &str) -> String {
        match self.index_type {
            IndexWidth::U16 => format!("{backend} --index-type u16"),
            IndexWidth::U32 => backend.to_owned(),
        }
    }

    fn simd(self) -> Result<Box<dyn Backend>, Failure> {
        let level = self.level()?;
        start_pool();
        Ok(match self.index_type {
            IndexWidth::U16 => Box::new(Simd::<u16>::with_level(level).map_err(unavailable)?),
            IndexWidth::U32 => Box::new(Simd::<u32>::with_level(level).map_err(unavailable)?),
        })
    }
}

fn unavailable(error: LevelUnavailableError) -> Failure {
    Failure::unavailable(format!("{error}; leave out --cpu-level for the best"))
}

/// The failure for a backend that this build does not have.
#[cfg(not(feature = "gpu"))]
pub(crate) fn not_built_in(name: &str) -> Failure {
    Failure::unavailable(format!(
        "this build of tess has no {name} backend: build it with --features {name}, or use --backend \
         core instead"
    ))
}
