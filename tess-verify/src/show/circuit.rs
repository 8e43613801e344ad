//! The signals of the circuit in `rtl/`: which stage and module gives each, and its value by the model.
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
    /// The patch as a whole: its counts.
    Patch,
    /// A factor, by its number in the specification's order.
    Factor(u32),
    /// A domain point.
    Point(u32),
    /// A primitive.
    Primitive(u32),
}

/// Such as `factor 3`.
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

/// A signal, by the stage and the name that benches give it, and the module of the circuit that makes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Signal {
    /// The option of `tess explain` that chooses what it describes.
    option: &'static str,
    stage: &'static str,
    name: &'static str,
    module: &'static str,
}

/// The signals of the circuit, those of each option in the order in which each feeds the next.
const STAGES: &str = include_str!("stages.tsv");
const _: () = assert!(
    STAGES.as_bytes()[0] == b'#',
    "stages.tsv is a symbolic link; git leaves its target's path without core.symlinks"
);

/// The signals of an option.
fn signals(option: &str) -> impl Iterator<Item = Signal> {
    let rows = STAGES.lines().filter(|line| !line.starts_with('#'));
    let signals = rows.filter_map(|row| {
        let [option, stage, name, module] = row.split('\t').collect::<Vec<_>>().try_into().ok()?;
        Some(Signal { option, stage, name, module })
    });
    signals.filter(move |signal| signal.option == option)
}

/// A signal that differs from the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct SignalDifference {
    /// The stage, as benches name it.
    pub stage: &'static str,
    /// Its name.
    #[cfg_attr(feature = "serde", serde(rename = "signal"))]
    pub name: &'static str,
    /// The module of `rtl/` that makes it, in a file of that name.
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

/// Nothing can be compared.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SignalError {
    /// The patch has no such factor, point or primitive.
    #[error("there is no {0}")]
    NoSuchPart(Part),
    /// No signal of this part has this name; the names there are.
    #[error("no signal {} here, expected one of: {}", quoted(.0), .1.join(", "))]
    NoSuchSignal(String, Vec<&'static str>),
}

/// The signals that differ from the model, in the order in which each feeds the next. What follows from the first is
/// there too.
///
/// # Errors
/// [`SignalError`]. A culled patch has no signal of its factors but `culled`.
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
        let Signal { stage, name, module, .. } = signal;
        seen.map(move |&(_, observed)| SignalDifference { stage, name, module, observed, expected })
    });
    Ok(differences.collect())
}

/// The model's value of each signal of a part; `None` if the patch has no such part.
fn values(case: &Case, part: Part) -> Option<Vec<(Signal, u32)>> {
    let patch = case.patch();
    let counts = patch.counts();
    let (option, values): (&str, Vec<u32>) = match part {
        Part::Patch => ("patch", vec![counts.points, counts.primitives]),
        Part::Factor(k) => {
            let factors = patch.processed().factors();
            let number = usize::try_from(k).ok().filter(|k| *k < case.domain().factors())?;
            (
                "factor",
                factors.map_or(Some(vec![1]), |all| all.iter().nth(number).map(|x| factor(&x)))?,
            )
        }
        Part::Point(i) => {
            let point = patch.point(i)?;
            (
                "point",
                vec![1, point.u.to_bits(), point.v.to_bits(), (i + 1 == counts.points).into()],
            )
        }
        Part::Primitive(t) => {
            let primitive = patch.primitive(t)?;
            let index = |i: usize| primitive.indices().get(i).copied().unwrap_or(0);
            let last = (t + 1 == counts.primitives).into();
            ("primitive", vec![1, primitive.size(), index(0), index(1), index(2), last])
        }
    };
    Some(signals(option).zip(values).collect())
}

/// In the order of the signals of `factor`.
fn factor(factor: &ProcessedFactor) -> Vec<u32> {
    let c = &factor.context;
    vec![
        0,
        factor.fixed.to_bits(),
        c.parity.odd(),
        c.fraction,
        c.half_points,
        c.points,
        c.split,
        c.inv_floor,
        c.inv_ceil,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn case(line: &str) -> Case {
        line.parse().expect("a case")
    }

    /// The values of a circuit without a fault do not differ; each signal alone is seen.
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
                let Signal { stage, name, module, .. } = signal;
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
