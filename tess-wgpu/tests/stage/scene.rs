//! A stage, its target, and the pixels that it draws.

use crate::both::{Both, Builder};
use crate::common::objects::{copy_pixels, group, layout, plain, storage, view_of, whole};
use crate::model;
use tess_core::{Config, Domain, PatchFactors};
use tess_wgpu::stage::{PatchCount, Room};
use tess_wgpu::{Error, Gpu};
use wgpu::BufferUsages as Usage;

/// The width and height in pixels: patches are in a grid of 4 x 2.
pub(crate) const SIZE: [u32; 2] = [4 * model::PATCH, 2 * model::PATCH];
/// The most patches.
pub(crate) const PATCHES: u32 = 8;

/// A pixel: the bits of u and v of its triangle's first vertex (on OpenGL: of its last), the patch,
/// and 1; or four zeros.
pub(crate) type Pixel = [u32; 4];

/// The user's WGSL for a domain.
pub(crate) fn source(domain: Domain) -> String {
    let hull = match domain {
        Domain::Quad => {
            "fn hull(number: u32) -> QuadFactors {\n    let at = 6u * number;\n    return QuadFactors(\
             vec4<f32>(given[at], given[at + 1u], given[at + 2u], given[at + 3u]), \
             vec2<f32>(given[at + 4u], given[at + 5u]));\n}"
        }
        Domain::Triangle => {
            "fn hull(number: u32) -> TriFactors {\n    let at = 4u * number;\n    return TriFactors(\
             vec3<f32>(given[at], given[at + 1u], given[at + 2u]), given[at + 3u]);\n}"
        }
        Domain::Isoline => {
            "fn hull(number: u32) -> IsolineFactors {\n    let at = 2u * number;\n    \
             return IsolineFactors(given[at], given[at + 1u]);\n}"
        }
    };
    include_str!("scene.wgsl").replace("HULL", hull)
}

fn is_gl(gpu: &Gpu) -> bool {
    gpu.info.backend == wgpu::Backend::Gl
}

/// A buffer of these factors.
fn given(gpu: &Gpu, patches: &[PatchFactors]) -> wgpu::Buffer {
    let words = tess_gpu::layout::factor_words(patches);
    let bytes = bytemuck::cast_slice(&words);
    gpu.upload("given", bytes, Usage::STORAGE).expect("the device has room")
}

/// A device, a target and the patches' factors.
#[derive(Debug)]
pub(crate) struct Scene {
    pub(crate) gpu: Gpu,
    pub(crate) domain: Domain,
    pub(crate) config: Config,
    pub(crate) patches: Vec<PatchFactors>,
    pub(crate) factors: wgpu::Buffer,
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) group: wgpu::BindGroup,
    target: wgpu::Texture,
    source: String,
}

pub(crate) const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;

impl Scene {
    pub(crate) fn new(domain: Domain, config: Config, patches: Vec<PatchFactors>) -> Self {
        let gpu = pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"));
        Self::on(gpu, domain, config, patches)
    }

    /// A scene on this device.
    pub(crate) fn on(gpu: Gpu, domain: Domain, config: Config, patches: Vec<PatchFactors>) -> Self {
        let factors = given(&gpu, &patches);
        let layout = layout(&gpu.device, wgpu::ShaderStages::COMPUTE, [storage(true)]);
        let group = group(&gpu.device, &layout, whole([&factors]));
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
        let target = plain(&gpu, FORMAT, SIZE, usage);
        let mut source = source(domain);
        if is_gl(&gpu) {
            source = source.replace("@interpolate(flat)", "@interpolate(flat, either)");
        }
        Self { gpu, domain, config, patches, factors, layout, group, target, source }
    }

    /// The user's bind group with other factors.
    pub(crate) fn bind(&self, patches: &[PatchFactors]) -> wgpu::BindGroup {
        group(&self.gpu.device, &self.layout, whole([&given(&self.gpu, patches)]))
    }

    /// The pixels of these patches by the model.
    pub(crate) fn pixels(&self, patches: &[PatchFactors]) -> Vec<Option<Pixel>> {
        model::pixels(self.config, patches, if is_gl(&self.gpu) { 2 } else { 0 })
    }

    /// A pipeline as an engine makes it: with a shader's entry point, vertex buffers, and a state
    /// of its own.
    pub(crate) fn pipeline(
        &self,
        wgsl: String,
        entry_point: &str,
        buffers: &[Option<wgpu::VertexBufferLayout<'_>>],
    ) -> wgpu::RenderPipeline {
        let device = &self.gpu.device;
        let source = wgpu::ShaderSource::Wgsl(wgsl.into());
        let module =
            device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: None,
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: Default::default(),
                buffers,
            },
            primitive: Default::default(),
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: None,
                compilation_options: Default::default(),
                targets: &[Some(FORMAT.into())],
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    /// The builder of a stage of at most [`PATCHES`] patches, and of its material.
    pub(crate) fn builder(&self) -> Builder<'_> {
        self.builder_of(&self.source).room(Room::WorstCase)
    }

    /// The same builder with other WGSL, and without the scene's room.
    pub(crate) fn builder_of<'a>(&'a self, source: &'a str) -> Builder<'a> {
        Builder::new(source, self.domain, self.config, PATCHES)
            .bind_group(&self.layout, &self.group)
            .target(FORMAT)
    }

    /// Builds a stage that must be valid.
    pub(crate) fn build(&self, builder: Builder<'_>) -> Both {
        builder.build(&self.gpu.device).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Prepares and draws a frame.
    pub(crate) fn frame(
        &self,
        stage: &mut Both,
        patches: PatchCount<'_>,
    ) -> Result<Vec<Pixel>, Error> {
        self.frame_with(stage, patches, |stage, pass| stage.draw(pass))
    }

    /// Prepares a frame, and draws it with `draw`.
    pub(crate) fn frame_with(
        &self,
        stage: &mut Both,
        patches: PatchCount<'_>,
        draw: impl FnOnce(&Both, &mut wgpu::RenderPass<'_>),
    ) -> Result<Vec<Pixel>, Error> {
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        stage.prepare(&mut encoder, patches)?;
        self.draw_only(encoder, |pass| draw(stage, pass))
    }

    /// Draws the prepared frame with `draw`, and returns the pixels.
    pub(crate) fn draw_only(
        &self,
        mut encoder: wgpu::CommandEncoder,
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) -> Result<Vec<Pixel>, Error> {
        in_pass(&mut encoder, &self.target, None, draw);
        let size = u64::from(16 * SIZE[0] * SIZE[1]);
        let pixels = self.gpu.buffer("pixels", size, Usage::COPY_DST | Usage::COPY_SRC)?;
        copy_pixels(&mut encoder, &self.target, &pixels);
        self.gpu.run(encoder)?;
        Ok(bytemuck::pod_collect_to_vec(&self.gpu.read(&pixels, size)?))
    }
}

/// Draws in a render pass of its own, whose only target is this one.
pub(crate) fn in_pass(
    encoder: &mut wgpu::CommandEncoder,
    target: &wgpu::Texture,
    multiview_mask: Option<std::num::NonZeroU32>,
    draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
) {
    let view = view_of(target);
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        })],
        multiview_mask,
        ..Default::default()
    });
    draw(&mut pass);
}
