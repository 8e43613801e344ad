//! The teapot's control nets, factors and shaders.

use glam::Vec3;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_gpu::{Setup, surfaces};
use tess_surface::{FactorRule, MeshError, Model, teapot};

/// The number of patches.
pub(crate) const PATCHES: u32 = 32;
/// The eye, which is also in draw.wgsl.
const EYE: Vec3 = Vec3::new(3.2, -7.6, 5.0);

/// The teapot's tessellation.
pub(crate) fn setup() -> Setup {
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    Setup::new(Domain::Quad, config)
}

/// The factors of its patches, by distance to the eye.
pub(crate) fn factors() -> Result<Vec<PatchFactors>, MeshError> {
    let model = Model::bezier(teapot::patches())?;
    let rule = FactorRule::Distance { eye: EYE, scale: 140.0 };
    let partitioning = setup().config.partitioning;
    Ok((0..model.len()).map(|number| rule.factors(&model, number, partitioning)).collect())
}

/// Its control nets as `draw.wgsl` reads them: x, y, z, w of 16 points for each patch.
pub(crate) fn nets() -> Vec<[f32; 4]> {
    let patches = teapot::patches();
    patches.iter().flat_map(|patch| patch.points.as_flattened()).map(|p| p.to_array()).collect()
}

/// The shaders: the formulas of a surface, and draw.wgsl, which calls them.
pub(crate) fn source() -> String {
    [surfaces::BEZIER, include_str!("draw.wgsl"), include_str!("material.wgsl")].join("\n")
}
