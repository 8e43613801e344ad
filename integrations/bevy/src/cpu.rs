//! Tessellation on the CPU: surfaces become ordinary meshes, with the same domain points as on the
//! GPU.

use crate::component::{TessSettings, TessStats, TessValues, Tessellated};
use crate::eye::{Casting, Eye, View};
use crate::is_on_cpu;
use crate::shape::ShapeVertex;
use bevy::asset::{Assets, Handle, RenderAssetUsages};
use bevy::camera::primitives::Aabb;
use bevy::camera::{Camera, Camera3d};
use bevy::ecs::prelude::*;
use bevy::log::warn_once;
use bevy::math::Vec3A;
use bevy::mesh::{Indices, Mesh, Mesh3d, PrimitiveTopology};
use bevy::pbr::{MeshMaterial3d, StandardMaterial, StandardMaterialKey};
use bevy::platform::collections::HashMap;
use bevy::render::renderer::RenderDevice;
use bevy::transform::components::GlobalTransform;
use tess_core::{Config, PatchFactors};
use tess_simd::{Numbering, Output, Tessellator};

/// A tessellator for each configuration, kept because it holds tables.
#[derive(Debug, Default, Resource)]
pub(crate) struct Tessellators {
    all: HashMap<Config, Tessellator>,
    output: Output<[f32; 2], u32>,
}

/// Vertices and indices of a surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Tessellation {
    pub(crate) vertices: Vec<ShapeVertex>,
    pub(crate) indices: Vec<u32>,
}

impl Tessellators {
    /// Tessellates the patches with these factors; `vertices_of` appends a patch's vertices at
    /// domain points.
    pub(crate) fn run(
        &mut self,
        config: Config,
        factors: &[PatchFactors],
        mut vertices_of: impl FnMut(u32, &[[f32; 2]], &mut Vec<ShapeVertex>),
    ) -> Result<Tessellation, tess_simd::Error> {
        let tessellator = self.all.entry(config).or_insert_with(|| Tessellator::new(config));
        let numbering = Numbering::PerBatch { base_vertex: 0 };
        tessellator.tessellate(factors, numbering, &mut self.output)?;
        let mut vertices = Vec::with_capacity(self.output.points().len());
        for patch in 0..factors.len() {
            if let (Some((points, _)), Ok(number)) =
                (self.output.patch(patch), u32::try_from(patch))
            {
                vertices_of(number, points, &mut vertices);
            }
        }
        Ok(Tessellation { vertices, indices: self.output.indices().to_vec() })
    }
}

/// The mesh of a surface: its triangles, or a line for each of their edges.
pub(crate) fn mesh(of: Tessellation, topology: PrimitiveTopology) -> Mesh {
    let Tessellation { vertices, indices } = of;
    let indices = match topology {
        PrimitiveTopology::LineList => {
            let edges = |&[a, b, c]: &[u32; 3]| [a, b, b, c, c, a];
            indices.as_chunks().0.iter().flat_map(edges).collect()
        }
        _ => indices,
    };
    let each = |of: fn(&ShapeVertex) -> [f32; 3]| vertices.iter().map(of).collect::<Vec<_>>();
    let uvs: Vec<[f32; 2]> = vertices.iter().map(|vertex| vertex.uv).collect();
    let colors: Vec<[f32; 4]> = vertices.iter().map(|vertex| vertex.color).collect();
    Mesh::new(topology, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, each(|vertex| vertex.position))
        .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, each(|vertex| vertex.normal))
        .with_inserted_attribute(Mesh::ATTRIBUTE_UV_0, uvs)
        .with_inserted_attribute(Mesh::ATTRIBUTE_COLOR, colors)
        .with_inserted_indices(Indices::U32(indices))
}

/// An entity's mesh and everything that it was made from. When that changes, the mesh is replaced.
#[derive(Clone, Component, Debug)]
pub(crate) struct Fallback {
    eye: Eye<'static>,
    wireframe: bool,
    has_tangents: bool,
    triangles: u64,
    mesh: Handle<Mesh>,
}

type CpuSurface<'a> = (
    Entity,
    Ref<'a, Tessellated>,
    Option<Ref<'a, TessValues>>,
    &'a GlobalTransform,
    Option<&'a MeshMaterial3d<StandardMaterial>>,
    Option<&'a mut Fallback>,
);

