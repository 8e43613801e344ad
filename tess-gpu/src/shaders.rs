//! The WGSL of each stage: constants, then the parts that the stage is made of.

use crate::bindings::{Access, Binding, Resource};
use crate::setup::{IndexType, Numbering, PointFormat, Setup};
use tess_core::{OutputPrimitive, Partitioning, SplitOrder};

/// A part of a shader: one file of `shaders/`.
macro_rules! part {
    ($name:literal) => {
        include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/", $name, ".wgsl"))
    };
}

mod probe;
mod pull;

pub use probe::Probe;
pub use pull::Pull;

/// One compute shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Raw factors to topologies, contexts, counts and offsets within blocks of 256 patches.
    Factors,
    /// Offsets of blocks within groups of 256 blocks.
    Scan,
    /// Offsets of groups in the output, and what the batch needs; behind the last chunk whether
    /// the output fits, draw arguments and dispatch sizes.
    Totals,
    /// The patch that each tile of the output begins with.
    Partition,
    /// Tiles of points.
    ExpandPoints,
    /// Tiles of indices.
    ExpandPrimitives,
}

impl Stage {
    /// Every stage, in the order in which they run.
    pub const ALL: [Self; 6] = [
        Self::Factors,
        Self::Scan,
        Self::Totals,
        Self::Partition,
        Self::ExpandPoints,
        Self::ExpandPrimitives,
    ];

    /// The name of its entry point.
    #[must_use]
    pub const fn entry_point(self) -> &'static str {
        match self {
            Self::Factors => "factors",
            Self::Scan => "scan",
            Self::Totals => "totals",
            Self::Partition => "partition_tiles",
            Self::ExpandPoints => "expand_points",
            Self::ExpandPrimitives => "expand_primitives",
        }
    }

    /// Its bindings, all in group 0, in order from binding 0.
    #[must_use]
    pub const fn bindings(self) -> &'static [Binding] {
        use Access::{Read, ReadWrite};
        use Resource::{
            Arguments, Contexts, Factors, Indices, Job, Offsets, Points, Status, Tables, Tiles,
            Topologies,
        };
        match self {
            Self::Factors => &[
                Binding(Job, Read),
                Binding(Factors, Read),
                Binding(Tables, Read),
                Binding(Topologies, ReadWrite),
                Binding(Contexts, ReadWrite),
                Binding(Offsets, ReadWrite),
            ],
            Self::Scan => &[Binding(Job, Read), Binding(Offsets, ReadWrite)],
            Self::Totals => &[
                Binding(Job, Read),
                Binding(Offsets, ReadWrite),
                Binding(Status, ReadWrite),
                Binding(Arguments, ReadWrite),
            ],
            Self::Partition => &[
                Binding(Job, Read),
                Binding(Offsets, Read),
                Binding(Status, Read),
                Binding(Tiles, ReadWrite),
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
            ],
            Self::ExpandPrimitives => &[
                Binding(Job, Read),
                Binding(Topologies, Read),
                Binding(Tables, Read),
                Binding(Offsets, Read),
                Binding(Status, Read),
                Binding(Tiles, Read),
                Binding(Indices, ReadWrite),
            ],
        }
    }

    /// Its WGSL, a whole module.
    #[must_use]
    pub fn source(self, setup: Setup) -> String {
        let mut source = setup.prelude() + &self.parts(setup).concat();
        if self == Self::ExpandPrimitives {
            source += match setup.index_type {
                IndexType::U16 => part!("indices_u16"),
                IndexType::U32 => part!("indices_u32"),
            };
        }
        source
    }

    const fn parts(self, setup: Setup) -> &'static [&'static str] {
        match self {
            Self::Factors => &[
                part!("state"),
                part!("fixed_point"),
                part!("d3d_float"),
                part!("process"),
                part!("make_context"),
                part!("topology"),
                part!("counts"),
                part!("prefix_sum"),
                part!("factors"),
            ],
            Self::Scan => &[part!("state"), part!("prefix_sum"), part!("scan")],
            Self::Totals => &[part!("state"), part!("prefix_sum"), part!("totals")],
            Self::Partition => &[part!("state"), part!("partition")],
            Self::ExpandPoints if setup.has_integer_factors() => &[
                part!("state"),
                part!("fixed_point"),
                part!("place_evenly"),
                part!("topology"),
                part!("shape"),
                part!("points"),
                part!("point_format"),
                part!("offsets"),
                part!("tile"),
                part!("alike"),
                part!("expand_points"),
            ],
            Self::ExpandPoints => &[
                part!("state"),
                part!("fixed_point"),
                part!("factor_context"),
                part!("place"),
                part!("stored_contexts"),
                part!("topology"),
                part!("shape"),
                part!("points"),
                part!("point_format"),
                part!("offsets"),
                part!("tile"),
                part!("alike"),
                part!("expand_points"),
            ],
            Self::ExpandPrimitives => &[
                part!("state"),
                part!("topology"),
                part!("shape"),
                part!("stitch"),
                part!("connect"),
                part!("offsets"),
                part!("tile"),
                part!("alike"),
                part!("expand_primitives"),
            ],
        }
    }

    /// `setup` with everything that this stage does not depend on set to one value, so that
    /// pipelines can be shared.
    #[must_use]
    pub fn relevant(self, setup: Setup) -> Setup {
        let plain = Setup {
            point_format: PointFormat::Packed,
            numbering: Numbering::PerBatch,
            index_type: IndexType::U32,
            ..setup
        };
        match self {
            Self::Factors => plain,
            Self::Scan | Self::Totals | Self::Partition => any_factors(plain),
            Self::ExpandPoints => {
                let mut own = any_factors(Setup { point_format: setup.point_format, ..plain });
                own.config.output = OutputPrimitive::Point;
                if !setup.has_integer_factors() {
                    own.config.partitioning = Partitioning::FractionalOdd;
                }
                own
            }
            Self::ExpandPrimitives => {
                let Setup { numbering, index_type, .. } = setup;
                any_factors(Setup { numbering, index_type, ..plain })
            }
        }
    }
}

/// Once factors are processed, partitioning and split order are in contexts and tables.
fn any_factors(mut setup: Setup) -> Setup {
    setup.config.partitioning = Partitioning::Integer;
    setup.config.split = SplitOrder::Ruler;
    setup
}
