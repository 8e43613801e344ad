//! The WGSL of each stage: constants, then the files that the stage needs.

use crate::bindings::{Access, Binding, Resource};
use crate::setup::{Copies, IndexType, Numbering, PointFormat, Setup, constants};
use crate::sizes;
use tess_core::Order;
use tess_core::{OutputPrimitive, Partitioning, SplitOrder};

#[cfg(any(target_arch = "wasm32", test))]
mod bare;
mod counting;
mod files;
mod probe;
mod pull;

pub use counting::Counting;
pub use probe::Probe;
pub use pull::Pull;

/// One of the compute shaders that a batch runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// The next four in one workgroup, for a small batch.
    Small,
    /// Raw factors to topologies, contexts, counts and offsets within blocks of 256 patches.
    Factors,
    /// Offsets of blocks within sections of 256 blocks.
    Scan,
    /// Offsets of sections in the output, and what the batch needs so far. After the last chunk:
    /// whether the output fits, draw arguments and dispatch sizes.
    Totals,
    /// The output of each distinct small topology, once.
    List,
    /// The patch that each tile of the output begins with.
    Partition,
    /// The draw arguments of each group of patches.
    Groups,
    /// Tiles of points.
    ExpandPoints,
    /// Tiles of indices.
    ExpandPrimitives,
    /// Both expansions of a small batch.
    ExpandSmall,
}

/// The bindings that [`Stage::Small`] and [`Stage::Factors`] begin with.
const FRONT: [Binding; 6] = [
    Binding(Resource::Job, Access::Read),
    Binding(Resource::Factors, Access::Read),
    Binding(Resource::Tables, Access::Read),
    Binding(Resource::Topologies, Access::ReadWrite),
    Binding(Resource::Contexts, Access::ReadWrite),
    Binding(Resource::Offsets, Access::ReadWrite),
];

const FACTORS: [Binding; 7] = front([Binding(Resource::Catalogue, Access::ReadWrite)]);

const SMALL: [Binding; 9] = front([
    Binding(Resource::Status, Access::ReadWrite),
    Binding(Resource::Tiles, Access::ReadWrite),
    Binding(Resource::Arguments, Access::ReadWrite),
]);

const EXPAND_SMALL: [Binding; 9] = [
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

/// [`FRONT`] and `more`, `ALL` together.
const fn front<const MORE: usize, const ALL: usize>(more: [Binding; MORE]) -> [Binding; ALL] {
    let mut all = [FRONT[0]; ALL];
    all.split_at_mut(FRONT.len()).0.copy_from_slice(&FRONT);
    all.split_at_mut(FRONT.len()).1.copy_from_slice(&more);
    all
}

impl Stage {
    /// Every stage, in the order in which they run.
    pub const ALL: [Self; 10] = [
        Self::Small,
        Self::Factors,
        Self::Scan,
        Self::Totals,
        Self::List,
        Self::Partition,
        Self::Groups,
        Self::ExpandPoints,
        Self::ExpandPrimitives,
        Self::ExpandSmall,
    ];

    /// The name of its entry point.
    #[must_use]
    pub const fn entry_point(self) -> &'static str {
        match self {
            Self::Small => "small",
            Self::Factors => "factors",
            Self::Scan => "scan",
            Self::Totals => "totals",
            Self::List => "list",
            Self::Partition => "partition_tiles",
            Self::Groups => "groups",
            Self::ExpandPoints => "expand_points",
            Self::ExpandPrimitives => "expand_primitives",
            Self::ExpandSmall => "expand_small",
        }
    }

    /// Its bindings, all in group 0, in order from binding 0.
    #[must_use]
    pub const fn bindings(self) -> &'static [Binding] {
        use Access::{Read, ReadWrite};
        use Resource::{
            Arguments, Catalogue, Contexts, Draws, Groups, Indices, Job, Offsets, Points, Status,
            Tables, Tiles, Topologies,
        };
        match self {
            Self::Small => &SMALL,
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
            Self::ExpandSmall => &EXPAND_SMALL,
        }
    }

    /// Its WGSL, a whole module.
    #[must_use]
    pub fn source(self, setup: Setup) -> String {
        let (file, expansion) = match self {
            Self::Small => ("small", None),
            Self::Factors => ("factors", None),
            Self::Scan => ("scan", None),
            Self::Totals => ("totals", None),
            Self::List => ("list", None),
            Self::Partition => ("partition", None),
            Self::Groups => ("groups", None),
            Self::ExpandPoints => {
                ("expand_points", Some((sizes::POINT_SCRATCH, sizes::POINT_THREADS)))
            }
            Self::ExpandPrimitives => {
                ("expand_primitives", Some((sizes::PRIMITIVE_SCRATCH, sizes::WORKGROUP)))
            }
            Self::ExpandSmall => ("expand_small", Some((sizes::POINT_SCRATCH, sizes::WORKGROUP))),
        };
        let own = expansion
            .map(|(entries, threads)| constants(&[("SCRATCH", entries), ("THREADS", threads)]));
        let is_list = matches!(self, Self::List);
        let stored = if is_list { "no_contexts" } else { "stored_contexts" };
        let [place, contexts] = files::placing(setup, stored);
        let [catalogue, elements] = files::expanding(matches!(self, Self::ExpandSmall));
        let lists = matches!(self, Self::Factors) && setup.has_triangles();
        let (indices, listing) = (files::indices(setup), files::listing(lists));
        let choices = [place, contexts, indices, listing, catalogue, elements];
        // A small tile has fewer elements than the patch that would be made for copying.
        let copies = if matches!(self, Self::ExpandSmall) { Copies::Never } else { setup.copies };
        Setup { copies, ..setup }.prelude()
            + &own.unwrap_or_default()
            + &files::joined(&[file], &choices)
    }

    /// The setup to make this stage's pipeline for. Everything that the stage does not depend on is
    /// set to one value, so that several setups share a pipeline.
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
            Self::Small => plain,
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
            Self::ExpandSmall => {
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

/// Points lie evenly or not.
fn placed_as(setup: Setup, mut own: Setup) -> Setup {
    if !setup.has_integer_factors() {
        own.config.partitioning = Partitioning::FractionalOdd;
    }
    own
}

/// Once factors are processed, partitioning and split order are in contexts and tables.
fn any_factors(mut setup: Setup) -> Setup {
    setup.config.partitioning = Partitioning::Integer;
    setup.config.split = SplitOrder::Ruler;
    setup
}
