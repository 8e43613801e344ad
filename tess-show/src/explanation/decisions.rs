//! The decisions of factor processing, with their reasons (spec section 3).

use super::factors::named;
use tess_core::{
    Domain, FixedFactor, Parity, Partitioning, Patch, PatchFactors, ProcessedFactor, ProcessedPatch,
};
use tess_verify::Named;

/// One sentence per decision, in the order of the specification's steps.
pub(super) fn decisions(patch: &Patch, raw: &PatchFactors) -> Vec<String> {
    let mut sentences = vec![cull(raw)];
    if let Some(processed) = patch.processed().factors() {
        let partitioning = patch.config().partitioning;
        sentences.extend(clamping(raw, processed, partitioning));
        sentences.extend(picture_frame(raw, partitioning));
        sentences.extend(rounding(processed));
        sentences.extend(inside_one(processed));
        sentences.extend(minimum(patch, processed));
    }
    sentences
}

fn cull(raw: &PatchFactors) -> String {
    let all = named(raw);
    match all[..raw.domain().outer_factors()]
        .iter()
        .find(|(_, factor)| !matches!(factor, x if *x > 0.0))
    {
        Some((name, factor)) => format!(
            "culled: {name} is {factor}, which is not greater than zero; no points, no indices"
        ),
        None => "not culled: every outer factor is greater than zero".to_owned(),
    }
}

fn clamping(
    raw: &PatchFactors,
    processed: &PatchFactors<ProcessedFactor>,
    partitioning: Partitioning,
) -> Vec<String> {
    let (low, high) = partitioning.range();
    let mut sentences = vec![format!("{} clamps factors to {low}..{high}", partitioning.name())];
    if raw.domain() == Domain::Isoline {
        sentences.push("density is processed as integer (1..64) whatever the partitioning".into());
    }
    for ((name, raw), (_, factor)) in named(raw).into_iter().zip(named(processed)) {
        if raw.to_bits() != factor.clamped {
            let clamped = f32::from_bits(factor.clamped);
            sentences.push(format!("{name}: {raw} is clamped to {clamped}"));
        }
    }
    sentences
}

fn picture_frame(raw: &PatchFactors, partitioning: Partitioning) -> Option<String> {
    const ONE_PLUS_2_POW_MINUS_17: f32 = f32::from_bits(0x3F80_0040);
    if partitioning != Partitioning::FractionalOdd || raw.domain() == Domain::Isoline {
        return None;
    }
    let above = named(raw).into_iter().find(|(_, factor)| *factor > ONE_PLUS_2_POW_MINUS_17);
    Some(match above {
        Some((name, factor)) => format!(
            "picture frame: {name} is {factor}, more than 1 + 2^-17, \
             so inside factors are at least 1 + 2^-16"
        ),
        None => "no picture frame: no factor is more than 1 + 2^-17".to_owned(),
    })
}

fn rounding(processed: &PatchFactors<ProcessedFactor>) -> Vec<String> {
    let changed = named(processed).into_iter().filter(|(_, f)| f.clamped != f.rounded);
    let sentence = |(name, factor): (&str, ProcessedFactor)| {
        let [from, to] = [factor.clamped, factor.rounded].map(f32::from_bits);
        format!("{name}: {from} is rounded up to {to}")
    };
    changed.map(sentence).collect()
}

/// Sentences about inside factors that are 1 and even, which happens in partitionings with integer
/// factors.
fn inside_one(processed: &PatchFactors<ProcessedFactor>) -> Vec<String> {
    let is_even_one = |factor: &ProcessedFactor| {
        factor.fixed == FixedFactor::ONE && factor.context.parity == Parity::Even
    };
    let ones = named(processed).into_iter().filter(|(_, factor)| is_even_one(factor));
    ones.map(|(name, _)| format!("{name} is 1 and counts as even, with the context of factor 2"))
        .collect()
}

fn minimum(patch: &Patch, processed: &PatchFactors<ProcessedFactor>) -> Option<String> {
    if processed.domain() == Domain::Isoline {
        return None;
    }
    let above = named(processed).into_iter().find(|(_, f)| f.fixed != FixedFactor::ONE);
    Some(match (patch.processed(), above) {
        (ProcessedPatch::Minimum(_), _) | (_, None) => {
            "minimum patch: every fixed-point factor is one".to_owned()
        }
        (_, Some((name, factor))) => format!(
            "not the minimum patch: {name} is {:#07x} in fixed point, not 0x10000",
            factor.fixed.to_bits()
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_verify::Case;

    /// The threshold itself does not make a picture frame; the next float does.
    #[test]
    fn a_picture_frame_begins_above_its_threshold() {
        for (inside, expected) in [("3f800040", "no picture frame"), ("3f800041", "picture frame")]
        {
            let line =
                format!("case tri fractional_odd line ruler{} {inside}", " 3f800040".repeat(3));
            let case: Case = line.parse().expect("a case");
            let all = decisions(&case.patch(), &case.factors);
            let says = |words: &str| all.iter().any(|sentence| sentence.starts_with(words));
            assert!(says(&format!("{expected}: ")), "{line}: {all:?}");
        }
    }
}
