//! The words of the specification for domains, partitionings, outputs and split orders.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use tess_core::{Domain, OutputPrimitive, Partitioning, SplitOrder};

/// Something that has a name on the command line and in vector files.
pub trait Named: Copy + PartialEq + Send + Sync + 'static {
    /// Every value with its name, in the order of the specification.
    const NAMES: &'static [(&'static str, Self)];

    /// The name.
    #[must_use]
    fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, value)| *value == self).map_or("", |(name, _)| name)
    }
}

impl Named for Domain {
    const NAMES: &'static [(&'static str, Self)] =
        &[("isoline", Self::Isoline), ("tri", Self::Triangle), ("quad", Self::Quad)];
}

impl Named for Partitioning {
    const NAMES: &'static [(&'static str, Self)] = &[
        ("integer", Self::Integer),
        ("pow2", Self::Pow2),
        ("fractional_odd", Self::FractionalOdd),
        ("fractional_even", Self::FractionalEven),
    ];
}

impl Named for OutputPrimitive {
    const NAMES: &'static [(&'static str, Self)] = &[
        ("point", Self::Point),
        ("line", Self::Line),
        ("triangle_cw", Self::TriangleCw),
        ("triangle_ccw", Self::TriangleCcw),
    ];
}

impl Named for SplitOrder {
    const NAMES: &'static [(&'static str, Self)] =
        &[("ruler", Self::Ruler), ("center", Self::Center)];
}

/// A parser of command-line values that takes the names of `T` and lists them in help and errors.
#[must_use]
pub fn parser<T: Named>() -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(T::NAMES.iter().map(|(name, _)| *name)).try_map(|name| {
        let found = T::NAMES.iter().find(|(known, _)| *known == name);
        found.map(|(_, value)| *value).ok_or("not one of the listed names")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_has_a_name() {
        assert!(Domain::ALL.iter().all(|domain| !domain.name().is_empty()), "domains");
        assert!(Partitioning::ALL.iter().all(|p| !p.name().is_empty()), "partitionings");
        assert!(OutputPrimitive::ALL.iter().all(|o| !o.name().is_empty()), "outputs");
        assert!(SplitOrder::ALL.iter().all(|split| !split.name().is_empty()), "split orders");
    }
}
