//! The WGSL of each stage: constants, then the parts that the stage is made of.

use crate::bindings::{Access, Binding, Resource};
use crate::setup::{IndexType, Numbering, PointFormat, Setup};
use tess_core::{OutputPrimitive, Partitioning, SplitOrder};

/// A part of a shader: one file of `shaders/`.
macro_rules! part {
    ($name:literal) => {
        include_str!(concat!("../shaders/", $name, ".wgsl"))
    };
}

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

/// A shader that runs one step alone, for comparing it with the golden model's. Binding 0 is what
/// goes in, 1 what comes out, 2 the [`crate::tables`]; the entry point is `probes`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Probe {
    /// Four words of a triangle patch's factors to its fixed-point u = 0 and inside factors.
    Factors,
    /// A 15.16 factor and its parity (1 is odd) to its packed context.
    Contexts,
    /// A packed context to 65 words of locations, as many of them written as it has points.
    Locations,
}

impl Probe {
    /// Every probe.
    pub const ALL: [Self; 3] = [Self::Factors, Self::Contexts, Self::Locations];

    /// Words of input and of output of one probe.
    #[must_use]
    pub const fn words(self) -> (u32, u32) {
        match self {
            Self::Factors => (4, 2),
            Self::Contexts => (2, 2),
            Self::Locations => (2, 65),
        }
    }

    /// Its WGSL, a whole module.
    #[must_use]
    pub fn source(self, setup: Setup) -> String {
        let parts: &[&str] = match self {
            Self::Factors => &[
                part!("state"),
                part!("fixed_point"),
                part!("d3d_float"),
                part!("process"),
                part!("make_context"),
                part!("topology"),
                part!("probe_factors"),
            ],
            Self::Contexts => &[
                part!("state"),
                part!("fixed_point"),
                part!("make_context"),
                part!("probe_contexts"),
            ],
            Self::Locations => &[
                part!("state"),
                part!("fixed_point"),
                part!("factor_context"),
                part!("place"),
                part!("probe_locations"),
            ],
        };
        setup.prelude() + &parts.concat() + part!("probe")
    }
}

/// WGSL that a user's own shader includes to compute any point or primitive of a patch from its
/// number alone, in constant time, so that nothing needs to be written out for drawing.
///
/// It declares `topologies` (as a batch of one chunk leaves them), `tables` and, unless
/// [`Setup::has_integer_factors`], `contexts` as read-only storage buffers, and offers
/// - `tess_point(patch_index, i) -> vec2<u32>`: u and v as 16.16 numbers,
/// - `tess_location(patch_index, i) -> vec2<f32>`: the same as binary32, exactly,
/// - `tess_primitive(patch_index, t) -> vec3<u32>`: the patch's own indices, as many as a
///   primitive has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Pull {
    /// Bind group of the buffers.
    pub group: u32,
    /// Binding of `topologies`; `tables` and `contexts` follow.
    pub first_binding: u32,
}

impl Pull {
    /// The WGSL, to stand in front of the user's.
    #[must_use]
    pub fn source(self, setup: Setup) -> String {
        let declare = |offset: u32, name: &str, of: &str| {
            let (group, binding) = (self.group, self.first_binding + offset);
            format!("@group({group}) @binding({binding}) var<storage, read> {name}: array<{of}>;\n")
        };
        let mut head = setup.prelude()
            + &declare(0, "topologies", "vec2<u32>")
            + &declare(1, "tables", "u32")
            + part!("state")
            + part!("fixed_point");
        if setup.has_integer_factors() {
            head += part!("place_evenly");
        } else {
            head += &declare(2, "contexts", "vec2<u32>");
            head += &format!("const FACTORS = {}u;\n", setup.factors());
            head += &[part!("factor_context"), part!("place"), part!("pulled_contexts")].concat();
        }
        let parts = [
            part!("topology"),
            part!("shape"),
            part!("points"),
            part!("stitch"),
            part!("connect"),
            part!("locate"),
        ];
        head + &parts.concat()
    }
}
