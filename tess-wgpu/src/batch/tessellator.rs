//! Makes the batches of one device.

use super::outputs::{Outputs, Patches};
use crate::Batch;
use crate::device::pipelines::{Edit, Pipelines};
use crate::error::Error;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tess_gpu::{Limits, Setup, Stage};

/// Makes batches for one device, and keeps the pipelines and tables that they share.
///
/// Clones share them too, so that nothing is compiled twice: pass one to
/// [`StageBuilder::tessellator`] or to another thread.
///
/// [`StageBuilder::tessellator`]: crate::stage::StageBuilder::tessellator
#[derive(Clone, Debug)]
pub struct Tessellator {
    device: wgpu::Device,
    shared: Arc<Mutex<Pipelines>>,
    limits: Limits,
}

impl Tessellator {
    /// A tessellator for a device with at least WebGPU's default limits. Higher limits of the
    /// device are used.
    ///
    /// Compiles nothing yet: making a [`Batch`] makes the pipelines that are missing.
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

    /// This tessellator with a pipeline cache of wgpu's, which a program can keep in a file. All
    /// pipelines that are made later use it, including those of clones and stages.
    #[must_use]
    pub fn with_pipeline_cache(self, cache: &wgpu::PipelineCache) -> Self {
        self.pipelines().cache = Some(cache.clone());
        self
    }

    pub(crate) const fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// Makes the missing pipelines of these stages.
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

    /// As [`Self::new`], but edits every shader before it is compiled: for tests that plant faults,
    /// and for experiments.
    #[cfg(feature = "measure")]
    #[must_use]
    pub fn with_edit(
        device: &wgpu::Device,
        edit: impl Fn(Stage, String) -> String + Send + Sync + 'static,
    ) -> Self {
        Self::of(device, Some(Box::new(edit)))
    }

    /// This tessellator with these limits instead of the device's, which must not be lower.
    #[must_use]
    pub const fn limited(mut self, limits: Limits) -> Self {
        self.limits = limits;
        self
    }

    /// Prepares a batch of `patches` patches: see [`Batch`].
    ///
    /// `factors` has the raw factors of the patches in the layout of
    /// [`tess_gpu::layout::factor_words`]. All buffers need the usage `STORAGE`. Make a batch once
    /// and encode it in each frame.
    ///
    /// # Errors
    /// [`Error::FactorsTooShort`], [`Error::NotStorage`], [`Error::SharedBuffer`],
    /// [`Error::TooManyPatches`] or [`Error::TooManyToPull`] for these patches and buffers;
    /// [`Error::LimitTooLow`] if the device cannot run batches; [`Error::BufferTooLarge`] or
    /// [`Error::OutOfMemory`] if the intermediate buffers do not fit the device.
    pub fn batch(
        &mut self,
        setup: Setup,
        patches: u32,
        factors: &wgpu::Buffer,
        outputs: Outputs<'_>,
    ) -> Result<Batch, Error> {
        self.batch_in_groups(setup, patches, &[], factors, outputs)
    }

    /// [`Self::batch`], with draw arguments for each group of patches ([`Batch::group_arguments`]),
    /// so that several meshes of one setup are tessellated together and drawn separately.
    ///
    /// `groups` has the number of each group's first patch, in ascending order and at most
    /// `patches`. A group ends where the next one begins, the last one at the end of the batch. A
    /// group may be empty.
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
