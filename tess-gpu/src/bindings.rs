//! What the shaders read and write, as data.

/// A buffer that a stage binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Resource {
    /// A [`crate::layout::Job`], the one uniform buffer.
    Job,
    /// The caller's raw factors.
    Factors,
    /// The constants of [`crate::tables`].
    Tables,
    /// Two words per patch of the chunk: [`crate::layout::Topology`].
    Topologies,
    /// Two words per factor of the chunk, factor after factor:
    /// [`crate::layout::pack_context`].
    Contexts,
    /// Offsets of patches, blocks and groups of the chunk.
    Offsets,
    /// A [`crate::layout::Status`] and the range of each chunk.
    Status,
    /// The patch that each tile begins with.
    Tiles,
    /// Draw arguments and dispatch sizes.
    Arguments,
    /// The caller's points.
    Points,
    /// The caller's indices.
    Indices,
}

/// How a stage uses a buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Access {
    /// Reads it.
    Read,
    /// Reads and writes it.
    ReadWrite,
}

/// A binding of a stage; its number is its place in [`crate::Stage::bindings`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Binding(pub Resource, pub Access);
