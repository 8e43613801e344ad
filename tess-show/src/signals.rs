//! The signals of a circuit, by the stage that makes them, and their values in the model.
//!
//! ```
//! use tess_show::{Part, compare_signals};
//!
//! let case = "case tri integer triangle_cw ruler 40000000 40000000 40000000 40000000".parse()?;
//! let seen = [("u", 0), ("v", 0x8001)];
//! let wrong = compare_signals(&case, Part::Point(1), &seen)?;
//! assert_eq!(wrong[0].to_string(), "v of stage points: observed 0x8001, expected 0x8000");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::part::Part;
use std::fmt;
use tess_core::ProcessedFactor;
use tess_verify::Case;
use tess_verify::quoted;

/// A signal: a value of a stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Signal {
    /// The stage of the specification.
    pub stage: &'static str,
    /// Its name in that stage.
    #[cfg_attr(feature = "serde", serde(rename = "signal"))]
    pub name: &'static str,
}

const fn signal(stage: &'static str, name: &'static str) -> Signal {
    Signal { stage, name }
}

// The signals of each part, in the order of `values`.
const OF_PATCH: [Signal; 2] = [signal("counts", "points"), signal("counts", "primitives")];
const OF_FACTOR: [Signal; 9] = [
    signal("factors", "culled"),
    signal("factors", "fixed"),
    signal("factors", "odd"),
    signal("factor_context", "fraction"),
    signal("factor_context", "half_points"),
    signal("factor_context", "points"),
    signal("factor_context", "split"),
    signal("factor_context", "inv_floor"),
    signal("factor_context", "inv_ceil"),
];
const OF_POINT: [Signal; 4] = [
    signal("points", "valid"),
    signal("points", "u"),
    signal("points", "v"),
    signal("points", "last"),
];
const OF_PRIMITIVE: [Signal; 6] = [
    signal("connect", "valid"),
    signal("connect", "size"),
    signal("connect", "i0"),
    signal("connect", "i1"),
    signal("connect", "i2"),
    signal("connect", "last"),
];

impl Part {
    /// The signals of a part of this kind, whatever its number, in an order in which each feeds
    /// those after it.
    #[must_use]
    pub const fn signals(self) -> &'static [Signal] {
        match self {
            Self::Patch => &OF_PATCH,
            Self::Factor(_) => &OF_FACTOR,
            Self::Point(_) => &OF_POINT,
            Self::Primitive(_) => &OF_PRIMITIVE,
        }
    }
}

/// A signal that differs from the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct SignalDifference {
    /// The signal.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub signal: Signal,
    /// The circuit's value.
    pub observed: u32,
    /// The model's value.
    pub expected: u32,
}

impl fmt::Display for SignalDifference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { signal: Signal { stage, name }, observed, expected } = self;
        write!(f, "{name} of stage {stage}: observed {observed:#x}, expected {expected:#x}")
    }
}

/// Signals that cannot be compared.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SignalError {
    /// The patch has no such factor, point or primitive.
    #[error("there is no {0}")]
    NoSuchPart(Part),
    /// No signal of this part has this name; with the names that exist.
    #[error("no signal {} here, expected one of: {}", quoted(.0), .1.join(", "))]
    NoSuchSignal(String, Vec<&'static str>),
}

/// The signals that differ from the model, in an order in which each feeds those after it.
/// Differences that follow from the first one are included.
///
/// # Errors
/// [`SignalError`]. The only signal of a culled patch's factors is `culled`.
pub fn compare_signals(
    case: &Case,
    part: Part,
    observed: &[(&str, u32)],
) -> Result<Vec<SignalDifference>, SignalError> {
    let values = values(case, part).ok_or(SignalError::NoSuchPart(part))?;
    let expected = || part.signals().iter().zip(&values);
    let is_known = |name: &str| expected().any(|(signal, _)| signal.name == name);
    if let Some((name, _)) = observed.iter().find(|(name, _)| !is_known(name)) {
        let known = expected().map(|(signal, _)| signal.name).collect();
        return Err(SignalError::NoSuchSignal((*name).to_owned(), known));
    }
    let differences = expected().flat_map(|(&signal, &expected)| {
        let seen =
            observed.iter().filter(move |(name, value)| *name == signal.name && *value != expected);
        seen.map(move |&(_, observed)| SignalDifference { signal, observed, expected })
    });
    Ok(differences.collect())
}

