//! The setup: everything that the patches of a batch have in common.

use crate::{sizes, tables};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, SplitOrder};
use tess_core::{Order, cache_order};

/// The format of domain points: 8 bytes each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PointFormat {
    /// A little-endian 64-bit number: u as a 16.16 number in bits 0..=16, v in bits 17..=33, the
    /// number of the patch in bits 34..=63. See [`crate::layout::PackedPoint`].
    #[default]
    Packed,
    /// u and v as binary32, exactly.
    F32,
}

/// The point that has index 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Numbering {
    /// The first point of the batch: one draw with the index buffer draws all patches.
    #[default]
    PerBatch,
    /// The first point of each patch, as in the specification.
    PerPatch,
}

/// Width of the indices.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum IndexType {
    /// 16 bits: enough for any single patch ([`Numbering::PerPatch`]), and for a batch of up to
    /// 65536 points. A larger batch with [`Numbering::PerBatch`] does not fit, however much room a
    /// [`crate::Plan`] is given.
    ///
    /// The index 65535 restarts primitives in WebGL 2, in WebGPU with strips, and in other
    /// interfaces if primitive restart is on. There, give the plan room for at most
    /// [`IndexType::points_without_restart`] points.
    U16,
    /// 32 bits.
    #[default]
    U32,
}

impl IndexType {
    /// Bytes of an index.
    #[must_use]
    pub const fn bytes(self) -> u32 {
        match self {
            Self::U16 => 2,
            Self::U32 => 4,
        }
    }

    /// The number of points that [`Numbering::PerBatch`] can number without the largest index,
    /// which restarts primitives: 65 535, or 2^32 - 1.
    #[must_use]
    pub const fn points_without_restart(self) -> u32 {
        match self {
            Self::U16 => u16::MAX as u32,
            Self::U32 => u32::MAX,
        }
    }
}

/// Whether neighbouring patches with the same topology are expanded once and copied.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Copies {
    /// One such patch is expanded and copied.
    #[default]
    WhereAlike,
    /// Each patch is expanded separately. For measuring the cost of neighbours that differ.
    Never,
}

/// Everything that is fixed before the patches of a batch arrive. Shaders and pipelines depend on
/// it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Setup {
    /// Domain of all patches.
    pub domain: Domain,
    /// Partitioning, output primitive and split order.
    pub config: Config,
    /// Format of the points.
    pub point_format: PointFormat,
    /// The point that has index 0.
    pub numbering: Numbering,
    /// Width of the indices.
    pub index_type: IndexType,
    /// Whether neighbours with the same topology are copied. The output is the same either way.
    pub copies: Copies,
    /// Order of the triangles of a patch.
    pub order: Order,
}

impl Setup {
    /// A setup with packed points, and with 32-bit indices that count from the first point of the
    /// batch. Triangles are in the specification's order.
    #[must_use]
    pub const fn new(domain: Domain, config: Config) -> Self {
        let (point_format, numbering) = (PointFormat::Packed, Numbering::PerBatch);
        let (index_type, copies) = (IndexType::U32, Copies::WhereAlike);
        let order = Order::Specification;
        Self { domain, config, point_format, numbering, index_type, copies, order }
    }

    /// The number of factors of a patch. Each is a binary32 in the buffer of factors, in the order
    /// of the specification (section 1), patch by patch without gaps.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "6 at most")]
    pub const fn factors(&self) -> u32 {
        self.domain.factors() as u32
    }

    /// The number of indices of a primitive: 1, 2 or 3.
    #[must_use]
    pub const fn indices_per_primitive(&self) -> u32 {
        self.config.output.indices_per_primitive(self.domain)
    }

    /// Bytes of one primitive's indices.
    #[must_use]
    pub const fn primitive_bytes(&self) -> u32 {
        self.index_type.bytes() * self.indices_per_primitive()
    }

    /// Whether factors are rounded to integers. If so, no contexts are stored.
    #[must_use]
    pub const fn has_integer_factors(&self) -> bool {
        self.config.partitioning.has_integer_factors()
    }

    /// Whether primitives are triangles.
    #[must_use]
    pub const fn has_triangles(&self) -> bool {
        self.indices_per_primitive() == 3
    }

    /// The constants that every shader begins with: those that `layout/setup.wgsl` does not declare
    /// itself.
    pub(crate) fn prelude(&self) -> String {
        let Config { partitioning, output, split } = self.config;
        let setup = [
            ("DOMAIN", self.domain as u32),
            ("PARTITIONING", partitioning as u32),
            ("OUTPUT", output as u32),
            ("SPLIT", split as u32),
            ("POINT_FORMAT", self.point_format as u32),
            ("NUMBERING", self.numbering as u32),
            ("FACTORS", self.factors()),
            ("COPIES", u32::from(self.copies == Copies::WhereAlike)),
            ("ORDER", self.order as u32),
        ];
        constants(&setup) + &constants(&SHARED) + &constants(&VALUES)
    }
}

/// Lists constants of modules: names and values.
macro_rules! named {
    ($($module:ident: $($name:ident)*;)*) => { [$($((stringify!($name), $module::$name),)*)*] };
}

/// The constants of [`sizes`] and [`tables`], which every shader has.
const SHARED: [(&str, u32); 30] = named! {
    cache_order: COLUMN;
    sizes: WORKGROUP ROUND SUMMED BLOCK BLOCK_BITS SECTION_BLOCKS SECTION_BLOCK_BITS SECTION
        SECTION_BITS DISPATCHES_AT SLOT_BITS SLOTS CATALOGUE_POINTS CATALOGUE_TRIANGLES
        LISTED_POINTS LISTED_PRIMITIVES USED_AT TILE PLACES_AT POINTS_AT TRIANGLES_AT;
    tables: RECIPROCALS_AT STITCHES_AT STITCH_WORDS TRANSITION_STRIDE FAN_STITCH RING_STITCH
        MIRRORED_STRIP PLAIN_STRIP;
};

/// The values that the setup's constants can have, by name.
const VALUES: [(&str, u32); 19] = [
    ("ISOLINE", Domain::Isoline as u32),
    ("TRIANGLE", Domain::Triangle as u32),
    ("QUAD", Domain::Quad as u32),
    ("INTEGER", Partitioning::Integer as u32),
    ("POW2", Partitioning::Pow2 as u32),
    ("FRACTIONAL_ODD", Partitioning::FractionalOdd as u32),
    ("FRACTIONAL_EVEN", Partitioning::FractionalEven as u32),
    ("OUTPUT_POINT", OutputPrimitive::Point as u32),
    ("OUTPUT_LINE", OutputPrimitive::Line as u32),
    ("OUTPUT_TRIANGLE_CW", OutputPrimitive::TriangleCw as u32),
    ("OUTPUT_TRIANGLE_CCW", OutputPrimitive::TriangleCcw as u32),
    ("RULER", SplitOrder::Ruler as u32),
    ("CENTER", SplitOrder::Centre as u32),
    ("PACKED", PointFormat::Packed as u32),
    ("F32", PointFormat::F32 as u32),
    ("SPECIFICATION", Order::Specification as u32),
    ("VERTEX_CACHE", Order::VertexCache as u32),
    ("PER_BATCH", Numbering::PerBatch as u32),
    ("PER_PATCH", Numbering::PerPatch as u32),
];

/// Declarations of constants.
pub(crate) fn constants(all: &[(&str, u32)]) -> String {
    all.iter().map(|(name, value)| format!("const {name} = {value}u;\n")).collect()
}
