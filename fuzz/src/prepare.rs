//! Factor preparation against a second formulation, in binary64 with every rounding made explicit.
//!
//! Sums, products and quotients of two binary32 numbers that are computed in binary64 and then
//! rounded to binary32 are the correctly rounded binary32 results, because 53 bits are more than
//! twice 24 plus one.

use crate::fault_is_planted;
use crate::input::Bytes;
use tess_core::prepare::{QuadAxes, Reduction, Request, prepare};
use tess_core::{Domain, Partitioning};
use tess_verify::Case;

/// Compares the unrounded and the rounded factors of one request. Errors: the first factor that
/// differs.
pub fn check(data: &[u8]) -> Result<(), String> {
    let mut bytes = Bytes(data);
    let (domain, config) = bytes.setting();
    let reduction = bytes.one_of([Reduction::Min, Reduction::Max, Reduction::Average]);
    let axes = bytes.one_of([QuadAxes::One, QuadAxes::Two]);
    let factors = bytes.factors(domain);
    let prepared = prepare(config.partitioning, reduction, Request::from_record(factors, axes));
    let second = Second { partitioning: config.partitioning, reduction, axes };
    let [unrounded, rounded] = second.prepare(domain, &factors.iter().collect::<Vec<_>>());
    for (result, observed, expected) in [
        ("unrounded", prepared.unrounded.map(f32::to_bits), unrounded),
        ("rounded", prepared.rounded.map(f32::to_bits), rounded),
    ] {
        let values = observed.iter().zip(expected.iter().map(|factor| factor.to_bits()));
        for (name, (mut observed, expected)) in domain.factor_names().iter().zip(values) {
            observed ^= u32::from(fault_is_planted());
            if observed != expected {
                // The case is the request in the form of a patch, with scales in place of inside
                // factors.
                let case = Case { config, factors };
                return Err(format!(
                    "\n{case}\nprepared with {reduction:?}, axes {axes:?}: {result} {name} is \
                     {observed:08x}, expected {expected:08x}"
                ));
            }
        }
    }
    Ok(())
}

/// The second formulation.
struct Second {
    partitioning: Partitioning,
    reduction: Reduction,
    axes: QuadAxes,
}

/// Rounds to binary32, to nearest, ties to even.
fn rounded(x: f64) -> f32 {
    x as f32
}

impl Second {
    /// Unrounded and rounded factors in the order of the domain.
    fn prepare(&self, domain: Domain, inputs: &[f32]) -> [Vec<f32>; 2] {
        let (outer, scales) = inputs.split_at(domain.outer_factors());
        if outer.iter().any(|x| x.is_nan() || *x <= 0.0) {
            let zeros = vec![0.0; inputs.len()];
            let unrounded = outer.iter().chain(scales.iter().map(|_| &0.0)).copied().collect();
            return [unrounded, zeros];
        }
        let cleaned: Vec<f32> = outer.iter().map(|x| x.max(1.0)).collect();
        if domain == Domain::Isoline {
            let parts = [Partitioning::Integer, self.partitioning];
            let unrounded: Vec<f32> =
                cleaned.iter().zip(parts).map(|(&x, p)| clamp(p, x)).collect();
            let up = unrounded.iter().zip(parts).map(|(&x, p)| round_up(p, x)).collect();
            return [unrounded, up];
        }
        let inside = match (domain, &cleaned[..], scales) {
            (Domain::Triangle, _, &[scale]) => vec![self.inside(&cleaned, scale)],
            (_, &[u0, v0, u1, v1], &[scale_u, scale_v]) => match self.axes {
                QuadAxes::One => vec![self.inside(&[v0, v1, u0, u1], scale_u); 2],
                QuadAxes::Two => {
                    let u = self.inside(&[v0, v1], scale_u);
                    let v = self.inside(&[u0, u1], scale_v);
                    self.widened(u, v)
                }
            },
            _ => unreachable!("as many scales as the domain has"),
        };
        let up = |x: &f32| round_up(self.partitioning, *x);
        let outer_up = cleaned.iter().map(|x| clamp(self.partitioning, up(x)));
        let rounded = outer_up.chain(inside.iter().map(up)).collect();
        [cleaned.iter().chain(&inside).copied().collect(), rounded]
    }

    fn inside(&self, outer: &[f32], scale: f32) -> f32 {
        let scale = if scale > 0.0 { scale.min(1.0) } else { 0.0 };
        let product = f64::from(reduce(self.reduction, outer)) * f64::from(scale);
        let x = clamp(self.partitioning, rounded(product));
        if self.partitioning != Partitioning::FractionalOdd || x >= 3.0 {
            return x;
        }
        let frame =
            if self.reduction == Reduction::Max { Reduction::Max } else { Reduction::Average };
        reduce(frame, outer).min(3.0)
    }

    /// The narrower of two axes grows to the other or to 3.
    fn widened(&self, u: f32, v: f32) -> Vec<f32> {
        if self.partitioning != Partitioning::FractionalOdd {
            return vec![u, v];
        }
        let at_least = u.max(v).min(3.0);
        vec![u.max(at_least), v.max(at_least)]
    }
}

fn reduce(reduction: Reduction, outer: &[f32]) -> f32 {
    let sum = || {
        let add = |sum: f32, x: &f32| rounded(f64::from(sum) + f64::from(*x));
        outer.iter().fold(0.0, add)
    };
    match reduction {
        Reduction::Min => outer.iter().copied().fold(f32::INFINITY, f32::min),
        Reduction::Max => outer.iter().copied().fold(0.0, f32::max),
        Reduction::Average => rounded(f64::from(sum()) / outer.len() as f64),
    }
}

fn clamp(partitioning: Partitioning, x: f32) -> f32 {
    let (low, high) = match partitioning {
        Partitioning::Integer | Partitioning::Pow2 => (1.0, 64.0),
        Partitioning::FractionalOdd => (1.0, 63.0),
        Partitioning::FractionalEven => (2.0, 64.0),
    };
    if x.is_nan() { low } else { x.clamp(low, high) }
}

fn round_up(partitioning: Partitioning, x: f32) -> f32 {
    match partitioning {
        Partitioning::Integer => rounded(f64::from(x).ceil()),
        Partitioning::Pow2 => {
            let mut power = 1.0_f64;
            while power < f64::from(x) && power < f64::INFINITY {
                power *= 2.0;
            }
            rounded(power)
        }
        Partitioning::FractionalOdd | Partitioning::FractionalEven => x,
    }
}