/// The model's value of each signal of a part, in the order of [`Part::signals`]; only of the first
/// one, `culled`, for a factor of a culled patch. `None` if the patch has no such part.
fn values(case: &Case, part: Part) -> Option<Vec<u32>> {
    let patch = case.patch();
    let counts = patch.counts();
    Some(match part {
        Part::Patch => vec![counts.points, counts.primitives],
        Part::Factor(k) => {
            let number = usize::try_from(k).ok().filter(|k| *k < case.domain().factors())?;
            match patch.processed().factors() {
                None => vec![1],
                Some(factors) => of_factor(&factors.iter().nth(number)?),
            }
        }
        Part::Point(i) => {
            let point = patch.point(i)?;
            let is_last = i + 1 == counts.points;
            vec![1, point.u.to_bits(), point.v.to_bits(), is_last.into()]
        }
        Part::Primitive(t) => {
            let primitive = patch.primitive(t)?;
            let index = |i: usize| primitive.indices().get(i).copied().unwrap_or(0);
            let is_last = t + 1 == counts.primitives;
            vec![1, primitive.size(), index(0), index(1), index(2), is_last.into()]
        }
    })
}

fn of_factor(factor: &ProcessedFactor) -> Vec<u32> {
    let context = &factor.context;
    vec![
        0,
        factor.fixed.to_bits(),
        context.parity.odd(),
        context.fraction,
        context.half_points,
        context.points,
        context.split_position,
        context.inv_floor,
        context.inv_ceil,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn case(line: &str) -> Case {
        line.parse().expect("a case")
    }

    /// The values of a fault-free circuit do not differ; a fault in any single signal is seen.
    #[test]
    fn every_signal_is_compared() {
        let case =
            case("case tri fractional_odd triangle_cw ruler 40200000 40400000 3f800000 40500000");
        for part in [Part::Patch, Part::Factor(3), Part::Point(7), Part::Primitive(0)] {
            let right = values(&case, part).expect("the part");
            assert_eq!(right.len(), part.signals().len(), "{part:?}: one value for each signal");
            let names = part.signals().iter().map(|signal| signal.name);
            let observed: Vec<_> = names.zip(right.iter().copied()).collect();
            assert_eq!(compare_signals(&case, part, &observed), Ok(vec![]), "{part:?}");
            for (i, (&signal, expected)) in part.signals().iter().zip(right).enumerate() {
                let mut wrong = observed.clone();
                wrong[i].1 ^= 1;
                let difference = SignalDifference { signal, observed: expected ^ 1, expected };
                assert_eq!(
                    compare_signals(&case, part, &wrong),
                    Ok(vec![difference]),
                    "{}",
                    signal.name
                );
            }
        }
    }

    #[test]
    fn what_is_not_there_is_refused() {
        let case = case(
            "case quad integer line ruler 3f800000 3f800000 3f800000 3f800000 40000000 40000000",
        );
        let points = case.patch().counts().points;
        for part in [Part::Factor(6), Part::Point(points), Part::Primitive(points - 1)] {
            assert_eq!(
                compare_signals(&case, part, &[]),
                Err(SignalError::NoSuchPart(part)),
                "{part:?}"
            );
        }
        let error = compare_signals(&case, Part::Patch, &[("u", 0)]).expect_err("no such signal");
        assert_eq!(error.to_string(), "no signal `u` here, expected one of: points, primitives");
        let culled = self::case("case isoline integer line ruler 00000000 3f800000");
        assert_eq!(
            compare_signals(&culled, Part::Factor(1), &[("culled", 1)]),
            Ok(vec![]),
            "culled"
        );
        assert!(
            compare_signals(&culled, Part::Factor(1), &[("fixed", 0)]).is_err(),
            "has nothing else"
        );
        let part = Part::Factor(2);
        assert_eq!(
            compare_signals(&culled, part, &[("culled", 1)]),
            Err(SignalError::NoSuchPart(part))
        );
    }

    #[test]
    fn the_last_point_and_primitive_are_marked() {
        let case = case("case tri integer line ruler 40400000 40400000 40400000 40400000");
        let counts = case.patch().counts();
        let last =
            |part| compare_signals(&case, part, &[("last", 2)]).expect("the part")[0].expected;
        for i in 0..counts.points {
            assert_eq!(last(Part::Point(i)), u32::from(i == counts.points - 1), "point {i}");
        }
        for t in 0..counts.primitives {
            assert_eq!(last(Part::Primitive(t)), u32::from(t == counts.primitives - 1), "{t}");
        }
    }
}
