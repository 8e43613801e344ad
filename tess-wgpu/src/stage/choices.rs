//! The choices that a stage offers.

use tess_gpu::Capacity;

/// The source of a stage's factors.
#[derive(Clone, Copy, Debug, Default)]
pub enum Factors<'a> {
    /// From the user's function `hull`.
    #[default]
    Hull,
    /// From the host: [`TessellationStage::set_factors`](super::TessellationStage::set_factors).
    /// Until then all patches are culled.
    Host,
    /// From this buffer, laid out as by [`tess_gpu::layout::factor_words`]. It needs the usage
    /// `STORAGE`, and each frame reads it.
    Buffer(&'a wgpu::Buffer),
}

/// The source of the vertex shader's points. All variants give the same points and triangles.
///
/// Their order is the same too if [`StageBuilder::order`](super::StageBuilder::order) sets it; the
/// default order without indices differs from that of the other variants. The order shows only
/// where triangles of one patch overlap and no depth test decides between them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Points {
    /// From a vertex buffer, 8 bytes each, with an index buffer.
    #[default]
    Stored,
    /// Computed from the vertex's index, with an index buffer. The vertex stage binds five storage
    /// buffers and one uniform buffer in addition to yours.
    Pull,
    /// Computed for each corner of each primitive, without buffers of points and indices. The
    /// vertex stage binds the same buffers as for [`Points::Pull`].
    PullWithoutIndices,
    /// From a vertex buffer of the user's `Vertex` structs, with an index buffer. After the
    /// tessellation a compute pass calls `domain` once for each point, and draws load its results.
    /// This is for a long `domain`, especially in a frame of several passes, and for tracing,
    /// picking or exporting the surface: see
    /// [`TessellationStage::vertices`](super::TessellationStage::vertices).
    ///
    /// Work that differs from draw to draw, such as applying the camera, belongs in a function of
    /// its own: [`StageBuilder::project`](super::StageBuilder::project). The bindings that `domain`
    /// reads must be visible to `COMPUTE`. The pass binds four storage buffers in addition to
    /// yours. A point takes the bytes of a `Vertex`, plus 8.
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

/// The size of a stage's buffers of points and indices.
///
/// A stage that stores neither ([`Points::PullWithoutIndices`]) can take [`Room::WorstCase`]
/// cheaply: 4 bytes for every 2048 points and for every 2048 primitives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Room {
    /// Room for all patches at factor 64, so that every frame fits.
    WorstCase,
    /// This number of bytes, points and indices together. All patches fit at factor 1 if the bytes
    /// suffice for that; the rest is divided in the proportion of patches with factor 8.
    Bytes(u64),
    /// Exactly this number of points and primitives.
    Exactly(Capacity),
    /// At first, room for all patches at factor 4. When a frame needs more than 7/8 of it, the
    /// stage makes larger buffers within the budget, at least twice as large, without waiting for
    /// the device; a later frame uses them. Output that rises by up to 4 % per frame therefore
    /// always fits. If 1024 frames use at most a fifth of the room, it shrinks. All pipelines are
    /// made when the stage is built, none by a frame.
    ///
    /// The first frames can be coarser than requested, or empty, depending on [`Overflow`]. For a
    /// picture that is drawn once, call
    /// [`TessellationStage::make_room`](super::TessellationStage::make_room) first, or use
    /// [`Room::WorstCase`].
    Automatic {
        /// The most bytes of points and indices together.
        most_bytes: u64,
    },
}

/// The fate of a frame whose output does not fit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Overflow {
    /// The device multiplies all factors above 1 by one scale, so that everything fits, but leaves
    /// them at least 1. Edges stay closed. If even factors of 1 give too much, nothing is drawn.
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
    /// The number at this offset, a multiple of 4, of a buffer with the usage `COPY_SRC`. A larger
    /// number than the stage was made for counts as that number.
    Device(&'a wgpu::Buffer, u64),
}

impl From<u32> for PatchCount<'_> {
    fn from(count: u32) -> Self {
        Self::Host(count)
    }
}
