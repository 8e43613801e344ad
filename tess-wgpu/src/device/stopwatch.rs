//! Measures times with the device's timestamps.

use crate::{Batch, Error, Gpu};
use tess_gpu::Stage;

/// Timestamps around work on the device.
#[derive(Debug)]
pub struct Stopwatch {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
}

/// The most timestamps of one measurement.
const MAX_STAMPS: u32 = 4096;

impl Stopwatch {
    /// The features that the device must be opened with.
    pub const FEATURES: wgpu::Features = wgpu::Features::TIMESTAMP_QUERY
        .union(wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS)
        .union(wgpu::Features::TIMESTAMP_QUERY_INSIDE_PASSES);

    /// Makes room for timestamps.
    ///
    /// # Errors
    /// [`Error::MissingFeatures`] if the device lacks some of [`Self::FEATURES`];
    /// [`Error::OutOfMemory`].
    pub fn new(gpu: &Gpu) -> Result<Self, Error> {
        let missing = Self::FEATURES - gpu.device.features();
        if !missing.is_empty() {
            return Err(Error::MissingFeatures { missing });
        }
        let usage = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
        let resolved = gpu.buffer("timestamps", 8 * u64::from(MAX_STAMPS), usage)?;
        let queries = gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("timestamps"),
            ty: wgpu::QueryType::Timestamp,
            count: MAX_STAMPS,
        });
        Ok(Self { queries, resolved })
    }

    /// Runs the commands that `work` records, and returns the nanoseconds that they took on the
    /// device.
    ///
    /// # Errors
    /// [`Error::DeviceLost`].
    pub fn time(
        &self,
        gpu: &Gpu,
        work: impl FnOnce(&mut wgpu::CommandEncoder),
    ) -> Result<u64, Error> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.write_timestamp(&self.queries, 0);
        work(&mut encoder);
        encoder.write_timestamp(&self.queries, 1);
        let stamps = self.finish(gpu, encoder, 2)?;
        Ok(self.nanoseconds(gpu, stamps[0], stamps[1]))
    }

    /// Runs a batch, and returns the nanoseconds of each of its dispatches, at most 4095.
    ///
    /// # Errors
    /// [`Error::DeviceLost`].
    pub fn time_stages(&self, gpu: &Gpu, batch: &Batch) -> Result<Vec<(Stage, u64)>, Error> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.write_timestamp(&self.queries, 0);
        let mut stages = Vec::new();
        let mut next = 1;
        batch.encode_each(&mut encoder, |pass, stage| {
            if next < MAX_STAMPS {
                pass.write_timestamp(&self.queries, next);
                stages.push(stage);
                next += 1;
            }
        });
        let stamps = self.finish(gpu, encoder, next)?;
        let times = stamps.windows(2).map(|pair| self.nanoseconds(gpu, pair[0], pair[1]));
        Ok(stages.into_iter().zip(times).collect())
    }

    fn finish(
        &self,
        gpu: &Gpu,
        mut encoder: wgpu::CommandEncoder,
        count: u32,
    ) -> Result<Vec<u64>, Error> {
        encoder.resolve_query_set(&self.queries, 0..count, &self.resolved, 0);
        gpu.run(encoder)?;
        Ok(bytemuck::pod_collect_to_vec(&gpu.read(&self.resolved, 8 * u64::from(count))?))
    }

    #[expect(
        clippy::float_arithmetic,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "the device gives its period as a binary32"
    )]
    fn nanoseconds(&self, gpu: &Gpu, from: u64, to: u64) -> u64 {
        (to.wrapping_sub(from) as f64 * f64::from(gpu.queue.get_timestamp_period())) as u64
    }
}
