//! The levels about which a rule must be asked before it counts as held.
//!
//! ```text
//! numbers   each number of segments in each role of each domain and spacing
//! classes   each class of value in each role of each domain and spacing
//! pairs     each number on an edge with each number inside, of each domain of surfaces
//! ```
//!
//! A role is the position of a level. Not every rule can be asked about every level: an outer level
//! of 0 leaves nothing to judge but that the patch is discarded.

use super::levels::TessellationLevel;
use super::standard::Specification;
use crate::case::Case;
use tess_core::{Domain, Partitioning};

/// The largest number of segments.
const LARGEST: u8 = 64;

/// A number of segments or a class of value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Number(u8),
    Class(Class),
}

/// A class of values that a tessellator might treat alike. Units are 2^-16, to which levels are
/// converted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Class {
    /// Number in [`UNUSUAL`].
    Unusual(u8),
    /// The power of two up to which values from 1 to 64 are rounded down, and the number in
    /// [`FRACTIONS`].
    Fraction(u8, u8),
}

/// Values below 1 and from 64.
const UNUSUAL: [&str; 12] = [
    "NaN",
    "-infinity",
    "negative numbers",
    "negative denormals",
    "-0",
    "0",
    "denormals",
    "numbers below 1",
    "64",
    "64 to 128",
    "numbers above 128",
    "infinity",
];
const NAN: u8 = 0;
const ZERO: u8 = 5;
const DENORMAL: u8 = 6;

/// What is above an integer, or above a whole number of units.
const FRACTIONS: [&str; 10] = [
    "integers",
    "integers and one unit",
    "integers and up to half a unit",
    "integers less up to half a unit",
    "whole units",
    "up to 0.4 of a unit",
    "0.4 to 0.5 of a unit",
    "half a unit",
    "0.5 to 0.6 of a unit",
    "0.6 of a unit and more",
];
const BINADES: u8 = 6;

impl Class {
    /// The class of a value.
    pub(super) fn of(value: f32) -> Self {
        let bits = value.to_bits();
        let is_negative = bits >> 31 == 1;
        let unusual = |number| Self::Unusual(number);
        match bits & 0x7FFF_FFFF {
            0x7F80_0001.. => unusual(NAN),
            0x7F80_0000 => unusual(if is_negative { 1 } else { 11 }),
            0x0080_0000.. if is_negative => unusual(2),
            1.. if is_negative => unusual(3),
            0 => unusual(if is_negative { 4 } else { ZERO }),
            1..0x0080_0000 => unusual(DENORMAL),
            0x0080_0000..0x3F80_0000 => unusual(7),
            0x4280_0000 => unusual(8),
            0x4280_0001..=0x4300_0000 => unusual(9),
            0x4300_0001..0x7F80_0000 => unusual(10),
            // 1 to 64, which are below 2^6 and have 23 fraction bits below their binade.
            _ => Self::of_fraction(bits),
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "a binade from 0 to 5")]
    const fn of_fraction(bits: u32) -> Self {
        let binade = (bits >> 23) - 127;
        // The number in units of 2^-23, and how much it is above an integer and a whole unit.
        let scaled = ((bits & 0x7F_FFFF | 0x80_0000) as u64) << binade;
        let (above, rest) = (scaled & 0x7F_FFFF, scaled & 0x7F);
        let fraction = match (above, rest) {
            (0, _) => 0,
            (0x80, _) => 1,
            (..=0x40, _) => 2,
            (0x7F_FFC0.., _) => 3,
            (_, 0) => 4,
            // 0.4 is 51.2 of 128, and 0.6 is 76.8.
            (_, ..52) => 5,
            (_, ..64) => 6,
            (_, 64) => 7,
            (_, ..77) => 8,
            _ => 9,
        };
        Self::Fraction(binade as u8, fraction)
    }

    /// Every class, without those of which there is no number: from 16, numbers have at most eight
    /// values within a unit.
    fn all() -> impl Iterator<Item = Self> {
        let unusual = (0..12).map(Self::Unusual);
        let fractions = (0..BINADES).flat_map(|b| (0..10).map(move |f| Self::Fraction(b, f)));
        let exists = |class: &Self| !matches!(class, Self::Fraction(4.., 6 | 8));
        unusual.chain(fractions).filter(exists)
    }

    const fn discards(self) -> bool {
        matches!(self, Self::Unusual(..=ZERO))
    }

    fn name(self) -> String {
        match self {
            Self::Unusual(number) => UNUSUAL[usize::from(number)].to_owned(),
            Self::Fraction(binade, fraction) => {
                let (low, what) = (1 << binade, FRACTIONS[usize::from(fraction)]);
                format!("{what} from {low} to {}", 2 * low)
            }
        }
    }
}

impl Kind {
    /// The number of kinds.
    pub(super) const COUNT: usize = LARGEST as usize + 1 + UNUSUAL.len() + 60;

    /// Every kind, numbers first.
    pub(super) fn all() -> impl Iterator<Item = Self> {
        (1..=LARGEST).map(Self::Number).chain(Class::all().map(Self::Class))
    }

