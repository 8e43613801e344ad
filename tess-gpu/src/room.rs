//! The conditions that a batch is planned for: a device's limits and the room for output.

use crate::setup::Setup;
use tess_core::{Patch, PatchFactors};

/// The limits of a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of one storage binding; should be at least 128 MiB. With a smaller limit, down to 4
    /// MiB, the tiles, the arguments and the catalogue of the largest batches may exceed it; all
    /// other bindings keep to it.
    pub storage_binding: u64,
    /// Workgroups along one dimension of a dispatch; should be at least 2048. Larger dispatches are
    /// laid out in rows of this length. A smaller limit, down to 1, is kept along x but not along
    /// y.
    pub workgroups: u32,
}

impl Limits {
    /// The limits that every WebGPU device supports.
    pub const WEBGPU: Self = Self { storage_binding: 128 << 20, workgroups: 65535 };
}

/// The room for a batch's output.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Capacity {
    /// Points, 8 bytes each.
    pub points: u32,
    /// Primitives, 1 to 3 indices each.
    pub primitives: u32,
}

impl Capacity {
    /// The most that `patches` patches can need, whatever their factors: up to 4225 points and 8192
    /// primitives each, and at most 2^32 - 1 of either in total.
    #[must_use]
    pub fn worst_case(setup: Setup, patches: u32) -> Self {
        Self::uniform(setup, patches, 64.0)
    }

    /// The room that `patches` patches need if all their factors are `factor`. Patches whose
    /// factors differ need no more than patches whose factors all equal the largest one.
    #[must_use]
    pub fn uniform(setup: Setup, patches: u32, factor: f32) -> Self {
        let counts = Patch::new(setup.config, PatchFactors::uniform(setup.domain, factor)).counts();
        Self {
            points: counts.points.saturating_mul(patches),
            primitives: counts.primitives.saturating_mul(patches),
        }
    }
}

/// A range of bytes of a buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// Offset of the first byte.
    pub offset: u64,
    /// Number of bytes.
    pub size: u64,
}
