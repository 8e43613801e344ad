//! Every kernel of `tess-simd` with the model's stage that it must equal: one table, which is
//! checked and timed.
//!
//! # The problem
//!
//! A wrong word in a batch shows only that something between raw factors and the output is wrong: a
//! patch goes through a dozen stages, each compiled for three CPU levels. So each stage also runs
//! separately, at each level, and its words are compared with those of the same stage of
//! `tess-core`. `tess-simd/tests/kernels.rs` does that; `benches/benches/kernels.rs` times the same
//! entries on the same inputs.
//!
//! # An entry
//!
//! ```text
//! name                  kernel           takes                        expected      format
//! stages/points/quad    Kernel::Points   regular quads,               the::points   16.16
//!                                        points alone as primitives
//! ```
//!
//! A [`Case`] is an entry's input in one round: random in even rounds, extreme in odd ones, with
//! another configuration in every second round. [`SEED`], the entry and the round determine it.
//! Patches reach a stage through the stages before it, and the entries are in the order of the
//! data. So the first entry that fails names the faulty kernel; those after it may only have
//! received its wrong words.
//!
//! # One entry at work
//!
//! `stages/points/quad` in round 6 takes regular quads of fractional-even factors. For each of them
//! the model walks its points, and `Words::points` notes two words per point under the names `u
//! of point` and `v of point`. The [`KernelTap`] takes the same patches through the front end and
//! lets `stages/points` write them into a buffer of exactly that size, twice: the state that it
//! keeps from run to run must change nothing. If word 9 of patch 2 differs, the message has the
//! entry, the level, the round, `v of point 4`, both words, and the patch as a case that `tess`
//! reads.
//!
//! # Adding one
//!
//! 1. Give the kernel a variant of `Kernel` and an arm in `tess-simd/src/kernels/kernel_taps`,
//!    which is compiled for each level.
//! 2. Write the model's answer in `references`, in the order in which `KernelTap::words` lists the
//!    output.
//! 3. Add a line to [`TABLE`]. A kernel without one fails the test.
//! 4. Plant a fault in the kernel and see the test name it.

mod inputs;
mod references;
mod words;

pub use words::{Difference, Words};

use Domain::{Isoline, Quad, Triangle};
use Kernel as K;
use inputs::Class::{self, Any, Compact, CompactFractional, CompactRegular, Regular, Small};
use inputs::{Draw, Patches, numbers as draw};
use references as the;
use tess_core::{Config, Domain, Order, OutputPrimitive, Parity, Partitioning, Patch, SplitOrder};
use tess_simd::{Format, Input, Kernel, KernelTap, Level};

/// The seed of all inputs.
pub const SEED: u64 = 0x7E55_1A7E;

/// A kernel and its reference.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The file of the kernel and perhaps its function.
    pub name: &'static str,
    name_at_avx512: &'static str,
    /// What [`KernelTap`] runs.
    pub kernel: Kernel,
    format: Format,
    takes: Takes,
    expected: Expected,
}

/// Notes the model's words.
type Expected = fn(&Case, &mut Words);

/// The inputs of an entry.
#[derive(Clone, Copy, Debug)]
enum Takes {
    /// Numbers that this function draws.
    Numbers(fn(&mut Draw) -> Vec<u32>),
    Patches(Patches),
}

/// An entry's input in one round.
#[derive(Debug)]
pub struct Case {
    input: Input,
    /// The patches as the model processes them.
    patches: Vec<Patch>,
}

