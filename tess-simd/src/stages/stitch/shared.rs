//! Stitch tables that tessellators share, because they depend only on the configuration.
//!
//! With the standard library, each configuration's tables are made once per process, by the first
//! tessellator that needs them. Without it, safe code has no way to wait for another thread's
//! tables, so a tessellator makes its own and shares them with its clones.

use super::Stitches;
use core::ops::Deref;
use tess_core::Config;

/// The stitch tables of a configuration.
#[derive(Clone, Debug)]
pub(crate) struct SharedStitches(Tables);

#[cfg(feature = "std")]
type Tables = &'static Stitches;
#[cfg(not(feature = "std"))]
type Tables = alloc::sync::Arc<Stitches>;

impl SharedStitches {
    /// The tables of a configuration, made if they do not exist yet.
    #[cfg(feature = "std")]
    pub(crate) fn of(config: Config) -> Self {
        use std::sync::OnceLock;
        use tess_core::{OutputPrimitive, Partitioning, SplitOrder};
        const SPACINGS: usize = 3;
        const WINDINGS: usize = 3;
        static ALL: [OnceLock<Stitches>; 2 * SPACINGS * WINDINGS] = [const { OnceLock::new() }; _];
        let spacing = match config.partitioning {
            Partitioning::Integer | Partitioning::Pow2 => 0,
            Partitioning::FractionalOdd => 1,
            Partitioning::FractionalEven => 2,
        };
        let winding = match config.output {
            OutputPrimitive::Point | OutputPrimitive::Line => 0,
            OutputPrimitive::TriangleCw => 1,
            OutputPrimitive::TriangleCcw => 2,
        };
        let split = match config.split {
            SplitOrder::Ruler => 0,
            SplitOrder::Centre => 1,
        };
        let number = (split * SPACINGS + spacing) * WINDINGS + winding;
        Self(ALL[number].get_or_init(|| Stitches::new(config)))
    }

    /// The tables of a configuration.
    #[cfg(not(feature = "std"))]
    pub(crate) fn of(config: Config) -> Self {
        Self(alloc::sync::Arc::new(Stitches::new(config)))
    }

    /// Bytes of the tables and their reference counts if they belong to this tessellator and its
    /// clones; 0 if they belong to the process.
    pub(crate) fn bytes(&self) -> usize {
        const COUNTERS: usize = 2 * size_of::<usize>();
        if cfg!(feature = "std") { 0 } else { COUNTERS + self.0.bytes() }
    }
}

impl Deref for SharedStitches {
    type Target = Stitches;

    #[cfg(feature = "std")]
    #[inline(always)]
    fn deref(&self) -> &Stitches {
        self.0
    }

    #[cfg(not(feature = "std"))]
    #[inline(always)]
    fn deref(&self) -> &Stitches {
        &self.0
    }
}