    /// Its place among all of them, below [`Self::COUNT`].
    pub(super) fn index(self) -> usize {
        let first = usize::from(LARGEST) + 1;
        match self {
            Self::Number(number) => usize::from(number),
            Self::Class(Class::Unusual(number)) => first + usize::from(number),
            Self::Class(Class::Fraction(binade, fraction)) => {
                first + UNUSUAL.len() + 10 * usize::from(binade) + usize::from(fraction)
            }
        }
    }

    /// The kinds of a level of a case: its number of segments, unless it is NaN, and its class.
    pub(super) fn of(case: &Case, position: usize) -> impl Iterator<Item = Self> {
        let outer = case.domain().outer_factors();
        let level = match position.checked_sub(outer) {
            None => TessellationLevel::outer(case, position),
            Some(inner) => {
                TessellationLevel::inner(case, inner).filter(|_| !super::levels::is_minimum(case))
            }
        };
        let number = level.and_then(|level| u8::try_from(level.segments()).ok());
        let value = case.factors.iter().nth(position).unwrap_or_default();
        number.map(Self::Number).into_iter().chain([Self::Class(Class::of(value))])
    }

    /// What it is called in a list of levels that were not asked.
    pub(super) fn name(self) -> String {
        match self {
            Self::Number(number) => number.to_string(),
            Self::Class(class) => class.name(),
        }
    }
}

/// A number of segments on an edge and one inside, along that edge. The triangles between them
/// depend on both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Pair {
    pub(super) outer: u8,
    pub(super) inside: u8,
}

impl Pair {
    /// The pair at an edge of a case; `None` for isolines, patches without an inside, and NaN.
    pub(super) fn of(case: &Case, edge: usize) -> Option<Self> {
        let axis = match case.domain() {
            _ if super::levels::is_minimum(case) => return None,
            Domain::Isoline => return None,
            Domain::Triangle => 0,
            // The edges u0 and u1 run along v.
            Domain::Quad => 1 - edge % 2,
        };
        let [outer, inside] =
            [TessellationLevel::outer(case, edge)?, TessellationLevel::inner(case, axis)?]
                .map(|level| u8::try_from(level.segments()).ok());
        Some(Self { outer: outer?, inside: inside? })
    }

    /// Every pair. An inside has at least two segments.
    pub(super) fn all() -> impl Iterator<Item = Self> {
        let with = |outer| (2..=LARGEST).map(move |inside| Self { outer, inside });
        (1..=LARGEST).flat_map(with)
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Classes {
    No,
    /// Those of which a patch has primitives.
    Drawn,
    All,
}

/// The levels that a rule is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Scope {
    numbers: bool,
    classes: Classes,
    outer: bool,
    inner: bool,
    isolines: bool,
    surfaces: bool,
    details: bool,
    pairs: bool,
    /// Only fractional spacings, and only numbers from this one.
    fractional: Option<u8>,
}

impl Scope {
    /// Every number in every role.
    pub(super) const fn numbers() -> Self {
        Self {
            numbers: true,
            classes: Classes::No,
            outer: true,
            inner: true,
            isolines: true,
            surfaces: true,
            details: true,
            pairs: false,
            fractional: None,
        }
    }

    /// Every class in every role, also those that discard; no numbers.
    pub(super) const fn values() -> Self {
        Self { numbers: false, classes: Classes::All, ..Self::numbers() }
    }

    pub(super) const fn and_classes(self) -> Self {
        Self { classes: Classes::Drawn, ..self }
    }

    pub(super) const fn and_pairs(self) -> Self {
        Self { pairs: true, ..self }
    }

    pub(super) const fn outer(self) -> Self {
        Self { inner: false, ..self }
    }

    pub(super) const fn inner(self) -> Self {
        Self { outer: false, ..self }
    }

    pub(super) const fn of_surfaces(self) -> Self {
        Self { isolines: false, ..self }
    }

    pub(super) const fn of_isolines(self) -> Self {
        Self { surfaces: false, ..self }
    }

    pub(super) const fn without_details(self) -> Self {
        Self { details: false, ..self }
    }

    pub(super) const fn fractional(self, least: u8) -> Self {
        Self { fractional: Some(least), ..self }
    }

    /// Whether a position of a domain is one of its roles.
    pub(super) fn has(self, domain: Domain, position: usize) -> bool {
        let is_isoline = domain == Domain::Isoline;
        let is_inner = position >= domain.outer_factors();
        (if is_isoline { self.isolines } else { self.surfaces })
            && (if is_inner { self.inner } else { self.outer })
            && (self.details || !is_isoline || position == 0)
            && (self.fractional.is_none() || !is_isoline || position == 1)
    }

    /// Whether the rule must be asked about every [`Pair`].
    pub(super) const fn wants_pairs(self) -> bool {
        self.pairs
    }

