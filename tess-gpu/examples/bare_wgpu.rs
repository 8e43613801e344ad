//! `tess-gpu` on wgpu alone: from raw factors to the buffers of an indexed indirect draw. Copy the
//! functions into your engine; `main` calls them in order.
//!
//!     cargo run -p tess-gpu --example bare_wgpu
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "an example that prints")]

use std::process::ExitCode;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_gpu::layout::{DrawIndexed, PackedPoint, factor_words};
use tess_gpu::{Access, Binding, Capacity, Dispatch, Limits, Plan, Resource, Setup, Stage};
use tess_gpu::{Span, Workgroups, tables};

/// A device with WebGPU's default limits.
///
/// # Errors
/// No adapter of these backends gives one.
pub(crate) fn open(backends: wgpu::Backends) -> Result<(wgpu::Device, wgpu::Queue), String> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = backends;
    let instance = wgpu::Instance::new(descriptor);
    let adapter = pollster::block_on(instance.request_adapter(&Default::default()))
        .map_err(|error| format!("no adapter: {error}"))?;
    pollster::block_on(adapter.request_device(&Default::default()))
        .map_err(|error| format!("no device: {error}"))
}

/// The buffer of each [`Resource`], in the order of [`Resource::ALL`].
pub(crate) type Buffers = [wgpu::Buffer; Resource::ALL.len()];

/// The buffers of a batch; `groups` is the first patch of each group. A renderer keeps them while
/// the plan stays, and has a pass of its own write the factors.
pub(crate) fn buffers(
    (device, queue): &(wgpu::Device, wgpu::Queue),
    setup: Setup,
    plan: &Plan,
    patches: &[PatchFactors],
    groups: &[u32],
) -> Buffers {
    use wgpu::BufferUsages as Usage;
    Resource::ALL.map(|resource| {
        let contents: Vec<u8> = match resource {
            Resource::Job => plan.jobs(),
            Resource::Factors => bytemuck::cast_slice(&factor_words(patches)).to_vec(),
            Resource::Tables => bytemuck::cast_slice(&tables(setup.config.split)).to_vec(),
            Resource::Groups => bytemuck::cast_slice(groups).to_vec(),
            // All zeros, as every new buffer of WebGPU.
            _ => Vec::new(),
        };
        let usage = match resource {
            Resource::Job => Usage::UNIFORM,
            Resource::Arguments | Resource::Draws => Usage::STORAGE | Usage::INDIRECT,
            Resource::Indices => Usage::STORAGE | Usage::INDEX,
            _ => Usage::STORAGE,
        };
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(&format!("{resource:?}")),
            // No buffer is empty, whatever the plan has.
            size: plan.buffer_size(resource).max(16),
            usage: usage | Usage::COPY_SRC | Usage::COPY_DST,
            mapped_at_creation: false,
        });
        queue.write_buffer(&buffer, 0, &contents);
        buffer
    })
}

/// The pipeline of a stage, which serves all setups of which [`Stage::relevant`] says the same.
/// `source` is the WGSL of [`Stage::source`].
pub(crate) fn pipeline(device: &wgpu::Device, stage: Stage, source: &str) -> wgpu::ComputePipeline {
    let label = Some(stage.entry_point());
    let entry = |(binding, &Binding(resource, access))| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: match (resource, access) {
                (Resource::Job, _) => wgpu::BufferBindingType::Uniform,
                (_, access) => {
                    wgpu::BufferBindingType::Storage { read_only: access == Access::Read }
                }
            },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let entries: Vec<_> = (0..).zip(stage.bindings()).map(entry).collect();
    let group = device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label, entries: &entries });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label,
        layout: Some(&device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label,
            bind_group_layouts: &[Some(&group)],
            immediate_size: 0,
        })),
        module: &device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label,
            source: wgpu::ShaderSource::Wgsl(source.into()),
        }),
        entry_point: label,
        compilation_options: wgpu::PipelineCompilationOptions {
            // Every word of it is written before it is read.
            zero_initialize_workgroup_memory: false,
            ..Default::default()
        },
        cache: None,
    })
}

