//! The kernels, compiled once for each CPU level and chosen at run time.

use crate::at_each_level;
use crate::batch::Batch;
use crate::block::Block;
#[cfg(target_arch = "x86_64")]
use crate::block::BlockPatch;
use crate::chunk::Chunk;
use crate::counts::PartCounts;
use crate::format::{IndexFormat, PointFormat};
use crate::kernel;
use crate::kernel::emit::{Blocks, Caches, Offsets, Room};
use crate::kernel::repeat::Repeat;
use crate::level::Level;
use crate::points::Coordinates;
#[cfg(target_arch = "x86_64")]
use crate::points::{Code, permute};
use crate::setup::Setup;
#[cfg(target_arch = "x86_64")]
use crate::writer::Writer;
use alloc::vec::Vec;
#[cfg(target_arch = "x86_64")]
use multiversion::{multiversion, target::match_target};
use tess_core::{Config, FactorContext, FixedFactor, Parity, Partitioning, SplitOrder};

at_each_level! {
    /// [`kernel::count::count`] at a level.
    fn count(config: Config, batch: &Batch<'_>) -> PartCounts = kernel::count::count;
}

at_each_level! {
    /// [`kernel::count::count_and_keep`] at a level.
    fn count_and_keep(
        config: Config,
        batch: &Batch<'_>,
        kept: &mut [Block; Chunk::BLOCKS],
    ) -> PartCounts = kernel::count::count_and_keep;
}

at_each_level! {
    /// [`kernel::front_end::process`] at a level.
    fn process(
        config: Config,
        batch: &Batch<'_>,
        blocks: &mut [Block; Chunk::BLOCKS],
    ) = kernel::front_end::process;
}

at_each_level! {
    /// [`kernel::emit::emit`] at the levels that have no permutes.
    fn emit_by_lookups<P: PointFormat, I: IndexFormat>(
        setup: &Setup,
        blocks: Blocks<'_>,
        room: Room<'_, P, I>,
        caches: &mut Caches,
    ) -> Offsets = emit_with_lookups;
}

/// [`kernel::emit::emit`] without permutes.
#[inline(always)]
fn emit_with_lookups<P: PointFormat, I: IndexFormat>(
    setup: &Setup,
    blocks: Blocks<'_>,
    room: Room<'_, P, I>,
    caches: &mut Caches,
) -> Offsets {
    kernel::emit::emit(setup, blocks, room, caches, &mut Coordinates::new())
}

/// [`kernel::emit::emit`] at a level.
pub(crate) fn emit<P: PointFormat, I: IndexFormat>(
    level: Level,
    setup: &Setup,
    blocks: Blocks<'_>,
    room: Room<'_, P, I>,
    caches: &mut Caches,
) -> Offsets {
    #[cfg(target_arch = "x86_64")]
    #[multiversion(targets(
        "x86_64+avx2+bmi1+bmi2+lzcnt+popcnt+avx512f+avx512bw+avx512cd+avx512dq+avx512vl"
    ))]
    fn avx512<P: PointFormat, I: IndexFormat>(
        setup: &Setup,
        blocks: Blocks<'_>,
        room: Room<'_, P, I>,
        caches: &mut Caches,
    ) -> Offsets {
        match_target! {
            "x86_64+avx512f+avx512bw+avx512dq+avx512vl" => {
                // Permutes are safe to call here, as this function has their instructions; a closure
                // takes them to where they are needed.
                let permute = |patch: BlockPatch<'_>, codes: &[Code], out: &mut Writer<'_, P>| {
                    permute::emit(patch, codes, out);
                };
                kernel::emit::emit(setup, blocks, room, caches, &mut permute::Permutes(permute))
            }
            // Compiled, but not run: the level is available only where all of these are. It would take the
            // codes of permutes for places (`points::for_level`).
            _ => emit_with_lookups(setup, blocks, room, caches),
        }
    }

    match level {
        #[cfg(target_arch = "x86_64")]
        Level::Avx512 => avx512(setup, blocks, room, caches),
        _ => emit_by_lookups(level, setup, blocks, room, caches),
    }
}

at_each_level! {
    /// [`kernel::repeat::repeat`] at a level.
    fn repeat<P: PointFormat, I: IndexFormat>(
        repeat: Repeat,
        room: Room<'_, P, I>,
    ) -> Offsets = kernel::repeat::repeat;
}

at_each_level! {
    /// [`kernel::probe::fixed_factors`] at a level.
    fn fixed_factors(
        partitioning: Partitioning,
        values: &[f32],
        factors: &mut [[FixedFactor; 2]],
    ) = kernel::probe::fixed_factors;
}

at_each_level! {
    /// [`kernel::probe::contexts`] at a level.
    fn contexts(
        split: SplitOrder,
        parity: Parity,
        factors: &[FixedFactor],
        contexts: &mut [FactorContext],
    ) = kernel::probe::contexts;
}

at_each_level! {
    /// [`kernel::probe::locations`] at a level.
    fn locations(contexts: &[FactorContext], locations: &mut Vec<u32>) = kernel::probe::locations;
}
