//! The component, and what the user sets for all of them.

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

/// A surface that is tessellated in each frame, by what each camera sees of it. It looks as its
/// [`MeshMaterial3d`] says; without one it has `StandardMaterial::default()`.
#[derive(Clone, Component, Debug)]
// The mesh is empty; Bevy finds the cameras and lights that see it.
#[require(Transform, Visibility, Mesh3d, SyncToRenderWorld, NoAutoAabb)]
#[require(MeshMaterial3d<StandardMaterial> = MeshMaterial3d(PLAIN))]
pub struct Tessellated {
    /// Its patches. Share them between entities that look alike in shape: they are then kept once.
    pub shape: Arc<dyn Shape>,
    /// How many segments its edges get.
    pub detail: LevelOfDetail,
    /// How factors become segments. Fractional ones do not pop as the camera moves.
    pub partitioning: Partitioning,
}

/// The material of surfaces without one.
pub(crate) const PLAIN: Handle<StandardMaterial> =
    uuid_handle!("5c1e8a3e-0b0e-4f0b-9d3c-7a5be9a1d2f4");

impl Tessellated {
    /// A surface of this shape, in segments of 8 pixels.
    pub fn new(shape: impl Shape) -> Self {
        Self::shared(Arc::new(shape))
    }

    /// The same of a shape that other entities have too.
    pub fn shared(shape: Arc<dyn Shape>) -> Self {
        Self { shape, detail: LevelOfDetail::default(), partitioning: Partitioning::FractionalEven }
    }

    /// The same surface with this many segments.
    #[must_use]
    pub const fn with_detail(mut self, detail: LevelOfDetail) -> Self {
        self.detail = detail;
        self
    }

    pub(crate) fn config(&self) -> Config {
        Config::new(self.partitioning, self.shape.winding())
    }
}

/// Numbers of an entity that change from frame to frame: the time, joint matrices. The surface
/// reads them with `tess_value`, its Rust form with [`Eye::value`](crate::Eye::value). Only those
/// that change are uploaded; keep their number.
#[derive(Clone, Component, Debug, Default, PartialEq)]
pub struct TessValues(pub Vec<f32>);

/// How surfaces are tessellated and drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Resource)]
pub struct TessSettings {
    /// Who tessellates.
    pub backend: TessBackend,
    /// Whether edges are drawn in place of triangles. On the GPU the device must have the feature
    /// `POLYGON_MODE_LINE`.
    pub wireframe: bool,
}

/// Who tessellates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TessBackend {
    /// The GPU if it has compute shaders, or else the CPU.
    #[default]
    Auto,
    /// The CPU, into ordinary meshes.
    Cpu,
}

/// How many triangles the surfaces had lately, a frame or two late on the GPU, and what was
/// uploaded for them.
#[derive(Clone, Debug, Default, Resource)]
pub struct TessStats(Arc<[AtomicU64; 2]>);

impl TessStats {
    /// Triangles of all surfaces and cameras.
    #[must_use]
    pub fn triangles(&self) -> u64 {
        self.0[0].load(Ordering::Relaxed)
    }

    /// Bytes of shapes, places, materials and values that the last frame uploaded; 0 on the CPU. It
    /// uploads the view of each camera too, and 4 bytes an entity if entities came or went.
    #[must_use]
    pub fn uploaded(&self) -> u64 {
        self.0[1].load(Ordering::Relaxed)
    }

    pub(crate) fn set(&self, triangles: u64, uploaded: u64) {
        self.0[0].store(triangles, Ordering::Relaxed);
        self.0[1].store(uploaded, Ordering::Relaxed);
    }
}
