//! The structures that host and shaders share, word by word, all little-endian.

use bytemuck::{Pod, Zeroable};
use tess_core::{DomainPoint, FactorContext, Parity, PatchFactors};

/// A portion of a batch and a window of its output. [`crate::Plan::jobs`] writes it, and the
/// shaders read it as `Job` of `layout/setup.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct Job {
    /// Patches of the portion; 0 only in a batch of no patches.
    pub patches: u32,
    /// Number of the portion's first patch within the batch.
    pub first_patch: u32,
    /// Number of the portion.
    pub portion: u32,
    /// Distance between the contexts of one factor and those of the next, in entries.
    pub stride: u32,
    /// The first entry in the offsets of a block of patches.
    pub blocks_at: u32,
    /// The first entry in the offsets of a block's common topology, which is 0 if its patches
    /// differ.
    pub alike_at: u32,
    /// The first entry in the offsets of a section of blocks.
    pub sections_at: u32,
    /// The first entry of the primitives in the table of tiles.
    pub primitive_tiles_at: u32,
    /// First tile of the bound window.
    pub window_first: u32,
    /// Tiles of the bound window.
    pub window_tiles: u32,
    /// Portions of the batch.
    pub portions: u32,
    /// Points that the batch has room for.
    pub point_capacity: u32,
    /// Primitives that the batch has room for.
    pub primitive_capacity: u32,
    /// Number of windows of the points.
    pub point_windows: u32,
    /// Number of windows of the primitives.
    pub primitive_windows: u32,
    /// Tiles of a window of the points.
    pub point_window_tiles: u32,
    /// Tiles of a window of the primitives.
    pub primitive_window_tiles: u32,
    /// The most workgroups in a row of a dispatch: the size along x of a dispatch of several rows.
    pub max_workgroups: u32,
    /// A tile has 2^`tile_bits` elements.
    pub tile_bits: u32,
    /// 1 if topologies are entered into the catalogue, otherwise 0.
    pub has_catalogue: u32,
}

/// The room that a batch needs, and whether it fits: the first 32 bytes of
/// [`crate::Resource::Status`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct Status {
    points: u32,
    points_high: u32,
    primitives: u32,
    primitives_high: u32,
    overflow: u32,
    reserved: [u32; 3],
}

impl Status {
    /// Points that the batch needs.
    #[must_use]
    pub const fn points(&self) -> u64 {
        self.points as u64 | (self.points_high as u64) << 32
    }

    /// Primitives that the batch needs: points, segments or triangles.
    #[must_use]
    pub const fn primitives(&self) -> u64 {
        self.primitives as u64 | (self.primitives_high as u64) << 32
    }

    /// Whether the points do not fit their buffer. If so, nothing was written.
    #[must_use]
    pub const fn points_overflow(&self) -> bool {
        self.overflow & 1 != 0
    }

    /// Whether the indices do not fit their buffer. If so, nothing was written.
    #[must_use]
    pub const fn indices_overflow(&self) -> bool {
        self.overflow & 2 != 0
    }

    /// Whether everything fits and was written.
    #[must_use]
    pub const fn fits(&self) -> bool {
        self.overflow == 0
    }
}

/// The place of a portion's output within the batch's output. The ranges of all portions follow the
/// [`Status`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct Range {
    /// First point.
    pub points_begin: u32,
    /// One past the last point.
    pub points_end: u32,
    /// First primitive.
    pub primitives_begin: u32,
    /// One past the last primitive.
    pub primitives_end: u32,
}

/// The arguments of an indexed indirect draw, as WebGPU and Vulkan lay them out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct DrawIndexed {
    /// Indices to draw; 0 if the output does not fit.
    pub index_count: u32,
    /// Always 1.
    pub instance_count: u32,
    /// First index of the group; 0 for a whole batch.
    pub first_index: u32,
    /// Always 0.
    pub base_vertex: u32,
    /// Always 0.
    pub first_instance: u32,
}

/// The key of a patch's connectivity: its state and the points along its edges. See spec section
/// 12.8, and `layout/topology.wgsl` for the bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct Topology(pub [u32; 2]);

impl Topology {
    /// 0 if the patch is culled, 1 if it is a minimum patch, otherwise 2.
    #[must_use]
    pub const fn state(self) -> u32 {
        self.0[0] >> 28
    }

    /// Points along outer edge `edge` (0..=3): 2..=65. An isoline patch has two such counts, for
    /// its density and its detail.
    #[must_use]
    pub const fn outer_points(self, edge: u32) -> u32 {
        self.0[0] >> (7 * edge) & 127
    }

    /// Points along the inside axes u and v: 2..=65 each.
    #[must_use]
    pub const fn inside_points(self) -> [u32; 2] {
        [self.0[1] & 127, self.0[1] >> 7 & 127]
    }
}

/// A domain point with the number of its patch, in [`crate::PointFormat::Packed`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct PackedPoint(pub [u32; 2]);

impl PackedPoint {
    /// A point of a patch, whose number is below 2^30.
    #[must_use]
    pub const fn new(point: DomainPoint, patch: u32) -> Self {
        let (u, v) = (point.u.to_bits(), point.v.to_bits());
        Self([u | v << 17, v >> 15 | patch << 2])
    }

    /// The point.
    #[must_use]
    pub const fn point(self) -> DomainPoint {
        let [low, high] = self.0;
        DomainPoint::from_bits(low & 0x1_FFFF, (low >> 17) | (high & 3) << 15)
    }

    /// The number of the point's patch, below 2^30.
    #[must_use]
    pub const fn patch(self) -> u32 {
        self.0[1] >> 2
    }
}

/// A factor context (spec section 4) in the shaders' form of two words. `points` is left out,
/// because it follows from the other numbers.
#[must_use]
pub const fn pack_context(context: &FactorContext) -> [u32; 2] {
    let low = context.inv_floor
        | context.half_points << 17
        | context.split_position << 23
        | context.parity.odd() << 29
        | context.inv_ceil >> 16 << 30;
    [low, context.inv_ceil & 0xFFFF | context.fraction << 16]
}

/// The factor context that [`pack_context`] packs to these words.
#[must_use]
pub const fn unpack_context([low, high]: [u32; 2]) -> FactorContext {
    let odd = low >> 29 & 1;
    let half_points = low >> 17 & 63;
    FactorContext {
        parity: if odd == 1 { Parity::Odd } else { Parity::Even },
        inv_floor: low & 0x1_FFFF,
        inv_ceil: high & 0xFFFF | (low >> 30 & 1) << 16,
        fraction: high >> 16,
        half_points,
        split_position: low >> 23 & 63,
        points: 2 * half_points + 1 - odd,
    }
}

/// The raw factors as the words that shaders read: the bits of each factor in the specification's
/// order (section 1), patch by patch.
#[must_use]
pub fn factor_words(patches: &[PatchFactors]) -> Vec<u32> {
    patches.iter().flat_map(PatchFactors::iter).map(f32::to_bits).collect()
}
