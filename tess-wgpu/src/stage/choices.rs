//! The types of the choices that a stage's builder offers.

use tess_gpu::Capacity;

/// Where the factors come from.
#[derive(Clone, Copy, Debug, Default)]
pub enum Factors<'a> {
    /// From the user's function `hull`.
    #[default]
    Hull,
    /// From the host: [`TessellationStage::set_factors`](super::TessellationStage::set_factors).
    /// Until then all patches are culled.
    Host,
    /// From this buffer, laid out as by [`tess_gpu::layout::factor_words`]. It needs the usage
    /// `STORAGE` and is read in each frame.
    Buffer(&'a wgpu::Buffer),
}

/// The source of the vertex shader's points.
///
/// Every choice gives the same points and triangles. If
/// [`StageBuilder::order`](super::StageBuilder::order) sets their order, that is the same too, and
/// so is the picture. The default order is different without an index buffer, which can be seen
/// where triangles of a patch overlap and no depth test decides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Points {
    /// From a vertex buffer with 8 bytes per point, and an index buffer.
    #[default]
    Stored,
    /// Computed from the index of the vertex; there is an index buffer. The vertex shader binds
    /// five storage buffers and one uniform buffer in addition to yours.
    Pull,
    /// Computed for each corner of each primitive; there are no buffers of points and indices. The
    /// vertex shader binds the same buffers as with [`Points::Pull`].
    PullWithoutIndices,
    /// From a buffer of the user's `Vertex` structs, with an index buffer. After the tessellation,
    /// a compute pass calls `domain` once for each point, and draws load the results: as attributes
    /// up to 32 bytes, and larger ones from a storage buffer, which is faster, where a binding
    /// holds all of them and a bind group is left (natively, not on OpenGL).
    /// Choose it for a long `domain`, above all if a frame has several passes, and to trace, pick
    /// or export the surface: see
    /// [`TessellationStage::vertices`](super::TessellationStage::vertices).
    ///
    /// What differs from draw to draw, such as the camera, then belongs in the function of
    /// [`MaterialBuilder::project`](super::MaterialBuilder::project). The bindings that `domain`
    /// reads must be visible to `COMPUTE`. The pass binds four storage buffers in addition to
    /// yours. A point takes 8 bytes more than a `Vertex`.
    Evaluated,
}

impl Points {
    /// Whether there is an index buffer.
    pub(super) const fn has_indices(self) -> bool {
        !matches!(self, Self::PullWithoutIndices)
    }

    /// Whether the batch writes packed points.
    pub(super) const fn are_written(self) -> bool {
        matches!(self, Self::Stored | Self::Evaluated)
    }

    #[cfg(test)]
    pub(super) const ALL: [Self; 4] =
        [Self::Stored, Self::Pull, Self::PullWithoutIndices, Self::Evaluated];
}

/// The room that a stage has for points and indices.
///
/// If a stage stores neither ([`Points::PullWithoutIndices`]), [`Room::WorstCase`] costs little: 4
/// bytes for each 2048 points and for each 2048 primitives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Room {
    /// Enough for all patches at factor 64: everything always fits.
    WorstCase,
    /// As much as fits in this number of bytes, points and indices together. All patches fit at
    /// factor 1 if the bytes suffice for that; the rest is divided in the proportion of patches of
    /// factor 8.
    Bytes(u64),
    /// Exactly this capacity.
    Exactly(Capacity),
    /// Enough for all patches at factor 4 at first. When a frame needs more than 7/8 of it, a later
    /// one has twice as much or more: the stage learns what was needed without waiting and makes
    /// larger buffers, within the budget. Output that rises by up to 4 % per frame therefore always
    /// fits. After 1024 frames that used a fifth of the room or less, it shrinks. The pipelines for
    /// any room are made when the stage is built, so no frame waits for a compiler.
    ///
    /// The first frames can therefore be coarser than asked for, or empty, depending on
    /// [`Overflow`]. For a picture that is drawn once, call
    /// [`TessellationStage::make_room`](super::TessellationStage::make_room) first, or choose
    /// [`Room::WorstCase`].
    Automatic {
        /// The most bytes of points and indices together.
        most_bytes: u64,
    },
}

/// The fate of a frame whose output does not fit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Overflow {
    /// The device multiplies all factors above 1 by one scale, so that everything fits. Factors
    /// above 64 count as 64, and no factor falls below 1. Edges stay closed. If even factors of 1
    /// give too much, nothing is drawn.
    #[default]
    Coarser,
    /// Nothing is drawn.
    DrawNothing,
}

/// The number of patches of a frame: a `u32`, or a `u32` in a buffer of the device.
#[derive(Clone, Copy, Debug)]
pub enum PatchCount<'a> {
    /// This number.
    Host(u32),
    /// The number at this offset, a multiple of 4, of a buffer with the usage `COPY_SRC`. If the
    /// number exceeds the most patches that the stage was made for, all of these are drawn.
    Device(&'a wgpu::Buffer, u64),
}

impl From<u32> for PatchCount<'_> {
    fn from(count: u32) -> Self {
        Self::Host(count)
    }
}
