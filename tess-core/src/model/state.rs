//! The settings of a tessellator before patches arrive (spec section 1).

/// The shape of a patch's parameter space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Domain {
    /// Parallel lines along u, stacked in v.
    Isoline,
    /// Barycentric (u, v), with w = 1 - u - v.
    Triangle,
    /// The unit square.
    Quad,
}

/// The spacing of the cuts that a factor makes along an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Partitioning {
    /// Equal segments, factor rounded up to an integer in 1..=64.
    Integer,
    /// Processed exactly as [`Partitioning::Integer`]; only the factor preparation
    /// ([`crate::prepare`]) rounds to powers of two.
    Pow2,
    /// An odd number of segments, two of them growing with the factor, in 1..=63.
    FractionalOdd,
    /// An even number of segments, two of them growing with the factor, in 2..=64.
    FractionalEven,
}

/// The elements of the index list. Clockwise as seen with v pointing down (spec section 7).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum OutputPrimitive {
    /// One index per domain point.
    Point,
    /// Line segments: the lines of an isoline patch, or all points joined in order.
    Line,
    /// Clockwise triangles (lines on an isoline domain).
    TriangleCw,
    /// Counter-clockwise triangles (lines on an isoline domain).
    TriangleCcw,
}

impl OutputPrimitive {
    /// How many indices a primitive of a patch of this domain has: 1, 2 or 3.
    #[must_use]
    #[inline]
    pub const fn indices_per_primitive(self, domain: Domain) -> u32 {
        match (self, domain) {
            (Self::Point, _) => 1,
            (Self::Line, _) | (_, Domain::Isoline) => 2,
            (Self::TriangleCw | Self::TriangleCcw, _) => 3,
        }
    }
}

/// The order in which points join an edge as its factor grows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum SplitOrder {
    /// Bit-reversed order, the standard.
    #[default]
    Ruler,
    /// From the centre outwards, the order of the Xbox 360 (spec section 10).
    Centre,
}

/// Whether an edge has an odd or an even number of segments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Parity {
    /// Even number of segments: a point is exactly in the middle.
    Even,
    /// Odd number of segments: a segment crosses the middle.
    Odd,
}

impl Parity {
    /// 1 for odd, 0 for even: the `odd` of the spec's formulas.
    #[must_use]
    pub const fn odd(self) -> u32 {
        match self {
            Self::Even => 0,
            Self::Odd => 1,
        }
    }
}

/// The fixed state of the tessellator; the domain comes with the factors of each patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Config {
    /// Spacing of the cuts.
    pub partitioning: Partitioning,
    /// The kind of primitive that the indices describe.
    pub output: OutputPrimitive,
    /// Order in which edges are split.
    pub split: SplitOrder,
}

impl Config {
    /// A configuration in the standard (ruler) split order.
    #[must_use]
    pub const fn new(partitioning: Partitioning, output: OutputPrimitive) -> Self {
        Self { partitioning, output, split: SplitOrder::Ruler }
    }
}

impl Domain {
    /// Every domain, in the order of the specification.
    pub const ALL: [Self; 3] = [Self::Isoline, Self::Triangle, Self::Quad];
}

impl Partitioning {
    /// Every partitioning, in the order of the specification.
    pub const ALL: [Self; 4] =
        [Self::Integer, Self::Pow2, Self::FractionalOdd, Self::FractionalEven];

    /// The range that factors are clamped to (spec section 3, step 2).
    #[must_use]
    pub const fn range(self) -> (f32, f32) {
        match self {
            Self::Integer | Self::Pow2 => (1.0, 64.0),
            Self::FractionalOdd => (1.0, 63.0),
            Self::FractionalEven => (2.0, 64.0),
        }
    }

    /// Whether every factor is rounded up to an integer (spec section 3, step 3).
    #[must_use]
    pub const fn has_integer_factors(self) -> bool {
        matches!(self, Self::Integer | Self::Pow2)
    }
}

impl OutputPrimitive {
    /// Every output primitive, in the order of the specification.
    pub const ALL: [Self; 4] = [Self::Point, Self::Line, Self::TriangleCw, Self::TriangleCcw];
}

impl SplitOrder {
    /// Both split orders.
    pub const ALL: [Self; 2] = [Self::Ruler, Self::Centre];
}