/// Makes the meshes if the CPU tessellates, and removes them otherwise.
#[expect(clippy::too_many_arguments, reason = "a system's parameters are what it uses")]
pub(crate) fn tessellate(
    mut commands: Commands,
    (settings, casting): (Res<TessSettings>, Res<Casting>),
    stats: Res<TessStats>,
    device: Option<Res<RenderDevice>>,
    cameras: Query<(&Camera, &GlobalTransform), With<Camera3d>>,
    mut surfaces: Query<CpuSurface<'_>>,
    mut tessellators: ResMut<Tessellators>,
    mut meshes: ResMut<Assets<Mesh>>,
    materials: Res<Assets<StandardMaterial>>,
) {
    if !is_on_cpu(&settings, device.as_deref()) {
        for (entity, .., fallback) in &surfaces {
            if fallback.is_some() {
                let mut entity = commands.entity(entity);
                entity.remove::<Fallback>();
                entity.insert(Mesh3d::default());
            }
        }
        return;
    }
    let Some(view) = view_of(&cameras, &casting) else { return };
    let mut triangles = 0;
    for (entity, surface, values, transform, material, mut fallback) in &mut surfaces {
        let rule = surface.detail;
        let eye = Eye { view, world_from_local: transform.affine(), rule, values: &[] };
        if is_unseen(&surface, &eye) {
            continue;
        }
        let wireframe = settings.wireframe;
        let material = material.and_then(|material| materials.get(material));
        let has_tangents = !wireframe && material.is_some_and(wants_tangents);
        let is_same = |old: &Fallback| {
            old.eye == eye && old.wireframe == wireframe && old.has_tangents == has_tangents
        };
        let is_changed =
            surface.is_changed() || values.as_ref().is_some_and(|values| values.is_changed());
        if let Some(old) = fallback.as_deref().filter(|old| is_same(old) && !is_changed) {
            triangles += old.triangles;
            continue;
        }
        let values = values.as_ref().map_or(&[][..], |values| &values.0);
        let seen = Eye { values, ..eye };
        let Some(tessellation) = tessellate_one(&surface, &seen, &mut tessellators) else {
            continue;
        };
        let count = tessellation.indices.len() as u64 / 3;
        triangles += count;
        let topology = match wireframe {
            true => PrimitiveTopology::LineList,
            false => PrimitiveTopology::TriangleList,
        };
        let mut made = mesh(tessellation, topology);
        if has_tangents && let Err(problem) = made.generate_tangents() {
            warn_once!("a surface has no tangents: {problem}");
        }
        let of = |mesh| Fallback { eye, wireframe, has_tangents, triangles: count, mesh };
        if let Some(old) = fallback.as_deref_mut() {
            *old = of(old.mesh.clone());
            if meshes.insert(&old.mesh, made).is_err() {
                warn_once!("the mesh of a surface is gone");
            }
            continue;
        }
        let handle = meshes.add(made);
        commands.entity(entity).insert((Mesh3d(handle.clone()), of(handle)));
    }
    stats.set(triangles, 0);
}

/// Whether a material needs tangents, as in render/pipelines.rs.
fn wants_tangents(material: &StandardMaterial) -> bool {
    StandardMaterialKey::from(material).intersects(
        StandardMaterialKey::NORMAL_MAP
            | StandardMaterialKey::CLEARCOAT_NORMAL_MAP
            | StandardMaterialKey::ANISOTROPY,
    )
}

/// Whether the camera sees neither a surface nor its shadow; the surface then keeps its mesh, if it
/// has one.
fn is_unseen(surface: &Tessellated, eye: &Eye) -> bool {
    let Aabb { center, half_extents } = surface.shape.bounds();
    let corners =
        [-1.0, 1.0].map(|x| [-1.0, 1.0].map(|y| [-1.0, 1.0].map(|z| Vec3A::new(x, y, z))));
    let middle = eye.to_world(center.into());
    let away =
        |corner: &Vec3A| middle.distance(eye.to_world((center + *corner * half_extents).into()));
    let radius = corners.as_flattened().as_flattened().iter().map(away).fold(0.0, f32::max);
    eye.is_unseen(middle, radius)
}

/// The view of the first camera that is active.
fn view_of(
    cameras: &Query<(&Camera, &GlobalTransform), With<Camera3d>>,
    casting: &Casting,
) -> Option<View> {
    let active = |&(camera, _): &(&Camera, &GlobalTransform)| camera.is_active;
    let (camera, transform) = cameras.iter().find(active)?;
    let height = camera.physical_viewport_size()?.y;
    Some(View::new(transform, camera.clip_from_view(), height, casting))
}

fn tessellate_one(
    surface: &Tessellated,
    eye: &Eye,
    tessellators: &mut Tessellators,
) -> Option<Tessellation> {
    let Some(shape) = surface.shape.on_cpu() else {
        warn_once!("a shape has no Rust form (Shape::on_cpu) and is not drawn without compute");
        return None;
    };
    let factors: Vec<_> =
        (0..surface.shape.patches()).map(|patch| shape.factors(patch, eye)).collect();
    tessellators
        .run(surface.config(), &factors, |patch, points, vertices| {
            shape.vertices(patch, eye, points, vertices);
        })
        .inspect_err(|problem| warn_once!("a surface cannot be tessellated: {problem}"))
        .ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wireframe_has_the_edges_of_each_triangle() {
        let vertices = vec![ShapeVertex::default(); 4];
        let made = Tessellation { vertices, indices: vec![0, 1, 2, 2, 1, 3] };
        let lines = mesh(made.clone(), PrimitiveTopology::LineList);
        let expected = Indices::U32(vec![0, 1, 1, 2, 2, 0, 2, 1, 1, 3, 3, 2]);
        assert_eq!(lines.indices(), Some(&expected), "three lines each");
        let triangles = mesh(made, PrimitiveTopology::TriangleList);
        assert_eq!(
            triangles.indices(),
            Some(&Indices::U32(vec![0, 1, 2, 2, 1, 3])),
            "as they were"
        );
    }
}
