//! One buffer with the patches of all meshes, one batch in groups, and one draw for each group.

use crate::app::{Args, Frame, Show};
use crate::scene::{Drawn, Mesh, Scene};
use crate::teapot::{self, PATCHES};
use std::error::Error;
use tess_gpu::layout::factor_words;
use tess_gpu::surfaces;
use tess_wgpu::Gpu;
use wgpu::BufferUsages as Usage;

/// The place and the colour of each teapot.
const TEAPOTS: [([f32; 3], [f32; 4]); 3] = [
    ([-1.9, -0.6, 0.2], [0.80, 0.15, 0.10, 1.0]),
    ([0.3, 1.4, 0.9], [0.10, 0.60, 0.15, 1.0]),
    ([2.3, -0.4, 0.2], [0.10, 0.20, 0.80, 1.0]),
];
/// The size of a teapot, which is 1 in the example `teapot`.
const SCALE: f32 = 0.45;

/// The control nets of all teapots, one after another.
fn nets() -> Vec<[f32; 4]> {
    let nets = teapot::nets();
    let placed = |at: [f32; 3]| {
        let place = move |&[x, y, z, w]: &[f32; 4]| {
            [SCALE * x + w * at[0], SCALE * y + w * at[1], SCALE * z + w * at[2], w]
        };
        nets.iter().map(place).collect::<Vec<_>>()
    };
    TEAPOTS.iter().flat_map(|&(at, _)| placed(at)).collect()
}

/// The teapots.
pub(crate) struct Meshes(Drawn);

impl Show for Meshes {
    fn new(gpu: &Gpu, format: wgpu::TextureFormat, _: &Args) -> Result<Self, Box<dyn Error>> {
        let words = factor_words(&teapot::factors()?).repeat(TEAPOTS.len());
        let factors = gpu.upload("factors", bytemuck::cast_slice(&words), Usage::STORAGE)?;
        let nets = gpu.upload("nets", bytemuck::cast_slice(&nets()), Usage::STORAGE)?;
        let colours = TEAPOTS
            .iter()
            .map(|(_, colour)| gpu.upload("colour", bytemuck::cast_slice(colour), Usage::UNIFORM));
        let colours = colours.collect::<Result<Vec<_>, _>>()?;
        let meshes: Vec<Mesh<'_>> = (0..)
            .zip(&colours)
            .map(|(number, material)| Mesh { first_patch: number * PATCHES, material })
            .collect();
        let source =
            [surfaces::BEZIER, include_str!("../teapot/draw.wgsl"), include_str!("material.wgsl")];
        let scene = Scene {
            setup: teapot::setup(),
            patches: PATCHES * u32::try_from(TEAPOTS.len())?,
            factors: &factors,
            room: [6 << 20, 12 << 20],
            source: &source.join("\n"),
            read: Some(&nets),
            meshes: &meshes,
            // Both sides are drawn, because the inside of the spouts is visible.
            cull: None,
        };
        Ok(Self(Drawn::new(gpu, format, &scene)?))
    }

    fn prepare(&mut self, frame: Frame<'_>) -> Result<(), Box<dyn Error>> {
        self.0.prepare(frame.encoder);
        Ok(())
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>) -> Result<(), tess_wgpu::Error> {
        self.0.draw(pass);
        Ok(())
    }

    fn check(&self, gpu: &Gpu) -> Result<(), Box<dyn Error>> {
        self.0.check(gpu)
    }

    fn title(&self) -> String {
        "meshes".to_owned()
    }
}
