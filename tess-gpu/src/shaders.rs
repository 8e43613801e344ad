//! The WGSL of each stage: constants, then the files that the stage needs.

use crate::bindings::{Access, Binding, Resource};
use crate::setup::{Copies, IndexType, Numbering, PointFormat, Setup, constants};
use crate::sizes;
use tess_core::Order;
use tess_core::{OutputPrimitive, Partitioning, SplitOrder};

mod counting;
mod files;
mod pull;
#[cfg(feature = "taps")]
mod taps;

pub use counting::Counting;
pub use pull::Pull;
#[cfg(feature = "taps")]
pub use taps::Tap;

/// One of the compute shaders that a batch runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// The work of [`Stage::Factors`] to [`Stage::Totals`] and of [`Stage::Partition`] in one
    /// dispatch, for a short batch.
    Short,
    /// Turns raw factors into topologies, contexts, counts and offsets within blocks of 256
    /// patches.
    Factors,
    /// Sums the offsets of blocks within sections of 256 blocks.
    Scan,
    /// Sums the offsets of sections in the output, and the needs of the batch so far. After the
    /// last portion it decides whether the output fits, and writes draw arguments and dispatch
    /// sizes.
    Totals,
    /// Expands each distinct small topology once, into the catalogue.
    List,
    /// Finds the patch that each tile of the output begins with.
    Partition,
    /// Writes the draw arguments of each group of patches.
    Groups,
    /// Writes the points, one tile per workgroup.
    ExpandPoints,
    /// Writes the indices, one tile per workgroup.
    ExpandPrimitives,
    /// Writes the points and indices of a short batch, one narrow tile per workgroup.
    ExpandShort,
}

/// The bindings that [`Stage::Short`] and [`Stage::Factors`] begin with.
const FRONT: [Binding; 6] = [
    Binding(Resource::Job, Access::Read),
    Binding(Resource::Factors, Access::Read),
    Binding(Resource::Tables, Access::Read),
    Binding(Resource::Topologies, Access::ReadWrite),
    Binding(Resource::Contexts, Access::ReadWrite),
    Binding(Resource::Offsets, Access::ReadWrite),
];

const FACTORS: [Binding; 7] = front([Binding(Resource::Catalogue, Access::ReadWrite)]);

const SHORT: [Binding; 9] = front([
    Binding(Resource::Status, Access::ReadWrite),
    Binding(Resource::Tiles, Access::ReadWrite),
    Binding(Resource::Arguments, Access::ReadWrite),
]);

const EXPAND_SHORT: [Binding; 9] = [
    Binding(Resource::Job, Access::Read),
    Binding(Resource::Topologies, Access::Read),
    Binding(Resource::Contexts, Access::Read),
    Binding(Resource::Tables, Access::Read),
    Binding(Resource::Offsets, Access::Read),
    Binding(Resource::Status, Access::Read),
    Binding(Resource::Indices, Access::ReadWrite),
    Binding(Resource::Tiles, Access::Read),
    Binding(Resource::Points, Access::ReadWrite),
];

/// [`FRONT`] followed by `more`: `ALL` bindings.
const fn front<const MORE: usize, const ALL: usize>(more: [Binding; MORE]) -> [Binding; ALL] {
    let mut all = [FRONT[0]; ALL];
    all.split_at_mut(FRONT.len()).0.copy_from_slice(&FRONT);
    all.split_at_mut(FRONT.len()).1.copy_from_slice(&more);
    all
}

impl Stage {
    /// Every stage. A short batch runs the first and the last, any other batch those between them;
    /// either also runs [`Stage::Groups`] if it has groups. [`crate::Plan::dispatches`] has the
    /// order.
    pub const ALL: [Self; 10] = [
        Self::Short,
        Self::Factors,
        Self::Scan,
        Self::Totals,
        Self::List,
        Self::Partition,
        Self::Groups,
        Self::ExpandPoints,
        Self::ExpandPrimitives,
        Self::ExpandShort,
    ];

