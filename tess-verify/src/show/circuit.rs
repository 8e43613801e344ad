//! The signals of the circuit in `rtl/`: the stage and module that drive each, and its value in the
//! model.
//!
//! ```
//! use tess_verify::show::{Part, compare_signals};
//!
//! let case = "case tri integer triangle_cw ruler 40000000 40000000 40000000 40000000".parse()?;
//! let seen = [("u", 0), ("v", 0x8001)];
//! let wrong = compare_signals(&case, Part::Point(1), &seen)?;
//! let text = "v of stage points (module tess_points): observed 0x8001, expected 0x8000";
//! assert_eq!(wrong[0].to_string(), text);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::case::Case;
use crate::quote::quoted;
use std::fmt;
use tess_core::ProcessedFactor;

/// The part of a patch that a signal describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Part {
    /// The whole patch: its counts.
    Patch,
    /// A factor, by its number in the order of the specification.
    Factor(u32),
    /// A domain point.
    Point(u32),
    /// A primitive.
    Primitive(u32),
}

/// For example `factor 3`.
impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Patch => f.write_str("patch"),
            Self::Factor(k) => write!(f, "factor {k}"),
            Self::Point(i) => write!(f, "point {i}"),
            Self::Primitive(t) => write!(f, "primitive {t}"),
        }
    }
}

/// A signal of the circuit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Signal {
    /// The stage, as test benches name it.
    stage: &'static str,
    /// Its name in that stage.
    name: &'static str,
    /// The module that drives it.
    module: &'static str,
}

const fn signal(stage: &'static str, name: &'static str, module: &'static str) -> Signal {
    Signal { stage, name, module }
}

// The signals of each part are in order: each one feeds those after it. `rtl/stages.tsv` has the
// same list for the circuit's test benches; a test compares the two.
const CULLED: Signal = signal("factors", "culled", "tess_factors");
const FIXED: Signal = signal("factors", "fixed", "tess_factor");
const ODD: Signal = signal("factors", "odd", "tess_factor");
const FRACTION: Signal = signal("factor_context", "fraction", "tess_factor_context");
const HALF_POINTS: Signal = signal("factor_context", "half_points", "tess_factor_context");
const FACTOR_POINTS: Signal = signal("factor_context", "points", "tess_factor_context");
const SPLIT: Signal = signal("factor_context", "split", "tess_factor_context");
const INV_FLOOR: Signal = signal("factor_context", "inv_floor", "tess_factor_context");
const INV_CEIL: Signal = signal("factor_context", "inv_ceil", "tess_factor_context");
const POINTS: Signal = signal("counts", "points", "tess_factors");
const PRIMITIVES: Signal = signal("counts", "primitives", "tess_factors");
const POINT_VALID: Signal = signal("points", "valid", "tess_points");
const U: Signal = signal("points", "u", "tess_points");
const V: Signal = signal("points", "v", "tess_points");
const LAST_POINT: Signal = signal("points", "last", "tess_points");
const PRIMITIVE_VALID: Signal = signal("connect", "valid", "tess_connect");
const SIZE: Signal = signal("connect", "size", "tess_connect");
const I0: Signal = signal("connect", "i0", "tess_connect");
const I1: Signal = signal("connect", "i1", "tess_connect");
const I2: Signal = signal("connect", "i2", "tess_connect");
const LAST_PRIMITIVE: Signal = signal("connect", "last", "tess_connect");

/// A signal that differs from the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct SignalDifference {
    /// The stage, as test benches name it.
    pub stage: &'static str,
    /// Its name.
    #[cfg_attr(feature = "serde", serde(rename = "signal"))]
    pub name: &'static str,
    /// The module of `rtl/` that drives it; its file has the same name.
    pub module: &'static str,
    /// The circuit's value.
    pub observed: u32,
    /// The model's value.
    pub expected: u32,
}

impl fmt::Display for SignalDifference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { stage, name, module, observed, expected } = self;
        write!(
            f,
            "{name} of stage {stage} (module {module}): observed {observed:#x}, expected {expected:#x}"
        )
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
    let expected = values(case, part).ok_or(SignalError::NoSuchPart(part))?;
    let is_known = |name: &str| expected.iter().any(|(signal, _)| signal.name == name);
    if let Some((name, _)) = observed.iter().find(|(name, _)| !is_known(name)) {
        let known = expected.iter().map(|(signal, _)| signal.name).collect();
        return Err(SignalError::NoSuchSignal((*name).to_owned(), known));
    }
    let differences = expected.into_iter().flat_map(|(signal, expected)| {
        let seen =
            observed.iter().filter(move |(name, value)| *name == signal.name && *value != expected);
        let Signal { stage, name, module } = signal;
        seen.map(move |&(_, observed)| SignalDifference { stage, name, module, observed, expected })
    });
    Ok(differences.collect())
}

