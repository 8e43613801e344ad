//! Factors, tessellation and evaluation, one block of patches at a time.
//!
//! Besides the model, memory holds the factors of its patches and one block, whatever the factors
//! are.

use super::output::{MeshBlock, MeshFile, Totals};
use super::statistics::{MeshStage, Statistics};
use crate::failure::Failure;
use crate::output::progress;
use rayon::prelude::*;
use tess_core::{
    Config, OutputPrimitive, Partitioning, PatchFactors, QuadFactors, TriangleFactors,
};
use tess_simd::{Batch, Numbering, Output, Tessellator};
use tess_surface::{DisplacedModel, FactorRule, Model, Sample};

/// The number of patches that are counted and sorted by domain at a time.
const FACTOR_BLOCK: usize = 8192;

/// The largest number of vertices held at a time: 32 MiB of vertices and 24 MiB of indices.
const VERTEX_BLOCK: f32 = 1_048_576.0;

/// The number of patches that a thread takes at a time.
const PATCHES_PER_TASK: usize = 32;

/// The stages that a model passes through.
#[derive(Debug)]
pub(crate) struct MeshJob<'a> {
    /// The patches.
    pub(crate) model: &'a Model,
    /// How finely the patches are cut.
    pub(crate) rule: FactorRule,
    /// The spacing of the cuts.
    pub(crate) partitioning: Partitioning,
    /// The same patches with their displacement, if they are displaced.
    pub(crate) displaced: Option<&'a DisplacedModel<'a>>,
}

/// Patches of one domain, with their factors.
struct Group<F> {
    patches: Vec<usize>,
    factors: Vec<F>,
}

/// The state that is kept between blocks.
struct Stream<'a> {
    job: &'a MeshJob<'a>,
    tessellator: Tessellator,
    domain_points: Output<[f32; 2], u32>,
    vertices: Vec<Sample>,
}

/// Sends every patch of the model through all stages into `sink`. Errors: those of the sink.
pub(crate) fn run(
    job: &MeshJob<'_>,
    sink: &mut MeshFile,
    statistics: &mut Statistics,
) -> Result<(), Failure> {
    let config = Config::new(job.partitioning, OutputPrimitive::TriangleCw);
    let mut stream = Stream {
        job,
        tessellator: Tessellator::new(config),
        domain_points: Output::new(),
        vertices: Vec::new(),
    };
    statistics.patches = job.model.len();
    let factors = statistics.time(MeshStage::Factors, || job.factors());
    let totals = statistics.time(MeshStage::Tessellation, || stream.count(&factors))?;
    statistics.time(MeshStage::Output, || sink.begin(totals))?;
    let bar = progress(job.model.len() as u64, "patches");
    for (number, block) in factors.chunks(FACTOR_BLOCK).enumerate() {
        let first = number * FACTOR_BLOCK;
        stream.block_of_patches(first, block, sink, statistics)?;
        bar.set_position((first + block.len()) as u64);
    }
    bar.finish_and_clear();
    Ok(())
}

impl MeshJob<'_> {
    /// The factors of all patches.
    fn factors(&self) -> Vec<PatchFactors> {
        let Self { model, rule, partitioning, .. } = self;
        (0..model.len())
            .into_par_iter()
            .with_min_len(PATCHES_PER_TASK)
            .map(|number| rule.factors(model, number, *partitioning))
            .collect()
    }
}

