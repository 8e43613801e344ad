//! Patches on a surface: their factors, what they are on the CPU, and what the GPU needs to draw
//! them.

use crate::gpu::GpuBatch;
use crate::thrown;
use std::f32::consts::TAU;
use tess_core::{Config, OutputPrimitive, Partitioning, PatchFactors};
use tess_gpu::layout::factor_words;
use tess_gpu::surfaces;
use tess_simd::{ExactOutput, Numbering, Tessellator};
use tess_surface::glam::{Vec3, Vec4};
use tess_surface::{Face, FactorRule, Model, PolygonMesh, Sample, Sides, Style, Surface, teapot};
use tess_verify::Named;
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

/// A model, the factors of its patches, and its last tessellation on the CPU.
#[wasm_bindgen]
#[derive(Debug)]
pub struct SurfaceView {
    model: Model,
    config: Config,
    factors: Vec<PatchFactors>,
    vertices: Vec<Sample>,
    indices: Vec<u32>,
}

#[wasm_bindgen]
impl SurfaceView {
    /// The surface `flat`, `teapot` or `terrain`, with factors of 1. Errors: another name.
    #[wasm_bindgen(constructor)]
    pub fn new(name: &str) -> Result<Self, JsError> {
        let model = match name {
            "flat" => Model::polygons(grid(4, |_, _| 0.0), Style::Flat)?,
            "teapot" => Model::bezier(teapot::patches())?,
            "terrain" => Model::polygons(grid(16, hills), Style::PointNormal)?,
            other => {
                return Err(thrown(format!("unknown surface {other}: flat, teapot or terrain")));
            }
        };
        let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
        let (factors, vertices, indices) = (Vec::new(), Vec::new(), Vec::new());
        let mut view = Self { model, config, factors, vertices, indices };
        view.set_factors(Partitioning::Integer.name(), FactorRule::Uniform(1.0))?;
        Ok(view)
    }

    /// Centre and radius of a sphere around the model.
    pub fn sphere(&self) -> Vec<f32> {
        let (low, high) = self.model.bounds();
        let centre = low.midpoint(high);
        vec![centre.x, centre.y, centre.z, centre.distance(high)]
    }

    /// How many patches there are.
    pub fn patches(&self) -> usize {
        self.model.len()
    }

    /// Gives all patches one factor everywhere. Errors: an unknown partitioning.
    pub fn uniform(&mut self, partitioning: &str, factor: f32) -> Result<(), JsError> {
        self.set_factors(partitioning, FactorRule::Uniform(factor))
    }

    /// Gives all patches factors by the distance from an eye; `scale` is the factor at distance 1.
    /// Errors: an unknown partitioning.
    pub fn by_distance(
        &mut self,
        partitioning: &str,
        scale: f32,
        x: f32,
        y: f32,
        z: f32,
    ) -> Result<(), JsError> {
        let eye = Vec3::new(x, y, z);
        self.set_factors(partitioning, FactorRule::Distance { eye, scale })
    }

    /// Tessellates on the CPU, and evaluates every point. Errors: the output is too large for this
    /// machine.
    pub fn tessellate(&mut self) -> Result<(), JsError> {
        let mut output = ExactOutput::new();
        let numbering = Numbering::PerBatch { base_vertex: 0 };
        Tessellator::new(self.config).tessellate(&self.factors, numbering, &mut output)?;
        self.evaluate(&output);
        self.indices = output.indices().to_vec();
        Ok(())
    }

    /// x, y and z of each vertex.
    pub fn positions(&self) -> Vec<f32> {
        self.vertices.iter().flat_map(|vertex| vertex.position.to_array()).collect()
    }

    /// The unit normal of each vertex.
    pub fn normals(&self) -> Vec<f32> {
        self.vertices.iter().flat_map(|vertex| vertex.normal.to_array()).collect()
    }

    /// Three vertices for each triangle.
    pub fn indices(&self) -> Vec<u32> {
        self.indices.clone()
    }

    /// The patches as a batch for the GPU, with room for any factors.
    pub fn batch(&self) -> GpuBatch {
        GpuBatch::to_draw(self.config, &self.factors)
    }

