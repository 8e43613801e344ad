//! The second formulation of the model, which reaches the same numbers by other ways and verifies
//! the model.

use crate::backend::{Answers, Backend, BackendError};
use crate::generate::from_fixed;
use tess_core::fixed_point::{HALF, ONE};
use tess_core::{
    Config, FactorContext, FixedFactor, IsolineFactors, OutputPrimitive, Parity, Partitioning,
    Patch, PatchFactors, Primitive, ProcessedPatch, SplitOrder, Tessellation,
};

/// Tests `tess-core` against itself: patches by random access, and contexts through the public
/// interface, by whole patches. Factors and locations are computed in binary64, in which none of
/// their values is rounded.
#[derive(Clone, Copy, Debug, Default)]
pub struct SecondFormulation;

impl Backend for SecondFormulation {
    fn name(&self) -> &'static str {
        "core"
    }

    fn device(&self) -> String {
        "random access; factors and locations in binary64".into()
    }

    fn tessellate(&mut self, config: Config, patches: &[PatchFactors]) -> Answers<Tessellation> {
        let by_number = |&factors: &PatchFactors| {
            let patch = Patch::new(config, factors);
            let indices = |primitive: Primitive| primitive.indices().to_vec();
            let indices = patch.primitives().flat_map(indices).collect();
            Tessellation { points: patch.points().collect(), indices }
        };
        Ok(patches.iter().map(by_number).collect())
    }

    fn fixed_factors(
        &mut self,
        partitioning: Partitioning,
        values: &[f32],
    ) -> Answers<[FixedFactor; 2]> {
        let pair = |&x: &f32| {
            let outer = if x > 0.0 { fixed(partitioning, low(partitioning), x) } else { 0 };
            [outer, fixed(partitioning, low_inside(partitioning), x)].map(FixedFactor::from_bits)
        };
        Ok(values.iter().map(pair).collect())
    }

    fn contexts(
        &mut self,
        split: SplitOrder,
        parity: Parity,
        factors: &[FixedFactor],
    ) -> Answers<FactorContext> {
        let partitioning = match parity {
            Parity::Even => Partitioning::FractionalEven,
            Parity::Odd => Partitioning::FractionalOdd,
        };
        let config = Config { partitioning, output: OutputPrimitive::Point, split };
        let context = |factor: &FixedFactor| {
            let detail = from_fixed(factor.to_bits());
            let line = PatchFactors::Isoline(IsolineFactors { density: 1.0, detail });
            match Patch::new(config, line).processed() {
                ProcessedPatch::Regular(PatchFactors::Isoline(line)) => Ok(line.detail.context),
                other => Err(BackendError::new(format!("a line of detail {detail} is {other:?}"))),
            }
        };
        factors.iter().map(context).collect()
    }

    fn locations(&mut self, contexts: &[FactorContext]) -> Answers<u32> {
        let of_one = |context: &FactorContext| {
            let context = *context;
            (0..context.points).map(move |p| location(&context, p))
        };
        Ok(contexts.iter().flat_map(of_one).collect())
    }
}

/// The lower end of the range of outer factors (spec section 3, step 2).
const fn low(partitioning: Partitioning) -> f64 {
    match partitioning {
        Partitioning::FractionalEven => 2.0,
        _ => 1.0,
    }
}

/// The lower end of the range of an inside factor, if another factor is 3 (step 4).
#[expect(clippy::float_arithmetic, reason = "the second formulation is in binary64")]
fn low_inside(partitioning: Partitioning) -> f64 {
    match partitioning {
        Partitioning::FractionalOdd => 1.0 + 1.0 / 65536.0,
        _ => low(partitioning),
    }
}

/// Steps 2, 3 and 7: `x` clamped, rounded, and as a multiple of 2^-16. NaN becomes the lower end.
#[expect(
    clippy::float_arithmetic,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the second formulation is in binary64; at most 64 * 65536"
)]
fn fixed(partitioning: Partitioning, low: f64, x: f32) -> u32 {
    let high = if partitioning == Partitioning::FractionalOdd { 63.0 } else { 64.0 };
    let clamped = f64::from(x).max(low).min(high);
    let rounded = match partitioning {
        Partitioning::Integer | Partitioning::Pow2 => clamped.ceil(),
        Partitioning::FractionalOdd | Partitioning::FractionalEven => clamped,
    };
    (rounded * 65536.0).round_ties_even() as u32
}

/// The location of point `p < context.points` (spec section 5): the weighted mean of its places in
/// the two subdivisions, rounded half up. In the second half, it is one minus the location of the
/// mirror image.
#[expect(
    clippy::float_arithmetic,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the second formulation is in binary64; at most 65536"
)]
fn location(context: &FactorContext, p: u32) -> u32 {
    let mirrored = context.points - 1 - p;
    let position = p.min(mirrored);
    if p == mirrored {
        return HALF;
    }
    let coarse_position = position - u32::from(position > context.split_position);
    let coarse = f64::from(coarse_position) * f64::from(context.inv_floor);
    let fine = f64::from(position) * f64::from(context.inv_ceil);
    let mean = coarse + (fine - coarse) * (f64::from(context.fraction) / 65536.0);
    let x = (mean + 0.5).floor() as u32;
    if p < mirrored { x } else { ONE - x }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core_backend::CoreBackend;

    /// Values at, between and beyond the ends of the ranges.
    #[test]
    fn factors_are_those_of_the_model() {
        let values = [
            f32::NAN,
            -1.0,
            0.0,
            1e-40,
            0.5,
            1.0,
            1.25,
            2.0,
            62.5,
            63.0,
            63.5,
            64.0,
            100.0,
            f32::INFINITY,
        ];
        for partitioning in Partitioning::ALL {
            let model = CoreBackend.fixed_factors(partitioning, &values).expect("it answers");
            let second =
                SecondFormulation.fixed_factors(partitioning, &values).expect("it answers");
            assert_eq!(second, model, "{partitioning:?}");
        }
    }

    #[test]
    fn it_says_what_it_is() {
        let device = "random access; factors and locations in binary64";
        assert_eq!((SecondFormulation.name(), &*SecondFormulation.device()), ("core", device));
    }
}
