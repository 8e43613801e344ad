//! The buffers that the shaders read and write.

/// A buffer that a stage binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Resource {
    /// One [`crate::layout::Job`] of [`crate::Plan::jobs`]: the only uniform buffer.
    Job,
    /// The caller's raw factors: [`crate::layout::factor_words`].
    Factors,
    /// The constants of [`crate::tables`].
    Tables,
    /// One [`crate::layout::Topology`] for each patch.
    Topologies,
    /// Two words for each factor ([`crate::layout::pack_context`]). Each portion has the contexts
    /// of the first factor of all its patches, then of the second factor, and so on.
    Contexts,
    /// The offsets of the output of patches, blocks and sections: [`crate::Plan::offset_entries`].
    Offsets,
    /// A [`crate::layout::Status`], then a [`crate::layout::Range`] for each portion.
    Status,
    /// For each tile of the output, the number of the patch that it begins with.
    Tiles,
    /// A [`crate::layout::DrawIndexed`], then the sizes of indirect dispatches. Needs the usage
    /// `INDIRECT`.
    Arguments,
    /// The output of distinct small topologies (`shared/catalogue.wgsl`). Must be zeros before the
    /// first run.
    Catalogue,
    /// For each group, the number of its first patch, in ascending order and at most the number of
    /// patches of the batch. A group ends where the next one begins, the last one at the end of the
    /// batch.
    Groups,
    /// A [`crate::layout::DrawIndexed`] for each group. Needs the usage `INDIRECT`.
    Draws,
    /// The caller's points: [`crate::PointFormat`].
    Points,
    /// The caller's indices: [`crate::IndexType`], [`crate::Numbering`].
    Indices,
}

impl Resource {
    /// Every resource.
    pub const ALL: [Self; 14] = [
        Self::Job,
        Self::Factors,
        Self::Tables,
        Self::Topologies,
        Self::Contexts,
        Self::Offsets,
        Self::Status,
        Self::Tiles,
        Self::Arguments,
        Self::Catalogue,
        Self::Groups,
        Self::Draws,
        Self::Points,
        Self::Indices,
    ];
}

/// A stage's access to a buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Access {
    /// The stage reads the buffer.
    Read,
    /// The stage reads and writes the buffer.
    ReadWrite,
}

/// A binding of a stage. Its number is its place in [`crate::Stage::bindings`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Binding(pub Resource, pub Access);
