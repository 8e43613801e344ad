//! Hills whose shadows are traced through the drawn triangles.

use crate::app::{self, Args, DEPTH, Frame, Show};
use crate::bindings::{Bound, bind, group, layout};
use crate::camera::Camera;
use crate::passes;
use glam::{Mat4, Vec3};
use std::error::Error;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_wgpu::stage::{self, Material, Points};
use tess_wgpu::{Gpu, TessellationStage};
use wgpu::{BindingResource, BindingType, BufferUsages as Usage, ShaderStages};

const PATCHES: u32 = 8 * 8;
const SHADING: &str = include_str!("shading.wgsl");

/// The most by which channels of a pixel may differ. A ray meets a triangle where the rasteriser
/// interpolates, except for rounding.
const CHANNEL: i16 = 12;

/// Draws into the file of `--screenshot`, and prints how much the picture by primary rays differs.
pub(crate) fn run(args: &Args) -> Result<(), Box<dyn Error>> {
    let path = args.text("screenshot").ok_or("rays draws into a file: --screenshot FILE")?;
    let gpu = pollster::block_on(open())?;
    let width = args.number("width", 960_u32)?.next_multiple_of(64);
    let size = [width, width * 3 / 4];
    let drawn = app::picture::<Rays>(&gpu, args, size)?;
    let traced = app::picture::<Rays>(&gpu, &args.with("primary", "rays"), size)?;
    let differs = |(a, b): (&[u8; 4], &[u8; 4])| {
        (0..3).any(|k| (i16::from(a[k]) - i16::from(b[k])).abs() > CHANNEL)
    };
    let pairs = drawn.as_chunks::<4>().0.iter().zip(traced.as_chunks::<4>().0);
    let count = pairs.filter(|&pair| differs(pair)).count();
    println!("{}: {count} of {} pixels differ when they are traced", gpu.name(), width * size[1]);
    crate::save(path, size, &drawn)
}

/// A device with ray queries.
async fn open() -> Result<Gpu, Box<dyn Error>> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = instance.request_adapter(&Default::default()).await?;
    let (info, rays) = (adapter.get_info(), wgpu::Features::EXPERIMENTAL_RAY_QUERY);
    if !adapter.features().contains(rays) {
        let wgpu::AdapterInfo { name, driver_info, .. } = info;
        return Err(format!("{name} ({driver_info}) lacks EXPERIMENTAL_RAY_QUERY").into());
    }
    let descriptor = wgpu::DeviceDescriptor {
        required_features: rays,
        // The default limits allow no acceleration structures.
        required_limits: adapter.limits(),
        experimental_features: experimental(),
        ..Default::default()
    };
    let (device, queue) = adapter.request_device(&descriptor).await?;
    Ok(Gpu { device, queue, info })
}

/// wgpu's token for features that may have bugs.
#[expect(unsafe_code, reason = "wgpu asks for it where a feature is experimental")]
fn experimental() -> wgpu::ExperimentalFeatures {
    // SAFETY: wgpu demands that the caller accepts bugs in ray queries. This example needs them,
    // and uses them as wgpu's documentation shows.
    unsafe { wgpu::ExperimentalFeatures::enabled() }
}

/// The stage with its frame, the acceleration structure, and the pipeline of primary rays.
pub(crate) struct Rays {
    _stage: TessellationStage,
    material: Material,
    /// The hills do not move, so this is the only frame.
    shown: stage::Frame,
    frame: wgpu::Buffer,
    bound: wgpu::BindGroup,
    traced: wgpu::BindGroup,
    primary: Option<wgpu::RenderPipeline>,
    _structures: (wgpu::Blas, wgpu::Tlas),
}

