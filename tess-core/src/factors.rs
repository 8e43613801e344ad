//! Factor processing: from raw binary32 factors to contexts (spec section 3).

use crate::d3d_float::{ceil, clamp, is_culled};
use crate::factor_context::FactorContext;
use crate::fixed_point::FixedFactor;
use crate::state::{Config, Domain, Parity, Partitioning};

/// The factors of an isoline patch, one `T` each; `f32` for raw factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct IsolineFactors<T = f32> {
    /// Number of lines; always processed as integer.
    pub density: T,
    /// Number of segments of each line.
    pub detail: T,
}

/// The factors of a triangle patch, one `T` each; `f32` for raw factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct TriangleFactors<T = f32> {
    /// Outer factor of the edge u = 0.
    pub u0: T,
    /// Outer factor of the edge v = 0.
    pub v0: T,
    /// Outer factor of the edge w = 0.
    pub w0: T,
    /// Inside factor.
    pub inside: T,
}

/// The factors of a quad patch, one `T` each; `f32` for raw factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct QuadFactors<T = f32> {
    /// Outer factor of the edge u = 0.
    pub u0: T,
    /// Outer factor of the edge v = 0.
    pub v0: T,
    /// Outer factor of the edge u = 1.
    pub u1: T,
    /// Outer factor of the edge v = 1.
    pub v1: T,
    /// Inside factor along u.
    pub inside_u: T,
    /// Inside factor along v.
    pub inside_v: T,
}

/// The factors of one patch of any domain, one `T` each; `f32` for raw factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PatchFactors<T = f32> {
    /// An isoline patch.
    Isoline(IsolineFactors<T>),
    /// A triangle patch.
    Triangle(TriangleFactors<T>),
    /// A quad patch.
    Quad(QuadFactors<T>),
}

/// The conversions between a domain's factors and an array in the specification's order (section
/// 1): this list of fields is the one place that says what that order is.
macro_rules! factor_order {
    ($factors:ident, $domain:ident, $count:literal, [$($field:ident),*]) => {
        impl<T> From<[T; $count]> for $factors<T> {
            /// The factors from an array in the specification's order.
            fn from([$($field),*]: [T; $count]) -> Self {
                Self { $($field),* }
            }
        }

        impl<T> From<$factors<T>> for [T; $count] {
            /// The factors in the specification's order.
            fn from($factors { $($field),* }: $factors<T>) -> Self {
                [$($field),*]
            }
        }

        impl<T> From<$factors<T>> for PatchFactors<T> {
            fn from(factors: $factors<T>) -> Self {
                Self::$domain(factors)
            }
        }

        impl<T: Copy> $factors<T> {
            /// The names of the fields, in the specification's order.
            pub const NAMES: [&'static str; $count] = [$(stringify!($field)),*];

            /// Every factor the same.
            pub const fn uniform(factor: T) -> Self {
                Self { $($field: factor),* }
            }
        }
    };
}

factor_order!(IsolineFactors, Isoline, 2, [density, detail]);
factor_order!(TriangleFactors, Triangle, 4, [u0, v0, w0, inside]);
factor_order!(QuadFactors, Quad, 6, [u0, v0, u1, v1, inside_u, inside_v]);

impl Domain {
    /// How many factors a patch has, outer ones first: isoline 2, triangle 4, quad 6.
    #[must_use]
    pub const fn factors(self) -> usize {
        self.factor_names().len()
    }

    /// How many outer factors a patch has: isoline 2 (density and detail), triangle 3, quad 4.
    #[must_use]
    pub const fn outer_factors(self) -> usize {
        self.factors() - self.inside_factors()
    }

    /// How many inside factors a patch has: isoline 0, triangle 1, quad 2.
    #[must_use]
    pub const fn inside_factors(self) -> usize {
        match self {
            Self::Isoline => 0,
            Self::Triangle => 1,
            Self::Quad => 2,
        }
    }

    /// The names of the factors in the specification's order, as the fields of [`PatchFactors`].
    #[must_use]
    pub const fn factor_names(self) -> &'static [&'static str] {
        match self {
            Self::Isoline => &IsolineFactors::<f32>::NAMES,
            Self::Triangle => &TriangleFactors::<f32>::NAMES,
            Self::Quad => &QuadFactors::<f32>::NAMES,
        }
    }
}

