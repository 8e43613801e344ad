//! The calls of a sequence, as values that are printed as they are written.

use std::fmt;

/// Which threads make the calls.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Threads {
    /// One.
    One,
    /// A new one for each call.
    Alternating,
    /// One for each slot, at the same time.
    Together,
}

/// Calls, each on the batch of a slot.
#[derive(Clone)]
pub(crate) struct Sequence {
    pub(crate) threads: Threads,
    pub(crate) steps: Vec<(usize, Call)>,
}

/// A call on a batch, which is null before the first one was made and after it was freed.
#[derive(Clone, Debug)]
pub(crate) enum Call {
    /// `tess_batch_create`, and `tess_batch_free` with the batch before.
    Create { config: [u32; 4], level: u32 },
    /// `tess_batch_free`.
    Free,
    /// `tess_batch_reserve`.
    Reserve,
    /// `tess_batch_set_triangles`.
    Triangles { order: u32 },
    /// `tess_batch_set_threads`.
    Pool { threads: u32 },
    /// `tess_batch_level`.
    Level,
    /// `tess_batch_count`.
    Count { patches: PatchRuns, wrong: Wrong },
    /// `tess_batch_run`.
    Run { patches: PatchRuns, to: To, wrong: Wrong },
    /// `tess_batch_patch`.
    Single { factors: Bits, to: To, wrong: Wrong },
    /// `tess_batch_groups`, of the batch that was run last.
    Groups { starts: [u32; 3] },
}

/// The bits of a patch's factors, as many as its domain has.
#[derive(Clone, Copy)]
pub(crate) struct Bits(pub(crate) [u32; 6]);

/// Runs of equal patches: how many, and their factors.
#[derive(Clone)]
pub(crate) struct PatchRuns(pub(crate) Vec<(u8, Bits)>);

/// Where the output goes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct To {
    /// The room for points, indices and ranges.
    pub(crate) room: [Room; 3],
    pub(crate) point_format: u32,
    pub(crate) index_type: u32,
    pub(crate) numbering: u32,
    pub(crate) base: Base,
    pub(crate) memory: u32,
    /// Whether the buffers hold what they held after the call before.
    pub(crate) keep: bool,
}

impl To {
    /// No buffer.
    pub(crate) const NOTHING: Self = Self {
        room: [Room::Absent; 3],
        point_format: 0,
        index_type: 0,
        numbering: 0,
        base: Base::Of(0),
        memory: 0,
        keep: false,
    };
}

/// The capacity of a buffer.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Room {
    /// As many elements as are needed.
    Exact,
    /// So many elements more.
    More(u8),
    /// One element less.
    Short,
    /// None, and the pointer is null.
    Absent,
    /// The smallest that memory cannot have.
    Impossible,
}

/// The number of the first point.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Base {
    Of(u32),
    /// Such that the largest index is so far from the largest of the index type.
    Limit(i8),
}

/// Arguments of a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BufferName {
    Factors,
    Points,
    Indices,
    Ranges,
    Counts,
    Output,
}

/// Fault of a call's pointers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wrong {
    Nothing,
    Null(BufferName),
    /// A byte beside where it should be.
    Askew(BufferName),
    /// The first part lies where the second one does.
    Shared(BufferName, BufferName),
    /// One float too many.
    Floats,
}

impl fmt::Debug for Bits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bits = self.0.map(|bits| format!("{bits:#x}"));
        write!(f, "Bits([{}])", bits.join(", "))
    }
}

impl fmt::Debug for PatchRuns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "PatchRuns(vec!{:?})", self.0)
    }
}

impl fmt::Debug for Sequence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "#[test]\nfn sequence() {{\n    replay({:?}, &[", self.threads)?;
        self.steps.iter().try_for_each(|step| writeln!(f, "        {step:?},"))?;
        f.write_str("    ]);\n}\n")
    }
}