/// Records one dispatch of a plan. An engine makes the bind groups once.
pub(crate) fn encode(
    device: &wgpu::Device,
    pass: &mut wgpu::ComputePass<'_>,
    pipeline: &wgpu::ComputePipeline,
    dispatch: &Dispatch,
    buffers: &Buffers,
) {
    let entry = |(binding, (resource, span)): (u32, (Resource, Span))| wgpu::BindGroupEntry {
        binding,
        resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &buffers[resource as usize],
            offset: span.offset,
            size: std::num::NonZeroU64::new(span.size),
        }),
    };
    let entries: Vec<_> = (0..).zip(dispatch.bindings()).map(entry).collect();
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(dispatch.stage().entry_point()),
        layout: &pipeline.get_bind_group_layout(0),
        entries: &entries,
    });
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, &group, &[]);
    match dispatch.workgroups() {
        Workgroups::Direct([x, y, z]) => pass.dispatch_workgroups(x, y, z),
        Workgroups::Indirect(offset) => {
            pass.dispatch_workgroups_indirect(&buffers[Resource::Arguments as usize], offset);
        }
    }
}

/// The words of a whole buffer, after everything that was submitted.
pub(crate) fn read(
    (device, queue): &(wgpu::Device, wgpu::Queue),
    buffer: &wgpu::Buffer,
) -> Vec<u32> {
    let staging = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("read back"),
        size: buffer.size(),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, buffer.size());
    queue.submit([encoder.finish()]);
    staging.map_async(wgpu::MapMode::Read, .., |mapped| mapped.expect("the device is not lost"));
    device.poll(wgpu::PollType::wait_indefinitely()).expect("the device is not lost");
    let view = staging.get_mapped_range(..).expect("it is mapped");
    bytemuck::pod_collect_to_vec(&view)
}

/// Tessellates patches of one setup into buffers with this room. What to draw is in the first 20
/// bytes of
/// [`Resource::Arguments`]: `draw_indexed_indirect(arguments, 0)` with [`Resource::Indices`] as the index buffer, and
/// a vertex shader that reads [`Resource::Points`] by `vertex_index`.
pub(crate) fn tessellate(
    gpu: &(wgpu::Device, wgpu::Queue),
    setup: Setup,
    patches: &[PatchFactors],
    room: Capacity,
) -> Buffers {
    let count = u32::try_from(patches.len()).expect("at most 2^30 patches");
    let plan = Plan::new(setup, count, room, Limits::WEBGPU);
    let buffers = buffers(gpu, setup, &plan, patches, &[]);
    let mut encoder = gpu.0.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_compute_pass(&Default::default());
    for dispatch in plan.dispatches() {
        // An engine makes each pipeline once.
        let stage = dispatch.stage();
        let pipeline = pipeline(&gpu.0, stage, &stage.source(stage.relevant(setup)));
        encode(&gpu.0, &mut pass, &pipeline, &dispatch, &buffers);
    }
    drop(pass);
    gpu.1.submit([encoder.finish()]);
    buffers
}

fn main() -> ExitCode {
    run(wgpu::Backends::from_env().unwrap_or_default())
}

/// Tessellates four patches and prints what to draw; 3 without an adapter.
pub(crate) fn run(backends: wgpu::Backends) -> ExitCode {
    let gpu = match open(backends) {
        Ok(gpu) => gpu,
        Err(reason) => {
            eprintln!("{reason}");
            return ExitCode::from(3);
        }
    };
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    let setup = Setup::new(Domain::Quad, config);
    let patches = [2.5, 3.0, 0.0, 5.25].map(|factor| PatchFactors::uniform(Domain::Quad, factor));
    let buffers = tessellate(&gpu, setup, &patches, Capacity::uniform(setup, 4, 5.25));
    let words = |resource: Resource| read(&gpu, &buffers[resource as usize]);
    let draw: DrawIndexed =
        bytemuck::pod_read_unaligned(bytemuck::cast_slice(&words(Resource::Arguments)[..5]));
    println!("{draw:?}");
    for &point in words(Resource::Points).as_chunks().0.iter().take(4) {
        println!("{:?} of patch {}", PackedPoint(point).point(), PackedPoint(point).patch());
    }
    ExitCode::SUCCESS
}
