//! Factors, tessellation and evaluation, one block of patches at a time.
//!
//! Besides the model, memory holds the factors of its patches and one block, whatever the factors
//! are.

use crate::parts::{ChannelKind, Parts};
use crate::write::{Block, Sink, Totals};
use glam::Vec3;
use rayon::prelude::*;
use std::io;
use std::time::{Duration, Instant};
use tess_core::{
    Config, OutputPrimitive, Partitioning, PatchFactors, QuadFactors, TriangleFactors,
};
use tess_simd::{Batch, Numbering, Output, Tessellator};
use tess_surface::{DisplacedModel, FactorRule, Model, Sample, Sides};

/// The number of patches that are counted and sorted by domain at a time.
const FACTOR_BLOCK: usize = 8192;

/// The largest number of vertices held at a time: 32 MiB of vertices and 24 MiB of indices.
const VERTEX_BLOCK: f32 = 1_048_576.0;

/// The number of patches that a thread takes at a time.
const PATCHES_PER_TASK: usize = 32;

/// A model and how finely it is cut.
#[derive(Debug)]
pub struct Job<'a> {
    /// The patches.
    pub model: &'a Model,
    /// How finely the patches are cut.
    pub rule: FactorRule,
    /// The spacing of the cuts.
    pub partitioning: Partitioning,
    /// The same patches with their displacement, if they are displaced.
    pub displaced: Option<&'a DisplacedModel<'a>>,
    /// The parts of the model. Without them it is one part with texture coordinates.
    pub parts: Option<&'a Parts>,
}

/// The stages of [`Job::run`], in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Factors by rule.
    Factors,
    /// Domain points and indices.
    Tessellation,
    /// Positions, normals and texture coordinates.
    Evaluation,
    /// The sink takes a block.
    Output,
}

/// What sees the progress of [`Job::run`].
pub trait Watch {
    /// A part of a stage took this long.
    fn spent(&mut self, _stage: Stage, _time: Duration) {}

    /// So many patches are done.
    fn done(&mut self, _patches: usize) {}
}

/// Nobody watches.
impl Watch for () {}

/// Patches of one domain, with their factors.
struct Group<F> {
    patches: Vec<usize>,
    factors: Vec<F>,
}

/// The state that is kept between blocks.
struct Stream<'a> {
    job: &'a Job<'a>,
    tessellator: Tessellator,
    domain_points: Output<[f32; 2], u32>,
    vertices: Vec<Sample>,
    is_border: Vec<bool>,
    /// The values of each channel of the part.
    channels: Vec<Vec<[f32; 4]>>,
    totals: Totals,
}

impl<'a> Job<'a> {
    /// The model with factors by this rule, at integer spacing, and not displaced.
    #[must_use]
    pub const fn new(model: &'a Model, rule: FactorRule) -> Self {
        Self { model, rule, partitioning: Partitioning::Integer, displaced: None, parts: None }
    }

    /// The size of the result.
    ///
    /// # Errors
    /// A batch has more than 2^32 points.
    pub fn totals(&self) -> io::Result<Totals> {
        let patches: Vec<usize> = (0..self.model.len()).collect();
        Stream::of(self).count(&patches, &self.factors())
    }

    /// Sends every patch of the model through all stages into `sink`, and returns the size of the
    /// result.
    ///
    /// # Errors
    /// Those of the sink.
    pub fn run(&self, sink: &mut dyn Sink, watch: &mut dyn Watch) -> io::Result<Totals> {
        let mut stream = Stream::of(self);
        let factors = timed(watch, Stage::Factors, || self.factors());
        let by_part = self.patches_by_part();
        let totals = timed(watch, Stage::Tessellation, || {
            let totals = by_part.iter().map(|patches| stream.count(patches, &factors));
            totals.collect::<io::Result<Vec<_>>>()
        })?;
        timed(watch, Stage::Output, || sink.begin(&totals))?;
        let mut done = 0;
        for (part, patches) in by_part.iter().enumerate() {
            for block in patches.chunks(FACTOR_BLOCK) {
                stream.block_of_patches(part, block, &factors, sink, watch)?;
                done += block.len();
                watch.done(done);
            }
        }
        Ok(stream.totals)
    }