impl<T: Copy> TriangleFactors<T> {
    /// The outer factors in edge order: u = 0, v = 0, w = 0.
    pub const fn outer(&self) -> [T; 3] {
        [self.u0, self.v0, self.w0]
    }
}

impl<T: Copy> QuadFactors<T> {
    /// The outer factors in edge order: u = 0, v = 0, u = 1, v = 1.
    pub const fn outer(&self) -> [T; 4] {
        [self.u0, self.v0, self.u1, self.v1]
    }

    /// The inside factors: along u, along v.
    pub const fn inside(&self) -> [T; 2] {
        [self.inside_u, self.inside_v]
    }
}

impl<T> PatchFactors<T> {
    /// The domain these factors belong to.
    pub const fn domain(&self) -> Domain {
        match self {
            Self::Isoline(_) => Domain::Isoline,
            Self::Triangle(_) => Domain::Triangle,
            Self::Quad(_) => Domain::Quad,
        }
    }

    /// The factors of a domain, factor `i` of the specification's order from `factor(i)`.
    pub fn from_fn(domain: Domain, factor: impl FnMut(usize) -> T) -> Self {
        use core::array::from_fn;
        match domain {
            Domain::Isoline => Self::Isoline(from_fn::<_, 2, _>(factor).into()),
            Domain::Triangle => Self::Triangle(from_fn::<_, 4, _>(factor).into()),
            Domain::Quad => Self::Quad(from_fn::<_, 6, _>(factor).into()),
        }
    }

    /// The factors with `f` applied to each, in the specification's order.
    pub fn map<U>(self, f: impl FnMut(T) -> U) -> PatchFactors<U> {
        match self {
            Self::Isoline(factors) => PatchFactors::Isoline(<[T; 2]>::from(factors).map(f).into()),
            Self::Triangle(factors) => {
                PatchFactors::Triangle(<[T; 4]>::from(factors).map(f).into())
            }
            Self::Quad(factors) => PatchFactors::Quad(<[T; 6]>::from(factors).map(f).into()),
        }
    }
}

impl<T: Copy> PatchFactors<T> {
    /// The factors of a domain, every one the same.
    pub const fn uniform(domain: Domain, factor: T) -> Self {
        match domain {
            Domain::Isoline => Self::Isoline(IsolineFactors::uniform(factor)),
            Domain::Triangle => Self::Triangle(TriangleFactors::uniform(factor)),
            Domain::Quad => Self::Quad(QuadFactors::uniform(factor)),
        }
    }

    /// The factors of a domain from a slice in the specification's order; `None` unless it has
    /// exactly [`Domain::factors`] elements.
    pub fn from_slice(domain: Domain, factors: &[T]) -> Option<Self> {
        (factors.len() == domain.factors()).then(|| Self::from_fn(domain, |i| factors[i]))
    }

    /// The factors in the specification's order: outer, then inside.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = T> + Clone + use<T> {
        let (array, count) = match *self {
            // What fills the array up is not taken.
            Self::Isoline(IsolineFactors { density, detail }) => {
                ([density, detail, detail, detail, detail, detail], 2)
            }
            Self::Triangle(factors) => {
                let [u0, v0, w0, inside] = factors.into();
                ([u0, v0, w0, inside, inside, inside], 4)
            }
            Self::Quad(factors) => (factors.into(), 6),
        };
        array.into_iter().take(count)
    }

    /// The outer factors in edge order; density and detail of an isoline patch.
    pub fn outer(&self) -> impl ExactSizeIterator<Item = T> + Clone + use<T> {
        self.iter().take(self.domain().outer_factors())
    }

    /// The inside factors: one of a triangle, along u and v of a quad, none of an isoline patch.
    pub fn inside(&self) -> impl ExactSizeIterator<Item = T> + Clone + use<T> {
        self.iter().skip(self.domain().outer_factors())
    }
}

/// One factor after each step of spec section 3.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ProcessedFactor {
    /// Bits of the binary32 factor after clamping (steps 2 and 5).
    pub clamped: u32,
    /// Bits of the binary32 factor after rounding (steps 3 and 5).
    pub rounded: u32,
    /// The factor as a 15.16 number (step 7).
    pub fixed: FixedFactor,
    /// The six numbers derived from it and its parity (step 6, spec section 4).
    pub context: FactorContext,
}

/// What factor processing makes of a patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProcessedPatch {
    /// An outer factor is zero, negative or NaN: no points, no indices.
    Culled,
    /// A triangle or quad whose factors all equal one: a single triangle or two.
    Minimum(PatchFactors<ProcessedFactor>),
    /// Every other patch.
    Regular(PatchFactors<ProcessedFactor>),
}

