//! Hills, tessellated once and drawn five times.

use crate::app::{self, Args, DEPTH, Frame, Show};
use crate::bindings::{Bound, bind};
use crate::camera::Camera;
use glam::{Mat4, Vec3};
use std::error::Error;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_wgpu::{Gpu, TessellationStage};
use wgpu::{BufferUsages as Usage, CompareFunction as Compare};

const PATCHES: u32 = 8 * 8;
/// Pixels across and down the shadow map.
const SHADOWS: u32 = 2048;
/// Bytes from one view's number to the next: a dynamic offset is a multiple of this.
const VIEW: u32 = 256;

/// The direction of the sun.
pub(crate) fn toward_sun() -> Vec3 {
    Vec3::new(0.62, -0.45, 0.35).normalize()
}

/// The cameras, for pictures of this width over height.
pub(crate) fn cameras(aspect: f32) -> [Mat4; 2] {
    let target = Vec3::new(4.0, 4.0, 0.2);
    [Vec3::new(4.0, -6.0, 5.0), Vec3::new(-4.5, 1.0, 4.0)]
        .map(|eye| Camera { eye, target, up: Vec3::Z, zoom: 1.7 }.clip_from_world(aspect))
}

/// The sun's, which sees all of the hills.
fn sun() -> Mat4 {
    let away = -toward_sun();
    let right = away.cross(Vec3::Z).normalize();
    let middle = Vec3::new(4.0, 4.0, 0.5);
    let row = |axis: Vec3, far: f32, plus: f32| (axis / far).extend(plus - axis.dot(middle) / far);
    let rows = [row(right, 6.0, 0.0), row(right.cross(away), 6.0, 0.0), row(away, 12.0, 0.5)];
    Mat4::from_rows(rows[0], rows[1], rows[2], glam::Vec4::W)
}

/// The stage, and all that draws it.
pub(crate) struct Passes {
    stage: TessellationStage,
    frame: wgpu::Buffer,
    group: wgpu::BindGroup,
    shadows: (wgpu::TextureView, wgpu::BindGroup),
    into_shadows: wgpu::RenderPipeline,
    into_depth: Option<wgpu::RenderPipeline>,
    in_colour: wgpu::RenderPipeline,
    size: [u32; 2],
}

impl Show for Passes {
    /// `--prepass off` leaves out the passes of depth alone.
    fn new(gpu: &Gpu, format: wgpu::TextureFormat, args: &Args) -> Result<Self, Box<dyn Error>> {
        let frame = gpu.buffer("frame", 208, Usage::UNIFORM | Usage::COPY_DST)?;
        let mut numbers = [0_u32; 3 * VIEW as usize / 4];
        (0..3).for_each(|view: u32| numbers[(view * VIEW / 4) as usize] = view);
        let views = gpu.upload("views", bytemuck::cast_slice(&numbers), Usage::UNIFORM)?;
        let (layout, group) = bind(gpu, &[Bound::Uniform(&frame), Bound::Dynamic(&views)]);
        let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
        let wgsl = include_str!("hills.wgsl");
        let builder = TessellationStage::builder(wgsl, Domain::Quad, config, PATCHES)
            .bind_group(&layout, &group)
            .without_pipeline();
        let vertex = builder.vertex_shader();
        let mut stage = builder.build(&gpu.device)?;
        // `hull` has the bindings of the stage's bind groups, though it does not ask who looks.
        stage.set_dynamic_offsets(0, &[0])?;

        let source = wgpu::ShaderSource::Wgsl(vertex.into());
        let descriptor = wgpu::ShaderModuleDescriptor { label: Some("hills"), source };
        let module = gpu.device.create_shader_module(descriptor);
        let shadows = app::texture(gpu, DEPTH, [SHADOWS; 2]);
        let shadows = app::view_of(&shadows);
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            compare: Some(Compare::LessEqual),
            ..Default::default()
        });
        let bound = [Bound::Depth(&shadows), Bound::Comparison(&sampler)];
        let (of_shadows, shadow_group) = bind(gpu, &bound);
        let make =
            |layouts: &[_], fragment, depth| pipeline(gpu, &module, layouts, fragment, depth);
        let colour = wgpu::ColorTargetState::from(format);
        let mask = wgpu::ColorWrites::empty();
        let nothing = ("nothing", wgpu::ColorTargetState { write_mask: mask, ..colour.clone() });
        let has_prepass = args.text("prepass") != Some("off");
        let compare = if has_prepass { Compare::Equal } else { Compare::Less };
        let both = [Some(&layout), Some(&of_shadows)];
        Ok(Self {
            stage,
            frame,
            group,
            shadows: (shadows, shadow_group),
            into_shadows: make(&both[..1], None, Compare::Less),
            into_depth: has_prepass.then(|| make(&both[..1], Some(nothing), Compare::Less)),
            in_colour: make(&both, Some(("shade", colour)), compare),
            size: [1; 2],
        })
    }

    fn prepare(&mut self, frame: Frame<'_>) -> Result<(), Box<dyn Error>> {
        self.size = frame.size;
        let [left, right] = cameras(0.5 * frame.size[0] as f32 / frame.size[1] as f32);
        let mut words: Vec<f32> =
            [left, right, sun()].iter().flat_map(Mat4::to_cols_array).collect();
        words.extend(toward_sun().extend(0.0).to_array());
        frame.gpu.queue.write_buffer(&self.frame, 0, bytemuck::cast_slice(&words));
        // Once, for all passes that follow.
        self.stage.prepare(frame.encoder, PATCHES)?;
        let depth_ops =
            wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store };
        let mut pass = frame.encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.shadows.0,
                depth_ops: Some(depth_ops),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&self.into_shadows);
        self.draw_for(&mut pass, 2);
        Ok(())
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let [width, height] = [self.size[0] / 2, self.size[1]].map(|size| size as f32);
        pass.set_bind_group(1, &self.shadows.1, &[]);
        for camera in 0..2_u8 {
            pass.set_viewport(f32::from(camera) * width, 0.0, width, height, 0.0, 1.0);
            for pipeline in self.into_depth.iter().chain([&self.in_colour]) {
                pass.set_pipeline(pipeline);
                self.draw_for(pass, camera.into());
            }
        }
    }

    fn title(&self) -> String {
        "passes: a shadow map, two cameras".to_owned()
    }
}

impl Passes {
    /// Draws with the pass's pipeline, for the left camera, the right one or the sun.
    fn draw_for(&self, pass: &mut wgpu::RenderPass<'_>, view: u32) {
        pass.set_bind_group(0, &self.group, &[view * VIEW]);
        self.stage.draw(pass);
    }
}

/// A pipeline of the stage's vertex shader, as an engine makes it.
fn pipeline(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    layouts: &[Option<&wgpu::BindGroupLayout>],
    fragment: Option<(&str, wgpu::ColorTargetState)>,
    compare: Compare,
) -> wgpu::RenderPipeline {
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: layouts,
        immediate_size: 0,
    });
    let targets = [fragment.as_ref().map(|fragment| fragment.1.clone())];
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("tess_vertex"),
            compilation_options: Default::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: 8,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Uint32x2],
            })],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            depth_write_enabled: Some(compare != Compare::Equal),
            depth_compare: Some(compare),
            ..app::depth()
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: fragment.as_ref().map(|(entry_point, _)| wgpu::FragmentState {
            module,
            entry_point: Some(entry_point),
            compilation_options: Default::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}
