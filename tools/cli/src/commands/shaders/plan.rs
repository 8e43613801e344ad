//! The dispatches of a batch of one portion and one window, as formulas: everything that `tess_gpu::Plan` says.

use super::formula::{Batch, Bounds, Formula};
use serde::Serialize;
use tess_gpu::layout::Job;
use tess_gpu::sizes::ALIGNMENT;
use tess_gpu::{
    Capacity, IndexType, Limits, Numbering, Plan, Resource, Setup, Span, Stage, Workgroups,
};

/// How batches of these numbers of patches run.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Variant {
    pub(super) min_patches: u32,
    pub(super) max_patches: u32,
    pub(super) max_points: u32,
    pub(super) max_primitives: u32,
    /// Bytes of each resource's buffer, in the order of [`resources`].
    pub(super) buffers: Vec<Buffer>,
    /// The words of each job.
    pub(super) jobs: Vec<Vec<Formula>>,
    pub(super) dispatches: Vec<Dispatch>,
}

#[derive(Clone, Debug, Serialize)]
pub(super) struct Buffer {
    #[serde(serialize_with = "resource_name")]
    pub(super) resource: Resource,
    pub(super) bytes: Formula,
}

/// One dispatch: what it binds, from binding 0 on, and how many workgroups it has.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Dispatch {
    #[serde(serialize_with = "stage_name")]
    pub(super) stage: Stage,
    pub(super) job: u32,
    pub(super) bindings: Vec<Bound>,
    pub(super) workgroups: Count,
}

#[derive(Clone, Debug, Serialize)]
pub(super) struct Bound {
    #[serde(serialize_with = "resource_name")]
    pub(super) resource: Resource,
    pub(super) offset: Formula,
    pub(super) bytes: Formula,
}

/// Workgroups in all, laid out in rows of `max_workgroups`; or where three words in the buffer of
/// arguments say them.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Count {
    Direct(Formula),
    IndirectAt(Formula),
}

fn resource_name<S: serde::Serializer>(resource: &Resource, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(&name_of(*resource))
}

fn stage_name<S: serde::Serializer>(stage: &Stage, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(stage.entry_point())
}

/// The name of a resource in both manifests.
pub(super) fn name_of(resource: Resource) -> String {
    format!("{resource:?}").to_lowercase()
}

/// Every stage that a variant runs, in the order of [`Stage::ALL`].
pub(super) fn stages(variants: &[Variant]) -> impl Iterator<Item = Stage> {
    let runs = |stage: &Stage| {
        let mut all = variants.iter().flat_map(|variant| &variant.dispatches);
        all.any(|dispatch| dispatch.stage == *stage)
    };
    Stage::ALL.into_iter().filter(runs)
}

/// All ways in which batches run, by their numbers of patches from 1 on.
///
/// # Errors
/// The plan has a size without a formula; the message says which.
pub(super) fn variants(setup: Setup) -> Result<Vec<Variant>, String> {
    let most = last(u32::MAX, |patches| with(setup, [patches, 1, 1, u32::MAX]).portions() == 1);
    let mut variants = Vec::new();
    let mut begin = 1;
    while begin <= most {
        let own = shape(setup, begin);
        // Shapes change at most once between two powers of two.
        let mut end = begin;
        while end < most && shape(setup, end.saturating_mul(2).min(most)) == own {
            end = end.saturating_mul(2).min(most);
        }
        let end = end + last(most - end, |more| shape(setup, end + more) == own);
        variants.push(Variant::new(setup, begin, end)?);
        begin = end + 1;
    }
    Ok(variants)
}

/// The dispatches for this many patches: stages, jobs, and whether the arguments are indirect.
fn shape(setup: Setup, patches: u32) -> Vec<(Stage, u32, bool)> {
    let plan = with(setup, [patches, 1, 1, u32::MAX]);
    plan.dispatches()
        .map(|d| (d.stage(), d.job(), matches!(d.workgroups(), Workgroups::Indirect(_))))
        .collect()
}

/// The resources of a batch without groups, which is what manifests describe.
pub(super) fn resources() -> impl Iterator<Item = Resource> {
    let is_of_groups = |resource: &Resource| matches!(resource, Resource::Groups | Resource::Draws);
    Resource::ALL.into_iter().filter(move |resource| !is_of_groups(resource))
}

/// The plan of a batch in the stages that every batch can have, bound by nothing but the number of
/// workgroups in a row.
pub(super) fn with(setup: Setup, [patches, points, primitives, workgroups]: Batch) -> Plan {
    let limits = Limits { storage_binding: 1 << 35, workgroups };
    Plan::in_long_stages(setup, patches, Capacity { points, primitives }, limits)
}

/// The largest of `0..=most` that is `good`; all up to it are, and 0 need not be.
fn last(most: u32, good: impl Fn(u32) -> bool) -> u32 {
    if good(most) {
        return most;
    }
    let (mut is_good, mut is_bad) = (0, most);
    while is_bad - is_good > 1 {
        let middle = is_good + (is_bad - is_good) / 2;
        if good(middle) { is_good = middle } else { is_bad = middle }
    }
    is_good
}