    /// The raw factors, as the batch's buffer `Factors` holds them.
    pub fn factor_words(&self) -> Vec<u32> {
        factor_words(&self.factors)
    }

    /// Words that the WGSL of [`Self::wgsl`] reads: 16 control points of each patch, x, y, z and 1,
    /// rows along v; then, where there are any, 4 corner and 4 edge normals of each patch, with a
    /// fourth number of 0.
    pub fn nets(&self) -> Vec<f32> {
        let surfaces = || (0..self.model.len()).map(|number| *self.model.patch(number).surface());
        let points = surfaces().flat_map(|surface| net(&surface)).flat_map(|p| p.to_array());
        let normals = surfaces().filter_map(|surface| match surface {
            Surface::PnQuad(quad) => Some([quad.corner_normals, quad.edge_normals]),
            _ => None,
        });
        let normals = normals.flatten().flatten().flat_map(|normal| normal.extend(0.0).to_array());
        points.chain(normals).collect()
    }

    /// WGSL with the functions `surface_position` and `surface_normal` of a patch's number, u and
    /// v. They read `nets`, an array of `vec4f`, which the caller declares.
    pub fn wgsl(&self) -> String {
        let normal = match self.model.patch(0).surface() {
            Surface::PnQuad(_) => {
                [surfaces::PN_EDGE, surfaces::POINT_NORMAL, POINT_NORMAL].join("\n")
            }
            _ => BEZIER_NORMAL.to_owned(),
        };
        let net = NET.replace("COUNT", &self.model.len().to_string());
        [surfaces::BEZIER, &net, &normal].join("\n")
    }
}

const NET: &str = "
const PATCHES = COUNTu;
fn net_of(number: u32) -> array<vec4f, 16> {
    var net: array<vec4f, 16>;
    for (var k = 0u; k < 16u; k++) {
        net[k] = nets[16u * number + k];
    }
    return net;
}
fn surface_position(number: u32, u: f32, v: f32) -> vec3f {
    return bezier_patch_position(net_of(number), u, v);
}";

const BEZIER_NORMAL: &str = "
fn surface_normal(number: u32, u: f32, v: f32) -> vec3f {
    return bezier_patch_normal(net_of(number), u, v);
}";

const POINT_NORMAL: &str = "
fn normals_of(first: u32) -> array<vec3f, 4> {
    return array<vec3f, 4>(
        nets[first].xyz, nets[first + 1u].xyz, nets[first + 2u].xyz, nets[first + 3u].xyz);
}
fn surface_normal(number: u32, u: f32, v: f32) -> vec3f {
    let first = 16u * PATCHES + 8u * number;
    return pn_quad_normal(normals_of(first), normals_of(first + 4u), u, v);
}";

/// The bicubic control points of a quad patch; a bilinear one's are raised to that degree.
#[expect(clippy::float_arithmetic, reason = "coordinates")]
fn net(surface: &Surface) -> Vec<Vec4> {
    match surface {
        Surface::Bezier(patch) => patch.points.concat(),
        Surface::PnQuad(quad) => quad.patch.points.concat(),
        Surface::Bilinear([a, b, c, d]) => {
            let at = |k: u8| f32::from(k) / 3.0;
            let point = |(row, column): (u8, u8)| {
                a.lerp(*b, at(column)).lerp(d.lerp(*c, at(column)), at(row)).extend(1.0)
            };
            (0..4).flat_map(|row| (0..4).map(move |column| (row, column))).map(point).collect()
        }
        _ => unreachable!("the surfaces of the page are quads"),
    }
}

impl SurfaceView {
    fn set_factors(&mut self, partitioning: &str, rule: FactorRule) -> Result<(), JsError> {
        let partitioning = Partitioning::from_name(partitioning).map_err(thrown)?;
        let of_patch = |number| rule.factors(&self.model, number, partitioning);
        self.factors = (0..self.model.len()).map(of_patch).collect();
        self.config = Config::new(partitioning, OutputPrimitive::TriangleCw);
        Ok(())
    }

