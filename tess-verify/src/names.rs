//! The names that vector files and the command line use.

use crate::quote::quoted;
use tess_core::prepare::{QuadAxes, Reduction};
use tess_core::{Domain, OutputPrimitive, Parity, Partitioning, Patch, ProcessedPatch, SplitOrder};

/// A choice whose values have names, such as a domain.
pub trait Named: Copy + PartialEq + 'static {
    /// The name of the choice, such as `domain`.
    const WHAT: &'static str;
    /// Every value with its name, in the order of the specification.
    const NAMES: &'static [(&'static str, Self)];

    /// The name of a value.
    #[must_use]
    fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, value)| *value == self).map_or("", |(name, _)| name)
    }

    /// The value that a name stands for.
    ///
    /// # Errors
    /// [`UnknownNameError`], which lists the known names.
    fn from_name(name: &str) -> Result<Self, UnknownNameError> {
        let found = Self::NAMES.iter().find(|(known, _)| *known == name);
        found.map(|(_, value)| *value).ok_or_else(|| UnknownNameError {
            what: Self::WHAT,
            name: name.into(),
            known: Self::NAMES.iter().map(|(known, _)| *known).collect(),
        })
    }
}

/// A name that no value has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown {what} {}, expected one of: {}", quoted(name), known.join(", "))]
#[non_exhaustive]
pub struct UnknownNameError {
    /// The name of the choice.
    pub what: &'static str,
    /// The unknown name.
    pub name: String,
    /// The known names.
    pub known: Vec<&'static str>,
}

/// The path that a patch takes: `culled`, `minimum` or `regular`.
#[must_use]
pub const fn way_of(patch: &Patch) -> &'static str {
    match patch.processed() {
        ProcessedPatch::Culled => "culled",
        ProcessedPatch::Minimum(_) => "minimum",
        ProcessedPatch::Regular(_) => "regular",
    }
}

/// Defines an enum with a name for each value, or gives names to one that is defined elsewhere.
macro_rules! named {
    ($(#[$of_type:meta])* $visible:vis enum $type:ident: $what:literal {
        $($(#[$of_value:meta])* $value:ident = $name:literal,)*
    }) => {
        $(#[$of_type])*
        $visible enum $type { $($(#[$of_value])* $value,)* }

        $crate::names::named!($type: $what { $($value = $name,)* });
    };
    ($type:ident: $what:literal { $($value:ident = $name:literal,)* }) => {
        impl $crate::names::Named for $type {
            const WHAT: &'static str = $what;
            const NAMES: &'static [(&'static str, Self)] = &[$(($name, Self::$value)),*];
        }
    };
}
pub(crate) use named;

named!(Domain: "domain" { Isoline = "isoline", Triangle = "tri", Quad = "quad", });
named!(Partitioning: "partitioning" {
    Integer = "integer",
    Pow2 = "pow2",
    FractionalOdd = "fractional_odd",
    FractionalEven = "fractional_even",
});
named!(OutputPrimitive: "output primitive" {
    Point = "point",
    Line = "line",
    TriangleCw = "triangle_cw",
    TriangleCcw = "triangle_ccw",
});
named!(SplitOrder: "split order" { Ruler = "ruler", Centre = "center", });
named!(Parity: "parity" { Even = "even", Odd = "odd", });
named!(Reduction: "reduction" { Min = "min", Max = "max", Average = "average", });
named!(QuadAxes: "axis" { One = "1", Two = "2", });

#[cfg(test)]
mod tests {
    use super::*;

    fn round_trip<T: Named + std::fmt::Debug>() {
        assert!(!T::NAMES.is_empty(), "{} has names", T::WHAT);
        for &(name, value) in T::NAMES {
            assert_eq!(T::from_name(name).ok(), Some(value), "{name}");
            assert_eq!(value.name(), name, "{value:?}");
        }
    }

    #[test]
    fn names_and_values_correspond() {
        round_trip::<Domain>();
        round_trip::<Partitioning>();
        round_trip::<OutputPrimitive>();
        round_trip::<SplitOrder>();
        round_trip::<Parity>();
        round_trip::<Reduction>();
        round_trip::<QuadAxes>();
    }

    #[test]
    fn unknown_names_say_what_would_be_right() {
        let error = SplitOrder::from_name("Ruler").expect_err("case matters").to_string();
        assert_eq!(error, "unknown split order `Ruler`, expected one of: ruler, center");
    }
}
