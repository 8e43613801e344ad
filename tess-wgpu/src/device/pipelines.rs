//! The pipelines and tables of one device, each made when it is first needed.

use super::{gpu, limits, pipeline};
use crate::error::{Error, checked};
use std::collections::HashMap;
use std::fmt;
use std::sync::{Arc, Weak};
use tess_core::SplitOrder;
#[cfg(feature = "measure")]
use tess_gpu::{Access, Resource, Tap};
use tess_gpu::{Binding, Setup, Stage, tables};

/// A change of a shader's source before it is compiled.
pub(crate) type Edit = Box<dyn Fn(Stage, String) -> String + Send + Sync>;

/// Pipelines by stage and by the part of the setup that the stage depends on; pipelines of taps;
/// tables by split order; and the pipelines and layouts that tessellation stages share.
pub(crate) struct Pipelines {
    device: wgpu::Device,
    /// wgpu's cache, which all later pipelines use.
    pub(crate) cache: Option<wgpu::PipelineCache>,
    edit: Option<Edit>,
    pipelines: HashMap<(Stage, Setup), wgpu::ComputePipeline>,
    #[cfg(feature = "measure")]
    taps: HashMap<(Tap, Setup), wgpu::ComputePipeline>,
    tables: HashMap<SplitOrder, wgpu::Buffer>,
    layouts: HashMap<Vec<wgpu::BindGroupLayoutEntry>, wgpu::BindGroupLayout>,
    pub(crate) passes: Shared<wgpu::ComputePipeline>,
    pub(crate) draws: Shared<wgpu::RenderPipeline>,
}

/// The key of a tessellation stage's pipeline: everything that determines it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct PipelineKey {
    /// The WGSL that the entry points reach and, for a render pipeline, the render state.
    pub(crate) text: String,
    pub(crate) entry_point: &'static str,
    pub(crate) layouts: Vec<wgpu::BindGroupLayout>,
    /// Names of pipeline constants, and the bits of their values.
    pub(crate) constants: Vec<(String, u64)>,
}

/// Pipelines that live as long as a stage uses them.
pub(crate) struct Shared<P>(HashMap<PipelineKey, Weak<P>>);

impl<P> Shared<P> {
    pub(crate) fn find(&self, key: &PipelineKey) -> Option<Arc<P>> {
        self.0.get(key).and_then(Weak::upgrade)
    }

    pub(crate) fn keep(&mut self, key: PipelineKey, made: P) -> Arc<P> {
        let made = Arc::new(made);
        self.0.retain(|_, one| one.strong_count() > 0);
        self.0.insert(key, Arc::downgrade(&made));
        made
    }
}

impl Pipelines {
    /// No pipelines or tables yet.
    pub(crate) fn new(device: &wgpu::Device, edit: Option<Edit>) -> Self {
        Self {
            device: device.clone(),
            cache: None,
            edit,
            pipelines: HashMap::new(),
            #[cfg(feature = "measure")]
            taps: HashMap::new(),
            tables: HashMap::new(),
            layouts: HashMap::new(),
            passes: Shared(HashMap::new()),
            draws: Shared(HashMap::new()),
        }
    }

    pub(crate) const fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// The layout of these entries, made when it is first needed.
    pub(crate) fn layout(
        &mut self,
        label: &str,
        entries: Vec<wgpu::BindGroupLayoutEntry>,
    ) -> Result<wgpu::BindGroupLayout, Error> {
        if let Some(layout) = self.layouts.get(&entries) {
            return Ok(layout.clone());
        }
        let layout = checked(&self.device, || {
            self.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(label),
                entries: &entries,
            })
        })?;
        self.layouts.insert(entries, layout.clone());
        Ok(layout)
    }

    /// The pipeline of a stage, made when it is first needed.
    pub(crate) fn pipeline(
        &mut self,
        stage: Stage,
        setup: Setup,
    ) -> Result<wgpu::ComputePipeline, Error> {
        let key = (stage, stage.relevant(setup));
        if let Some(pipeline) = self.pipelines.get(&key) {
            return Ok(pipeline.clone());
        }
        let mut source = stage.source(key.1);
        if let Some(edit) = &self.edit {
            source = edit(stage, source);
        }
        let pipeline = self.compiled(stage.entry_point(), source, stage.bindings())?;
        self.pipelines.insert(key, pipeline.clone());
        Ok(pipeline)
    }

    /// The pipeline of a shader with these bindings in group 0.
    fn compiled(
        &mut self,
        entry_point: &str,
        source: String,
        bindings: &[Binding],
    ) -> Result<wgpu::ComputePipeline, Error> {
        let entry =
            |(number, &binding)| pipeline::entry(number, binding, wgpu::ShaderStages::COMPUTE);
        let layouts = [self.layout(entry_point, (0..).zip(bindings).map(entry).collect())?];
        let module = pipeline::module(&self.device, entry_point, source)?;
        let options = wgpu::PipelineCompilationOptions {
            // The shaders write every word of workgroup memory before they read it.
            zero_initialize_workgroup_memory: false,
            ..Default::default()
        };
        let (of, cache) = ((&module, entry_point), self.cache.as_ref());
        pipeline::compute(&self.device, of, &layouts, options, cache)
    }

    /// The pipeline of a tap, made when it is first needed.
    #[cfg(feature = "measure")]
    pub(crate) fn tap(&mut self, tap: Tap, setup: Setup) -> Result<wgpu::ComputePipeline, Error> {
        if let Some(pipeline) = self.taps.get(&(tap, setup)) {
            return Ok(pipeline.clone());
        }
        let bindings = [Access::Read, Access::ReadWrite, Access::Read]
            .map(|access| Binding(Resource::Tables, access));
        let pipeline = self.compiled("taps", tap.source(setup), &bindings)?;
        self.taps.insert((tap, setup), pipeline.clone());
        Ok(pipeline)
    }

    /// The constant tables of a split order, uploaded when they are first needed.
    pub(crate) fn tables(&mut self, split: SplitOrder) -> Result<wgpu::Buffer, Error> {
        if let Some(buffer) = self.tables.get(&split) {
            return Ok(buffer.clone());
        }
        let words = tables(split);
        let bytes = bytemuck::cast_slice::<u32, u8>(&words);
        let (needed, limits) = (size_of_val(bytes) as u64, self.device.limits());
        limits::at_least("max_buffer_size", needed, limits.max_buffer_size)?;
        limits::at_least(
            "max_storage_buffer_binding_size",
            needed,
            limits.max_storage_buffer_binding_size,
        )?;
        let buffer = gpu::filled(&self.device, "tables", bytes, wgpu::BufferUsages::STORAGE)?;
        self.tables.insert(split, buffer.clone());
        Ok(buffer)
    }
}

impl fmt::Debug for Pipelines {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { device, pipelines, tables, .. } = self;
        let mut all = f.debug_struct("Pipelines");
        all.field("device", device).field("pipelines", pipelines).field("tables", tables);
        all.finish_non_exhaustive()
    }
}
