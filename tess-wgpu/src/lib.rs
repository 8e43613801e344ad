//! Runs the compute shaders of `tess-gpu` on wgpu: pipelines are made once, a batch's buffers and bind groups
//! once per batch, and encoding it into the caller's command encoder is all that is left per frame.

mod batch;
mod buffers;
mod dispatches;
mod gpu;
mod stopwatch;
mod whole;

pub use batch::{Batch, Error, Outputs};
pub use gpu::{Gpu, Unavailable, Wanted};
pub use stopwatch::Stopwatch;
pub use whole::Output;

use std::collections::HashMap;
use std::fmt;
use tess_core::SplitOrder;
use tess_gpu::bindings::{Access, Binding, Resource};
use tess_gpu::setup::Setup;
use tess_gpu::shaders::Stage;
use tess_gpu::sizes::Limits;
use tess_gpu::tables::tables;

/// Makes and keeps the pipelines of one device.
pub struct Tessellator {
    device: wgpu::Device,
    edit: Box<dyn Fn(Stage, String) -> String + Send + Sync>,
    limits: Limits,
    pipelines: HashMap<(Stage, Setup), wgpu::ComputePipeline>,
    tables: HashMap<SplitOrder, wgpu::Buffer>,
}

impl Tessellator {
    /// For a device with at least WebGPU's default limits; it uses what the device has beyond.
    #[must_use]
    pub fn new(device: &wgpu::Device) -> Self {
        Self::with_edit(device, |_, source| source)
    }

    /// The same, with every shader edited before it is compiled: for tests that plant faults and
    /// for experiments.
    #[must_use]
    pub fn with_edit(
        device: &wgpu::Device,
        edit: impl Fn(Stage, String) -> String + Send + Sync + 'static,
    ) -> Self {
        let (pipelines, tables) = (HashMap::new(), HashMap::new());
        let of_device = device.limits();
        let limits = Limits {
            storage_binding: of_device.max_storage_buffer_binding_size,
            workgroups: of_device.max_compute_workgroups_per_dimension,
        };
        Self { device: device.clone(), edit: Box::new(edit), limits, pipelines, tables }
    }

    /// The same, keeping to these limits instead of the device's, which are higher.
    #[must_use]
    pub const fn limited(mut self, limits: Limits) -> Self {
        self.limits = limits;
        self
    }

    /// Prepares `patches` patches of the caller's buffers: see [`Batch`].
    ///
    /// # Errors
    /// [`Error`] if the buffer of factors is too short or is not to be bound as storage.
    pub fn batch(
        &mut self,
        setup: Setup,
        patches: u32,
        factors: &wgpu::Buffer,
        outputs: Outputs<'_>,
    ) -> Result<Batch, Error> {
        Batch::new(self, setup, patches, factors, outputs)
    }

    const fn limits(&self) -> Limits {
        self.limits
    }

    const fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// The pipeline of a stage, made when it is first asked for.
    fn pipeline(&mut self, stage: Stage, setup: Setup) -> wgpu::ComputePipeline {
        let key = (stage, stage.relevant(setup));
        let (device, edit) = (&self.device, &self.edit);
        let make = || make_pipeline(device, stage, &edit(stage, stage.source(key.1)));
        self.pipelines.entry(key).or_insert_with(make).clone()
    }

    /// The constant tables of a split order, uploaded when they are first asked for.
    fn tables(&mut self, split: SplitOrder) -> wgpu::Buffer {
        let device = &self.device;
        let make = || {
            let words = tables(split);
            gpu::filled(device, "tables", bytemuck::cast_slice(&words), wgpu::BufferUsages::STORAGE)
        };
        self.tables.entry(split).or_insert_with(make).clone()
    }
}

impl fmt::Debug for Tessellator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { device, pipelines, tables, .. } = self;
        let mut all = f.debug_struct("Tessellator");
        all.field("device", device).field("pipelines", pipelines).field("tables", tables);
        all.finish_non_exhaustive()
    }
}

fn make_pipeline(device: &wgpu::Device, stage: Stage, source: &str) -> wgpu::ComputePipeline {
    let label = Some(stage.entry_point());
    let entries: Vec<_> = (0..).zip(stage.bindings()).map(layout_entry).collect();
    compute_pipeline(device, label, source, &entries)
}

/// The pipeline of a probe's source, and its buffers bound.
fn probe_pipeline(
    device: &wgpu::Device,
    source: &str,
    buffers: &[wgpu::Buffer; 3],
) -> (wgpu::ComputePipeline, wgpu::BindGroup) {
    let label = Some("probes");
    let accesses = [Access::Read, Access::ReadWrite, Access::Read];
    let bindings = accesses.map(|access| Binding(Resource::Tables, access));
    let entries: Vec<_> = (0..).zip(&bindings).map(layout_entry).collect();
    let pipeline = compute_pipeline(device, label, source, &entries);
    let entries: Vec<_> = (0..)
        .zip(buffers)
        .map(|(binding, buffer)| wgpu::BindGroupEntry {
            binding,
            resource: buffer.as_entire_binding(),
        })
        .collect();
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &entries,
    });
    (pipeline, group)
}

fn compute_pipeline(
    device: &wgpu::Device,
    label: Option<&str>,
    source: &str,
    entries: &[wgpu::BindGroupLayoutEntry],
) -> wgpu::ComputePipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label,
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    let group =
        device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label, entries });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label,
        bind_group_layouts: &[Some(&group)],
        immediate_size: 0,
    });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label,
        layout: Some(&layout),
        module: &module,
        entry_point: label,
        compilation_options: wgpu::PipelineCompilationOptions {
            // Every word of it is written before it is read.
            zero_initialize_workgroup_memory: false,
            ..Default::default()
        },
        cache: None,
    })
}

fn layout_entry(
    (binding, &Binding(resource, access)): (u32, &Binding),
) -> wgpu::BindGroupLayoutEntry {
    let ty = match (resource, access) {
        (Resource::Job, _) => wgpu::BufferBindingType::Uniform,
        (_, Access::Read) => wgpu::BufferBindingType::Storage { read_only: true },
        (_, Access::ReadWrite) => wgpu::BufferBindingType::Storage { read_only: false },
    };
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
        count: None,
    }
}
