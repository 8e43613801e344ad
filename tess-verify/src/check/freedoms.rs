//! Freedoms that the specification leaves to a device, and that a comparison can grant (spec
//! section 13).

use crate::case::Case;
use crate::strength::{Conversion, Denormals, ListOrder, Strength};
use std::collections::BTreeSet;
use tess_core::{DomainPoint, Tessellation};

/// The largest factor of the model.
const LARGEST: u32 = 64;

/// Freedoms that a device takes together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Freedoms {
    /// Positive denormal outer factors are flushed to zero, which culls the patch.
    pub flush: bool,
    /// Factors are converted to fixed point within 0.6 units in the last place.
    pub conversion: bool,
    /// Primitives and points come in another order.
    pub order: bool,
    /// Factors above the model's largest are not clamped to it; a device need not do so. It is
    /// taken alone.
    pub clamping: bool,
}

impl Freedoms {
    /// Every combination; those of fewer freedoms come first.
    #[must_use]
    pub fn combinations() -> Vec<Self> {
        let bit = |number: u32, bit: u32| number >> bit & 1 == 1;
        let combined = (1..8).map(|number| Self {
            flush: bit(number, 0),
            conversion: bit(number, 1),
            order: bit(number, 2),
            clamping: false,
        });
        let clamping = Self { clamping: true, ..Self::default() };
        let mut all: Vec<Self> = combined.chain([clamping]).collect();
        all.sort_by_key(|freedoms| freedoms.parts().count());
        all
    }

    /// For each freedom: its name, the option of `tess check` that grants it, and its words.
    fn parts(self) -> impl Iterator<Item = [&'static str; 3]> {
        let flush = "positive denormal outer factors are flushed to zero, which culls";
        let conversion = "factors are converted to fixed point within 0.6 ulp";
        let order = "primitives or points come in another order, and are the model's";
        let clamping = "factors above 64 are not clamped to the model's range";
        [
            (self.flush, ["flush", "--denormals flush", flush]),
            (self.conversion, ["conversion", "--conversion 0.6ulp", conversion]),
            (self.order, ["order", "--order any", order]),
            (self.clamping, ["clamping", "", clamping]),
        ]
        .into_iter()
        .filter_map(|(is_taken, part)| is_taken.then_some(part))
    }

    fn joined(self, part: usize, by: &str) -> String {
        self.parts().map(|parts| parts[part]).collect::<Vec<_>>().join(by)
    }

    /// A name, such as `flush_and_conversion`.
    #[must_use]
    pub fn name(self) -> String {
        self.joined(0, "_and_")
    }

    /// The options of `tess check` with which such a device counts as equal; empty if there are
    /// none.
    #[must_use]
    pub fn options(self) -> String {
        self.joined(1, " ")
    }

    /// A description of the device's way.
    #[must_use]
    pub fn words(self) -> String {
        self.joined(2, ", and ")
    }

    /// Whether all of these are among the others, which are more.
    #[must_use]
    pub fn are_part_of(self, others: Self) -> bool {
        let own: Vec<_> = self.parts().collect();
        own.len() < others.parts().count()
            && own.iter().all(|part| others.parts().any(|other| other == *part))
    }

    /// Whether these, added to a strength, explain an output that differs at it. `max_level` is the
    /// largest factor that the device supports; pass 64 if it is unknown.
    #[must_use]
    pub fn explain(
        self,
        case: &Case,
        observed: &Tessellation,
        strength: Strength,
        max_level: u32,
    ) -> bool {
        if self.clamping {
            let is_larger = case.factors.iter().any(|factor| factor > 64.0);
            return max_level > LARGEST && is_larger && has_more_places(case, observed);
        }
        let mut weaker = strength;
        if self.flush {
            weaker.denormals = Denormals::Flush;
        }
        if self.conversion {
            weaker.conversion = Conversion::Within06Ulp;
        }
        if self.order {
            weaker.order = ListOrder::Any;
        }
        weaker != strength && weaker.accepts(case, observed)
    }
}

/// Whether the output has more distinct points than the model's, as if its factors were larger.
fn has_more_places(case: &Case, observed: &Tessellation) -> bool {
    let places = |output: &Tessellation| {
        let place = |point: &DomainPoint| (point.u.to_bits(), point.v.to_bits());
        output.points.iter().map(place).collect::<BTreeSet<_>>().len()
    };
    places(observed) > places(&case.patch().tessellate())
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};

    /// The outputs are the model's for factor 100, which it clamps to 64: as they are, or with one
    /// more point.
    #[test]
    fn larger_factors_explain_more_points() {
        let case = |factor: f32| {
            let config = Config::new(Partitioning::Integer, OutputPrimitive::Point);
            Case { config, factors: PatchFactors::uniform(Domain::Isoline, factor) }
        };
        let model = case(100.0).patch().tessellate();
        let with = |point| {
            let mut output = model.clone();
            output.points.push(point);
            output
        };
        let finer = with(DomainPoint::from_bits(0x123, 0x456));
        let strength = Strength::default();
        let clamping = Freedoms { clamping: true, ..Freedoms::default() };
        let explains = |factor: f32, output: &Tessellation, max_level: u32| {
            clamping.explain(&case(factor), output, strength, max_level)
        };
        assert!(explains(100.0, &finer, 128), "one place more");
        assert!(!explains(100.0, &model, 128), "as many places");
        assert!(!explains(64.0, &finer, 128), "no factor above 64");
        assert!(!explains(100.0, &finer, 64), "a device that takes 64 at most");
        let repeated = with(model.points[0]);
        assert!(!explains(100.0, &repeated, 128), "a place twice");
    }

    /// A combination is named only where each of its freedoms is needed, so parts come first.
    #[test]
    fn combinations_come_after_their_parts() {
        let all = Freedoms::combinations();
        let names: Vec<String> = all.iter().map(|freedoms| freedoms.name()).collect();
        assert_eq!(names.len(), 8, "{names:?}");
        assert!(names.contains(&"flush_and_conversion".to_owned()), "{names:?}");
        for (i, one) in all.iter().enumerate() {
            let parts = all.iter().filter(|other| other.are_part_of(*one));
            assert!(parts.clone().all(|part| all[..i].contains(part)), "{}", one.name());
            assert_eq!(parts.count(), [0, 0, 2, 6][one.parts().count()], "{}", one.name());
        }
    }
}
