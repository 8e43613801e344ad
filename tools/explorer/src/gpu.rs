//! The shaders of `tess-gpu` for a page with WebGPU, and the verdict on their output.

use crate::{json, thrown};
use serde::Serialize;
use std::collections::BTreeMap;
use tess_core::{Config, Counts, Domain, DomainPoint, PatchFactors, Tessellation};
use tess_gpu::layout::{PackedPoint, factor_words};
use tess_gpu::sizes::ALIGNMENT;
use tess_gpu::{
    Access, Binding, Capacity, Limits, Numbering, Order, Plan, Resource, Setup, Span, Stage,
    Workgroups, tables,
};
use tess_verify::check::Mismatch;
use tess_verify::vectors::Listing;
use tess_verify::{Case, Named};
use tess_workloads::Workload;
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

/// The constant tables of a split order.
#[wasm_bindgen]
#[derive(Debug)]
pub struct GpuTables;

#[wasm_bindgen]
impl GpuTables {
    /// The words of the buffer `Tables`. Errors: an unknown split order.
    pub fn words(split: &str) -> Result<Vec<u32>, JsError> {
        Ok(tables(Named::from_name(split).map_err(thrown)?))
    }
}

/// Every shader that the configuration of a case line can need, by entry point: JSON. For tests of
/// a browser's compiler. Errors: the line is no case.
#[wasm_bindgen]
pub fn shader_sources(line: &str) -> Result<String, JsError> {
    let case: Case = line.parse().map_err(thrown)?;
    let setup = setup(case.domain(), case.config);
    let source = |stage: Stage| (stage.entry_point(), stage.source(stage.relevant(setup)));
    Ok(json(&Stage::ALL.map(source).into_iter().collect::<BTreeMap<_, _>>()))
}

/// Output on the page: packed points, and indices that count from each patch's first point.
fn setup(domain: Domain, config: Config) -> Setup {
    Setup { numbering: Numbering::PerPatch, ..Setup::new(domain, config) }
}

/// A batch of patches of one configuration.
#[wasm_bindgen]
#[derive(Debug)]
pub struct GpuBatch {
    setup: Setup,
    patches: Vec<PatchFactors>,
    plan: Plan,
}

/// The manifest of one batch, in the form of `tess shaders` (docs/shaders.md) with numbers for its
/// formulas, and with the WGSL of each stage: as the module `batch.js` of `bindings/webgpu` takes
/// it.
#[derive(Serialize)]
struct Manifest {
    setup: Described,
    stages: Vec<Shader>,
    job_stride: u64,
    plans: [OnePlan; 1],
}

#[derive(Serialize)]
struct Described {
    split: &'static str,
    /// Bytes of a primitive's indices.
    primitive_bytes: u32,
}

#[derive(Serialize)]
struct Shader {
    name: &'static str,
    entry_point: &'static str,
    source: String,
    bindings: Vec<ShaderBinding>,
}

#[derive(Serialize)]
struct ShaderBinding {
    binding: u32,
    /// `uniform` or `storage`.
    kind: &'static str,
    is_written: bool,
}

#[derive(Serialize)]
struct OnePlan {
    min_patches: u32,
    max_patches: u32,
    max_points: u32,
    max_primitives: u32,
    buffers: Vec<Buffer>,
    jobs: Vec<Vec<u32>>,
    dispatches: Vec<PassStep>,
}

#[derive(Serialize)]
struct Buffer {
    resource: String,
    bytes: u64,
}

#[derive(Serialize)]
struct PassStep {
    stage: &'static str,
    bindings: Vec<Bound>,
    workgroups: Count,
}

#[derive(Serialize)]
struct Bound {
    resource: String,
    offset: u64,
    bytes: u64,
}

/// The number of workgroups, or the byte of the buffer of arguments where it is.
#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
enum Count {
    Direct(u64),
    IndirectAt(u64),
}

#[wasm_bindgen]
impl GpuBatch {
    /// The patches of case lines, one a line, all of one domain and configuration. Errors: a line
    /// that is no case or of another configuration than the first one.
    #[wasm_bindgen(constructor)]
    pub fn new(lines: &str) -> Result<Self, JsError> {
        let cases = lines.lines().map(str::parse).collect::<Result<Vec<Case>, _>>();
        Self::of_cases(&cases.map_err(thrown)?).map_err(thrown)
    }

    /// The patches of a workload of `tess bench`, or the first ones, up to this many MiB of output.
    /// Errors: there is no workload of that name, or not one of its patches makes so little.
    pub fn workload(name: &str, mebibytes: u32) -> Result<Self, JsError> {
        let all = Workload::named(name);
        let [workload] = &all[..] else {
            return Err(thrown(format!("{name} is not the name of one workload")));
        };
        match fitting(workload, mebibytes) {
            0 => Err(thrown(format!("a patch of {name} makes more than {mebibytes} MiB"))),
            count => Ok(Self::of(workload.config, workload.patches[..count].to_vec())),
        }
    }