impl Variant {
    fn new(setup: Setup, min_patches: u32, max_patches: u32) -> Result<Self, String> {
        let one = |points, primitives| with(setup, [min_patches, points, primitives, u32::MAX]);
        let numbered = match (setup.index_type, setup.numbering) {
            (IndexType::U16, Numbering::PerBatch) => 1 << 16,
            _ => u32::MAX,
        };
        let max_points = last(numbered, |points| one(points, 1).point_windows() <= 1);
        let max_primitives = last(u32::MAX, |count| one(1, count).primitive_windows() <= 1);
        let bounds =
            [(min_patches, max_patches), (1, max_points), (1, max_primitives), (1, u32::MAX)];
        let asked = Asked { setup, bounds };
        let dispatches = shape(setup, min_patches).len();
        Ok(Self {
            min_patches,
            max_patches,
            max_points,
            max_primitives,
            buffers: resources().map(|r| asked.buffer(r)).collect::<Result<_, _>>()?,
            jobs: asked.jobs()?,
            dispatches: (0..dispatches).map(|i| asked.dispatch(i)).collect::<Result<_, _>>()?,
        })
    }
}

/// A plan that is asked for formulas.
struct Asked {
    setup: Setup,
    bounds: Bounds,
}

impl Asked {
    fn formula(&self, what: &str, of: impl Fn(&Plan) -> u64) -> Result<Formula, String> {
        let setup = self.setup;
        Formula::of(self.bounds, |batch| of(&with(setup, batch))).ok_or_else(|| {
            let (least, most) = self.bounds[0];
            format!("{what} of {least} to {most} patches has no formula that a manifest can state")
        })
    }

    fn buffer(&self, resource: Resource) -> Result<Buffer, String> {
        let what = format!("the size of {}", name_of(resource));
        Ok(Buffer { resource, bytes: self.formula(&what, |plan| plan.buffer_size(resource))? })
    }

    fn jobs(&self) -> Result<Vec<Vec<Formula>>, String> {
        let stride = usize::try_from(ALIGNMENT).unwrap_or_default();
        let plan = with(self.setup, self.bounds.map(|(least, _)| least));
        let jobs = plan.jobs().len() / stride;
        let word = |job: usize, word: usize| {
            let at = stride * job + 4 * word;
            self.formula(&format!("word {word} of job {job}"), |plan| {
                let jobs = plan.jobs();
                jobs.get(at..at + 4)
                    .and_then(|bytes| bytes.try_into().ok())
                    .map_or(u64::MAX, |bytes| u64::from(u32::from_le_bytes(bytes)))
            })
        };
        (0..jobs).map(|job| (0..size_of::<Job>() / 4).map(|w| word(job, w)).collect()).collect()
    }

    fn dispatch(&self, number: usize) -> Result<Dispatch, String> {
        let asked = |plan: &Plan| plan.dispatches().nth(number);
        let plan = with(self.setup, self.bounds.map(|(least, _)| least));
        let Some(first) = asked(&plan) else { return Err(format!("no dispatch {number}")) };
        let stage = first.stage();
        let bound = |(binding, (resource, _)): (usize, (Resource, Span))| {
            let what = format!("binding {binding} of {}", stage.entry_point());
            let span = |plan: &Plan| asked(plan).and_then(|d| d.bindings().nth(binding));
            Ok(Bound {
                resource,
                offset: self.formula(&what, |p| span(p).map_or(u64::MAX, |(_, s)| s.offset))?,
                bytes: self.formula(&what, |p| span(p).map_or(u64::MAX, |(_, s)| s.size))?,
            })
        };
        let bindings = first.bindings().enumerate().map(bound).collect::<Result<_, String>>()?;
        Ok(Dispatch { stage, job: first.job(), bindings, workgroups: self.count(number, &first)? })
    }

    fn count(&self, number: usize, first: &tess_gpu::Dispatch) -> Result<Count, String> {
        let what = format!("the workgroups of {}", first.stage().entry_point());
        let asked = |plan: &Plan| plan.dispatches().nth(number).map(|d| d.workgroups());
        if let Workgroups::Indirect(_) = first.workgroups() {
            let at = |plan: &Plan| match asked(plan) {
                Some(Workgroups::Indirect(at)) => at,
                _ => u64::MAX,
            };
            return Ok(Count::IndirectAt(self.formula(&what, at)?));
        }
        let in_a_row = |plan: &Plan| match asked(plan) {
            Some(Workgroups::Direct([x, 1, 1])) => u64::from(x),
            _ => u64::MAX,
        };
        let mut bounds = self.bounds;
        bounds[3] = (u32::MAX, u32::MAX);
        Asked { setup: self.setup, bounds }.formula(&what, in_a_row).map(Count::Direct)
    }
}
