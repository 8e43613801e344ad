//! The kernels, compiled once for each CPU level and chosen at run time.

use crate::batch::Batch;
use crate::block::{self, BLOCKS, Block};
use crate::format::{IndexFormat, PointFormat};
use crate::level::Level;
use crate::part::{self, Blocks, PartCounts};
use crate::probe;
use crate::stitch::Stitches;
use alloc::vec::Vec;
use multiversion::multiversion;
use tess_core::{Config, FactorContext, FixedFactor, Parity, Partitioning, SplitOrder};

/// Defines a function that runs `$kernel` at a level: one instance for each, which the level's
/// availability was checked for ([`Level::is_available`] asks for the same instructions).
macro_rules! at_each_level {
    (
        $(#[$doc:meta])*
        fn $name:ident $(<$($type:ident: $bound:ident),*>)? ($($arg:ident: $arg_type:ty),* $(,)?)
            $(-> $result:ty)? = $kernel:path;
    ) => {
        $(#[$doc])*
        pub(crate) fn $name $(<$($type: $bound),*>)? (level: Level, $($arg: $arg_type),*)
            $(-> $result)?
        {
            #[multiversion(targets("x86_64+avx2+bmi1+bmi2+lzcnt+popcnt"))]
            fn avx2 $(<$($type: $bound),*>)? ($($arg: $arg_type),*) $(-> $result)? {
                $kernel($($arg),*)
            }

            #[multiversion(targets(
                "x86_64+avx2+bmi1+bmi2+lzcnt+popcnt+avx512f+avx512bw+avx512cd+avx512dq+avx512vl"
            ))]
            fn avx512 $(<$($type: $bound),*>)? ($($arg: $arg_type),*) $(-> $result)? {
                $kernel($($arg),*)
            }

            match level {
                Level::Baseline => $kernel($($arg),*),
                Level::Avx2 => avx2($($arg),*),
                Level::Avx512 => avx512($($arg),*),
            }
        }
    };
}

at_each_level! {
    /// [`part::count`] at a level.
    fn count(config: Config, batch: &Batch<'_>) -> PartCounts = part::count;
}

at_each_level! {
    /// [`block::process_blocks`] at a level.
    fn process_blocks(
        config: Config,
        batch: &Batch<'_>,
        first: usize,
        blocks: &mut [Block; BLOCKS],
    ) = block::process_blocks;
}

at_each_level! {
    /// [`part::emit_blocks`] at a level.
    fn emit<P: PointFormat, I: IndexFormat>(
        config: Config,
        stitches: &Stitches,
        blocks: Blocks<'_, P, I>,
    ) -> (u32, u32) = part::emit_blocks;
}

at_each_level! {
    /// [`probe::fixed_factors`] at a level.
    fn fixed_factors(
        partitioning: Partitioning,
        values: &[f32],
        factors: &mut [[FixedFactor; 2]],
    ) = probe::fixed_factors_kernel;
}

at_each_level! {
    /// [`probe::contexts`] at a level.
    fn contexts(
        split: SplitOrder,
        parity: Parity,
        factors: &[FixedFactor],
        contexts: &mut [FactorContext],
    ) = probe::contexts_kernel;
}

at_each_level! {
    /// [`probe::locations`] at a level.
    fn locations(contexts: &[FactorContext], locations: &mut Vec<u32>) = probe::locations_kernel;
}