    /// The patches of each part, in their order.
    fn patches_by_part(&self) -> Vec<Vec<usize>> {
        let Some(parts) = self.parts.filter(|parts| parts.list.len() > 1) else {
            return vec![(0..self.model.len()).collect()];
        };
        let mut by_part = vec![Vec::new(); parts.list.len()];
        (0..self.model.len()).for_each(|patch| by_part[parts.of(patch)].push(patch));
        by_part
    }

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

fn timed<T>(watch: &mut dyn Watch, stage: Stage, part: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = part();
    watch.spent(stage, start.elapsed());
    result
}

/// The size of the result if all factors are the same.
///
/// # Errors
/// None for models that exist.
fn uniform_totals(model: &Model, partitioning: Partitioning, factor: f32) -> io::Result<Totals> {
    let count = (0..model.len()).into_par_iter();
    let quads = count.filter(|&patch| matches!(model.sides(patch), Sides::Quad(_))).count() as u64;
    let triangles = model.len() as u64 - quads;
    let config = Config::new(partitioning, OutputPrimitive::TriangleCw);
    let mut tessellator = Tessellator::new(config);
    let mut one = |batch: Batch<'_>| {
        let counted = tessellator.count(batch).map_err(io::Error::other)?;
        Ok::<_, io::Error>((counted.points() as u64, counted.indices() as u64))
    };
    let triangle = one(Batch::from(&[TriangleFactors::uniform(factor)][..]))?;
    let quad = one(Batch::from(&[QuadFactors::uniform(factor)][..]))?;
    Ok(Totals {
        vertices: triangles * triangle.0 + quads * quad.0,
        indices: triangles * triangle.1 + quads * quad.1,
    })
}

/// The largest whole factor, the same for all patches, with which the result `fits`; at least the
/// partitioning's smallest.
pub fn largest_factor(
    model: &Model,
    partitioning: Partitioning,
    fits: impl Fn(Totals) -> bool,
) -> Option<f32> {
    let (low, high) = partitioning.range();
    let factors = (0u8..64).map(|k| high - f32::from(k)).take_while(|&factor| factor >= low);
    let mut found =
        factors.filter(|&factor| uniform_totals(model, partitioning, factor).is_ok_and(&fits));
    found.next()
}

impl<'a> Stream<'a> {
    fn of(job: &'a Job<'a>) -> Self {
        let config = Config::new(job.partitioning, OutputPrimitive::TriangleCw);
        Self {
            job,
            tessellator: Tessellator::new(config),
            domain_points: Output::new(),
            vertices: Vec::new(),
            is_border: Vec::new(),
            channels: Vec::new(),
            totals: Totals::default(),
        }
    }

    /// The numbers of vertices and indices of these patches.
    fn count(&mut self, patches: &[usize], factors: &[PatchFactors]) -> io::Result<Totals> {
        let mut totals = Totals::default();
        for block in patches.chunks(FACTOR_BLOCK) {
            let (triangles, quads) = by_domain(block, factors);
            for batch in [Batch::from(&triangles.factors[..]), Batch::from(&quads.factors[..])] {
                let counted = self.tessellator.count(batch).map_err(io::Error::other)?;
                totals.vertices += counted.points() as u64;
                totals.indices += counted.indices() as u64;
            }
        }
        Ok(totals)
    }

    /// Processes patches of one part.
    fn block_of_patches(
        &mut self,
        part: usize,
        patches: &[usize],
        factors: &[PatchFactors],
        sink: &mut dyn Sink,
        watch: &mut dyn Watch,
    ) -> io::Result<()> {
        let (triangles, quads) = by_domain(patches, factors);
        for group in triangles.parts(|f| f.outer().into_iter().fold(f.inside, f32::max)) {
            self.group(part, group.0, Batch::from(group.1), sink, watch)?;
        }
        for group in quads.parts(|f| f.outer().into_iter().chain(f.inside()).fold(1.0, f32::max)) {
            self.group(part, group.0, Batch::from(group.1), sink, watch)?;
        }
        Ok(())
    }

    /// Tessellates and evaluates patches of one part and one domain.
    fn group(
        &mut self,
        part: usize,
        patches: &[usize],
        batch: Batch<'_>,
        sink: &mut dyn Sink,
        watch: &mut dyn Watch,
    ) -> io::Result<()> {
        if patches.is_empty() {
            return Ok(());
        }
        let numbering = Numbering::PerBatch { base_vertex: 0 };
        timed(watch, Stage::Tessellation, || {
            self.tessellator.tessellate(batch, numbering, &mut self.domain_points)
        })
        .map_err(io::Error::other)?;
        timed(watch, Stage::Evaluation, || self.evaluate(part, patches));
        let described = self.job.parts.and_then(|parts| parts.list.get(part));
        let block = Block {
            part,
            vertices: &self.vertices,
            has_texcoords: described.is_none_or(|part| part.has_texcoords),
            channels: &self.channels,
            is_border: &self.is_border,
            indices: self.domain_points.indices(),
        };
        timed(watch, Stage::Output, || sink.block(&block))?;
        self.totals.vertices += block.vertices.len() as u64;
        self.totals.indices += block.indices.len() as u64;
        Ok(())
    }