    /// Buffers, shaders and dispatches: JSON.
    pub fn manifest(&self) -> String {
        json(&self.to_manifest())
    }

    /// The contents of the buffer of factors.
    pub fn factors(&self) -> Vec<u32> {
        factor_words(&self.patches)
    }

    /// The first difference between the model and what the shaders wrote, in words; nothing if
    /// every bit is equal. `points` has two words for each point.
    pub fn difference(&self, points: &[u32], indices: &[u32]) -> Option<String> {
        let (mut points, mut indices) = (points.as_chunks::<2>().0, indices);
        for &factors in &self.patches {
            let case = Case { config: self.setup.config, factors };
            let expected = case.patch().tessellate();
            // As many as are expected, or as there are.
            let own = expected.points.len().min(points.len());
            let own = points.split_off(..own).unwrap_or_default().iter();
            let own_indices = expected.indices.len().min(indices.len());
            let own_indices = indices.split_off(..own_indices).unwrap_or_default();
            let observed =
                Tessellation { points: own.map(unpacked).collect(), indices: own_indices.to_vec() };
            if let Some(mismatch) = Mismatch::between(&case, &observed, &expected) {
                return Some(format!("{case}: {mismatch}"));
            }
        }
        None
    }

    /// Output of the shaders for the batch's first patch, as a listing.
    pub fn listing(&self, points: &[u32], indices: &[u32]) -> String {
        let points = points.as_chunks::<2>().0.iter().map(unpacked).collect();
        let output = Tessellation { points, indices: indices.to_vec() };
        let case = Case { config: self.setup.config, factors: self.patches[0] };
        Listing { line: 0, case, output }.to_string()
    }

    /// Triangles, segments or points of the whole batch.
    pub fn primitives(&self) -> u32 {
        capacity(self.setup.config, &self.patches).primitives
    }
}

impl GpuBatch {
    fn of_cases(cases: &[Case]) -> Result<Self, String> {
        let Some(first) = cases.first() else { return Err("no case".into()) };
        let is_alike = |case: &Case| case.config == first.config && case.domain() == first.domain();
        match cases.iter().find(|case| !is_alike(case)) {
            Some(case) => Err(format!("{case}: another configuration than `{first}`")),
            None => Ok(Self::of(first.config, cases.iter().map(|case| case.factors).collect())),
        }
    }

    fn of(config: Config, patches: Vec<PatchFactors>) -> Self {
        let setup = setup(patches[0].domain(), config);
        let count = u32::try_from(patches.len()).unwrap_or(u32::MAX);
        let plan = Plan::new(setup, count, capacity(config, &patches), Limits::WEBGPU);
        Self { setup, patches, plan }
    }

    /// A batch whose indices count from the batch's first point, in the order that draws fastest.
    /// It has room for any factors of as many patches.
    pub(crate) fn to_draw(config: Config, patches: &[PatchFactors]) -> Self {
        let order = Order::VertexCache;
        let setup = Setup { order, ..Setup::new(patches[0].domain(), config) };
        let count = u32::try_from(patches.len()).unwrap_or(u32::MAX);
        let plan = Plan::new(setup, count, Capacity::worst_case(setup, count), Limits::WEBGPU);
        Self { setup, patches: patches.to_vec(), plan }
    }

    fn to_manifest(&self) -> Manifest {
        let Self { setup, plan, .. } = self;
        let stages: Vec<Stage> = plan.dispatches().map(|step| step.stage()).collect();
        let stages = Stage::ALL.into_iter().filter(|stage| stages.contains(stage));
        let one = OnePlan {
            min_patches: plan.patches(),
            max_patches: plan.patches(),
            max_points: u32::MAX,
            max_primitives: u32::MAX,
            buffers: Resource::ALL.into_iter().filter_map(|it| self.buffer(it)).collect(),
            jobs: jobs(plan),
            dispatches: plan.dispatches().map(|step| to_step(&step)).collect(),
        };
        let (split, primitive_bytes) = (setup.config.split.name(), setup.primitive_bytes());
        Manifest {
            setup: Described { split, primitive_bytes },
            stages: stages.map(|stage| shader(stage, *setup)).collect(),
            job_stride: ALIGNMENT,
            plans: [one],
        }
    }

