//! Calling helpers on a device.

use crate::{Args, Table};
use tess_gpu::surfaces;
use tess_wgpu::Gpu;
use wgpu::BufferUsages as Usage;

/// The text that the stage joins to the user's functions.
const TYPES: &str = include_str!("../../shaders/types.wgsl");

/// Calls a helper for each case.
const CALLS: &str = "
@group(0) @binding(0) var<storage, read> cases: array<array<vec4<f32>, 5>>;
@group(0) @binding(1) var<storage, read_write> results: array<vec4<f32>>;
@group(0) @binding(2) var map: texture_2d<f32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < arrayLength(&cases) {
        let a = cases[id.x];
        _ = textureDimensions(map);
        results[id.x] = CALL;
    }
}
";

/// The shader of a call, with an edit of what the stage joins.
fn source(edit: impl Fn(&str) -> String, call: &str) -> String {
    let mut joined = vec![TYPES, surfaces::HELPERS];
    if call.contains("bezier") {
        joined.extend([surfaces::BEZIER, surfaces::BEZIER_FACTORS]);
    }
    edit(&joined.join("\n")) + &CALLS.replace("CALL", call)
}

/// Texels of the height image along x and y.
pub(crate) const SIZE: [u16; 2] = [8, 4];

/// The heights of the image: of 8 bits, so that their mixtures at 1/256 of a texel are exact.
pub(crate) fn heights() -> Vec<f32> {
    (0..SIZE[0] * SIZE[1]).map(|i| f32::from(i * 37 % 256) / 256.0).collect()
}

/// A device with the height image.
#[derive(Debug)]
pub(crate) struct Device {
    gpu: Gpu,
    map: wgpu::TextureView,
}

impl Device {
    /// A machine without one is a failure, not a reason to skip.
    pub(crate) fn open() -> Self {
        let gpu = pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"));
        let [width, height] = SIZE.map(u32::from);
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("heights"),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::R32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(4 * width),
            rows_per_image: None,
        };
        let texels = heights();
        gpu.queue.write_texture(
            texture.as_image_copy(),
            bytemuck::cast_slice(&texels),
            layout,
            size,
        );
        let map = texture.create_view(&Default::default());
        Self { gpu, map }
    }

    /// The results of a table's calls, with an edit of what the stage joins.
    pub(crate) fn run(&self, edit: impl Fn(&str) -> String, table: &Table) -> Vec<[f32; 4]> {
        let device = &self.gpu.device;
        let layout = self.layout();
        let pipeline = self.pipeline(&source(edit, table.call), &layout);
        let args: Vec<Args> = table.cases.iter().map(|case| case.args).collect();
        let cases = self.gpu.upload("cases", bytemuck::cast_slice(&args), Usage::STORAGE);
        let cases = cases.expect("there is room");
        let poison = vec![[f32::NAN; 4]; args.len()];
        let usage = Usage::STORAGE | Usage::COPY_SRC;
        let results = self.gpu.upload("results", bytemuck::cast_slice(&poison), usage);
        let results = results.expect("there is room");
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &layout,
            entries: &[
                entry(0, cases.as_entire_binding()),
                entry(1, results.as_entire_binding()),
                entry(2, wgpu::BindingResource::TextureView(&self.map)),
            ],
        });
        let mut encoder = device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        let groups = u32::try_from(args.len().div_ceil(64)).expect("a table is short");
        pass.dispatch_workgroups(groups, 1, 1);
        drop(pass);
        self.gpu.run(encoder).expect("the device finishes");
        let bytes = self.gpu.read(&results, results.size()).expect("the device answers");
        bytemuck::pod_collect_to_vec(&bytes)
    }

    fn pipeline(&self, source: &str, layout: &wgpu::BindGroupLayout) -> wgpu::ComputePipeline {
        let device = &self.gpu.device;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("helpers"),
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
        device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("helpers"),
            layout: Some(&device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: None,
                bind_group_layouts: &[Some(layout)],
                immediate_size: 0,
            })),
            module: &module,
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        })
    }

    fn layout(&self) -> wgpu::BindGroupLayout {
        let buffer = |binding, read_only| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        let map = wgpu::BindGroupLayoutEntry {
            binding: 2,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: false },
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
            count: None,
        };
        self.gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &[buffer(0, true), buffer(1, false), map],
        })
    }
}