    /// Computes the vertices of the block: each patch's domain points on its surface, and the
    /// further values there.
    fn evaluate(&mut self, part: usize, patches: &[usize]) {
        let Job { model, displaced, parts, .. } = *self.job;
        let points = self.domain_points.points();
        let is_quad =
            matches!(patches.first().map(|&patch| model.sides(patch)), Some(Sides::Quad(_)));
        self.is_border.clear();
        self.is_border.extend(points.iter().map(|&point| is_on_border(point, is_quad)));
        self.vertices.resize(points.len(), Sample::default());
        each_patch(&self.domain_points, patches, &mut self.vertices, |number, points, out| {
            match displaced {
                None => model.patch(number).samples(points, out),
                Some(displaced) => displaced.patch(number).samples(points, out),
            }
        });
        let Some((parts, mesh)) = parts.zip(model.mesh()) else { return };
        let used = parts.list.get(part).map_or(&[][..], |part| &part.channels);
        self.channels.resize(used.len(), Vec::new());
        for (values, &number) in self.channels.iter_mut().zip(used) {
            let channel = &parts.channels[number];
            values.resize(points.len(), [0.0; 4]);
            each_patch(&self.domain_points, patches, values, |number, points, out| {
                let at = |index: u32| channel.values[index as usize];
                let corners = mesh.faces[number].positions.map(at);
                for (&point, out) in points.iter().zip(out) {
                    *out = between(&corners, point);
                    if channel.kind == ChannelKind::Tangent {
                        let [x, y, z, side] = *out;
                        let along = Vec3::new(x, y, z).normalize_or(Vec3::X);
                        *out = along.extend(if side < 0.0 { -1.0 } else { 1.0 }).to_array();
                    }
                }
            });
        }
    }
}

/// Calls `fill` for each patch of a batch, with its number, its domain points and its part of
/// `out`.
fn each_patch<T: Send>(
    batch: &Output<[f32; 2], u32>,
    patches: &[usize],
    out: &mut [T],
    fill: impl Fn(usize, &[[f32; 2]], &mut [T]) + Sync,
) {
    let (points, ranges) = (batch.points(), batch.ranges());
    let mut rest = out;
    let mut parts = Vec::with_capacity(patches.len());
    for (&number, range) in patches.iter().zip(ranges) {
        let (own, after) = rest.split_at_mut(range.points as usize);
        let first = range.first_point as usize;
        parts.push((number, &points[first..first + own.len()], own));
        rest = after;
    }
    let parts = parts.into_par_iter().with_min_len(PATCHES_PER_TASK);
    parts.for_each(|(number, points, out)| fill(number, points, out));
}

/// Whether a domain point is on an edge of its patch. Domain points are multiples of 2^-16, so that
/// `u + v` does not round.
fn is_on_border([u, v]: [f32; 2], is_quad: bool) -> bool {
    u <= 0.0 || v <= 0.0 || if is_quad { u >= 1.0 || v >= 1.0 } else { u + v >= 1.0 }
}

/// The value at a domain point between those of the corners. On an edge, both patches compute the
/// same sum of two products.
fn between(corners: &Sides<[f32; 4]>, [u, v]: [f32; 2]) -> [f32; 4] {
    std::array::from_fn(|k| match corners {
        Sides::Triangle([a, b, c]) => a[k] * u + b[k] * v + c[k] * (1.0 - u - v),
        Sides::Quad([a, b, c, d]) => {
            let (low, high) = (a[k] * (1.0 - u) + b[k] * u, d[k] * (1.0 - u) + c[k] * u);
            low * (1.0 - v) + high * v
        }
    })
}

/// Patches and their factors, by domain.
fn by_domain(
    patches: &[usize],
    factors: &[PatchFactors],
) -> (Group<TriangleFactors>, Group<QuadFactors>) {
    let mut triangles = Group { patches: Vec::new(), factors: Vec::new() };
    let mut quads = Group { patches: Vec::new(), factors: Vec::new() };
    for &number in patches {
        match factors[number] {
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
