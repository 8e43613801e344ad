//! The dispatches of a batch of one portion and one window, as formulas that cover everything in
//! `tess_gpu::Plan`.

use super::formula::{Formula, Variable};
use serde::{Serialize, Serializer};
use std::mem::offset_of;
use tess_gpu::layout::Job;
use tess_gpu::sizes::{ALIGNMENT, BLOCK, CATALOGUE_PATCHES, SECTION, TILE};
use tess_gpu::{
    Capacity, IndexType, Limits, Numbering, Plan, Resource, Setup, Span, Stage, Workgroups,
};

/// How batches of this range of patches run.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Variant {
    pub(super) min_patches: u32,
    pub(super) max_patches: u32,
    pub(super) max_points: u32,
    pub(super) max_primitives: u32,
    /// The bytes of each resource's buffer, in the order of [`resources`].
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

/// One dispatch: its bindings, from binding 0, and its number of workgroups.
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

/// The total number of workgroups, laid out in rows of `max_workgroups`; or the place of its three
/// words in the buffer of arguments.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Count {
    Direct(Formula),
    IndirectAt(Formula),
}

/// The name of a resource in both manifests.
pub(super) fn resource_name<S: Serializer>(of: &Resource, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(&format!("{of:?}").to_lowercase())
}

fn stage_name<S: Serializer>(stage: &Stage, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(stage.entry_point())
}

/// Every stage that a variant runs, in the order of [`Stage::ALL`].
pub(super) fn stages(variants: &[Variant]) -> impl Iterator<Item = Stage> {
    let runs = |stage: &Stage| {
        let mut all = variants.iter().flat_map(|variant| &variant.dispatches);
        all.any(|dispatch| dispatch.stage == *stage)
    };
    Stage::ALL.into_iter().filter(runs)
}

/// All ways in which batches run, by their numbers of patches from 1: with a catalogue, or without.
pub(super) fn variants(setup: Setup) -> Vec<Variant> {
    let most = with(setup, u32::MAX).portion_patches();
    let ranges = match with(setup, most).has_catalogue() {
        true => vec![(1, CATALOGUE_PATCHES - 1), (CATALOGUE_PATCHES, most)],
        false => vec![(1, most)],
    };
    ranges.into_iter().map(|(least, most)| Variant::new(setup, least, most)).collect()
}

/// The resources of a batch without groups; only these are in manifests.
pub(super) fn resources() -> impl Iterator<Item = Resource> {
    let is_of_groups = |resource: &Resource| matches!(resource, Resource::Groups | Resource::Draws);
    Resource::ALL.into_iter().filter(move |resource| !is_of_groups(resource))
}

/// The bytes of one storage binding: large enough that batches are limited only by the number of
/// workgroups in a row.
const BINDING: u64 = 1 << 35;

/// The plan of a batch with room for one point and one primitive, in those stages that every batch
/// can have.
fn with(setup: Setup, patches: u32) -> Plan {
    let limits = Limits { storage_binding: BINDING, workgroups: u32::MAX };
    Plan::in_long_stages(setup, patches, Capacity { points: 1, primitives: 1 }, limits)
}

impl Variant {
    fn new(setup: Setup, min_patches: u32, max_patches: u32) -> Self {
        let max_points = match (setup.index_type, setup.numbering) {
            (IndexType::U16, Numbering::PerBatch) => 1 << 16,
            _ => u32::MAX,
        };
        // The primitives of the whole tiles that one binding holds.
        let bound =
            BINDING / u64::from(setup.primitive_bytes()) / u64::from(TILE) * u64::from(TILE);
        let least = Least { setup, plan: with(setup, min_patches) };
        let buffer = |resource| Buffer { resource, bytes: least.buffer(resource) };
        Self {
            min_patches,
            max_patches,
            max_points,
            max_primitives: u32::try_from(bound).unwrap_or(u32::MAX),
            buffers: resources().map(buffer).collect(),
            jobs: least.jobs(),
            dispatches: least.plan.dispatches().map(|one| least.dispatch(&one)).collect(),
        }
    }
}

