//! Tessellation with the output read back to the host.

use crate::error::Error;
use crate::{Batch, Gpu, Outputs, Tessellator};
use tess_core::{Patch, PatchFactors};
use tess_gpu::layout::{DrawIndexed, Status, factor_words};
use tess_gpu::{IndexType, Setup};

/// The output of a batch, read back.
#[derive(Clone, Debug)]
pub struct ReadBack {
    /// The numbers of points and primitives, and whether they fit.
    pub status: Status,
    /// The draw arguments.
    pub draw: DrawIndexed,
    /// The beginning of each patch's output: its first point and its first primitive.
    pub begins: Vec<[u32; 2]>,
    /// The points, two words each: see [`tess_gpu::PointFormat`].
    pub points: Vec<[u32; 2]>,
    /// The indices, widened to 32 bits.
    pub indices: Vec<u32>,
}

impl Tessellator {
    /// Tessellates these patches and reads everything back. The sizes of the buffers come from the
    /// counts of the model ([`tess_core`]).
    ///
    /// # Errors
    /// [`Error::WrongDomain`] for patches of another domain than the setup's; an error of size if
    /// the factors or the output are too large for the device; [`Error::DeviceLost`].
    pub fn tessellate(
        &mut self,
        gpu: &Gpu,
        setup: Setup,
        patches: &[PatchFactors],
    ) -> Result<ReadBack, Error> {
        gpu.finish(self.tessellate_async(gpu, setup, patches))
    }

    /// Does the same as [`Self::tessellate`] without blocking: see [`Gpu::read_async`].
    ///
    /// # Errors
    /// Those of [`Tessellator::tessellate`].
    pub async fn tessellate_async(
        &mut self,
        gpu: &Gpu,
        setup: Setup,
        patches: &[PatchFactors],
    ) -> Result<ReadBack, Error> {
        check_domains(setup, patches)?;
        let words = factor_words(patches);
        let usage = wgpu::BufferUsages::STORAGE;
        let factors = gpu.upload("factors", bytemuck::cast_slice(&words), usage)?;
        let count = u32::try_from(patches.len())
            .map_err(|_| Error::TooManyPatches { got: patches.len() })?;
        let room = model_counts(setup, patches);
        let mut run = Run::new(self, gpu, setup, (count, &factors), room).await?;
        // The shaders' counts differ from the model's only if the shaders are wrong. Their output
        // is read back too.
        if !run.status.fits() && counts(&run.status) != room {
            run = Run::new(self, gpu, setup, (count, &factors), counts(&run.status)).await?;
        }
        if !run.status.fits() {
            let [points, primitives] = counts(&run.status);
            return Err(Error::OutputTooLarge { points, primitives });
        }
        run.read(gpu, setup).await
    }
}

/// The points and primitives that the model counts.
fn model_counts(setup: Setup, patches: &[PatchFactors]) -> [u64; 2] {
    patches.iter().fold([0; 2], |[points, primitives], &factors| {
        let counts = Patch::new(setup.config, factors).counts();
        [points + u64::from(counts.points), primitives + u64::from(counts.primitives)]
    })
}

/// The points and primitives that a batch counted.
const fn counts(status: &Status) -> [u64; 2] {
    [status.points(), status.primitives()]
}

/// A batch that has run, and its output on the device.
struct Run {
    batch: Batch,
    points: wgpu::Buffer,
    indices: wgpu::Buffer,
    status: Status,
}

impl Run {
    /// Makes a batch with room for these points and primitives, and runs it.
    async fn new(
        tessellator: &mut Tessellator,
        gpu: &Gpu,
        setup: Setup,
        (count, factors): (u32, &wgpu::Buffer),
        [points, primitives]: [u64; 2],
    ) -> Result<Self, Error> {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let points = gpu.buffer("points", 8 * points, usage)?;
        let index_bytes = u64::from(setup.primitive_bytes()) * primitives;
        let indices = gpu.buffer("indices", index_bytes.next_multiple_of(8), usage)?;
        let outputs = Outputs::Buffers { points: &points, indices: &indices };
        let batch = tessellator.batch(setup, count, factors, outputs)?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        batch.encode(&mut encoder);
        gpu.submit(encoder)?;
        let status = gpu.read_async(batch.status(), size_of::<Status>() as u64).await?;
        let status = bytemuck::pod_read_unaligned(&status);
        Ok(Self { batch, points, indices, status })
    }

    /// Reads everything back.
    async fn read(&self, gpu: &Gpu, setup: Setup) -> Result<ReadBack, Error> {
        let arguments = self.batch.draw_arguments();
        let draw = gpu.read_async(arguments, size_of::<DrawIndexed>() as u64).await?;
        let [points, primitives] = counts(&self.status);
        let points = gpu.read_async(&self.points, 8 * points).await?;
        let count = primitives * u64::from(setup.indices_per_primitive());
        let bytes = (count * u64::from(setup.index_type.bytes())).next_multiple_of(4);
        let indices = gpu.read_async(&self.indices, bytes).await?;
        Ok(ReadBack {
            status: self.status,
            draw: bytemuck::pod_read_unaligned(&draw),
            begins: begins(gpu, &self.batch).await?,
            points: bytemuck::pod_collect_to_vec(&points),
            indices: widened(setup, &indices, count),
        })
    }
}

/// Refuses patches of another domain, because the shaders would read their factors as those of
/// other patches.
pub(crate) fn check_domains(setup: Setup, patches: &[PatchFactors]) -> Result<(), Error> {
    let expected = setup.domain;
    match patches.iter().position(|factors| factors.domain() != expected) {
        None => Ok(()),
        Some(patch) => Err(Error::WrongDomain { patch, expected, got: patches[patch].domain() }),
    }
}

/// The first `count` indices in these bytes.
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

/// The beginning of each patch's output.
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
