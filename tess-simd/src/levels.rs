//! The kernels, compiled once for each CPU level and chosen at run time.

use crate::data::batch::Batch;
use crate::data::chunk::{Chunk, Stretch};
use crate::data::format::IndexFormat;
use crate::data::point_writer::PointWriter;
use crate::data::ranges::Ranges;
use crate::kernels;
use crate::kernels::emit::{Caches, Offsets, OneWriters, Packets};
use crate::kernels::repeat::Repeat;
use crate::stages::counts::PartCounts;
#[cfg(target_arch = "x86_64")]
use crate::stages::packet::PacketPatch;
use crate::stages::packet::{OnePatch, Packet, RawPair};
use crate::stages::points::Lookup;
#[cfg(target_arch = "x86_64")]
use crate::stages::points::{Code, permute, permute::Permutes};
use crate::stages::settings::Settings;
use tess_core::{Config, Counts, Domain};
use tess_level::at_each_level;
#[cfg(target_arch = "x86_64")]
use tess_level::with_avx512;
use wide::i32x8;

at_each_level! {
    /// [`kernels::front_end::count`] at a level.
    fn count(config: Config, batch: &Batch<'_>) -> PartCounts = kernels::front_end::count::<i32>,
        baseline = kernels::front_end::count::<i32x8>;
}

at_each_level! {
    /// [`kernels::front_end::count_and_keep`] at a level.
    fn count_and_keep(
        config: Config,
        batch: &Batch<'_>,
        kept: &mut [Packet; Chunk::PACKETS],
    ) -> Option<PartCounts> = kernels::front_end::count_and_keep::<i32>,
        baseline = kernels::front_end::count_and_keep::<i32x8>;
}

at_each_level! {
    /// [`kernels::front_end::process`] at a level.
    fn process(
        config: Config,
        batch: &Batch<'_>,
        packets: &mut [Packet; Chunk::PACKETS],
    ) = kernels::front_end::process::<i32>,
        baseline = kernels::front_end::process::<i32x8>;
}

at_each_level! {
    /// [`Stretch::new`] at a level.
    fn stretch(batch: &Batch<'_>, start: usize) -> Stretch = Stretch::new;
}

at_each_level! {
    /// [`OnePatch::process`] at a level.
    fn process_one(
        one: &mut OnePatch,
        config: Config,
        domain: Domain,
        a: RawPair,
        b: RawPair,
        c: RawPair,
    ) -> Counts = OnePatch::process;
}

at_each_level! {
    /// [`kernels::emit::emit`] at a level. Points of compact patches are made by permutes if the
    /// level has them, otherwise by look-up.
    fn emit<W: PointWriter, I: IndexFormat>(
        settings: &Settings,
        packets: Packets<'_>,
        room: (W, &mut [I]),
        caches: &mut Caches,
        lookup: &mut Lookup,
    ) -> Offsets = kernels::emit::emit, avx512 = emit_by_permutes;
}

at_each_level! {
    /// [`kernels::emit::emit_one`] at a level, points as in [`emit`].
    fn emit_one<W: PointWriter, I: IndexFormat>(
        to: &mut OneWriters<'_, W, I>,
        a: RawPair,
        b: RawPair,
        c: RawPair,
        lookup: &mut Lookup,
    ) -> bool = kernels::emit::emit_one, avx512 = emit_one_by_permutes;
}

#[cfg(target_arch = "x86_64")]
with_avx512! {
    fn emit_by_permutes<W: PointWriter, I: IndexFormat>(
        settings: &Settings,
        packets: Packets<'_>,
        room: (W, &mut [I]),
        caches: &mut Caches,
        _: &mut Lookup,
    ) -> Offsets {
        // A closure gets the instructions of the enclosing function; a trait method cannot.
        let permute = |patch: PacketPatch<'_>, codes: &[Code], out: &mut W| {
            permute::emit(patch, codes, out);
        };
        kernels::emit::emit(settings, packets, room, caches, &mut Permutes(permute))
    }

    fn emit_one_by_permutes<W: PointWriter, I: IndexFormat>(
        to: &mut OneWriters<'_, W, I>,
        a: RawPair,
        b: RawPair,
        c: RawPair,
        _: &mut Lookup,
    ) -> bool {
        let permute = |patch: PacketPatch<'_>, codes: &[Code], out: &mut W| {
            permute::emit(patch, codes, out);
        };
        kernels::emit::emit_one(to, a, b, c, &mut Permutes(permute))
    }
}

at_each_level! {
    /// [`kernels::repeat::repeat`] at a level.
    fn repeat<W: PointWriter, I: IndexFormat>(
        repeat: Repeat,
        room: (W, &mut [I]),
        ranges: &mut Ranges<'_>,
    ) -> Offsets = kernels::repeat::repeat;
}

/// The stage taps.
#[cfg(feature = "taps")]
pub(crate) use taps::{contexts, fixed_factors, locations};

#[cfg(feature = "taps")]
mod taps {
    use crate::kernels;
    use alloc::vec::Vec;
    use tess_core::{FactorContext, FixedFactor, Parity, Partitioning, SplitOrder};
    use tess_level::at_each_level;

    at_each_level! {
        /// [`kernels::taps::fixed_factors`] at a level.
        fn fixed_factors(
            partitioning: Partitioning,
            values: &[f32],
            factors: &mut [[FixedFactor; 2]],
        ) = kernels::taps::fixed_factors;
    }

    at_each_level! {
        /// [`kernels::taps::contexts`] at a level.
        fn contexts(
            split: SplitOrder,
            parity: Parity,
            factors: &[FixedFactor],
            contexts: &mut [FactorContext],
        ) = kernels::taps::contexts;
    }

    at_each_level! {
        /// [`kernels::taps::locations`] at a level.
        fn locations(
            contexts: &[FactorContext],
            locations: &mut Vec<u32>,
        ) = kernels::taps::locations;
    }
}

/// The kernel taps.
#[cfg(all(feature = "taps", feature = "apart"))]
pub(crate) use alone::{compact_points, of_indices, of_numbers, of_patches, of_points};

#[cfg(all(feature = "taps", feature = "apart"))]
mod alone {
    use crate::data::format::IndexFormat;
    use crate::data::point_writer::PointWriter;
    use crate::kernels::kernel_taps::{self, Kernel, TapInput, TapOutput};
    use tess_level::at_each_level;

    at_each_level! {
        /// [`kernel_taps::of_numbers`] at a level.
        fn of_numbers(
            kernel: Kernel,
            work: &TapInput,
            made: &mut TapOutput,
        ) -> bool = kernel_taps::of_numbers;
    }

    at_each_level! {
        /// [`kernel_taps::of_patches`] at a level.
        fn of_patches(
            kernel: Kernel,
            work: &TapInput,
            made: &mut TapOutput,
        ) -> bool = kernel_taps::of_patches;
    }

    at_each_level! {
        /// Points of compact patches, made as in [`super::emit`].
        fn compact_points(work: &TapInput, made: &mut TapOutput) = kernel_taps::compact_by_lookup,
            avx512 = kernel_taps::compact_by_permutes;
    }

    at_each_level! {
        /// [`kernel_taps::of_points`] at a level.
        fn of_points<W: PointWriter>(work: &TapInput, out: W) = kernel_taps::of_points;
    }

    at_each_level! {
        /// [`kernel_taps::of_indices`] at a level.
        fn of_indices<I: IndexFormat>(work: &TapInput, indices: &mut [I]) = kernel_taps::of_indices;
    }
}
