//! Who tessellates: the backends that this build has, chosen by `--backend`.
//!
//! One adapter per backend, each an implementation of [`Backend`].

#[cfg(feature = "gpu")]
pub mod gpu;

pub mod simd;

use crate::failure::Failure;
use clap::ValueEnum;
use tess_check::backend::Backend;
use tess_check::core_backend::CoreBackend;

/// The names that `--backend` takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum BackendName {
    /// The golden model
    Core,
    /// Batches on the CPU, 8 patches per vector
    Simd,
    /// Compute shaders
    Gpu,
}

/// The options that choose a backend.
#[derive(Clone, Debug, clap::Args)]
pub struct BackendArgs {
    /// Implementation to run
    #[arg(long, value_name = "NAME", default_value = "core")]
    pub backend: BackendName,
}

impl BackendArgs {
    /// A backend with no further options.
    #[must_use]
    pub const fn named(backend: BackendName) -> Self {
        Self { backend }
    }

    /// Makes the chosen backend ready.
    ///
    /// # Errors
    /// Exit code 3 if this build or this machine does not have it, with the next step.
    pub fn select(&self) -> Result<Box<dyn Backend>, Failure> {
        self.select_named(self.backend)
    }

    /// Makes a backend ready that another option names, as these options say.
    ///
    /// # Errors
    /// As for [`Self::select`].
    pub fn select_named(&self, name: BackendName) -> Result<Box<dyn Backend>, Failure> {
        match name {
            BackendName::Core => Ok(Box::new(CoreBackend)),
            BackendName::Simd => Ok(Box::new(simd::Simd::new())),
            #[cfg(feature = "gpu")]
            BackendName::Gpu => Ok(Box::new(gpu::GpuBackend::open()?)),
            #[cfg(not(feature = "gpu"))]
            BackendName::Gpu => Err(not_built_in("gpu")),
        }
    }
}

/// The failure of asking for a backend that this build does not have.
#[cfg(not(feature = "gpu"))]
pub(crate) fn not_built_in(name: &str) -> Failure {
    Failure::unavailable(format!(
        "this build of tess has no {name} backend; --backend core is always there"
    ))
}