/// The smallest batch of a variant. Its plan provides everything that does not depend on the batch;
/// a test compares the formulas with the plans of other batches.
struct Least {
    setup: Setup,
    plan: Plan,
}

/// `times` the number of blocks of patches, rounded up; `times` is per block.
fn blocks(times: impl Into<u64>) -> Formula {
    Formula::term(times, Variable::Patches, BLOCK)
}

impl Least {
    fn buffer(&self, resource: Resource) -> Formula {
        let factors = u64::from(self.setup.factors());
        let each = |bytes: u64, of| Formula::term(bytes, of, 1);
        let tiles = |of| Formula::term(4u64, of, TILE);
        match resource {
            Resource::Factors => each(4 * factors, Variable::Patches),
            Resource::Topologies => blocks(8 * BLOCK),
            Resource::Contexts => blocks(8 * factors * u64::from(BLOCK)),
            Resource::Offsets => {
                blocks(8 * (BLOCK + 2)).and(Formula::term(8u64, Variable::Patches, SECTION))
            }
            Resource::Tiles => tiles(Variable::Points).and(tiles(Variable::Primitives)).and(16),
            Resource::Points => each(8, Variable::Points),
            Resource::Indices => {
                let bytes = self.setup.primitive_bytes().into();
                Formula { multiple: 8, ..each(bytes, Variable::Primitives) }
            }
            _ => self.plan.buffer_size(resource).into(),
        }
    }

    /// The words of each job.
    fn jobs(&self) -> Vec<Vec<Formula>> {
        let one = |of| Formula::term(1u64, of, 1);
        let words = [
            (offset_of!(Job, patches), one(Variable::Patches)),
            (offset_of!(Job, stride), blocks(BLOCK)),
            (offset_of!(Job, blocks_at), blocks(BLOCK)),
            (offset_of!(Job, alike_at), blocks(BLOCK + 1)),
            (offset_of!(Job, sections_at), blocks(BLOCK + 2)),
            (
                offset_of!(Job, primitive_tiles_at),
                Formula::term(1u64, Variable::Points, TILE).and(2),
            ),
            (offset_of!(Job, point_capacity), one(Variable::Points)),
            (offset_of!(Job, primitive_capacity), one(Variable::Primitives)),
            (offset_of!(Job, max_workgroups), one(Variable::MaxWorkgroups)),
        ];
        let bytes = self.plan.jobs();
        let job = |bytes: &[u8]| {
            let read = bytes[..size_of::<Job>()].as_chunks().0.iter();
            let mut job: Vec<Formula> =
                read.map(|word| u64::from(u32::from_le_bytes(*word)).into()).collect();
            words.iter().for_each(|(at, formula)| job[at / 4].clone_from(formula));
            job
        };
        bytes.chunks(usize::try_from(ALIGNMENT).unwrap_or_default()).map(job).collect()
    }

    /// A dispatch. With one portion and one window, everything except jobs is bound whole.
    fn dispatch(&self, one: &tess_gpu::Dispatch) -> Dispatch {
        let bound = |(resource, span): (Resource, Span)| Bound {
            resource,
            offset: span.offset.into(),
            bytes: match resource {
                Resource::Job => span.size.into(),
                _ => self.buffer(resource),
            },
        };
        let workgroups = match (one.workgroups(), one.stage()) {
            (Workgroups::Indirect(at), _) => Count::IndirectAt(at.into()),
            (_, Stage::Factors) => Count::Direct(blocks(1u64)),
            (_, Stage::Scan) => Count::Direct(Formula::term(1u64, Variable::Patches, SECTION)),
            (Workgroups::Direct([x, ..]), _) => Count::Direct(u64::from(x).into()),
        };
        let bindings = one.bindings().map(bound).collect();
        Dispatch { stage: one.stage(), job: one.job(), bindings, workgroups }
    }
}
