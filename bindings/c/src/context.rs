//! Contexts that callers pass in, and the signals that place a point with a context.

use crate::status::{TESS_NOT_A_CONTEXT, TESS_OUT_OF_RANGE, TessStatus};
use crate::types::{TessContext, parity};
use tess_core::fixed_point::ONE;
use tess_core::place::placement;
use tess_core::{FactorContext, FixedFactor, Parity, SplitOrder};

/// The model's context with these numbers; `TESS_NOT_A_CONTEXT` if no factor has it.
///
/// `half_points` and `fraction` determine half the factor, and thus one context for each split
/// order. All other numbers are refused, so that the arithmetic of placement cannot overflow.
pub(crate) fn checked(given: TessContext) -> Result<FactorContext, TessStatus> {
    let parity = parity(given.parity)?;
    if given.half_points == 0 || given.half_points > 32 || given.fraction >= ONE {
        return Err(TESS_NOT_A_CONTEXT);
    }
    // half = C if the fraction is 0, else C - 1 plus the fraction; at most 32.
    let below = if given.fraction == 0 { 0 } else { ONE };
    let half = (given.half_points << 16) - below + given.fraction;
    let factor = match parity {
        Parity::Even => 2 * half,
        Parity::Odd => (2 * half).saturating_sub(ONE),
    };
    SplitOrder::ALL
        .into_iter()
        .map(|split| FactorContext::new(FixedFactor::from_bits(factor), parity, split))
        .find(|&context| TessContext::from(context) == given)
        .ok_or(TESS_NOT_A_CONTEXT)
}

/// The signals of the placement of point `p` of an edge, in the order in which hardware computes
/// them (specification, section 5):
///
/// - flip: 1 on the second half of the edge, else 0,
/// - the position on the half edge, 0..32; `half_points` in the exact middle,
/// - the place in the coarser subdivision; 0 in the exact middle,
/// - the place in the finer subdivision; 0 in the exact middle,
/// - the location on the half edge, rounded; one half in the exact middle,
/// - the location, 0..0x10000.
pub(crate) fn place_signals(context: &FactorContext, p: u32) -> Result<[u32; 6], TessStatus> {
    if p >= context.points {
        return Err(TESS_OUT_OF_RANGE);
    }
    let placement = placement(context, p);
    let (coarse, fine) = placement.blend.map_or((0, 0), |blend| (blend.coarse, blend.fine));
    let (flip, location) = (u32::from(placement.flip), placement.location.to_bits());
    Ok([flip, placement.position, coarse, fine, placement.half_location, location])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::status::TESS_UNKNOWN_VALUE;
    use tess_core::fixed_point::HALF;

    /// The contexts of integers, halves and their neighbours.
    fn contexts() -> impl Iterator<Item = FactorContext> {
        let factors = (2..=128u32).flat_map(|halves| {
            [halves * HALF - 1, halves * HALF, halves * HALF + 1, halves * HALF + 0x1234]
        });
        factors.flat_map(|bits| {
            [Parity::Even, Parity::Odd].into_iter().flat_map(move |parity| {
                SplitOrder::ALL
                    .map(|split| FactorContext::new(FixedFactor::from_bits(bits), parity, split))
            })
        })
    }

    #[test]
    fn every_context_passes_and_no_altered_one() {
        let mut altered_seen = 0;
        for context in contexts() {
            let given = TessContext::from(context);
            assert_eq!(checked(given), Ok(context), "the context of a factor");
            for altered in [
                TessContext { inv_floor: given.inv_floor ^ 1, ..given },
                TessContext { inv_ceil: given.inv_ceil + 1, ..given },
                TessContext { fraction: given.fraction + ONE, ..given },
                TessContext { half_points: given.half_points + 32, ..given },
                TessContext { half_points: 0, ..given },
                TessContext { split: u32::MAX, ..given },
                TessContext { points: given.points + 1, ..given },
            ] {
                altered_seen += 1;
                assert_eq!(checked(altered), Err(TESS_NOT_A_CONTEXT), "{altered:?}");
            }
            let parity = TessContext { parity: 2, ..given };
            assert_eq!(checked(parity), Err(TESS_UNKNOWN_VALUE), "a third parity");
        }
        assert!(altered_seen > 10_000, "only {altered_seen} contexts");
    }

    /// The formula of section 5, applied to the signals, gives the model's location.
    #[test]
    fn steps_lead_to_the_location() {
        for context in contexts() {
            for p in 0..context.points {
                let signals = place_signals(&context, p).expect("a point of this edge");
                let [flip, position, coarse, fine, half_location, location] = signals;
                let blend = if position == context.half_points {
                    HALF
                } else {
                    let weighted = coarse * (ONE - context.fraction) + fine * context.fraction;
                    (weighted + HALF) >> 16
                };
                assert_eq!(half_location, blend, "{context:?}, p = {p}: {signals:?}");
                let placed = if flip == 1 { ONE - blend } else { blend };
                assert_eq!(location, placed, "{context:?}, p = {p}: {signals:?}");
            }
            let beyond = place_signals(&context, context.points);
            assert_eq!(beyond, Err(TESS_OUT_OF_RANGE), "{context:?}");
        }
    }
}
