//! Plain stores of the same number of bytes, for comparison.

use tess_wgpu::Gpu;

const SHADER: &str = "
@group(0) @binding(0) var<storage, read_write> words: array<vec4<u32>>;

@compute @workgroup_size(256)
fn fill(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let at = (workgroup.x + workgroup.y * workgroups.x) * 256u + thread;
    if at < arrayLength(&words) {
        words[at] = vec4<u32>(at, at + 1u, at + 2u, at + 3u);
    }
}
";

/// The kernel that fills.
#[derive(Debug)]
pub(super) struct Fill {
    pipeline: wgpu::ComputePipeline,
}

/// A range of a buffer, bound.
#[derive(Debug)]
pub(super) struct Span {
    group: wgpu::BindGroup,
    workgroups: u32,
}

impl Fill {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("fill"),
            source: wgpu::ShaderSource::Wgsl(SHADER.into()),
        });
        let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("fill"),
            layout: None,
            module: &module,
            entry_point: Some("fill"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        Self { pipeline }
    }

    /// Covers the first `bytes` bytes of a buffer, rounded up to 16, with as many bindings as
    /// needed.
    pub(super) fn spans(&self, gpu: &Gpu, buffer: &wgpu::Buffer, bytes: u64) -> Vec<Span> {
        let most = gpu.device.limits().max_storage_buffer_binding_size / 256 * 256;
        let bytes = bytes.next_multiple_of(16).min(buffer.size());
        let count = bytes.div_ceil(most);
        (0..count)
            .map(|number| {
                let offset = number * most;
                self.span(gpu, buffer, offset, most.min(bytes - offset))
            })
            .collect()
    }

    fn span(&self, gpu: &Gpu, buffer: &wgpu::Buffer, offset: u64, bytes: u64) -> Span {
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("fill"),
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                    buffer,
                    offset,
                    size: std::num::NonZeroU64::new(bytes),
                }),
            }],
        });
        let workgroups = u32::try_from(bytes.div_ceil(16 * 256)).unwrap_or(u32::MAX);
        Span { group, workgroups }
    }

    pub(super) fn encode(&self, encoder: &mut wgpu::CommandEncoder, spans: &[Span]) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&self.pipeline);
        for Span { group, workgroups } in spans {
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups((*workgroups).min(65535), workgroups.div_ceil(65535), 1);
        }
    }
}
