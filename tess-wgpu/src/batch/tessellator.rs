//! Batches of one device, made.

use super::outputs::{Outputs, Patches};
use crate::Batch;
use crate::device::pipelines::{Edit, Pipelines};
use crate::error::Error;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tess_gpu::{Limits, Setup, Stage};

/// Makes batches for one device, and keeps the pipelines and tables that they share.
///
/// A clone shares them too, so that nothing is compiled twice: for [`StageBuilder::tessellator`],
/// or another thread.
///
/// [`StageBuilder::tessellator`]: crate::stage::StageBuilder::tessellator
#[derive(Clone, Debug)]
pub struct Tessellator {
    device: wgpu::Device,
    shared: Arc<Mutex<Pipelines>>,
    limits: Limits,
}

impl Tessellator {
    /// For a device with at least WebGPU's default limits. Higher limits of the device are used.
    ///
    /// Nothing is compiled yet: a [`Batch`] makes the pipelines that are missing.
    #[must_use]
    pub fn new(device: &wgpu::Device) -> Self {
        Self::of(device, None)
    }

    fn of(device: &wgpu::Device, edit: Option<Edit>) -> Self {
        let limits = device.limits();
        let limits = Limits {
            storage_binding: limits.max_storage_buffer_binding_size,
            workgroups: limits.max_compute_workgroups_per_dimension,
        };
        let shared = Arc::new(Mutex::new(Pipelines::new(device, edit)));
        Self { device: device.clone(), shared, limits }
    }

    /// The same; pipelines that are made from now on, also by clones and stages, go through wgpu's
    /// cache, which a program can keep in a file.
    #[must_use]
    pub fn with_pipeline_cache(self, cache: &wgpu::PipelineCache) -> Self {
        self.pipelines().cache = Some(cache.clone());
        self
    }

    pub(crate) const fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// Makes the pipelines of these stages that are missing.
    pub(crate) fn compile(&self, setup: Setup, stages: &[Stage]) -> Result<(), Error> {
        let mut pipelines = self.pipelines();
        stages.iter().try_for_each(|&stage| pipelines.pipeline(stage, setup).map(drop))
    }

    /// The pipelines that clones share.
    pub(crate) fn pipelines(&self) -> MutexGuard<'_, Pipelines> {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }

    #[cfg(feature = "measure")]
    pub(crate) const fn limits(&self) -> Limits {
        self.limits
    }

    /// The same, with every shader edited before it is compiled: for tests that plant faults and
    /// for experiments.
    #[cfg(feature = "measure")]
    #[must_use]
    pub fn with_edit(
        device: &wgpu::Device,
        edit: impl Fn(Stage, String) -> String + Send + Sync + 'static,
    ) -> Self {
        Self::of(device, Some(Box::new(edit)))
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

    /// The same, with draw arguments for each group of patches ([`Batch::group_arguments`]), so
    /// that several meshes of one setup are tessellated in one go and drawn one by one.
    ///
    /// `groups` holds the number of each group's first patch. A group ends where the next one
    /// begins, the last one at the end of the batch; a group may be empty. The numbers ascend and
    /// are at most `patches`.
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
        let patches = Patches { count: patches, groups, factors };
        Batch::new((&mut self.pipelines(), self.limits), setup, patches, outputs)
    }
}