    /// `None` for a buffer that a batch without groups does not have.
    fn buffer(&self, resource: Resource) -> Option<Buffer> {
        let is_of_groups = matches!(resource, Resource::Groups | Resource::Draws);
        let bytes = self.plan.buffer_size(resource).next_multiple_of(16).max(16);
        (!is_of_groups).then(|| Buffer { resource: name(resource), bytes })
    }
}

fn shader(stage: Stage, setup: Setup) -> Shader {
    let binding = |(binding, one): (u32, &Binding)| ShaderBinding {
        binding,
        kind: if one.0 == Resource::Job { "uniform" } else { "storage" },
        is_written: one.1 == Access::ReadWrite,
    };
    Shader {
        name: stage.entry_point(),
        entry_point: stage.entry_point(),
        source: stage.source(stage.relevant(setup)),
        bindings: (0..).zip(stage.bindings()).map(binding).collect(),
    }
}

/// The words of each job.
fn jobs(plan: &Plan) -> Vec<Vec<u32>> {
    let bytes = plan.jobs();
    let words =
        |job: &[u8]| job.as_chunks().0.iter().map(|&word| u32::from_le_bytes(word)).collect();
    bytes.chunks(usize::try_from(ALIGNMENT).unwrap_or(usize::MAX)).map(words).collect()
}

fn to_step(dispatch: &tess_gpu::Dispatch) -> PassStep {
    let workgroups = match dispatch.workgroups() {
        Workgroups::Direct(along) => Count::Direct(along.into_iter().map(u64::from).product()),
        Workgroups::Indirect(at) => Count::IndirectAt(at),
    };
    let bound = |(of, span): (Resource, Span)| Bound {
        resource: name(of),
        offset: span.offset,
        bytes: span.size,
    };
    let stage = dispatch.stage().entry_point();
    PassStep { stage, bindings: dispatch.bindings().map(bound).collect(), workgroups }
}

fn name(resource: Resource) -> String {
    format!("{resource:?}").to_lowercase()
}

fn capacity(config: Config, patches: &[PatchFactors]) -> Capacity {
    let mut capacity = Capacity { points: 0, primitives: 0 };
    for &factors in patches {
        let counts = Case { config, factors }.patch().counts();
        capacity.points += counts.points;
        capacity.primitives += counts.primitives;
    }
    Capacity { points: capacity.points.max(1), primitives: capacity.primitives.max(1) }
}

/// How many patches make up to this many MiB of output.
fn fitting(workload: &Workload, mebibytes: u32) -> usize {
    let mut bytes = 0;
    let fits = |counts: &Counts| {
        bytes += 8 * u64::from(counts.points) + 4 * u64::from(counts.indices);
        bytes <= u64::from(mebibytes) << 20
    };
    workload.counts().take_while(fits).count()
}

fn unpacked(words: &[u32; 2]) -> DomainPoint {
    PackedPoint(*words).point()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_difference_is_named_with_its_case() {
        let case = "case quad integer triangle_cw ruler";
        let cases = ["40000000", "40400000"].map(|factor| {
            format!("{case}{}", format!(" {factor}").repeat(6)).parse::<Case>().expect("a case")
        });
        let batch = GpuBatch::of_cases(&cases).expect("alike");
        let outputs = cases.map(|case| case.patch().tessellate());
        let pack = |&point: &DomainPoint| PackedPoint::new(point, 0).0;
        let mut points: Vec<u32> =
            outputs.iter().flat_map(|output| output.points.iter().flat_map(pack)).collect();
        let indices: Vec<u32> = outputs.iter().flat_map(|o| o.indices.clone()).collect();
        assert_eq!(batch.difference(&points, &indices), None, "equal");
        assert!(batch.difference(&points, &indices[1..]).is_some(), "too short");
        points[2 * outputs[0].points.len()] ^= 1;
        let difference = batch.difference(&points, &indices).expect("a fault");
        assert!(difference.starts_with(&format!("{}: point 0 u", cases[1])), "{difference}");
    }

    #[test]
    fn every_buffer_and_shader_is_there() {
        let batch =
            GpuBatch::of_cases(&["case tri pow2 point center 40000000 40000000 40000000 40000000"
                .parse()
                .expect("a case")])
            .expect("one");
        let manifest = batch.to_manifest();
        let [plan] = &manifest.plans;
        let size = |of: &str| plan.buffers.iter().find(|one| one.resource == of).map(|it| it.bytes);
        for step in &plan.dispatches {
            let shader = manifest.stages.iter().find(|one| one.name == step.stage);
            let shader = shader.expect("its stage is there");
            assert_eq!(shader.bindings.len(), step.bindings.len(), "{}", step.stage);
            for one in &step.bindings {
                let end = Some(one.offset + one.bytes);
                assert!(end <= size(&one.resource), "{}: {}", step.stage, one.resource);
            }
        }
    }
}
