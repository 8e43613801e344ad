//! Patches on a surface, tessellated and evaluated on the CPU.

use crate::thrown;
use std::f32::consts::TAU;
use tess_core::{Config, OutputPrimitive, Partitioning, PatchFactors};
use tess_simd::{Numbering, Output, Tessellator};
use tess_surface::glam::Vec3;
use tess_surface::{Face, FactorRule, Model, PolygonMesh, Sample, Sides, Style, teapot};
use tess_verify::names::Named;
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

/// A model and its last tessellation.
#[wasm_bindgen]
#[derive(Debug)]
pub struct SurfaceView {
    model: Model,
    vertices: Vec<Sample>,
    indices: Vec<u32>,
}

#[wasm_bindgen]
impl SurfaceView {
    /// The surface `flat`, `teapot` or `terrain`.
    ///
    /// # Errors
    /// Another name.
    #[wasm_bindgen(constructor)]
    pub fn new(name: &str) -> Result<Self, JsError> {
        Self::named(name).map_err(thrown)
    }

    /// Centre and radius of a sphere around the model.
    #[must_use]
    pub fn sphere(&self) -> Vec<f32> {
        let (low, high) = self.model.bounds();
        let centre = low.midpoint(high);
        vec![centre.x, centre.y, centre.z, centre.distance(high)]
    }

    /// How many patches there are.
    #[must_use]
    pub fn patches(&self) -> usize {
        self.model.len()
    }

    /// Tessellates with one factor everywhere.
    ///
    /// # Errors
    /// An unknown partitioning.
    pub fn uniform(&mut self, partitioning: &str, factor: f32) -> Result<(), JsError> {
        self.tessellate(partitioning, FactorRule::Uniform(factor)).map_err(thrown)
    }

    /// Tessellates with factors by the distance from an eye; `scale` is the factor at distance 1.
    ///
    /// # Errors
    /// An unknown partitioning.
    pub fn by_distance(
        &mut self,
        partitioning: &str,
        scale: f32,
        x: f32,
        y: f32,
        z: f32,
    ) -> Result<(), JsError> {
        let eye = Vec3::new(x, y, z);
        self.tessellate(partitioning, FactorRule::Distance { eye, scale }).map_err(thrown)
    }

    /// x, y and z of each vertex.
    #[must_use]
    pub fn positions(&self) -> Vec<f32> {
        self.vertices.iter().flat_map(|vertex| vertex.position.to_array()).collect()
    }

    /// The unit normal of each vertex.
    #[must_use]
    pub fn normals(&self) -> Vec<f32> {
        self.vertices.iter().flat_map(|vertex| vertex.normal.to_array()).collect()
    }

    /// Three vertices for each triangle.
    #[must_use]
    pub fn indices(&self) -> Vec<u32> {
        self.indices.clone()
    }
}

impl SurfaceView {
    fn named(name: &str) -> Result<Self, String> {
        let error = |error: tess_surface::MeshError| error.to_string();
        let model = match name {
            "flat" => Model::polygons(grid(4, |_, _| 0.0), Style::Flat).map_err(error)?,
            "teapot" => Model::bezier(teapot::patches()).map_err(error)?,
            "terrain" => Model::polygons(grid(16, hills), Style::PointNormal).map_err(error)?,
            other => return Err(format!("unknown surface {other}: flat, teapot or terrain")),
        };
        Ok(Self { model, vertices: Vec::new(), indices: Vec::new() })
    }

    fn tessellate(&mut self, partitioning: &str, rule: FactorRule) -> Result<(), String> {
        let partitioning = Partitioning::from_name(partitioning).map_err(|e| e.to_string())?;
        let factors: Vec<PatchFactors> =
            (0..self.model.len()).map(|n| rule.factors(&self.model, n, partitioning)).collect();
        let config = Config::new(partitioning, OutputPrimitive::TriangleCw);
        let mut output: Output<[f32; 2], u32> = Output::new();
        let numbering = Numbering::PerBatch { base_vertex: 0 };
        Tessellator::new(config)
            .tessellate(&factors, numbering, &mut output)
            .map_err(|error| error.to_string())?;
        self.evaluate(&output);
        self.indices = output.indices().to_vec();
        Ok(())
    }

    /// Every patch's domain points on its surface.
    fn evaluate(&mut self, output: &Output<[f32; 2], u32>) {
        let mut vertices = vec![Sample::default(); output.points().len()];
        for (number, range) in output.ranges().iter().enumerate() {
            let own = range.first_point as usize..(range.first_point + range.points) as usize;
            let (points, samples) = (&output.points()[own.clone()], &mut vertices[own]);
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
            let mut view = SurfaceView::named(name).expect("a surface");
            let eye = Vec3::new(3.0, 1.0, 2.0);
            for rule in [FactorRule::Uniform(3.0), FactorRule::Distance { eye, scale: 20.0 }] {
                view.tessellate("fractional_odd", rule).expect("tessellates");
                let count = view.vertices.len();
                assert!(!view.indices.is_empty(), "{name} has triangles");
                assert!(view.indices.iter().all(|&i| (i as usize) < count), "{name}");
                assert!(view.vertices.iter().all(|v| v.position.is_finite()), "{name}");
            }
        }
    }
}
