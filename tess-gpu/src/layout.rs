//! The structures that host and shaders share, word by word.

use bytemuck::{Pod, Zeroable};
use tess_core::{DomainPoint, FactorContext, Parity, PatchFactors};

/// One chunk of a batch and one window of its output: `Job` in `state.wgsl`, which says what the
/// members mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
#[expect(missing_docs, reason = "documented where they are used, in state.wgsl")]
pub struct Job {
    pub patches: u32,
    pub first_patch: u32,
    pub chunk: u32,
    pub stride: u32,
    pub blocks_at: u32,
    pub alike_at: u32,
    pub groups_at: u32,
    pub primitive_tiles_at: u32,
    pub window_first: u32,
    pub window_tiles: u32,
    pub chunks: u32,
    pub point_capacity: u32,
    pub primitive_capacity: u32,
    pub point_windows: u32,
    pub primitive_windows: u32,
    pub point_window_tiles: u32,
    pub primitive_window_tiles: u32,
}

/// What a batch needs and whether it fitted: the head of `Status` in `state.wgsl`.
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

    /// Whether the points did not fit. Then nothing was written.
    #[must_use]
    pub const fn points_overflow(&self) -> bool {
        self.overflow & 1 != 0
    }

    /// Whether the indices did not fit. Then nothing was written.
    #[must_use]
    pub const fn indices_overflow(&self) -> bool {
        self.overflow & 2 != 0
    }

    /// Whether everything fitted and was written.
    #[must_use]
    pub const fn fits(&self) -> bool {
        self.overflow == 0
    }
}

/// Where a chunk's output lies within the batch's: `Range` in `state.wgsl`.
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
    /// Indices to draw; 0 if the output did not fit.
    pub index_count: u32,
    /// Always 1.
    pub instance_count: u32,
    /// Always 0.
    pub first_index: u32,
    /// Always 0.
    pub base_vertex: u32,
    /// Always 0.
    pub first_instance: u32,
}

/// What connectivity depends on: `topology.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct Topology(pub [u32; 2]);

impl Topology {
    /// 0 if the patch is culled, 1 for a minimum patch, 2 for any other.
    #[must_use]
    pub const fn state(self) -> u32 {
        self.0[0] >> 28
    }

    /// Points along outer edge `edge`; of an isoline density and detail.
    #[must_use]
    pub const fn outer_points(self, edge: u32) -> u32 {
        self.0[0] >> (7 * edge) & 127
    }

    /// Points along the inside axes u and v.
    #[must_use]
    pub const fn inside_points(self) -> [u32; 2] {
        [self.0[1] & 127, self.0[1] >> 7]
    }
}

/// A packed domain point with the number of its patch: `point_format.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct PackedPoint(pub [u32; 2]);

impl PackedPoint {
    /// The point.
    #[must_use]
    pub const fn point(self) -> DomainPoint {
        let [low, high] = self.0;
        DomainPoint::from_bits(low & 0x1_FFFF, (low >> 17) | (high & 3) << 15)
    }

    /// The number of its patch, below 2^30.
    #[must_use]
    pub const fn patch(self) -> u32 {
        self.0[1] >> 2
    }
}

/// A factor context in the shaders' two words (`factor_context.wgsl`).
#[must_use]
pub const fn pack_context(context: &FactorContext) -> [u32; 2] {
    let low = context.inv_floor
        | context.half_points << 17
        | context.split << 23
        | context.parity.odd() << 29
        | context.inv_ceil >> 16 << 30;
    [low, context.inv_ceil & 0xFFFF | context.fraction << 16]
}

/// The factor context in two words of the shaders; every field but `points` is stored.
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
        split: low >> 23 & 63,
        points: 2 * half_points + 1 - odd,
    }
}

/// The words of raw factors as the shaders read them: the bits of each factor in the
/// specification's order, patch after patch.
#[must_use]
pub fn factor_words(patches: &[PatchFactors]) -> Vec<u32> {
    let mut words = Vec::new();
    for patch in patches {
        match patch {
            PatchFactors::Isoline(f) => words.extend([f.density, f.detail].map(f32::to_bits)),
            PatchFactors::Triangle(f) => {
                words.extend(f.outer().map(f32::to_bits));
                words.push(f.inside.to_bits());
            }
            PatchFactors::Quad(f) => {
                words.extend(f.outer().map(f32::to_bits));
                words.extend(f.inside().map(f32::to_bits));
            }
        }
    }
    words
}