/// The model's value of each signal of a part; `None` if the patch has no such part.
fn values(case: &Case, part: Part) -> Option<Vec<(Signal, u32)>> {
    let patch = case.patch();
    let counts = patch.counts();
    Some(match part {
        Part::Patch => vec![(POINTS, counts.points), (PRIMITIVES, counts.primitives)],
        Part::Factor(k) => {
            let number = usize::try_from(k).ok().filter(|k| *k < case.domain().factors())?;
            match patch.processed().factors() {
                None => vec![(CULLED, 1)],
                Some(factors) => of_factor(&factors.iter().nth(number)?),
            }
        }
        Part::Point(i) => {
            let point = patch.point(i)?;
            let is_last = i + 1 == counts.points;
            vec![
                (POINT_VALID, 1),
                (U, point.u.to_bits()),
                (V, point.v.to_bits()),
                (LAST_POINT, is_last.into()),
            ]
        }
        Part::Primitive(t) => {
            let primitive = patch.primitive(t)?;
            let index = |i: usize| primitive.indices().get(i).copied().unwrap_or(0);
            let is_last = t + 1 == counts.primitives;
            vec![
                (PRIMITIVE_VALID, 1),
                (SIZE, primitive.size()),
                (I0, index(0)),
                (I1, index(1)),
                (I2, index(2)),
                (LAST_PRIMITIVE, is_last.into()),
            ]
        }
    })
}

fn of_factor(factor: &ProcessedFactor) -> Vec<(Signal, u32)> {
    let context = &factor.context;
    vec![
        (CULLED, 0),
        (FIXED, factor.fixed.to_bits()),
        (ODD, context.parity.odd()),
        (FRACTION, context.fraction),
        (HALF_POINTS, context.half_points),
        (FACTOR_POINTS, context.points),
        (SPLIT, context.split_position),
        (INV_FLOOR, context.inv_floor),
        (INV_CEIL, context.inv_ceil),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn case(line: &str) -> Case {
        line.parse().expect("a case")
    }

    /// The list of the circuit's test benches has the same rows: the option of `tess explain` that
    /// selects the part, and the signal. A published package has no such list.
    #[test]
    fn the_circuit_has_the_same_signals() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../rtl/stages.tsv");
        let Ok(list) = std::fs::read_to_string(path) else { return };
        let case =
            case("case tri fractional_odd triangle_cw ruler 40200000 40400000 3f800000 40500000");
        let parts = [
            ("factor", Part::Factor(0)),
            ("patch", Part::Patch),
            ("point", Part::Point(0)),
            ("primitive", Part::Primitive(0)),
        ];
        let own = parts.into_iter().flat_map(|(option, part)| {
            let row = move |(Signal { stage, name, module }, _)| {
                format!("{option}\t{stage}\t{name}\t{module}")
            };
            values(&case, part).expect("the part").into_iter().map(row).collect::<Vec<_>>()
        });
        let rows = list.lines().filter(|line| !line.starts_with('#'));
        assert_eq!(own.collect::<Vec<_>>(), rows.collect::<Vec<_>>());
    }

    /// The values of a fault-free circuit do not differ; a fault in any single signal is seen.
    #[test]
    fn every_signal_is_compared() {
        let case =
            case("case tri fractional_odd triangle_cw ruler 40200000 40400000 3f800000 40500000");
        for part in [Part::Patch, Part::Factor(3), Part::Point(7), Part::Primitive(0)] {
            let right = values(&case, part).expect("the part");
            let observed: Vec<_> =
                right.iter().map(|(signal, value)| (signal.name, *value)).collect();
            assert_eq!(compare_signals(&case, part, &observed), Ok(vec![]), "{part:?}");
            for (i, (signal, expected)) in right.into_iter().enumerate() {
                let mut wrong = observed.clone();
                wrong[i].1 ^= 1;
                let Signal { stage, name, module } = signal;
                let observed = expected ^ 1;
                let difference = SignalDifference { stage, name, module, observed, expected };
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
