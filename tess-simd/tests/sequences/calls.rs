//! Calls of a tessellator. They print as Rust, so that a failing sequence can be pasted into
//! `found.rs`.

use std::fmt;
use tess_core::{Config, Domain, IsolineFactors, PatchFactors, QuadFactors, TriangleFactors};
use tess_simd::{Level, Order};

/// A new tessellator.
#[derive(Clone, Debug)]
pub(crate) struct Start {
    pub(crate) config: Config,
    pub(crate) level: Level,
    pub(crate) order: Order,
    pub(crate) threads: usize,
    /// Whether the calls come from a thread of a pool of four, or from one outside any pool.
    pub(crate) in_pool: bool,
}

/// One call, or several that belong together.
#[derive(Clone, Debug)]
pub(crate) enum Call {
    /// `write`, or `write_apart`.
    Write(Patches, To),
    /// `count`, and then `write` into each of these.
    Count(Patches, List<To>),
    /// `tessellate` into the output of these formats, which is kept, and the ranges of groups that
    /// begin at these patches.
    Tessellate(Patches, Format, Width, From, List<u32>),
    /// `patch`, or `patch_apart`.
    Patch(Factors, Room),
    /// `count_patch`, and then `write` into each of these.
    CountPatch(Factors, List<Room>),
    Reserve,
    SetOrder(Order),
    SetThreads(usize),
    /// The copy replaces the tessellator.
    Copy,
}

/// Patches of a batch: runs of equal ones.
#[derive(Clone, Debug)]
pub(crate) struct Patches {
    pub(crate) layout: Layout,
    pub(crate) domain: Domain,
    pub(crate) runs: List<(usize, Factors)>,
}

impl Patches {
    /// All of them, one by one.
    pub(crate) fn all(&self) -> Vec<PatchFactors> {
        let run = |&(times, Factors(factors)): &_| std::iter::repeat_n(factors, times);
        self.runs.0.iter().flat_map(run).collect()
    }
}

/// The layout of a batch in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Layout {
    Structures,
    Columns,
    AnyDomain,
    /// Columns whose last one has one factor less: refused.
    Uneven,
    /// The last patch has another domain: refused.
    Mixed,
}

/// Buffers of a batch.
#[derive(Clone, Debug)]
pub(crate) struct To {
    pub(crate) room: Room,
    pub(crate) from: From,
    /// Ranges beyond those needed; `None`: no ranges are wanted.
    pub(crate) ranges: Option<isize>,
}

/// Buffers of points and indices: elements beyond those needed; -1: one element short.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Room {
    pub(crate) format: Format,
    pub(crate) width: Width,
    pub(crate) points: isize,
    /// The second array of points, if there are two.
    pub(crate) second: isize,
    pub(crate) indices: isize,
}

/// The format that points are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Float,
    Fixed,
    /// Two arrays. An output that is kept has none.
    Apart,
}

/// The width that indices are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Width {
    Bits16,
    Bits32,
}

/// The point that indices count from.
#[derive(Clone, Copy, Debug)]
pub(crate) enum From {
    EachPatch,
    Base(u32),
    /// The largest index is this much above the largest one of its width. Base vertices end at 0
    /// and 2^32 - 1.
    Limit(i64),
}

/// A list that prints as the call of [`list`] that makes it.
#[derive(Clone)]
pub(crate) struct List<T>(pub(crate) Vec<T>);

pub(crate) fn list<T, const N: usize>(all: [T; N]) -> List<T> {
    List(all.into())
}

impl<T: fmt::Debug> fmt::Debug for List<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "list({:?})", self.0)
    }
}

/// Raw factors that print as the call of [`quad`], [`triangle`] or [`isoline`] that makes them.
#[derive(Clone, Copy)]
pub(crate) struct Factors(pub(crate) PatchFactors);

pub(crate) fn quad(factors: [f32; 6]) -> Factors {
    Factors(QuadFactors::from(factors).into())
}

pub(crate) fn triangle(factors: [f32; 4]) -> Factors {
    Factors(TriangleFactors::from(factors).into())
}

pub(crate) fn isoline(factors: [f32; 2]) -> Factors {
    Factors(IsolineFactors::from(factors).into())
}

impl fmt::Debug for Factors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let all: Vec<f32> = self.0.iter().collect();
        let one = |x: f32| match x.is_finite() {
            true => format!("{x:?}"),
            false => format!("f32::from_bits({:#x})", x.to_bits()),
        };
        let name = match self.0 {
            PatchFactors::Isoline(_) => "isoline",
            PatchFactors::Triangle(_) => "triangle",
            PatchFactors::Quad(_) => "quad",
        };
        if all.iter().all(|x| x.to_bits() == all[0].to_bits()) {
            return write!(f, "{name}([{}; {}])", one(all[0]), all.len());
        }
        write!(f, "{name}([{}])", all.into_iter().map(one).collect::<Vec<_>>().join(", "))
    }
}

/// A test that makes these calls.
pub(crate) fn as_test(start: &Start, calls: &[Call]) -> String {
    let calls: String = calls.iter().map(|call| format!("        {call:?},\n")).collect();
    format!(
        "#[test]\nfn found() {{\n    let start = {start:?};\n    let calls = [\n{calls}    ];\n    assert_eq!(replay(&start, &calls), Ok(()));\n}}\n"
    )
}
