//! The choices that a stage offers.

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
    /// From this buffer, as [`tess_gpu::layout::factor_words`] lays them out. It has the usage
    /// `STORAGE` and is read in each frame.
    Buffer(&'a wgpu::Buffer),
}

/// Where the vertex shader takes its points from. Points and triangles are the same, and so is
/// their order if [`StageBuilder::order`](super::StageBuilder::order) gives one: then the picture
/// is the same too. Its default is another without indices, which shows where triangles of a patch
/// overlap and no depth test decides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Points {
    /// From a vertex buffer, 8 bytes each, with an index buffer.
    #[default]
    Stored,
    /// Computed from the index of the vertex; there is an index buffer. The vertex stage binds five
    /// storage buffers and one uniform buffer besides yours.
    Pull,
    /// Computed for each corner of each primitive; there are no buffers of points and indices. The
    /// vertex stage binds the same as with [`Points::Pull`].
    PullWithoutIndices,
    /// From a vertex buffer of the user's `Vertex` structs, with an index buffer. After the
    /// tessellation a compute pass calls `domain` once for each point, and draws load what it
    /// returned. Take it for a long `domain`, above all in a frame of several passes, and to trace,
    /// pick or export the surface: see
    /// [`TessellationStage::vertices`](super::TessellationStage::vertices).
    ///
    /// What differs from draw to draw, such as the camera, is then a function of its own:
    /// [`StageBuilder::project`](super::StageBuilder::project). The bindings that `domain` reads
    /// are visible to `COMPUTE`. The pass binds four storage buffers besides yours. A point takes
    /// the bytes of a `Vertex` and 8.
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

/// How much room a stage has for points and indices.
///
/// [`Room::WorstCase`] costs a stage little if it stores neither ([`Points::PullWithoutIndices`]):
/// 4 bytes for each 2048 points and for each 2048 primitives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Room {
    /// Enough for all patches at factor 64: everything always fits.
    WorstCase,
    /// As much as this number of bytes holds, points and indices together. All patches fit at
    /// factor 1 if the bytes suffice for that; the rest is divided in the proportion of patches of
    /// factor 8.
    Bytes(u64),
    /// Exactly this.
    Exactly(Capacity),
    /// Enough for all patches at factor 4 at first. When a frame needs more than 7/8 of it, a later
    /// one has twice as much or more: the stage learns what was needed without waiting and makes
    /// larger buffers, within the budget. Output that rises by up to 4 % a frame therefore always
    /// fits. Room of which 1024 frames use a fifth or less shrinks. The pipelines for any room are
    /// made when the stage is built, none by a frame.
    ///
    /// The first frames can therefore be coarser than asked for, or empty, as [`Overflow`] says.
    /// For a picture that is drawn once, call
    /// [`TessellationStage::make_room`](super::TessellationStage::make_room) first, or take
    /// [`Room::WorstCase`].
    Automatic {
        /// The most bytes of points and indices together.
        most_bytes: u64,
    },
}

/// The fate of a frame whose output does not fit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Overflow {
    /// All factors are scaled down by one number, on the device, until everything fits. Edges stay
    /// closed. If even factors of 1 give too much, nothing is drawn.
    #[default]
    Coarser,
    /// Nothing is drawn.
    DrawNothing,
}

/// How many patches a frame has: a `u32`, or a `u32` in a buffer of the device.
#[derive(Clone, Copy, Debug)]
pub enum PatchCount<'a> {
    /// This number.
    Host(u32),
    /// The number at this offset, a multiple of 4, of a buffer with the usage `COPY_SRC`. A number
    /// beyond what the stage was made for counts as that.
    Device(&'a wgpu::Buffer, u64),
}

impl From<u32> for PatchCount<'_> {
    fn from(count: u32) -> Self {
        Self::Host(count)
    }
}