impl Stream<'_> {
    /// The numbers of vertices and indices of all patches.
    fn count(&mut self, factors: &[PatchFactors]) -> Result<Totals, Failure> {
        let mut totals = Totals::default();
        for block in factors.chunks(FACTOR_BLOCK) {
            let (triangles, quads) = by_domain(0, block);
            for batch in [Batch::from(&triangles.factors[..]), Batch::from(&quads.factors[..])] {
                let counted = self.tessellator.count(batch).map_err(Failure::bad_input)?;
                totals.vertices += counted.points() as u64;
                totals.indices += counted.indices() as u64;
            }
        }
        Ok(totals)
    }

    /// Processes consecutive patches, starting with number `first`.
    fn block_of_patches(
        &mut self,
        first: usize,
        factors: &[PatchFactors],
        sink: &mut MeshFile,
        statistics: &mut Statistics,
    ) -> Result<(), Failure> {
        let (triangles, quads) = by_domain(first, factors);
        for part in triangles.parts(|f| f.outer().into_iter().fold(f.inside, f32::max)) {
            self.group(part.0, Batch::from(part.1), sink, statistics)?;
        }
        for part in quads.parts(|f| f.outer().into_iter().chain(f.inside()).fold(1.0, f32::max)) {
            self.group(part.0, Batch::from(part.1), sink, statistics)?;
        }
        Ok(())
    }

    /// Tessellates and evaluates patches of one domain.
    fn group(
        &mut self,
        patches: &[usize],
        batch: Batch<'_>,
        sink: &mut MeshFile,
        statistics: &mut Statistics,
    ) -> Result<(), Failure> {
        if patches.is_empty() {
            return Ok(());
        }
        let numbering = Numbering::PerBatch { base_vertex: 0 };
        statistics
            .time(MeshStage::Tessellation, || {
                self.tessellator.tessellate(batch, numbering, &mut self.domain_points)
            })
            .map_err(Failure::bad_input)?;
        statistics.time(MeshStage::Evaluation, || self.evaluate(patches));
        let block = MeshBlock {
            first_vertex: statistics.vertices,
            vertices: &self.vertices,
            indices: self.domain_points.indices(),
        };
        statistics.time(MeshStage::Output, || sink.block(&block))?;
        statistics.vertices += block.vertices.len() as u64;
        statistics.triangles += block.indices.len() as u64 / 3;
        Ok(())
    }

    /// Computes the vertices of the block: each patch's domain points on its surface.
    fn evaluate(&mut self, patches: &[usize]) {
        let (points, ranges) = (self.domain_points.points(), self.domain_points.ranges());
        self.vertices.resize(points.len(), Sample::default());
        let mut rest = &mut self.vertices[..];
        let mut parts = Vec::with_capacity(patches.len());
        for (&number, range) in patches.iter().zip(ranges) {
            let (own, after) = rest.split_at_mut(range.points as usize);
            let first = range.first_point as usize;
            parts.push((number, &points[first..first + own.len()], own));
            rest = after;
        }
        let MeshJob { model, displaced, .. } = *self.job;
        let parts = parts.into_par_iter().with_min_len(PATCHES_PER_TASK);
        parts.for_each(|(number, points, out)| match displaced {
            None => model.patch(number).samples(points, out),
            Some(displaced) => displaced.patch(number).samples(points, out),
        });
    }
}

/// Consecutive patches, starting with number `first`, and their factors, by domain.
fn by_domain(
    first: usize,
    factors: &[PatchFactors],
) -> (Group<TriangleFactors>, Group<QuadFactors>) {
    let mut triangles = Group { patches: Vec::new(), factors: Vec::new() };
    let mut quads = Group { patches: Vec::new(), factors: Vec::new() };
    for (number, factors) in (first..).zip(factors) {
        match *factors {
            PatchFactors::Triangle(factors) => triangles.push(number, factors),
            PatchFactors::Quad(factors) => quads.push(number, factors),
            PatchFactors::Isoline(_) => {} // no surface has isolines
        }
    }
    (triangles, quads)
}

impl<F> Group<F> {
    fn push(&mut self, patch: usize, factors: F) {
        self.patches.push(patch);
        self.factors.push(factors);
    }

    /// Splits the group into parts with few enough vertices, by the largest factor of each patch.
    fn parts(&self, largest: impl Fn(&F) -> f32) -> impl Iterator<Item = (&[usize], &[F])> {
        // A patch with factors up to f has at most as many points as a grid of f + 2 by f + 2.
        let mut room = VERTEX_BLOCK;
        let parts = self.factors.chunk_by(move |a, b| {
            let side = largest(a).max(largest(b)) + 3.0;
            room -= side * side;
            let fits = room > 0.0;
            room = if fits { room } else { VERTEX_BLOCK };
            fits
        });
        let mut first = 0;
        parts.map(move |factors| {
            let patches = &self.patches[first..first + factors.len()];
            first += factors.len();
            (patches, factors)
        })
    }
}