    /// Every patch's domain points on its surface.
    fn evaluate(&mut self, output: &ExactOutput) {
        let all: Vec<[f32; 2]> = output.points().iter().map(|point| point.to_f32()).collect();
        let mut vertices = vec![Sample::default(); all.len()];
        for (number, range) in output.ranges().iter().enumerate() {
            let own = range.first_point as usize..(range.first_point + range.points) as usize;
            let (points, samples) = (&all[own.clone()], &mut vertices[own]);
            self.model.patch(number).samples(points, samples);
        }
        self.vertices = vertices;
    }
}

/// A square of `side` times `side` quads, 4 units wide, with z up; `height` takes the place in the
/// square, from 0 to 1.
#[expect(clippy::float_arithmetic, reason = "coordinates")]
fn grid(side: u16, height: fn(f32, f32) -> f32) -> PolygonMesh {
    let along = |k: u16| f32::from(k) / f32::from(side);
    let corners = (0..=side).flat_map(|y| (0..=side).map(move |x| (x, y)));
    let corner = |x: u16, y: u16| u32::from(y) * u32::from(side + 1) + u32::from(x);
    let quad = |x: u16, y: u16| {
        let positions =
            Sides::Quad([corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)]);
        Face { positions, normals: None, texcoords: None }
    };
    let place = |(x, y): (u16, u16)| {
        let (x, y) = (along(x), along(y));
        Vec3::new(4.0 * x - 2.0, 4.0 * y - 2.0, height(x, y))
    };
    PolygonMesh {
        positions: corners.map(place).collect(),
        faces: (0..side)
            .flat_map(|y| (0..side).map(move |x| (x, y)))
            .map(|(x, y)| quad(x, y))
            .collect(),
        ..PolygonMesh::default()
    }
}

/// Hills whose opposite borders fit.
#[expect(clippy::float_arithmetic, reason = "heights")]
fn hills(x: f32, y: f32) -> f32 {
    let wave = |turns: f32, along: f32, phase: f32| libm::sinf(TAU * (turns * along + phase));
    0.4 * wave(1.0, x, 0.1) * wave(1.0, y, 0.3)
        + 0.22 * wave(2.0, x, 0.7) * wave(3.0, y, 0.2)
        + 0.08 * wave(5.0, x, 0.4) * wave(4.0, y, 0.9)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_surface_has_triangles_of_its_vertices() {
        for name in ["flat", "teapot", "terrain"] {
            let mut view = SurfaceView::new(name).expect("a surface");
            let eye = Vec3::new(3.0, 1.0, 2.0);
            for rule in [FactorRule::Uniform(3.0), FactorRule::Distance { eye, scale: 20.0 }] {
                view.set_factors("fractional_odd", rule).expect("a partitioning");
                view.tessellate().expect("tessellates");
                let count = view.vertices.len();
                assert!(!view.indices.is_empty(), "{name} has triangles");
                assert!(view.indices.iter().all(|&i| (i as usize) < count), "{name}");
                assert!(view.vertices.iter().all(|v| v.position.is_finite()), "{name}");
            }
        }
    }

    /// The nets that the GPU evaluates are the surfaces that the CPU does.
    #[test]
    fn every_surface_is_its_net() {
        for name in ["flat", "teapot", "terrain"] {
            let view = SurfaceView::new(name).expect("a surface");
            for number in 0..view.model.len() {
                let patch = view.model.patch(number);
                let points = net(patch.surface());
                let row = |k: usize| [0, 1, 2, 3].map(|column| points[4 * k + column]);
                let rows = [0, 1, 2, 3].map(row);
                let bezier = tess_surface::BezierPatch { points: rows };
                for (u, v) in [(0.25, 0.5), (0.875, 0.125), (0.4, 0.7)] {
                    let (here, there) = (patch.frame(u, v).position, bezier.frame(u, v).position);
                    assert!(here.distance(there) < 1e-5, "{name} {number}: {here} and {there}");
                }
            }
            let normals = view.nets().len() - 64 * view.model.len();
            let expected = if name == "terrain" { 32 * view.model.len() } else { 0 };
            assert_eq!(normals, expected, "{name}: normals of point-normal quads");
        }
    }
}
