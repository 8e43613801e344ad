//! The picture: the teapot's control nets and factors as buffers, tessellation and an indexed
//! indirect draw, recorded into one command buffer; nothing is read back before the pixels are
//! finished.

#[path = "../shared/picture.rs"]
pub(crate) mod picture;

use glam::Vec3;
use picture::Scene;
use std::error::Error;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_gpu::layout::factor_words;
use tess_gpu::{Setup, surfaces};
use tess_surface::{FactorRule, MeshError, Model, teapot};
use tess_wgpu::Gpu;
use wgpu::BufferUsages as Usage;

/// The number of patches.
pub(crate) const PATCHES: u32 = 32;
/// The eye, as draw.wgsl has it.
const EYE: Vec3 = Vec3::new(3.2, -7.6, 5.0);
/// The colour behind it.
pub(crate) const BACKGROUND: wgpu::Color = wgpu::Color { r: 0.93, g: 0.94, b: 0.96, a: 1.0 };

/// How the teapot is tessellated.
pub(crate) fn setup() -> Setup {
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    Setup::new(Domain::Quad, config)
}

/// The factors of its patches: by distance to the eye.
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

/// Renders the teapot. The pixels are RGBA, row by row.
pub(crate) fn render(gpu: &Gpu) -> Result<Vec<u8>, Box<dyn Error>> {
    let words = factor_words(&factors()?);
    let factors = gpu.upload("factors", bytemuck::cast_slice(&words), Usage::STORAGE)?;
    let nets = gpu.upload("nets", bytemuck::cast_slice(&nets()), Usage::STORAGE)?;
    let scene = Scene {
        setup: setup(),
        patches: PATCHES,
        factors: &factors,
        room: [2 << 20, 4 << 20],
        source: &source(),
        read: Some(&nets),
        meshes: &[],
        // One sees into the spout.
        cull: None,
        background: BACKGROUND,
    };
    let encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    picture::render(gpu, encoder, &scene)
}