/// Every kernel, in the order in which data goes through them.
pub const TABLE: &[Entry] = &[
    numbers("stages/reciprocal", K::Reciprocal, draw::divisors, the::reciprocals),
    numbers("stages/factors clamp", K::Clamp, draw::raw, the::clamped),
    numbers("stages/factors ceil", K::Ceil, draw::in_range, the::ceilings),
    numbers("stages/factors to_fixed", K::ToFixed, draw::in_range, the::fixed),
    patches("stages/factors process", K::Factors, ALL, Any, the::factors),
    patches("stages/factors process, wide", K::FactorsByEight, ALL, Any, the::factors),
    patches("stages/factors process_one", K::FactorsOfOne, ALL, Any, the::factors),
    numbers("stages/factor_context", K::Context, draw::fixed, the::contexts),
    numbers("stages/factor_context point_count", K::PointCount, draw::fixed, the::point_counts),
    numbers("stages/place place_in_half", K::PlaceInHalf, draw::few_fixed, the::half_locations),
    numbers("stages/place", K::Place, draw::few_fixed, the::locations),
    patches("stages/counts", K::Counts, ALL, Any, the::counts),
    patches("stages/counts, wide", K::CountsByEight, ALL, Any, the::counts),
    patches("stages/packet, wide", K::PacketByEight, ALL, Any, the::packets),
    patches("stages/packet", K::Packet, ALL, Any, the::packets),
    patches("stages/packet/one", K::PacketOfOne, ALL, Any, the::packets),
    patches("kernels/front_end process", K::Process, ALL, Any, the::packets),
    patches("kernels/front_end process_one", K::ProcessOne, ALL, Any, the::counts_of_each),
    patches("kernels/front_end count", K::Count, ALL, Any, the::totals),
    patches("kernels/front_end count_and_keep", K::CountAndKeep, ALL, Any, the::packets_and_totals),
    numbers("data/format", K::Float, draw::coordinates, the::floats),
    numbers("data/writer points", K::WritePoints, draw::runs, the::written_points),
    numbers("data/writer points, binary32", K::WritePoints, draw::runs, the::written_points)
        .as_f32(),
    numbers("data/point_writer/apart", K::WritePoints, draw::runs, the::written_points).apart(),
    numbers("data/writer indices, u32", K::WriteIndices, draw::runs, the::written_indices),
    numbers("data/writer indices, u16", K::WriteIndices, draw::runs, the::written_indices).narrow(),
    patches("stages/points/tables", K::Tables, ALL, Regular, the::tables),
    patches("stages/points/isoline", K::Points, &[Isoline], Regular, the::points).points(),
    patches("stages/points/triangle", K::Points, &[Triangle], Regular, the::points).points(),
    patches("stages/points/quad", K::Points, &[Quad], Regular, the::points).points(),
    numbers("stages/stitch/tables", K::Stitches, draw::stitches, the::stitches),
    numbers("stages/stitch/rows, u32", K::RowsU32, draw::rows, the::rows_u32),
    numbers("stages/stitch/rows, u16", K::RowsU16, draw::rows, the::rows_u16),
    patches("stages/connect isolines", K::ConnectU32, &[Isoline], Regular, the::indices_u32),
    patches("stages/connect/triangle", K::ConnectU32, &[Triangle], Regular, the::indices_u32),
    patches("stages/connect/quad", K::ConnectU32, &[Quad], Regular, the::indices_u32),
    patches("stages/connect, u16", K::ConnectU16, ALL, Regular, the::indices_u16),
    patches("stages/connect/rings, columns", K::ConnectInColumns, DISCS, Regular, the::indices_u32)
        .triangles(),
    patches("stages/points/coordinate_code", K::Codes, DISCS, CompactRegular, the::points).points(),
    patches("stages/template, compact", K::CompactTemplate, DISCS, Compact, the::templates),
    patches("stages/points/lookup", K::CompactPoints, DISCS, CompactFractional, the::points)
        .points()
        .at_avx512("stages/points/permute"),
    patches("stages/template", K::Template, ALL, Small, the::templates),
    patches("kernels/emit emit_one", K::EmitOne, DISCS, Compact, the::output).narrow(),
    patches("kernels/emit compact", K::Emit, DISCS, Compact, the::output_and_ranges),
    patches("kernels/emit", K::Emit, ALL, Any, the::output_and_ranges),
    patches("kernels/emit, binary32, u16", K::Emit, ALL, Any, the::output_and_ranges).narrow(),
    patches("kernels/emit, apart", K::Emit, ALL, Any, the::output_and_ranges).apart(),
    numbers("kernels/repeat", K::Repeat, draw::periods, the::repeated),
    numbers("kernels/repeat, binary32, u16", K::Repeat, draw::periods, the::repeated).narrow(),
    numbers("kernels/repeat, apart", K::Repeat, draw::periods, the::repeated).apart(),
];

const ALL: &[Domain] = &Domain::ALL;
const DISCS: &[Domain] = &[Triangle, Quad];

/// An entry whose inputs are numbers.
const fn numbers(
    name: &'static str,
    kernel: Kernel,
    draw: fn(&mut Draw) -> Vec<u32>,
    expected: Expected,
) -> Entry {
    let (takes, format) = (Takes::Numbers(draw), Format::FixedU32);
    Entry { name, name_at_avx512: name, kernel, format, takes, expected }
}