impl Show for Rays {
    /// `--primary rays` traces a ray for each pixel instead of drawing.
    fn new(gpu: &Gpu, format: wgpu::TextureFormat, args: &Args) -> Result<Self, Box<dyn Error>> {
        let device = &gpu.device;
        let frame = gpu.buffer("frame", 144, Usage::UNIFORM | Usage::COPY_DST)?;
        let (of_frame, bound) = bind(gpu, &[Bound::Uniform(&frame)]);
        let tlas = device.create_tlas(&wgpu::CreateTlasDescriptor {
            label: Some("scene"),
            max_instances: 1,
            flags: wgpu::AccelerationStructureFlags::PREFER_FAST_TRACE,
            update_mode: wgpu::AccelerationStructureUpdateMode::Build,
        });
        let structure = BindingType::AccelerationStructure { vertex_return: false };
        let of_scene = layout(device, ShaderStages::FRAGMENT, [structure]);
        let scene = [(0, BindingResource::AccelerationStructure(&tlas))];
        let scene = group(device, &of_scene, scene);
        let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
        let wgsl = SHADING.to_owned() + include_str!("hills.wgsl");
        let mut stage = TessellationStage::builder(&wgsl, Domain::Quad, config, PATCHES)
            .bind_group(&of_frame, &bound)
            .points(Points::Evaluated)
            .build(device)?;
        let material = stage
            .material(&wgsl)
            .bind_group(&of_frame, &bound)
            .bind_group(&of_scene, &scene)
            .project("seen")
            .target(format)
            .depth(app::depth())
            .build()?;
        let (shown, structures) = build(gpu, &mut stage, tlas)?;
        let storage = BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: true },
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let of_traced = layout(device, ShaderStages::FRAGMENT, [structure, storage, storage]);
        let (vertices, indices) = stage.vertices().zip(stage.indices()).ok_or("stored")?;
        let traced = [
            (0, BindingResource::AccelerationStructure(&structures.1)),
            (1, vertices.as_entire_binding()),
            (2, indices.as_entire_binding()),
        ];
        let traced = group(device, &of_traced, traced);
        let by_rays = args.text("primary") == Some("rays");
        let primary = by_rays.then(|| primary(device, format, [&of_frame, &of_traced]));
        let (_stage, _structures) = (stage, structures);
        Ok(Self { _stage, material, shown, frame, bound, traced, primary, _structures })
    }

    fn prepare(&mut self, frame: Frame<'_>) -> Result<(), Box<dyn Error>> {
        let aspect = frame.size[0] as f32 / frame.size[1] as f32;
        let (eye, target) = (Vec3::new(4.0, -6.0, 5.0), Vec3::new(4.0, 4.0, 0.2));
        let camera = Camera { eye, target, up: Vec3::Z, zoom: 2.2 };
        let forward = (target - eye).normalize_or(Vec3::Y);
        let right = forward.cross(Vec3::Z).normalize_or(Vec3::X);
        let up = right.cross(forward);
        let mut words = Mat4::to_cols_array(&camera.clip_from_world(aspect)).to_vec();
        let sun = passes::toward_sun();
        for vector in [eye, sun, forward, right * aspect / camera.zoom, up / camera.zoom] {
            words.extend(vector.extend(0.0).to_array());
        }
        frame.gpu.queue.write_buffer(&self.frame, 0, bytemuck::cast_slice(&words));
        // The hills do not move: they are prepared once, and the structure holds their triangles.
        Ok(())
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>) -> Result<(), tess_wgpu::Error> {
        match &self.primary {
            None => self.material.draw(pass, &self.shown)?,
            Some(primary) => {
                pass.set_pipeline(primary);
                pass.set_bind_group(0, &self.bound, &[]);
                pass.set_bind_group(1, &self.traced, &[]);
                pass.draw(0..3, 0..1);
            }
        }
        Ok(())
    }

    fn title(&self) -> String {
        "rays: traced shadows".to_owned()
    }
}

/// Prepares the stage, and builds the structure of its triangles.
fn build(
    gpu: &Gpu,
    stage: &mut TessellationStage,
    mut tlas: wgpu::Tlas,
) -> Result<(stage::Frame, (wgpu::Blas, wgpu::Tlas)), Box<dyn Error>> {
    // A structure is made for known numbers of vertices and indices.
    let counts = stage.make_room(&gpu.queue, PATCHES)?;
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let shown = stage.prepare(&mut encoder, PATCHES)?;
    let size = wgpu::BlasTriangleGeometrySizeDescriptor {
        vertex_format: wgpu::VertexFormat::Float32x3,
        vertex_count: u32::try_from(counts.points)?,
        index_format: Some(wgpu::IndexFormat::Uint32),
        index_count: Some(3 * u32::try_from(counts.primitives)?),
        flags: wgpu::AccelerationStructureGeometryFlags::OPAQUE,
    };
    let blas = gpu.device.create_blas(
        &wgpu::CreateBlasDescriptor {
            label: Some("hills"),
            flags: wgpu::AccelerationStructureFlags::PREFER_FAST_TRACE,
            update_mode: wgpu::AccelerationStructureUpdateMode::Build,
        },
        wgpu::BlasGeometrySizeDescriptors::Triangles { descriptors: vec![size.clone()] },
    );
    let identity = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    tlas[0] = Some(wgpu::TlasInstance::new(&blas, identity, 0, 0xff));
    let (vertices, indices) = stage.vertices().zip(stage.indices()).ok_or("they are stored")?;
    let geometry = wgpu::BlasTriangleGeometry {
        size: &size,
        vertex_buffer: &vertices,
        first_vertex: 0,
        // The position is the first member of `Vertex`.
        vertex_stride: stage.vertex_layout().array_stride,
        index_buffer: Some(&indices),
        first_index: Some(0),
        transform_buffer: None,
        transform_buffer_offset: None,
    };
    let entry = wgpu::BlasBuildEntry {
        blas: &blas,
        geometry: wgpu::BlasGeometries::TriangleGeometries(vec![geometry]),
    };
    encoder.build_acceleration_structures([&entry], [&tlas]);
    gpu.run(encoder)?;
    Ok((shown, (blas, tlas)))
}

/// The pipeline that traces a ray for each pixel.
fn primary(
    device: &wgpu::Device,
    format: wgpu::TextureFormat,
    layouts: [&wgpu::BindGroupLayout; 2],
) -> wgpu::RenderPipeline {
    let text = SHADING.to_owned() + include_str!("primary.wgsl");
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("primary rays"),
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &layouts.map(Some),
        immediate_size: 0,
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("primary rays"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("cover"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState { format: DEPTH, ..app::depth() }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("trace"),
            compilation_options: Default::default(),
            targets: &[Some(format.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
