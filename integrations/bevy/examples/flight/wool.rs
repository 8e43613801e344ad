//! A shape with hull and domain functions of its own: a rounded mesh, covered with wool, which
//! nods.

use bevy::camera::primitives::Aabb;
use bevy::math::{Mat4, Vec3, Vec4, ops};
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

    fn vertices(
        &self,
        patch: u32,
        eye: &Eye,
        points: &[[f32; 2]],
        vertices: &mut Vec<ShapeVertex>,
    ) {
        let samples = self.0.points_of(patch, points);
        let rows = [0, 4, 8].map(|n| [0, 1, 2, 3].map(|k| eye.value(n + k)));
        let joint = Mat4::from_cols_array_2d(&[rows[0], rows[1], rows[2], [0.0; 4]]).transpose();
        vertices.extend(points.iter().zip(samples).map(|(&uv, [at, normal])| {
            let high = height(at);
            let rise =
                [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| (height(at + STEP * axis) - high) / STEP);
            let rise = Vec3::from(rise);
            let bent = normal - (rise - rise.dot(normal) * normal);
            let skinned = |v: Vec4| v.lerp(joint * v, smoothstep(1.5, 2.1, at.z)).truncate();
            ShapeVertex {
                position: skinned((at + high * normal).extend(1.0)).to_array(),
                normal: skinned(bent.extend(0.0)).normalize().to_array(),
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
    let (brown, cream) = (Vec3::new(0.55, 0.24, 0.09), Vec3::new(0.89, 0.69, 0.45));
    brown.lerp(cream, smoothstep(1.9, 2.3, at.z)).extend(1.0)
}

fn smoothstep(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The matrix of the head's joint after a number of seconds, as three rows.
pub(crate) fn nod(seconds: f32) -> Vec<f32> {
    let neck = Mat4::from_translation(Vec3::new(0.5, 0.17, 1.6));
    let joint = neck * Mat4::from_rotation_x(0.4 * ops::sin(2.0 * seconds)) * neck.inverse();
    joint.transpose().to_cols_array()[..12].to_vec()
}