    /// Whether the rule must be asked about a kind of level in a role.
    pub(super) fn wants(
        self,
        specification: Specification,
        (domain, spacing, position): (Domain, Partitioning, usize),
        kind: Kind,
    ) -> bool {
        let is_exact = specification == Specification::D3d11;
        let is_pow2 = spacing == Partitioning::Pow2;
        if !self.has(domain, position)
            || (self.fractional.is_some() && spacing.has_integer_factors())
            || (is_pow2 && !is_exact)
        {
            return false;
        }
        let is_inner = position >= domain.outer_factors();
        match kind {
            Kind::Number(n) if is_pow2 => {
                self.numbers && n.is_power_of_two() && !(is_inner && n == 1)
            }
            Kind::Number(n) => self.wants_number(domain, spacing, position, n),
            Kind::Class(_) if is_pow2 => false,
            Kind::Class(class) => match self.classes {
                Classes::No => false,
                Classes::All => is_inner || class != Class::Unusual(DENORMAL),
                // Vulkan does not say what an inner level is that is NaN.
                Classes::Drawn if is_inner => is_exact || class != Class::Unusual(NAN),
                Classes::Drawn => !class.discards() && class != Class::Unusual(DENORMAL),
            },
        }
    }

    fn wants_number(self, domain: Domain, spacing: Partitioning, position: usize, n: u8) -> bool {
        let is_density = domain == Domain::Isoline && position == 0;
        let is_inner = position >= domain.outer_factors();
        let is_one = match spacing {
            _ if is_density => true,
            Partitioning::Integer | Partitioning::Pow2 => true,
            Partitioning::FractionalOdd => n % 2 == 1,
            Partitioning::FractionalEven => n.is_multiple_of(2),
        };
        // An inside has at least two columns, because a vertex is between them.
        self.numbers && is_one && !(is_inner && n == 1) && n >= self.fractional.unwrap_or(1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Edges u0 and u1 run along v, so the second inner level is theirs.
    #[test]
    fn pairs_are_of_the_level_along_the_edge() {
        let levels = "40800000 40a00000 40400000 40000000 40a00000 40c00000";
        let line = format!("case quad integer triangle_cw ruler {levels}");
        let case: Case = line.parse().expect("a case");
        let pairs = [0, 1, 2, 3].map(|edge| Pair::of(&case, edge));
        let pair = |outer, inside| Some(Pair { outer, inside });
        assert_eq!(pairs, [pair(4, 6), pair(5, 5), pair(3, 6), pair(2, 5)]);
    }

    /// Both ends of each class.
    #[test]
    fn values_have_classes() {
        let named = |bits: u32| Class::of(f32::from_bits(bits)).name();
        for (bits, name) in [
            (0x7F80_0001, "NaN"),
            (0xFFFF_FFFF, "NaN"),
            (0xFF80_0000, "-infinity"),
            (0xFF7F_FFFF, "negative numbers"),
            (0x8080_0000, "negative numbers"),
            (0x807F_FFFF, "negative denormals"),
            (0x8000_0001, "negative denormals"),
            (0x8000_0000, "-0"),
            (0, "0"),
            (1, "denormals"),
            (0x007F_FFFF, "denormals"),
            (0x0080_0000, "numbers below 1"),
            (0x3F7F_FFFF, "numbers below 1"),
            (0x3F80_0000, "integers from 1 to 2"),
            (0x3F80_0001, "integers and up to half a unit from 1 to 2"),
            (0x3F80_0040, "integers and up to half a unit from 1 to 2"),
            (0x3F80_0041, "0.5 to 0.6 of a unit from 1 to 2"),
            (0x3F80_0080, "integers and one unit from 1 to 2"),
            (0x3F80_0100, "whole units from 1 to 2"),
            (0x3F80_0133, "up to 0.4 of a unit from 1 to 2"),
            (0x3F80_0134, "0.4 to 0.5 of a unit from 1 to 2"),
            (0x3F80_0140, "half a unit from 1 to 2"),
            (0x3F80_014C, "0.5 to 0.6 of a unit from 1 to 2"),
            (0x3F80_014D, "0.6 of a unit and more from 1 to 2"),
            (0x3FFF_FFC0, "integers less up to half a unit from 1 to 2"),
            (0x3FFF_FFFF, "integers less up to half a unit from 1 to 2"),
            (0x427F_FFFF, "integers less up to half a unit from 32 to 64"),
            (0x4280_0000, "64"),
            (0x4280_0001, "64 to 128"),
            (0x4300_0000, "64 to 128"),
            (0x4300_0001, "numbers above 128"),
            (0x7F7F_FFFF, "numbers above 128"),
            (0x7F80_0000, "infinity"),
        ] {
            assert_eq!(named(bits), name, "{bits:08x}");
        }
    }

    /// No two kinds share a counter, and each has one.
    #[test]
    fn kinds_have_places() {
        let mut places: Vec<_> = Kind::all().map(Kind::index).collect();
        assert_eq!(places.len(), 64 + 12 + 60 - 4, "numbers, unusual values and fractions");
        places.sort_unstable();
        places.dedup();
        assert_eq!(places.len(), Kind::all().count(), "all different");
        assert!(places.iter().all(|place| *place < Kind::COUNT), "{places:?}");
    }
}
