//! A shape that moves with the time: water.wgsl in Rust.

use bevy::camera::primitives::Aabb;
use bevy::math::{UVec2, Vec2, Vec3, Vec4, Vec4Swizzles, ops};
use bevy_tess::tess_core::{Domain, OutputPrimitive, PatchFactors};
use bevy_tess::{CpuShape, Eye, Shape, ShapeVertex, quad_factors};
use std::borrow::Cow;

const PATCHES: u32 = 16;

/// A square level of water of this size.
#[derive(Debug)]
pub(crate) struct Water(pub(crate) f32);

impl Water {
    fn place(&self, patch: u32, uv: Vec2) -> Vec2 {
        let cell = UVec2::new(patch % PATCHES, patch / PATCHES).as_vec2();
        ((cell + uv) / PATCHES as f32 - 0.5) * self.0
    }
}

impl Shape for Water {
    fn domain(&self) -> Domain {
        Domain::Quad
    }

    fn winding(&self) -> OutputPrimitive {
        OutputPrimitive::TriangleCcw
    }

    fn patches(&self) -> u32 {
        PATCHES * PATCHES
    }

    fn bounds(&self) -> Aabb {
        let corner = Vec3::new(0.5 * self.0, 0.11, 0.5 * self.0);
        Aabb::from_min_max(-corner, corner)
    }

    fn surface(&self) -> Cow<'static, str> {
        include_str!("water.wgsl").into()
    }

    fn words(&self) -> Vec<u32> {
        vec![self.0.to_bits()]
    }

    fn on_cpu(&self) -> Option<&dyn CpuShape> {
        Some(self)
    }
}

impl CpuShape for Water {
    fn factors(&self, patch: u32, eye: &Eye) -> PatchFactors {
        let [a, b, c, d] = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y].map(|uv| {
            let Vec2 { x, y: z } = self.place(patch, uv);
            eye.to_world(Vec3::new(x, 0.0, z))
        });
        let edges = [eye.edge(a, d), eye.edge(a, b), eye.edge(b, c), eye.edge(d, c)];
        PatchFactors::Quad(quad_factors(edges))
    }

    fn vertices(
        &self,
        patch: u32,
        eye: &Eye,
        points: &[[f32; 2]],
        vertices: &mut Vec<ShapeVertex>,
    ) {
        let seconds = eye.value(0);
        vertices.extend(points.iter().map(|&uv| {
            let place = self.place(patch, uv.into());
            let one = |wave: Vec4| {
                let (sin, cos) = ops::sin_cos(wave.xy().dot(place) + wave.w * seconds);
                wave.z * Vec3::new(sin, wave.x * cos, wave.y * cos)
            };
            let wave = one(Vec4::new(1.1, 0.6, 0.05, 1.4))
                + one(Vec4::new(-0.5, 1.7, 0.04, 1.9))
                + one(Vec4::new(2.3, -1.9, 0.02, 2.6));
            ShapeVertex {
                position: [place.x, wave.x, place.y],
                normal: Vec3::new(-wave.y, 1.0, -wave.z).normalize().to_array(),
                uv,
                color: [1.0; 4],
            }
        }));
    }
}
