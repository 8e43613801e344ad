//! The compute shaders as a backend.

use crate::failure::Failure;
use tess_core::{
    Config, Domain, DomainPoint, FactorContext, FixedFactor, OutputPrimitive, Parity, Partitioning,
    PatchFactors, SplitOrder, Tessellation,
};
use tess_gpu::layout::{PackedPoint, pack_context, unpack_context};
use tess_gpu::{Numbering, Setup, Tap};
use tess_verify::{Answers, Backend, BackendError};
use tess_wgpu::{Gpu, ReadBack, Tessellator};
use tess_workloads::IndexWidth;

/// `tess-gpu` on the first available adapter, with WebGPU's default limits.
#[derive(Debug)]
pub(crate) struct GpuBackend {
    gpu: Gpu,
    tessellator: Tessellator,
    index_type: IndexWidth,
}

impl GpuBackend {
    /// Opens the adapter, for indices of 16 or 32 bits. Errors: exit code 3 if there is no adapter.
    pub(crate) fn open(index_type: IndexWidth) -> Result<Self, Failure> {
        let gpu = pollster::block_on(Gpu::open()).map_err(Failure::unavailable)?;
        let tessellator = Tessellator::new(&gpu.device);
        Ok(Self { gpu, tessellator, index_type })
    }

    fn tap(
        &mut self,
        tap: Tap,
        partitioning: Partitioning,
        split: SplitOrder,
        input: &[u32],
    ) -> Answers<u32> {
        let config = Config { split, ..Config::new(partitioning, OutputPrimitive::Point) };
        let setup = Setup::new(Domain::Triangle, config);
        self.tessellator.tap(&self.gpu, tap, setup, input).map_err(BackendError::new)
    }
}

/// The setup that the program uses: indices count each patch's own points, as in the model.
pub(crate) fn setup_of(domain: Domain, config: Config, index_type: IndexWidth) -> Setup {
    let index_type = match index_type {
        IndexWidth::U16 => tess_gpu::IndexType::U16,
        IndexWidth::U32 => tess_gpu::IndexType::U32,
    };
    Setup { numbering: Numbering::PerPatch, index_type, ..Setup::new(domain, config) }
}

impl Backend for GpuBackend {
    fn name(&self) -> &'static str {
        "gpu"
    }

    fn device(&self) -> String {
        self.gpu.name()
    }

    fn tessellate(&mut self, config: Config, patches: &[PatchFactors]) -> Answers<Tessellation> {
        let Some(first) = patches.first() else { return Ok(Vec::new()) };
        let setup = setup_of(first.domain(), config, self.index_type);
        let output = self.tessellator.tessellate(&self.gpu, setup, patches);
        split_by_patch(&output.map_err(BackendError::new)?, setup)
    }

    fn fixed_factors(
        &mut self,
        partitioning: Partitioning,
        values: &[f32],
    ) -> Answers<[FixedFactor; 2]> {
        let patch = |x: &f32| [x.to_bits(), 3f32.to_bits(), 3f32.to_bits(), x.to_bits()];
        let input: Vec<u32> = values.iter().flat_map(patch).collect();
        let words = self.tap(Tap::Factors, partitioning, SplitOrder::Ruler, &input)?;
        Ok(words.as_chunks().0.iter().map(|pair| pair.map(FixedFactor::from_bits)).collect())
    }

    fn contexts(
        &mut self,
        split: SplitOrder,
        parity: Parity,
        factors: &[FixedFactor],
    ) -> Answers<FactorContext> {
        let pair = |factor: &FixedFactor| [factor.to_bits(), parity.odd()];
        let input: Vec<u32> = factors.iter().flat_map(pair).collect();
        let words = self.tap(Tap::Contexts, Partitioning::Integer, split, &input)?;
        Ok(words.as_chunks().0.iter().copied().map(unpack_context).collect())
    }

    fn locations(&mut self, contexts: &[FactorContext]) -> Answers<u32> {
        let input: Vec<u32> = contexts.iter().flat_map(pack_context).collect();
        let words = self.tap(Tap::Locations, Partitioning::Integer, SplitOrder::Ruler, &input)?;
        let all = words.as_chunks::<65>().0.iter().zip(contexts);
        Ok(all
            .flat_map(|(all, context)| all.iter().copied().take(context.points as usize))
            .collect())
    }
}

/// Splits a batch into its patches, in the numbering of the specification.
pub(crate) fn split_by_patch(output: &ReadBack, setup: Setup) -> Answers<Tessellation> {
    let each = setup.indices_per_primitive() as usize;
    let end = [output.points.len(), output.indices.len() / each];
    let begins = output.begins.iter().map(|begin| begin.map(|element| element as usize));
    let ends = begins.clone().skip(1).chain([end]);
    begins
        .zip(ends)
        .enumerate()
        .map(|(number, (begin, end))| {
            let points = output.points.get(begin[0]..end[0]);
            let indices = output.indices.get(begin[1] * each..end[1] * each);
            let (Some(points), Some(indices)) = (points, indices) else {
                return Err(BackendError::new(format!(
                    "patch {number} lies at {begin:?}..{end:?}, outside of the output"
                )));
            };
            let points = points.iter().map(|&words| own_point(number, words));
            Ok(Tessellation {
                points: points.collect::<Result<_, _>>()?,
                indices: indices.to_vec(),
            })
        })
        .collect()
}

/// The point in these words. Errors: the words name another patch.
fn own_point(patch: usize, words: [u32; 2]) -> Result<DomainPoint, BackendError> {
    let packed = PackedPoint(words);
    if packed.patch() as usize == patch {
        Ok(packed.point())
    } else {
        let other = packed.patch();
        Err(BackendError::new(format!("a point of patch {patch} says it is of patch {other}")))
    }
}
