//! A stage whose frames are drawn for up to four cameras.

use crate::Result;
use std::cell::RefCell;
use tess_core::{Config, Domain, Order, OutputPrimitive, Partitioning};
use tess_wgpu::stage::{Frame, Material, Points, Room, VertexLayout};
use tess_wgpu::{Gpu, TessellationStage};

/// The width and height of a target in pixels.
const SIZE: u32 = 1024;
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// The first pass has a colour; the others only depth, as in shadow maps.
const CAMERAS: [&str; 4] = ["camera_0", "camera_1", "camera_2", "camera_3"];

/// The source of a draw's vertices.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Way {
    /// The vertex shader calls `domain`.
    Stored,
    /// Evaluated vertices are loaded as the stage does it.
    Evaluated,
    /// Evaluated vertices are attributes.
    Attributes,
}

/// The colour and the depth target.
pub(crate) struct Targets([wgpu::TextureView; 2]);

/// A stage, and a way to draw its frames for each camera.
pub(crate) struct Scene {
    stage: RefCell<TessellationStage>,
    passes: Vec<Pass>,
    patches: u32,
}

enum Pass {
    Material(Material),
    Attributes(wgpu::RenderPipeline),
}

impl Scene {
    pub(crate) fn new(
        gpu: &Gpu,
        (text, patches): (&str, u32),
        way: Way,
        order: Order,
    ) -> Result<Self> {
        let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
        let points = if way == Way::Stored { Points::Stored } else { Points::Evaluated };
        let builder = TessellationStage::builder(text, Domain::Quad, config, patches)
            .points(points)
            .order(order)
            .room(Room::Automatic { most_bytes: 1 << 30 });
        let mut stage = builder.clone().build(&gpu.device)?;
        let passes = CAMERAS.iter().enumerate().map(|(number, camera)| match way {
            Way::Attributes => {
                let shader = (builder.vertex_shader(Some(camera))?, stage.vertex_layout());
                Ok(Pass::Attributes(by_attributes(gpu, shader, number == 0)))
            }
            Way::Stored | Way::Evaluated => {
                let material = stage.material(text).project(camera).depth(depth());
                let material = if number == 0 { material.target(FORMAT) } else { material };
                material.build().map(Pass::Material)
            }
        });
        let passes = passes.collect::<std::result::Result<_, tess_wgpu::Error>>()?;
        // The first run has the room of a new stage, and makes more; the second tells of that.
        stage.make_room(&gpu.queue, patches)?;
        let found = stage.make_room(&gpu.queue, patches)?;
        if found.scale < 1.0 {
            return Err("the room does not hold the frame, which would be coarser".into());
        }
        Ok(Self { stage: RefCell::new(stage), passes, patches })
    }

    /// Records a frame: one `prepare`, and this number of passes.
    pub(crate) fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        targets: &Targets,
        passes: usize,
    ) {
        let mut stage = self.stage.borrow_mut();
        let frame = stage.prepare(encoder, self.patches);
        let frame = frame.expect("the device works and the number is the stage's");
        for (number, pass) in self.passes.iter().take(passes).enumerate() {
            let mut target = targets.begin(encoder, number == 0);
            pass.draw(&mut target, (&stage, &frame));
        }
    }
}

impl Pass {
    fn draw(&self, pass: &mut wgpu::RenderPass<'_>, (stage, frame): (&TessellationStage, &Frame)) {
        match self {
            Self::Material(material) => material.draw(pass, frame).expect("it is the last frame"),
            Self::Attributes(pipeline) => {
                let (vertices, indices) =
                    stage.vertices().zip(stage.indices()).expect("they are stored");
                pass.set_pipeline(pipeline);
                pass.set_vertex_buffer(0, vertices.slice(..));
                pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
                pass.draw_indexed_indirect(&stage.indirect(), 0);
            }
        }
    }
}

/// The pipeline of a vertex shader that gets evaluated vertices as attributes of this layout.
fn by_attributes(
    gpu: &Gpu,
    (text, layout): (String, &VertexLayout),
    has_colour: bool,
) -> wgpu::RenderPipeline {
    let source = wgpu::ShaderSource::Wgsl(text.into());
    let module =
        gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let targets = [Some(FORMAT.into())];
    let fragment = wgpu::FragmentState {
        module: &module,
        entry_point: Some("shade"),
        compilation_options: Default::default(),
        targets: &targets,
    };
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("attributes"),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("tess_vertex"),
            compilation_options: Default::default(),
            buffers: &[Some(layout.buffer())],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(depth()),
        multisample: wgpu::MultisampleState::default(),
        fragment: has_colour.then_some(fragment),
        multiview_mask: None,
        cache: None,
    })
}

fn depth() -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: DEPTH,
        depth_write_enabled: Some(true),
        depth_compare: Some(wgpu::CompareFunction::Less),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}

impl Targets {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let target = |format| {
            let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: None,
                size: wgpu::Extent3d { width: SIZE, height: SIZE, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
                view_formats: &[],
            });
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        Self([FORMAT, DEPTH].map(target))
    }

    /// Begins a pass, with the colour target or only with the depth.
    fn begin<'a>(
        &self,
        encoder: &'a mut wgpu::CommandEncoder,
        has_colour: bool,
    ) -> wgpu::RenderPass<'a> {
        let Self([colour, depth]) = self;
        let colours = [Some(wgpu::RenderPassColorAttachment {
            view: colour,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        })];
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &colours[..usize::from(has_colour)],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        })
    }
}
