//! Who tessellates: the backends that this build has, chosen by `--backend`.
//!
//! One adapter per backend, each an implementation of [`Backend`].

#[cfg(feature = "gpu")]
pub(crate) mod gpu;
pub(crate) mod simd;
#[cfg(test)]
mod tests;

use crate::failure::Failure;
use clap::ValueEnum;
use simd::Simd;
use tess_simd::{Level, LevelUnavailable};
use tess_verify::backend::Backend;
use tess_verify::core_backend::CoreBackend;
use tess_verify::workloads::IndexType;

/// The names that `--backend` takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum BackendName {
    /// The golden model
    Core,
    /// Batches on the CPU, a patch in each lane
    Simd,
    /// Compute shaders
    Gpu,
}

/// The options that choose a backend.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct BackendArgs {
    /// Implementation to run
    #[arg(long, value_name = "NAME", default_value = "core")]
    pub(crate) backend: BackendName,
    /// What it can be told.
    #[command(flatten)]
    pub(crate) options: BackendOptions,
}

/// What a backend can be told.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct BackendOptions {
    /// CPU level of the simd backend (baseline, avx2 or avx512); the best of this machine unless
    /// said
    #[arg(long, value_name = "NAME", value_parser = cpu_level)]
    pub(crate) cpu_level: Option<Level>,
    /// Width of the indices that simd and gpu write: u16 or u32
    #[arg(long, value_name = "TYPE", default_value = "u32", value_parser = index_type)]
    pub(crate) index_type: IndexType,
}

fn index_type(name: &str) -> Result<IndexType, String> {
    match name {
        "u16" => Ok(IndexType::U16),
        "u32" => Ok(IndexType::U32),
        _ => Err("an index type is u16 or u32".to_owned()),
    }
}

fn cpu_level(name: &str) -> Result<Level, String> {
    let known = Level::ALL.into_iter().find(|level| level.name() == name);
    known.ok_or_else(|| "the levels are baseline, avx2 and avx512".to_owned())
}

impl BackendArgs {
    /// Makes the chosen backend ready.
    ///
    /// # Errors
    /// Exit code 2 if it is told what it does not know, 3 if this build or this machine does not have it,
    /// with the next step.
    pub(crate) fn select(&self) -> Result<Box<dyn Backend>, Failure> {
        self.options.level_of(self.backend)?;
        self.select_named(self.backend)
    }

    /// Makes a backend ready that another option names, as these options say.
    ///
    /// # Errors
    /// As for [`Self::select`].
    pub(crate) fn select_named(&self, name: BackendName) -> Result<Box<dyn Backend>, Failure> {
        self.options.select(name)
    }
}

impl BackendOptions {
    /// The CPU level to run a backend at: only the simd backend has any.
    ///
    /// # Errors
    /// Exit code 2 if a level was asked of another backend, 3 if this machine cannot run it.
    pub(crate) fn level_of(self, name: BackendName) -> Result<Level, Failure> {
        match (self.cpu_level, name) {
            (None, _) => Ok(Level::detect()),
            (Some(level), BackendName::Simd) if level.is_available() => Ok(level),
            (Some(level), BackendName::Simd) => Err(unavailable(LevelUnavailable(level))),
            (Some(_), _) => Err(Failure::bad_input("--cpu-level goes with --backend simd")),
        }
    }

    /// Makes a backend ready as these options say.
    ///
    /// # Errors
    /// Exit code 2 if the backend has no indices of that width, 3 if this build or this machine does
    /// not have it, with the next step.
    pub(crate) fn select(self, name: BackendName) -> Result<Box<dyn Backend>, Failure> {
        match name {
            BackendName::Core => {
                self.only_32_bits()?;
                Ok(Box::new(CoreBackend))
            }
            BackendName::Simd => self.simd(),
            #[cfg(feature = "gpu")]
            BackendName::Gpu => Ok(Box::new(gpu::GpuBackend::open(self.index_type)?)),
            #[cfg(not(feature = "gpu"))]
            BackendName::Gpu => Err(not_built_in("gpu")),
        }
    }

    /// Refuses 16-bit indices on behalf of the model, which has none.
    ///
    /// # Errors
    /// Exit code 2 if they are asked for.
    pub(crate) fn only_32_bits(self) -> Result<(), Failure> {
        match self.index_type {
            IndexType::U32 => Ok(()),
            IndexType::U16 => Err(Failure::bad_input(
                "--index-type u16 goes with --backend simd or gpu; core has indices of 32 bits alone",
            )),
        }
    }

    /// The words on a command line that choose this backend in this way.
    #[must_use]
    pub(crate) fn words(self, backend: &str) -> String {
        match self.index_type {
            IndexType::U16 => format!("{backend} --index-type u16"),
            IndexType::U32 => backend.to_owned(),
        }
    }

    fn simd(self) -> Result<Box<dyn Backend>, Failure> {
        let level = self.cpu_level.unwrap_or_else(Level::detect);
        Ok(match self.index_type {
            IndexType::U16 => Box::new(Simd::<u16>::with_level(level).map_err(unavailable)?),
            IndexType::U32 => Box::new(Simd::<u32>::with_level(level).map_err(unavailable)?),
        })
    }
}

fn unavailable(error: LevelUnavailable) -> Failure {
    Failure::unavailable(format!("{error}; leave out --cpu-level for the best"))
}

/// The failure of asking for a backend that this build does not have.
#[cfg(not(feature = "gpu"))]
pub(crate) fn not_built_in(name: &str) -> Failure {
    Failure::unavailable(format!(
        "this build of tess has no {name} backend; --backend core is always there"
    ))
}
