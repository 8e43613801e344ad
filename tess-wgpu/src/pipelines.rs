//! Pipelines and tables of one device, each made when it is first asked for.

use crate::error::{Error, checked};
use crate::{gpu, limits, pipeline};
use std::collections::HashMap;
use std::fmt;
use tess_core::SplitOrder;
#[cfg(feature = "measure")]
use tess_gpu::Tap;
use tess_gpu::{Limits, Setup, Stage, tables};

/// What changes a shader's source before it is compiled.
pub(crate) type Edit = Box<dyn Fn(Stage, String) -> String + Send + Sync>;

/// Pipelines by stage and by the part of the setup that the stage depends on; those of taps; tables by split order.
pub(crate) struct Pipelines {
    device: wgpu::Device,
    limits: Limits,
    edit: Option<Edit>,
    pipelines: HashMap<(Stage, Setup), wgpu::ComputePipeline>,
    #[cfg(feature = "measure")]
    taps: HashMap<(Tap, Setup), wgpu::ComputePipeline>,
    tables: HashMap<SplitOrder, wgpu::Buffer>,
}

impl Pipelines {
    /// None yet.
    pub(crate) fn new(device: &wgpu::Device, edit: Option<Edit>) -> Self {
        let limits = Limits {
            storage_binding: device.limits().max_storage_buffer_binding_size,
            workgroups: device.limits().max_compute_workgroups_per_dimension,
        };
        Self {
            device: device.clone(),
            limits,
            edit,
            pipelines: HashMap::new(),
            #[cfg(feature = "measure")]
            taps: HashMap::new(),
            tables: HashMap::new(),
        }
    }

    /// Keeps to these limits instead of the device's.
    pub(crate) const fn limit(&mut self, limits: Limits) {
        self.limits = limits;
    }

    pub(crate) const fn limits(&self) -> Limits {
        self.limits
    }

    pub(crate) const fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// The pipeline of a stage, made when it is first asked for.
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
        let pipeline = checked(&self.device, || pipeline::of_stage(&self.device, stage, &source))?;
        self.pipelines.insert(key, pipeline.clone());
        Ok(pipeline)
    }

    /// The pipeline of a tap, made when it is first asked for.
    #[cfg(feature = "measure")]
    pub(crate) fn tap(&mut self, tap: Tap, setup: Setup) -> Result<wgpu::ComputePipeline, Error> {
        if let Some(pipeline) = self.taps.get(&(tap, setup)) {
            return Ok(pipeline.clone());
        }
        let source = tap.source(setup);
        let pipeline = checked(&self.device, || pipeline::of_tap(&self.device, &source))?;
        self.taps.insert((tap, setup), pipeline.clone());
        Ok(pipeline)
    }

    /// The constant tables of a split order, uploaded when they are first asked for.
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
        let Self { device, limits, pipelines, tables, .. } = self;
        let mut all = f.debug_struct("Pipelines");
        all.field("device", device).field("limits", limits);
        all.field("pipelines", pipelines).field("tables", tables);
        all.finish_non_exhaustive()
    }
}