/// An entry whose inputs are patches.
const fn patches(
    name: &'static str,
    kernel: Kernel,
    domains: &'static [Domain],
    class: Class,
    expected: Expected,
) -> Entry {
    let takes = Takes::Patches(Patches { domains, class, outputs: &OutputPrimitive::ALL });
    Entry { name, name_at_avx512: name, kernel, format: Format::FixedU32, takes, expected }
}

impl Entry {
    const fn as_f32(self) -> Self {
        Self { format: Format::F32U32, ..self }
    }

    /// With indices of 16 bits, and points as binary32.
    const fn narrow(self) -> Self {
        Self { format: Format::F32U16, ..self }
    }

    const fn apart(self) -> Self {
        Self { format: Format::ApartU32, ..self }
    }

    /// With only points as primitives, which is little work for the model.
    const fn points(self) -> Self {
        self.making(&[OutputPrimitive::Point])
    }

    const fn triangles(self) -> Self {
        self.making(inputs::TRIANGLES)
    }

    const fn making(self, outputs: &'static [OutputPrimitive]) -> Self {
        let takes = match self.takes {
            Takes::Patches(patches) => Takes::Patches(Patches { outputs, ..patches }),
            numbers @ Takes::Numbers(_) => numbers,
        };
        Self { takes, ..self }
    }

    /// With another file at AVX-512.
    const fn at_avx512(self, name: &'static str) -> Self {
        Self { name_at_avx512: name, ..self }
    }

    /// The file of the kernel at a level.
    pub const fn name_at(&self, level: Level) -> &'static str {
        if matches!(level, Level::Avx512) { self.name_at_avx512 } else { self.name }
    }
}

impl Entry {
    /// The input of a round.
    pub fn case(&self, round: u32) -> Case {
        let mut draw = Draw::new(SEED, round);
        let turn = round as usize / 2;
        let (output, split) = (OutputPrimitive::ALL[turn / 4 % 4], SplitOrder::ALL[turn / 16 % 2]);
        let partitioning = Partitioning::ALL[turn % 4];
        let mut config = Config { partitioning, output, split };
        if matches!(self.kernel, Kernel::Stitches | Kernel::RowsU16 | Kernel::RowsU32) {
            config.output = inputs::TRIANGLES[turn / 4 % 2];
        }
        draw.config = config;
        let parity = if turn.is_multiple_of(2) { Parity::Even } else { Parity::Odd };
        draw.parity = parity;
        let (mut order, mut numbers, mut patches) = (Order::Specification, Vec::new(), Vec::new());
        match &self.takes {
            Takes::Numbers(drawn) => numbers = drawn(&mut draw),
            Takes::Patches(kind) => {
                config = kind.config(config);
                patches = kind.draw(&mut draw, config);
                let in_any_order = !matches!(self.kernel, Kernel::ConnectU16 | Kernel::ConnectU32);
                if self.kernel == Kernel::ConnectInColumns || in_any_order && draw.below(3) == 0 {
                    order = Order::VertexCache;
                }
            }
        }
        let base = [0, 77, 0xFFFF, u32::MAX - 40][draw.below(4) as usize];
        let per_batch = draw.below(2) == 1 && self.kernel != Kernel::EmitOne;
        let (format, sizes) = (self.format, [0; 2]);
        let of_model = patches.iter().map(|&factors| Patch::new(config, factors)).collect();
        let input =
            Input { config, order, parity, base, per_batch, format, numbers, patches, sizes };
        Case { input, patches: of_model }
    }

    /// The model's words for a case; sets the case's sizes to those of this output.
    pub fn expected(&self, case: &mut Case) -> Words {
        let mut words = Words::default();
        (self.expected)(case, &mut words);
        case.input.sizes = words.sizes();
        words
    }

    /// The tap of a case, whose sizes are known.
    ///
    /// # Panics
    /// This machine lacks the level.
    pub fn tap(&self, case: &Case, level: Level) -> KernelTap {
        KernelTap::new(self.kernel, level, &case.input).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Runs the kernel twice, because the state that it keeps from run to run may change its
    /// result, and compares its output.
    ///
    /// # Errors
    /// The first difference.
    pub fn compare(&self, case: &Case, expected: &Words, level: Level) -> Result<(), Difference> {
        let mut tap = self.tap(case, level);
        for _ in 0..2 {
            tap.run();
            expected.compare(case, &the::readable(self.kernel, case, tap.words()))?;
        }
        Ok(())
    }
}
