//! Single stages and kernels over many inputs, for [`crate::KernelTap`].

mod numbers;
mod patches;
mod writers;

pub(crate) use numbers::of_numbers;
#[cfg(target_arch = "x86_64")]
pub(crate) use patches::compact_by_permutes;
pub(crate) use patches::{compact_by_lookup, of_patches};
pub(crate) use writers::{of_indices, of_points};

use crate::data::lanes::{Column, LANES};
use crate::data::output::PatchRange;
use crate::stages::counts::PacketCounts;
use crate::stages::factors::Processed;
use crate::stages::packet::{Packet, PacketPatch, ROWS};
use crate::stages::points::{Code, LocationTables, Lookup};
use crate::stages::settings::Settings;
use crate::stages::template::Templates;
use alloc::vec::Vec;
use tess_core::{Domain, DomainPoint, FactorContext, Parity, PatchFactors};

macro_rules! kernels {
    ($($name:ident),* $(,)?) => {
        /// The stages and kernels that a [`crate::KernelTap`] runs, each named after its file.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[expect(missing_docs, reason = "the table of `tests/kernels` says what each takes and gives")]
        pub enum Kernel {
            $($name),*
        }

        impl Kernel {
            /// All of them.
            pub const ALL: &[Self] = &[$(Self::$name),*];
        }
    };
}
kernels!(
    Reciprocal,
    Clamp,
    Ceil,
    ToFixed,
    PointCount,
    Context,
    Place,
    PlaceInHalf,
    Factors,
    FactorsByEight,
    FactorsOfOne,
    Counts,
    CountsByEight,
    Packet,
    PacketByEight,
    PacketOfOne,
    Tables,
    Points,
    Codes,
    CompactTemplate,
    CompactPoints,
    Template,
    Stitches,
    RowsU16,
    RowsU32,
    ConnectU16,
    ConnectU32,
    ConnectInColumns,
    Float,
    WritePoints,
    WriteIndices,
    Process,
    Count,
    CountAndKeep,
    ProcessOne,
    Emit,
    EmitOne,
    Repeat,
);

/// The data that taps read: [`crate::Input`], and the output of the preceding stages.
#[derive(Debug)]
pub(crate) struct TapInput {
    pub(crate) settings: Settings,
    pub(crate) parity: Parity,
    pub(crate) numbers: Vec<u32>,
    pub(crate) contexts: Vec<FactorContext>,
    pub(crate) domain: Domain,
    pub(crate) patches: Vec<PatchFactors>,
    pub(crate) raw: Vec<Column<f32>>,
    pub(crate) packets: Vec<Packet>,
    pub(crate) base: u32,
}

impl TapInput {
    /// The patches that are not culled.
    #[inline(always)]
    fn patches(&self) -> impl Iterator<Item = PacketPatch<'_>> {
        let lanes = self.packets.iter().flat_map(|packet| (0..LANES).map(|i| packet.patch(i)));
        lanes.filter(|patch| patch.points() != 0)
    }
}

/// The output of taps, and the tables that they keep between patches.
#[derive(Debug)]
pub(crate) struct TapOutput {
    pub(crate) words: Vec<u32>,
    pub(crate) processed: Vec<Processed>,
    pub(crate) ones: Vec<Processed<1, ROWS>>,
    pub(crate) counts: Vec<PacketCounts>,
    pub(crate) packets: Vec<Packet>,
    pub(crate) codes: Vec<Code>,
    pub(crate) points: Vec<DomainPoint>,
    pub(crate) floats: Vec<[f32; 2]>,
    pub(crate) apart: [Vec<f32>; 2],
    pub(crate) indices: Vec<u32>,
    pub(crate) narrow: Vec<u16>,
    pub(crate) ranges: Vec<PatchRange>,
    pub(crate) tables: LocationTables,
    pub(crate) templates: Templates,
    pub(crate) lookup: Lookup,
}

impl TapOutput {
    pub(crate) fn new() -> Self {
        Self {
            words: Vec::new(),
            processed: Vec::new(),
            ones: Vec::new(),
            counts: Vec::new(),
            packets: Vec::new(),
            codes: Vec::new(),
            points: Vec::new(),
            floats: Vec::new(),
            apart: [Vec::new(), Vec::new()],
            indices: Vec::new(),
            narrow: Vec::new(),
            ranges: Vec::new(),
            tables: LocationTables::EMPTY,
            templates: Templates::new(),
            lookup: Lookup::new(),
        }
    }
}