/// Which bounds and which parity rule apply to a factor.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    Edge,
    Inside,
}

impl ProcessedPatch {
    /// The processed factors; `None` if the patch is culled.
    #[must_use]
    pub const fn factors(&self) -> Option<&PatchFactors<ProcessedFactor>> {
        match self {
            Self::Culled => None,
            Self::Minimum(factors) | Self::Regular(factors) => Some(factors),
        }
    }
}

/// Processes the raw factors of one patch. Total: every bit pattern is valid.
///
/// Spec section 3, whose steps the functions below are named after.
#[must_use]
pub fn process(config: Config, raw: PatchFactors) -> ProcessedPatch {
    if is_culled(raw.outer()) {
        return ProcessedPatch::Culled;
    }
    if let PatchFactors::Isoline(raw) = raw {
        return process_isoline(config, raw);
    }
    let low = inside_low(config.partitioning, raw.iter());
    let edges = raw.domain().outer_factors();
    let mut number = 0;
    let factors = raw.map(|factor| {
        number += 1;
        if number <= edges {
            process_edge(config, factor)
        } else {
            process_inside(config, factor, low)
        }
    });
    minimum_or_regular(factors)
}

/// The density is always processed as integer.
fn process_isoline(config: Config, raw: IsolineFactors) -> ProcessedPatch {
    let integer = Config { partitioning: Partitioning::Integer, ..config };
    ProcessedPatch::Regular(PatchFactors::Isoline(IsolineFactors {
        density: process_edge(integer, raw.density),
        detail: process_edge(config, raw.detail),
    }))
}

/// Steps 2, 3, 6 and 7 for an outer or isoline factor.
fn process_edge(config: Config, raw: f32) -> ProcessedFactor {
    process_factor(config, Role::Edge, clamp(raw, config.partitioning.range()))
}

/// Steps 5, 6 and 7 for an inside factor, with the lower bound of step 4.
fn process_inside(config: Config, raw: f32, low: f32) -> ProcessedFactor {
    let (_, high) = config.partitioning.range();
    process_factor(config, Role::Inside, clamp(raw, (low, high)))
}

fn process_factor(config: Config, role: Role, clamped: f32) -> ProcessedFactor {
    let rounded = if config.partitioning.has_integer_factors() { ceil(clamped) } else { clamped };
    let fixed = FixedFactor::from_f32(rounded);
    let parity = parity(config.partitioning, role, fixed);
    ProcessedFactor {
        clamped: clamped.to_bits(),
        rounded: rounded.to_bits(),
        fixed,
        context: FactorContext::new(fixed, parity, config.split),
    }
}

/// Step 4: the lower bound of the inside factors. A NaN is not greater than anything.
fn inside_low(partitioning: Partitioning, mut all: impl Iterator<Item = f32>) -> f32 {
    const ONE_PLUS_2_POW_MINUS_17: f32 = f32::from_bits(0x3F80_0040);
    const ONE_PLUS_2_POW_MINUS_16: f32 = f32::from_bits(0x3F80_0080);
    let needs_picture_frame = partitioning == Partitioning::FractionalOdd
        && all.any(|factor| factor > ONE_PLUS_2_POW_MINUS_17);
    if needs_picture_frame { ONE_PLUS_2_POW_MINUS_16 } else { partitioning.range().0 }
}

/// Step 6. Integer factors have a zero fraction here.
fn parity(partitioning: Partitioning, role: Role, fixed: FixedFactor) -> Parity {
    match partitioning {
        Partitioning::FractionalOdd => Parity::Odd,
        Partitioning::FractionalEven => Parity::Even,
        Partitioning::Integer | Partitioning::Pow2 => {
            let odd = (fixed.to_bits() >> 16) & 1 == 1;
            let inside_one = role == Role::Inside && fixed == FixedFactor::ONE;
            if odd && !inside_one { Parity::Odd } else { Parity::Even }
        }
    }
}

/// Step 8.
fn minimum_or_regular(factors: PatchFactors<ProcessedFactor>) -> ProcessedPatch {
    if factors.iter().all(|factor| factor.fixed == FixedFactor::ONE) {
        ProcessedPatch::Minimum(factors)
    } else {
        ProcessedPatch::Regular(factors)
    }
}
