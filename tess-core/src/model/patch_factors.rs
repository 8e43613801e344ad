//! The raw factors of each domain, and their order (spec section 1).

use crate::model::state::Domain;

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

/// Defines the conversions between a domain's factors and an array in the specification's order
/// (section 1). The list of fields is the only definition of that order.
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

        impl<T> $factors<T> {
            /// The factors with `f` applied to each, in the specification's order.
            pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> $factors<U> {
                $factors { $($field: f(self.$field)),* }
            }
        }

        impl<T: Copy> $factors<T> {
            /// The names of the fields, in the specification's order.
            pub const NAMES: [&'static str; $count] = [$(stringify!($field)),*];

            /// Factors that all equal `factor`.
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

    /// The names of the factors in the specification's order: the fields of the domain's structure.
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

    /// The factors of a domain: factor `i` in the specification's order is `factor(i)`.
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
            Self::Isoline(factors) => PatchFactors::Isoline(factors.map(f)),
            Self::Triangle(factors) => PatchFactors::Triangle(factors.map(f)),
            Self::Quad(factors) => PatchFactors::Quad(factors.map(f)),
        }
    }
}

impl<T: Copy> PatchFactors<T> {
    /// The factors of a domain, all equal to `factor`.
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
            // `take` drops the padding.
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

    /// The inside factors: one for a triangle, two for a quad (along u, along v), none for an
    /// isoline patch.
    pub fn inside(&self) -> impl ExactSizeIterator<Item = T> + Clone + use<T> {
        self.iter().skip(self.domain().outer_factors())
    }
}
