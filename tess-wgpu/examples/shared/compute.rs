//! A compute pass of one shader.

use super::picture::{group, whole};
use tess_wgpu::Gpu;

/// Records a compute pass of `threads` threads in workgroups of 64, over `buffers` as bindings
/// 0, 1, ... of group 0.
pub(crate) fn encode_compute(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    (module, entry_point): (&wgpu::ShaderModule, &str),
    buffers: &[&wgpu::Buffer],
    threads: u32,
) {
    let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(entry_point),
        layout: None,
        module,
        entry_point: Some(entry_point),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
    pass.set_pipeline(&pipeline);
    let layout = pipeline.get_bind_group_layout(0);
    let group = group(&gpu.device, &layout, whole(buffers.iter().copied()));
    pass.set_bind_group(0, &group, &[]);
    pass.dispatch_workgroups(threads.div_ceil(64), 1, 1);
}
