//! The dispatches in order, and the buffers that each binds.

use super::Plan;
use super::jobs::JobPart;
use crate::bindings::{Binding, Resource};
use crate::layout::Job;
use crate::room::{Capacity, Span};
use crate::shaders::Stage;
use crate::sizes::{ALIGNMENT, BLOCK, SECTION, SLOTS, WORKGROUP};

/// One stage over one part of the batch: bind [`Dispatch::bindings`], then dispatch
/// [`Dispatch::workgroups`].
#[derive(Clone, Copy, Debug)]
pub struct Dispatch {
    plan: Plan,
    stage: Stage,
    portion: u32,
    part: JobPart,
}

/// The number of workgroups of a dispatch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Workgroups {
    /// These numbers along x, y and z.
    Direct([u32; 3]),
    /// Three words at this byte offset of [`Resource::Arguments`], which an earlier dispatch
    /// writes.
    Indirect(u64),
}

impl Plan {
    /// All dispatches of a batch, in order. Each dispatch reads the results of earlier ones.
    ///
    /// All portions are counted before any is expanded, so that nothing is written unless
    /// everything fits.
    pub fn dispatches(&self) -> impl Iterator<Item = Dispatch> + use<> {
        let plan = *self;
        let portions = 0..self.portions().max(1);
        let counting: &[Stage] = match self.patches {
            0 => &[Stage::Totals],
            _ if self.is_short() => &[Stage::Short],
            _ => &[Stage::Factors, Stage::Scan, Stage::Totals],
        };
        let groups: &[Stage] = if self.groups == 0 { &[] } else { &[Stage::Groups] };
        let whole =
            move |portion| move |&stage| Dispatch { plan, stage, portion, part: JobPart::Whole };
        let list = self.has_catalogue().then(|| whole(0)(&Stage::List));
        let counting =
            portions.clone().flat_map(move |portion| counting.iter().map(whole(portion)));
        let groups = portions.flat_map(move |portion| groups.iter().map(whole(portion)));
        let expansion = (0..self.portions()).flat_map(move |portion| plan.expansion(portion));
        counting.chain(list).chain(groups).chain(expansion)
    }

    /// The dispatches that write the output of a portion; none if there is no room for output.
    fn expansion(self, portion: u32) -> impl Iterator<Item = Dispatch> + use<> {
        let has_room = self.capacity != Capacity::default();
        let (points, primitives) = match self.is_short() {
            true => (0, 0),
            false => (self.point_windows(), self.primitive_windows()),
        };
        let dispatch = move |stage, part| Dispatch { plan: self, stage, portion, part };
        let first = if self.is_short() { Stage::ExpandShort } else { Stage::Partition };
        let first = has_room.then(|| dispatch(first, JobPart::Whole));
        let points = (0..points)
            .map(move |window| dispatch(Stage::ExpandPoints, JobPart::Points { window }));
        let primitives = (0..primitives)
            .map(move |window| dispatch(Stage::ExpandPrimitives, JobPart::Primitives { window }));
        first.into_iter().chain(points).chain(primitives)
    }
}

impl Dispatch {
    /// The stage whose pipeline the dispatch runs.
    #[must_use]
    pub const fn stage(&self) -> Stage {
        self.stage
    }

    /// The number of the dispatch's job in the buffer of jobs.
    #[must_use]
    pub fn job(&self) -> u32 {
        self.plan.job_number(self.portion, self.part)
    }

    /// The bindings of the dispatch in group 0, in order from binding 0: each a buffer, and the
    /// bytes of it to bind.
    pub fn bindings(&self) -> impl ExactSizeIterator<Item = (Resource, Span)> {
        let resources = self.stage.bindings().iter();
        resources.map(|&Binding(resource, _)| (resource, self.span(resource)))
    }

    /// The workgroups of the dispatch.
    #[must_use]
    pub fn workgroups(&self) -> Workgroups {
        let patches = self.plan.patches_in(self.portion);
        match self.stage {
            Stage::Factors => Workgroups::Direct(self.plan.in_rows(patches.div_ceil(BLOCK))),
            Stage::Scan => Workgroups::Direct(self.plan.in_rows(patches.div_ceil(SECTION))),
            Stage::Short | Stage::Totals => Workgroups::Direct([1; 3]),
            Stage::List => Workgroups::Direct(self.plan.in_rows(SLOTS)),
            Stage::Groups => {
                Workgroups::Direct(self.plan.in_rows(self.plan.groups.div_ceil(WORKGROUP)))
            }
            Stage::ExpandShort => {
                let tiles = |elements: u32| elements.div_ceil(self.plan.tile());
                let Capacity { points, primitives } = self.plan.capacity;
                Workgroups::Direct(self.plan.in_rows(tiles(points) + tiles(primitives)))
            }
            Stage::Partition | Stage::ExpandPoints | Stage::ExpandPrimitives => {
                Workgroups::Indirect(self.plan.arguments_at(self.job()))
            }
        }
    }

    fn span(&self, resource: Resource) -> Span {
        let (plan, portion) = (&self.plan, self.portion);
        let whole = Span { offset: 0, size: plan.buffer_size(resource) };
        match (resource, self.part) {
            (Resource::Job, _) => {
                let offset = ALIGNMENT * u64::from(self.job());
                Span { offset, size: size_of::<Job>() as u64 }
            }
            (Resource::Factors, _) => plan.factors(portion),
            (Resource::Topologies, _) => plan.topologies(portion),
            (Resource::Contexts, _) => plan.contexts(portion),
            (Resource::Offsets, _) => plan.offsets(portion),
            (Resource::Points, JobPart::Points { window }) => plan.point_window(window),
            (Resource::Indices, JobPart::Primitives { window }) => plan.primitive_window(window),
            _ => whole,
        }
    }
}
