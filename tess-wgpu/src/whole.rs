//! Patches in, output back on the host.

use crate::error::Error;
use crate::{Batch, Gpu, Outputs, Tessellator};
use tess_core::PatchFactors;
use tess_gpu::layout::{DrawIndexed, Status, factor_words};
use tess_gpu::{IndexType, Setup};

/// The output of a batch, read back.
#[derive(Clone, Debug)]
pub struct ReadBack {
    /// The batch's needs.
    pub status: Status,
    /// The draw arguments.
    pub draw: DrawIndexed,
    /// Where each patch's output begins: its first point and its first primitive.
    pub begins: Vec<[u32; 2]>,
    /// The points, two words each: see [`tess_gpu::PointFormat`].
    pub points: Vec<[u32; 2]>,
    /// The indices, widened to 32 bits.
    pub indices: Vec<u32>,
}

impl Tessellator {
    /// Counts the batch, makes buffers of that size, tessellates and reads everything back.
    ///
    /// # Errors
    /// [`Error::WrongDomain`] for patches of another domain than the setup's; an error of size if the
    /// factors or the output are too large for the device; [`Error::DeviceLost`].
    pub fn tessellate(
        &mut self,
        gpu: &Gpu,
        setup: Setup,
        patches: &[PatchFactors],
    ) -> Result<ReadBack, Error> {
        gpu.finish(self.tessellate_async(gpu, setup, patches))
    }

    /// The same without blocking: see [`Gpu::read_async`].
    ///
    /// # Errors
    /// As [`Tessellator::tessellate`].
    pub async fn tessellate_async(
        &mut self,
        gpu: &Gpu,
        setup: Setup,
        patches: &[PatchFactors],
    ) -> Result<ReadBack, Error> {
        use wgpu::BufferUsages as Usage;
        check_domains(setup, patches)?;
        let words = factor_words(patches);
        let factors = gpu.upload("factors", bytemuck::cast_slice(&words), Usage::STORAGE)?;
        let count = u32::try_from(patches.len())
            .map_err(|_| Error::TooManyPatches { got: patches.len() })?;
        let needed = run(gpu, &self.batch(setup, count, &factors, Outputs::CountOnly)?).await?;
        let indices = needed.primitives() * u64::from(setup.indices_per_primitive());
        let usage = Usage::STORAGE | Usage::COPY_SRC;
        let point_buffer = gpu.buffer("points", 8 * needed.points(), usage)?;
        let index_bytes = u64::from(setup.index_type.bytes()) * indices;
        let index_buffer = gpu.buffer("indices", index_bytes.next_multiple_of(8), usage)?;
        let outputs = Outputs::Buffers { points: &point_buffer, indices: &index_buffer };
        let batch = self.batch(setup, count, &factors, outputs)?;
        let status = run(gpu, &batch).await?;
        if !status.fits() {
            let (points, primitives) = (needed.points(), needed.primitives());
            return Err(Error::OutputTooLarge { points, primitives });
        }
        let draw = gpu.read_async(batch.draw_arguments(), size_of::<DrawIndexed>() as u64).await?;
        Ok(ReadBack {
            status,
            draw: bytemuck::pod_read_unaligned(&draw),
            begins: begins(gpu, &batch).await?,
            points: bytemuck::pod_collect_to_vec(
                &gpu.read_async(&point_buffer, 8 * needed.points()).await?,
            ),
            indices: widened(
                setup,
                &gpu.read_async(&index_buffer, index_bytes.next_multiple_of(4)).await?,
                indices,
            ),
        })
    }
}

/// Refuses patches of another domain, whose factors would be read as those of other patches.
pub(crate) fn check_domains(setup: Setup, patches: &[PatchFactors]) -> Result<(), Error> {
    let expected = setup.domain;
    match patches.iter().position(|factors| factors.domain() != expected) {
        None => Ok(()),
        Some(patch) => Err(Error::WrongDomain { patch, expected, got: patches[patch].domain() }),
    }
}

/// The first `count` indices of these bytes.
fn widened(setup: Setup, bytes: &[u8], count: u64) -> Vec<u32> {
    let mut indices: Vec<u32> = match setup.index_type {
        IndexType::U16 => {
            bytes.as_chunks().0.iter().map(|&two| u16::from_le_bytes(two).into()).collect()
        }
        IndexType::U32 => bytemuck::pod_collect_to_vec(bytes),
    };
    indices.truncate(usize::try_from(count).unwrap_or(usize::MAX));
    indices
}

/// Where each patch's output begins.
async fn begins(gpu: &Gpu, batch: &Batch) -> Result<Vec<[u32; 2]>, Error> {
    let bytes = gpu.read_async(batch.offsets(), batch.offsets().size()).await?;
    let offsets: Vec<[u32; 2]> = bytemuck::pod_collect_to_vec(&bytes[..bytes.len() / 8 * 8]);
    let at = |entry: u64| usize::try_from(entry).ok().and_then(|entry| offsets.get(entry));
    let sum = |[points, primitives]: [u32; 2], entry: u64| {
        let [more_points, more_primitives] = at(entry).copied().unwrap_or_default();
        [points.wrapping_add(more_points), primitives.wrapping_add(more_primitives)]
    };
    let begin = |patch| batch.plan().offset_entries(patch).into_iter().fold([0; 2], sum);
    Ok((0..batch.plan().patches()).map(begin).collect())
}

/// Runs a batch; returns its status.
async fn run(gpu: &Gpu, batch: &Batch) -> Result<Status, Error> {
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    batch.encode(&mut encoder);
    gpu.submit(encoder)?;
    let status = gpu.read_async(batch.status(), size_of::<Status>() as u64).await?;
    Ok(bytemuck::pod_read_unaligned(&status))
}
