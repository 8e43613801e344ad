//! Bevy's picking: rays are tested against triangles that the CPU makes with a shape's Rust
//! functions.

use crate::component::{TessValues, Tessellated};
use crate::cpu::Tessellators;
use crate::eye::{Casting, Eye, View};
use crate::shape::{CpuShape, Shape, ShapeVertex};
use bevy::camera::Camera;
use bevy::camera::primitives::Aabb;
use bevy::camera::visibility::{RenderLayers, ViewVisibility};
use bevy::ecs::prelude::*;
use bevy::log::warn_once;
use bevy::math::{Mat3, Vec2, Vec3, Vec3A};
use bevy::picking::Pickable;
use bevy::picking::backend::ray::RayMap;
use bevy::picking::backend::{HitData, PointerHits};
use bevy::picking::mesh_picking::ray_cast::{
    Backfaces, RayMeshHit, ray_aabb_intersection_3d, ray_mesh_intersection,
};
use bevy::platform::collections::HashMap;
use bevy::shape::{Aabb3d, Ray3d};
use bevy::transform::components::GlobalTransform;
use std::sync::Arc;
use tess_core::{Config, Partitioning, PatchFactors};

/// The factor of the triangles against which rays are tested.
const FACTOR: f32 = 16.0;

/// Domain points and triangles of a patch.
#[derive(Debug, Default)]
struct Grid {
    points: Vec<[f32; 2]>,
    indices: Vec<u32>,
}

/// The boxes of an entity's patches, in local space. A box encloses the triangles of the patch's
/// [`Grid`].
#[derive(Debug)]
pub(crate) struct Boxes {
    shape: Arc<dyn Shape>,
    values: Vec<f32>,
    all: Vec<Aabb3d>,
}

type PickedSurface<'a> = (
    Entity,
    &'a Tessellated,
    (&'a GlobalTransform, &'a Aabb, &'a ViewVisibility),
    Option<&'a TessValues>,
    Option<&'a RenderLayers>,
    Option<&'a Pickable>,
);

/// Reports to Bevy the surfaces under the pointers.
pub(crate) fn pick(
    rays: Res<RayMap>,
    cameras: Query<(&Camera, &GlobalTransform, Option<&RenderLayers>)>,
    surfaces: Query<PickedSurface<'_>>,
    mut tessellators: ResMut<Tessellators>,
    mut known: Local<HashMap<Entity, Boxes>>,
    mut hits: MessageWriter<PointerHits>,
) {
    known.retain(|entity, _| surfaces.contains(*entity));
    for (id, ray) in rays.iter() {
        let Ok((camera, at, layers)) = cameras.get(id.camera) else { continue };
        let Some(size) = camera.physical_viewport_size() else { continue };
        let view = View::new(at, camera.clip_from_view(), size.y, &Casting::default());
        let mut picks = Vec::new();
        for (entity, surface, (transform, bounds, visible), values, own, pickable) in &surfaces {
            let is_there = visible.get()
                && layers.unwrap_or_default().intersects(own.unwrap_or_default())
                && pickable.is_none_or(|pickable| pickable.is_hoverable);
            let world_from_local = transform.affine();
            let bounds = Aabb3d { min: bounds.min(), max: bounds.max() };
            if !is_there || ray_aabb_intersection_3d(*ray, &bounds, &world_from_local).is_none() {
                continue;
            }
            let Some(shape) = surface.shape.on_cpu() else {
                warn_once!("a shape has no Rust form (Shape::on_cpu) and cannot be picked");
                continue;
            };
            let values = values.map_or(&[][..], |values| &values.0);
            let eye = Eye { view, world_from_local, rule: surface.detail, values };
            let grid = grid(surface, &mut tessellators);
            let is_same =
                |old: &Boxes| Arc::ptr_eq(&old.shape, &surface.shape) && old.values == values;
            if !known.get(&entity).is_some_and(is_same) {
                let all = boxes(surface, shape, &eye, &grid);
                let (shape, values) = (Arc::clone(&surface.shape), values.to_vec());
                known.insert(entity, Boxes { shape, values, all });
            }
            if let Some([place, normal]) = hit(shape, &eye, *ray, &grid, &known[&entity].all) {
                let depth = ray.origin.distance(place);
                picks.push((entity, HitData::new(id.camera, depth, Some(place), Some(normal))));
            }
        }
        if !picks.is_empty() {
            hits.write(PointerHits::new(id.pointer, picks, camera.order as f32));
        }
    }
}

/// The grid that all patches of a surface share.
fn grid(surface: &Tessellated, tessellators: &mut Tessellators) -> Grid {
    let config = Config::new(Partitioning::Integer, surface.shape.winding());
    let factors = [PatchFactors::uniform(surface.shape.domain(), FACTOR)];
    let mut points = Vec::new();
    let made = tessellators.run(config, &factors, |_, all, _| points.extend_from_slice(all));
    made.map(|made| Grid { points, indices: made.indices }).unwrap_or_default()
}

fn vertices(
    shape: &dyn CpuShape,
    patch: u32,
    eye: &Eye<'_>,
    points: &[[f32; 2]],
) -> Vec<ShapeVertex> {
    let mut vertices = Vec::with_capacity(points.len());
    shape.vertices(patch, eye, points, &mut vertices);
    vertices
}

fn boxes(surface: &Tessellated, shape: &dyn CpuShape, eye: &Eye<'_>, grid: &Grid) -> Vec<Aabb3d> {
    let of = |patch| {
        let all = vertices(shape, patch, eye, &grid.points);
        let all = all.iter().map(|vertex| Vec3A::from(vertex.position));
        let min = all.clone().fold(Vec3A::MAX, Vec3A::min);
        Aabb3d { min, max: all.fold(Vec3A::MIN, Vec3A::max) }
    };
    (0..surface.shape.patches()).map(of).collect()
}

/// The nearest place at which a ray hits the front of a surface, and the normal there, in world
/// space. The place is on the surface itself, at the domain point where the ray hits a triangle of
/// the grid.
fn hit(
    shape: &dyn CpuShape,
    eye: &Eye<'_>,
    ray: Ray3d,
    Grid { points, indices }: &Grid,
    boxes: &[Aabb3d],
) -> Option<[Vec3; 2]> {
    let to_world = eye.world_from_local;
    let mut nearest: Option<(f32, u32, Vec2)> = None;
    for (patch, own) in (0..).zip(boxes) {
        if ray_aabb_intersection_3d(ray, own, &to_world).is_none() {
            continue;
        }
        let positions: Vec<_> =
            vertices(shape, patch, eye, points).iter().map(|vertex| vertex.position).collect();
        let (indices, uvs) = (Some(&indices[..]), Some(&points[..]));
        let found =
            ray_mesh_intersection(ray, &to_world, &positions, None, indices, uvs, Backfaces::Cull);
        if let Some(RayMeshHit { distance, uv: Some(uv), .. }) = found
            && nearest.is_none_or(|(least, ..)| distance < least)
        {
            nearest = Some((distance, patch, uv));
        }
    }
    let (_, patch, uv) = nearest?;
    let vertex = *vertices(shape, patch, eye, &[uv.to_array()]).first()?;
    let normal = Mat3::from(to_world.matrix3).inverse().transpose() * Vec3::from(vertex.normal);
    Some([to_world.transform_point3(vertex.position.into()), normal.normalize()])
}
