//! The simple way: patches in, output back on the host.

use crate::layout::{DrawIndexed, Status, factor_words};
use crate::runner::{Batch, Gpu, Outputs, Tessellator};
use crate::setup::Setup;
use tess_core::PatchFactors;

/// A batch's output, read back.
#[derive(Clone, Debug)]
pub struct Output {
    /// What the batch needed.
    pub status: Status,
    /// The draw arguments.
    pub draw: DrawIndexed,
    /// The points, two words each: see [`crate::PointFormat`].
    pub points: Vec<[u32; 2]>,
    /// The indices.
    pub indices: Vec<u32>,
}

impl Tessellator {
    /// Counts the batch, makes buffers of that size, tessellates and reads everything back.
    ///
    /// # Errors
    /// A message if the device was lost or the output does not fit the device.
    pub fn tessellate(
        &mut self,
        gpu: &Gpu,
        setup: Setup,
        patches: &[PatchFactors],
    ) -> Result<Output, String> {
        use wgpu::BufferUsages as Usage;
        let words = factor_words(patches);
        let factors = gpu.upload("factors", bytemuck::cast_slice(&words), Usage::STORAGE);
        let count = u32::try_from(patches.len()).map_err(|error| error.to_string())?;
        let prepare = |tessellator: &mut Self, outputs| {
            tessellator.batch(setup, count, &factors, outputs).map_err(|error| error.to_string())
        };
        let needed = run(gpu, &prepare(self, Outputs::CountOnly)?)?;
        let indices = needed.primitives() * u64::from(setup.indices_per_primitive());
        let usage = Usage::STORAGE | Usage::COPY_SRC;
        let point_buffer = gpu.buffer("points", 8 * needed.points(), usage);
        let index_buffer = gpu.buffer("indices", 4 * indices, usage);
        let outputs = Outputs::Buffers { points: &point_buffer, indices: &index_buffer };
        let batch = prepare(self, outputs)?;
        let status = run(gpu, &batch)?;
        if !status.fits() {
            return Err(format!("{} points and {indices} indices do not fit", needed.points()));
        }
        let draw = gpu.read(batch.draw_arguments(), size_of::<DrawIndexed>() as u64)?;
        Ok(Output {
            status,
            draw: bytemuck::pod_read_unaligned(&draw),
            points: bytemuck::pod_collect_to_vec(&gpu.read(&point_buffer, 8 * needed.points())?),
            indices: bytemuck::pod_collect_to_vec(&gpu.read(&index_buffer, 4 * indices)?),
        })
    }
}

/// Runs a batch; returns its status.
fn run(gpu: &Gpu, batch: &Batch) -> Result<Status, String> {
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    batch.encode(&mut encoder);
    gpu.run(encoder)?;
    Ok(bytemuck::pod_read_unaligned(&gpu.read(batch.status(), size_of::<Status>() as u64)?))
}
