//! A shape with hull and domain functions of its own: a rounded mesh, covered with wool.

use bevy::camera::primitives::Aabb;
use bevy::math::{Vec3, Vec4, ops};
use bevy_tess::tess_core::{Domain, PatchFactors};
use bevy_tess::{CpuShape, Eye, PointNormalMesh, Shape, ShapeVertex};
use std::borrow::Cow;

/// A woolly mesh.
#[derive(Debug)]
pub(crate) struct Wool(pub(crate) PointNormalMesh);

impl Shape for Wool {
    fn domain(&self) -> Domain {
        self.0.domain()
    }

    fn patches(&self) -> u32 {
        self.0.patches()
    }

    fn bounds(&self) -> Aabb {
        self.0.bounds()
    }

    fn surface(&self) -> Cow<'static, str> {
        Cow::Owned([&PointNormalMesh::functions(), include_str!("wool.wgsl")].join("\n"))
    }

    fn words(&self) -> Vec<u32> {
        self.0.words()
    }

    fn on_cpu(&self) -> Option<&dyn CpuShape> {
        Some(self)
    }
}

/// wool.wgsl in Rust.
impl CpuShape for Wool {
    fn factors(&self, patch: u32, eye: &Eye) -> PatchFactors {
        PatchFactors::Triangle(self.0.factors_of(patch, eye))
    }

    fn vertices(&self, patch: u32, points: &[[f32; 2]], vertices: &mut Vec<ShapeVertex>) {
        let samples = self.0.points_of(patch, points);
        vertices.extend(points.iter().zip(samples).map(|(&uv, [at, normal])| {
            let high = height(at);
            let rise =
                [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| (height(at + STEP * axis) - high) / STEP);
            let rise = Vec3::from(rise);
            let bent = normal - (rise - rise.dot(normal) * normal);
            ShapeVertex {
                position: (at + high * normal).to_array(),
                normal: bent.normalize().to_array(),
                uv,
                color: color(at).to_array(),
            }
        }));
    }
}

const STEP: f32 = 0.001;

fn height(at: Vec3) -> f32 {
    let p = 27.0 * at;
    let waves = ops::sin(p.x) * ops::sin(p.y + 0.7 * ops::sin(p.z))
        + 0.6 * ops::sin(1.7 * p.z + p.x) * ops::cos(1.9 * p.y);
    0.014 * waves
}

fn color(at: Vec3) -> Vec4 {
    let t = ((at.z - 1.9) / 0.4).clamp(0.0, 1.0);
    let (brown, cream) = (Vec3::new(0.55, 0.24, 0.09), Vec3::new(0.89, 0.69, 0.45));
    brown.lerp(cream, t * t * (3.0 - 2.0 * t)).extend(1.0)
}
