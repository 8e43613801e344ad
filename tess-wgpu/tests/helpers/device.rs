//! Calls helpers on a device.

use crate::objects::{compute, dispatch, group, image, layout, storage};
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

/// The heights of the image, of 8 bits, so that interpolation at 1/256 of a texel is exact.
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
    /// If there is none, the test fails, and is not skipped.
    pub(crate) fn open() -> Self {
        let gpu = pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"));
        let texels = heights();
        let bytes = bytemuck::cast_slice(&texels);
        let map = image(&gpu, wgpu::TextureFormat::R32Float, SIZE.map(u32::from), bytes);
        Self { gpu, map }
    }

    /// The results of a table's calls, with an edit of what the stage joins.
    pub(crate) fn run(&self, edit: impl Fn(&str) -> String, table: &Table) -> Vec<[f32; 4]> {
        let device = &self.gpu.device;
        let map = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: false },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        let types = [storage(true), storage(false), map];
        let layout = layout(device, wgpu::ShaderStages::COMPUTE, types);
        let pipeline = compute(device, source(edit, table.call), "main", &[&layout]);
        let args: Vec<Args> = table.cases.iter().map(|case| case.args).collect();
        let cases = self.gpu.upload("cases", bytemuck::cast_slice(&args), Usage::STORAGE);
        let cases = cases.expect("there is room");
        let poison = vec![[f32::NAN; 4]; args.len()];
        let usage = Usage::STORAGE | Usage::COPY_SRC;
        let results = self.gpu.upload("results", bytemuck::cast_slice(&poison), usage);
        let results = results.expect("there is room");
        let map = wgpu::BindingResource::TextureView(&self.map);
        let resources = [cases.as_entire_binding(), results.as_entire_binding(), map];
        let group = group(device, &layout, (0..).zip(resources));
        let groups = u32::try_from(args.len().div_ceil(64)).expect("a table is short");
        dispatch(&self.gpu, &pipeline, &[&group], groups).expect("the device finishes");
        let bytes = self.gpu.read(&results, results.size()).expect("the device answers");
        bytemuck::pod_collect_to_vec(&bytes)
    }
}
