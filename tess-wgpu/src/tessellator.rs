//! Pipelines and tables of one device.

use crate::batch::Patches;
use crate::error::{Error, checked};
use crate::{Batch, Outputs, gpu, limits, pipeline};
use std::collections::HashMap;
use std::fmt;
use tess_core::SplitOrder;
use tess_gpu::tables;
use tess_gpu::{Limits, Setup, Stage};

/// Makes and keeps the pipelines and tables of one device.
pub struct Tessellator {
    device: wgpu::Device,
    limits: Limits,
    edit: Option<Edit>,
    pipelines: HashMap<(Stage, Setup), wgpu::ComputePipeline>,
    tables: HashMap<SplitOrder, wgpu::Buffer>,
}

/// What changes a shader's source before it is compiled.
type Edit = Box<dyn Fn(Stage, String) -> String + Send + Sync>;

impl Tessellator {
    /// For a device with at least WebGPU's default limits; it uses what the device has beyond.
    ///
    /// Nothing is compiled yet: a [`Batch`] makes the pipelines that are missing.
    #[must_use]
    pub fn new(device: &wgpu::Device) -> Self {
        let limits = Limits {
            storage_binding: device.limits().max_storage_buffer_binding_size,
            workgroups: device.limits().max_compute_workgroups_per_dimension,
        };
        let (pipelines, tables) = (HashMap::new(), HashMap::new());
        Self { device: device.clone(), limits, edit: None, pipelines, tables }
    }

    /// The same, with every shader edited before it is compiled: for tests that plant faults and
    /// for experiments.
    #[cfg(feature = "measure")]
    #[must_use]
    pub fn with_edit(
        device: &wgpu::Device,
        edit: impl Fn(Stage, String) -> String + Send + Sync + 'static,
    ) -> Self {
        Self { edit: Some(Box::new(edit)), ..Self::new(device) }
    }

    /// The same, keeping to these limits instead of the device's, which are higher.
    #[must_use]
    pub const fn limited(mut self, limits: Limits) -> Self {
        self.limits = limits;
        self
    }

    /// Prepares a batch of `patches` patches: see [`Batch`].
    ///
    /// `factors` holds the raw factors of the patches as [`tess_gpu::layout::factor_words`] writes
    /// them. All buffers have the usage `STORAGE`. Make a batch once and encode it each frame.
    ///
    /// # Errors
    /// [`Error::FactorsTooShort`], [`Error::NotStorage`], [`Error::SharedBuffer`] or
    /// [`Error::TooManyPatches`] for these buffers; [`Error::BufferTooLarge`] or
    /// [`Error::OutOfMemory`] if what is in between does not fit the device.
    pub fn batch(
        &mut self,
        setup: Setup,
        patches: u32,
        factors: &wgpu::Buffer,
        outputs: Outputs<'_>,
    ) -> Result<Batch, Error> {
        self.batch_in_groups(setup, patches, &[], factors, outputs)
    }

    /// The same, with draw arguments for each group of patches ([`Batch::group_arguments`]), so that
    /// several meshes of one setup are tessellated in one go and drawn one by one.
    ///
    /// `groups` holds the number of each group's first patch. A group ends where the next one begins, the
    /// last one at the end of the batch; a group may be empty. The numbers ascend and are at most `patches`.
    ///
    /// # Errors
    /// [`Error::MisplacedGroup`] or [`Error::TooManyGroups`] for these groups, and the errors of
    /// [`Self::batch`].
    pub fn batch_in_groups(
        &mut self,
        setup: Setup,
        patches: u32,
        groups: &[u32],
        factors: &wgpu::Buffer,
        outputs: Outputs<'_>,
    ) -> Result<Batch, Error> {
        Batch::new(self, setup, Patches { count: patches, groups, factors }, outputs)
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

impl fmt::Debug for Tessellator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { device, limits, pipelines, tables, .. } = self;
        let mut all = f.debug_struct("Tessellator");
        all.field("device", device).field("limits", limits);
        all.field("pipelines", pipelines).field("tables", tables);
        all.finish_non_exhaustive()
    }
}
