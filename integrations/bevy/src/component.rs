//! The component, and the settings and statistics of all surfaces.

use crate::detail::LevelOfDetail;
use crate::shape::Shape;
use bevy::asset::{Handle, uuid_handle};
use bevy::camera::visibility::{NoAutoAabb, Visibility};
use bevy::ecs::prelude::*;
use bevy::mesh::Mesh3d;
use bevy::pbr::{MeshMaterial3d, StandardMaterial};
use bevy::render::sync_world::SyncToRenderWorld;
use bevy::transform::components::Transform;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use tess_core::{Config, Partitioning};

/// A surface that is tessellated in each frame for each camera. Its look is that of its
/// [`MeshMaterial3d`]; without one it has `StandardMaterial::default()`.
#[derive(Clone, Component, Debug)]
// The mesh is empty; through it, Bevy finds the cameras and lights that see the surface.
#[require(Transform, Visibility, Mesh3d, SyncToRenderWorld, NoAutoAabb)]
#[require(MeshMaterial3d<StandardMaterial> = MeshMaterial3d(PLAIN))]
pub struct Tessellated {
    /// The surface's patches. Entities can share a shape, which is then stored once.
    pub shape: Arc<dyn Shape>,
    /// The rule for the number of segments of its edges.
    pub detail: LevelOfDetail,
    /// The rule by which factors become segments. With fractional ones, segments do not pop as the
    /// camera moves.
    pub partitioning: Partitioning,
}

/// The material of surfaces without one.
pub(crate) const PLAIN: Handle<StandardMaterial> =
    uuid_handle!("5c1e8a3e-0b0e-4f0b-9d3c-7a5be9a1d2f4");

impl Tessellated {
    /// A surface of this shape, with segments of 8 pixels.
    pub fn new(shape: impl Shape) -> Self {
        Self::shared(Arc::new(shape))
    }

    /// A surface of a shape that other entities share, with segments of 8 pixels.
    pub fn shared(shape: Arc<dyn Shape>) -> Self {
        Self { shape, detail: LevelOfDetail::default(), partitioning: Partitioning::FractionalEven }
    }

    /// The same surface with this level of detail.
    #[must_use]
    pub const fn with_detail(mut self, detail: LevelOfDetail) -> Self {
        self.detail = detail;
        self
    }

    pub(crate) fn config(&self) -> Config {
        Config::new(self.partitioning, self.shape.winding())
    }
}

/// Numbers of an entity that change from frame to frame, such as the time or joint matrices. The
/// WGSL reads them with `tess_value`, a [`CpuShape`](crate::CpuShape) with
/// [`Eye::value`](crate::Eye::value). Only those that change are uploaded. Keep their number
/// constant, because a new number moves the entity in the buffers.
#[derive(Clone, Component, Debug, Default, PartialEq)]
pub struct TessValues(pub Vec<f32>);

/// Settings for tessellating and drawing all surfaces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Resource)]
pub struct TessSettings {
    /// The processor that tessellates.
    pub backend: TessBackend,
    /// Whether edges are drawn instead of triangles. On the GPU, the device needs the feature
    /// `POLYGON_MODE_LINE`.
    pub wireframe: bool,
}

/// The processor that tessellates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TessBackend {
    /// The GPU if it has compute shaders, or else the CPU.
    #[default]
    Auto,
    /// The CPU, into ordinary meshes.
    Cpu,
}

/// Statistics of all surfaces: their triangles, a frame or two late on the GPU, and the uploaded
/// bytes.
#[derive(Clone, Debug, Default, Resource)]
pub struct TessStats(Arc<[AtomicU64; 2]>);

impl TessStats {
    /// Triangles of all surfaces and cameras.
    #[must_use]
    pub fn triangles(&self) -> u64 {
        self.0[0].load(Ordering::Relaxed)
    }

    /// Bytes of shapes, places, materials and values that the last frame uploaded; 0 on the CPU.
    /// The count leaves out the view of each camera, and 4 bytes per entity in frames in which
    /// entities came or went.
    #[must_use]
    pub fn uploaded(&self) -> u64 {
        self.0[1].load(Ordering::Relaxed)
    }

    pub(crate) fn set(&self, triangles: u64, uploaded: u64) {
        self.0[0].store(triangles, Ordering::Relaxed);
        self.0[1].store(uploaded, Ordering::Relaxed);
    }
}