    /// The name of the stage's entry point.
    #[must_use]
    pub const fn entry_point(self) -> &'static str {
        match self {
            Self::Short => "short_batch",
            Self::Factors => "factors",
            Self::Scan => "scan",
            Self::Totals => "totals",
            Self::List => "list",
            Self::Partition => "partition_tiles",
            Self::Groups => "groups",
            Self::ExpandPoints => "expand_points",
            Self::ExpandPrimitives => "expand_primitives",
            Self::ExpandShort => "expand_short",
        }
    }

    /// The stage's bindings, all in group 0, in order from binding 0.
    #[must_use]
    pub const fn bindings(self) -> &'static [Binding] {
        use Access::{Read, ReadWrite};
        use Resource::{
            Arguments, Catalogue, Contexts, Draws, Groups, Indices, Job, Offsets, Points, Status,
            Tables, Tiles, Topologies,
        };
        match self {
            Self::Short => &SHORT,
            Self::Factors => &FACTORS,
            Self::Scan => &[Binding(Job, Read), Binding(Offsets, ReadWrite)],
            Self::Totals => &[
                Binding(Job, Read),
                Binding(Offsets, ReadWrite),
                Binding(Status, ReadWrite),
                Binding(Arguments, ReadWrite),
            ],
            Self::List => {
                &[Binding(Job, Read), Binding(Tables, Read), Binding(Catalogue, ReadWrite)]
            }
            Self::Partition => &[
                Binding(Job, Read),
                Binding(Offsets, Read),
                Binding(Status, Read),
                Binding(Tiles, ReadWrite),
            ],
            Self::Groups => &[
                Binding(Job, Read),
                Binding(Offsets, Read),
                Binding(Status, Read),
                Binding(Groups, Read),
                Binding(Draws, ReadWrite),
            ],
            Self::ExpandPoints => &[
                Binding(Job, Read),
                Binding(Topologies, Read),
                Binding(Contexts, Read),
                Binding(Tables, Read),
                Binding(Offsets, Read),
                Binding(Status, Read),
                Binding(Tiles, Read),
                Binding(Points, ReadWrite),
                Binding(Catalogue, Read),
            ],
            Self::ExpandPrimitives => &[
                Binding(Job, Read),
                Binding(Topologies, Read),
                Binding(Tables, Read),
                Binding(Offsets, Read),
                Binding(Status, Read),
                Binding(Tiles, Read),
                Binding(Indices, ReadWrite),
                Binding(Catalogue, Read),
            ],
            Self::ExpandShort => &EXPAND_SHORT,
        }
    }

    /// The stage's WGSL, a whole module.
    #[must_use]
    pub fn source(self, setup: Setup) -> String {
        let (file, expansion) = match self {
            Self::Short => ("entry_points/short_batch", None),
            Self::Factors => ("entry_points/factors", None),
            Self::Scan => ("entry_points/scan", None),
            Self::Totals => ("entry_points/totals", None),
            Self::List => ("entry_points/list", None),
            Self::Partition => ("entry_points/partition", None),
            Self::Groups => ("entry_points/groups", None),
            Self::ExpandPoints => {
                ("entry_points/expand_points", Some((sizes::POINT_SCRATCH, sizes::POINT_THREADS)))
            }
            Self::ExpandPrimitives => (
                "entry_points/expand_primitives",
                Some((sizes::PRIMITIVE_SCRATCH, sizes::WORKGROUP)),
            ),
            Self::ExpandShort => {
                ("entry_points/expand_short", Some((sizes::POINT_SCRATCH, sizes::WORKGROUP)))
            }
        };
        let own = expansion
            .map(|(entries, threads)| constants(&[("SCRATCH", entries), ("THREADS", threads)]));
        let is_list = matches!(self, Self::List);
        let stored = if is_list { "variants/no_contexts" } else { "variants/stored_contexts" };
        let [place, contexts] = files::placing(setup, stored);
        let [catalogue, elements] = files::expanding(matches!(self, Self::ExpandShort));
        let lists = matches!(self, Self::Factors) && setup.has_triangles();
        let (indices, listing) = (files::indices(setup), files::listing(lists));
        let choices = [place, contexts, indices, listing, catalogue, elements];
        // A narrow tile has fewer elements than a patch that would be expanded for copying.
        let copies = if matches!(self, Self::ExpandShort) { Copies::Never } else { setup.copies };
        Setup { copies, ..setup }.prelude()
            + &own.unwrap_or_default()
            + &files::joined(&[file], &choices)
    }

    /// The setup for this stage's pipeline. Settings that the stage does not depend on have a fixed
    /// value, so that several setups share a pipeline.
    #[must_use]
    pub fn relevant(self, setup: Setup) -> Setup {
        let plain = Setup {
            point_format: PointFormat::Packed,
            numbering: Numbering::PerBatch,
            index_type: IndexType::U32,
            copies: Copies::WhereAlike,
            order: Order::Specification,
            ..setup
        };
        match self {
            Self::Short => plain,
            Self::Factors => Setup { copies: setup.copies, ..plain },
            Self::Scan | Self::Totals | Self::Partition | Self::Groups => any_factors(plain),
            Self::ExpandPoints => {
                let Setup { point_format, copies, .. } = setup;
                let mut own = any_factors(Setup { point_format, copies, ..plain });
                own.config.output = OutputPrimitive::Point;
                placed_as(setup, own)
            }
            Self::List => {
                let Setup { point_format, order, .. } = setup;
                placed_as(setup, any_factors(Setup { point_format, order, ..plain }))
            }
            Self::ExpandShort => {
                let copies = Copies::WhereAlike;
                placed_as(setup, any_factors(Setup { copies, ..setup }))
            }
            Self::ExpandPrimitives => {
                let Setup { numbering, index_type, copies, order, .. } = setup;
                any_factors(Setup { numbering, index_type, copies, order, ..plain })
            }
        }
    }
}

/// Keeps only whether points are evenly spaced (integer factors) or not.
fn placed_as(setup: Setup, mut own: Setup) -> Setup {
    if !setup.has_integer_factors() {
        own.config.partitioning = Partitioning::FractionalOdd;
    }
    own
}

/// Fixes partitioning and split order. After factor processing, they are part of the contexts and
/// tables.
fn any_factors(mut setup: Setup) -> Setup {
    setup.config.partitioning = Partitioning::Integer;
    setup.config.split = SplitOrder::Ruler;
    setup
}
