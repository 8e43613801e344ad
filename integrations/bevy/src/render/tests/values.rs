//! Values of each frame.

use super::{SIZE, app, picture, run};
use crate::{
    CpuShape, DEFAULT_FRAGMENT, Eye, Shape, ShapeVertex, TessBackend, TessSettings, TessValues,
    Tessellated,
};
use bevy::camera::primitives::Aabb;
use bevy::prelude::*;
use std::borrow::Cow;
use tess_core::{Domain, PatchFactors};

/// A square that the second value moves to the right.
#[derive(Debug)]
struct Moved;

impl Shape for Moved {
    fn domain(&self) -> Domain {
        Domain::Quad
    }

    fn patches(&self) -> u32 {
        1
    }

    fn bounds(&self) -> Aabb {
        Aabb::from_min_max(Vec3::splat(-1.0), Vec3::splat(1.0))
    }

    fn surface(&self) -> Cow<'static, str> {
        "fn hull(number: u32) -> QuadFactors {
            return tess_quad_factors(vec4<f32>(2.0));
        }

        fn domain(number: u32, uv: vec2<f32>) -> Vertex {
            let at = tess_place(number);
            let local = vec3<f32>(0.3 * (uv - 0.5) + vec2<f32>(tess_value(at, 1u), 0.0), 0.0);
            return tess_vertex_of(at, local, vec3<f32>(0.0, 0.0, 1.0), uv, vec4<f32>(1.0));
        }"
        .into()
    }

    fn fragment(&self) -> Cow<'static, str> {
        DEFAULT_FRAGMENT.into()
    }

    fn words(&self) -> Vec<u32> {
        Vec::new()
    }

    fn on_cpu(&self) -> Option<&dyn CpuShape> {
        Some(self)
    }
}

impl CpuShape for Moved {
    fn factors(&self, _: u32, _: &Eye) -> PatchFactors {
        PatchFactors::uniform(Domain::Quad, 2.0)
    }

    fn vertices(&self, _: u32, eye: &Eye, points: &[[f32; 2]], vertices: &mut Vec<ShapeVertex>) {
        vertices.extend(points.iter().map(|&uv| ShapeVertex {
            position: [0.3 * (uv[0] - 0.5) + eye.value(1), 0.3 * (uv[1] - 0.5), 0.0],
            normal: [0.0, 0.0, 1.0],
            uv,
            color: [1.0; 4],
        }));
    }
}

/// Whether something is drawn to the left, in the middle and to the right; and the picture.
fn seen(app: &mut App) -> ([bool; 3], Vec<[u8; 4]>) {
    run(app);
    let pixels = picture(app);
    let middle = SIZE * SIZE / 2 + SIZE / 2;
    ([middle - 16, middle, middle + 16].map(|at| pixels[at as usize][0] > 0), pixels)
}

#[test]
fn both_ways_see_the_values_of_each_frame() {
    let [gpu, cpu] = [TessBackend::Auto, TessBackend::Cpu].map(|backend| {
        let mut app = app();
        app.insert_resource(TessSettings { backend, ..default() });
        let white = StandardMaterial { unlit: true, ..default() };
        let white = app.world_mut().resource_mut::<Assets<StandardMaterial>>().add(white);
        let square = (Tessellated::new(Moved), MeshMaterial3d(white));
        let values = |all: &[f32]| TessValues(all.to_vec());
        let left = app.world_mut().spawn((square.clone(), values(&[9.0, -0.4, 7.0]))).id();
        let right = app.world_mut().spawn((square, values(&[9.0, 0.4]))).id();
        let before = seen(&mut app);
        assert_eq!(before.0, [true, false, true], "{backend:?}");
        app.world_mut().entity_mut(right).insert(values(&[9.0, 0.0]));
        let moved = seen(&mut app);
        assert_eq!(moved.0, [true, true, false], "{backend:?}, moved");
        app.world_mut().entity_mut(right).insert(values(&[9.0, 0.4, 8.0]));
        assert_eq!(seen(&mut app), before, "{backend:?}, with one more, which nobody reads");
        app.world_mut().entity_mut(left).insert(values(&[9.0]));
        let fewer = seen(&mut app);
        assert_eq!(fewer.0, [false, true, true], "{backend:?}, 0 if there are fewer");
        [before.1, moved.1, fewer.1]
    });
    assert_eq!(gpu, cpu, "the pictures are the same");
}
