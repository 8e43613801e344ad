//! A listing's differences from the model as words that fit into a link.
//!
//! Words are joined by `-`: `P40` and `T60` are other numbers of points and primitives,
//! `p7.aaab.5555` is point 7 with u and v as hex bits, `t12.6.8.7` is primitive 12 with its
//! indices.

use crate::patch::PatchView;
use std::fmt::Write;
use tess_core::{DomainPoint, MAX_INDICES, MAX_POINTS, Tessellation};
use tess_show::differing;
use tess_verify::vectors::Listing;
use wasm_bindgen::prelude::wasm_bindgen;

/// More differences make a link that is too long for some programs.
const MOST: usize = 200;

/// Differences from the model, in words; nothing if they are too many for a link.
#[wasm_bindgen]
pub fn difference_words(expected: &PatchView, observed: &PatchView) -> Option<String> {
    let (expected, observed) = (&expected.listing, &observed.listing);
    let [points, primitives] = differing(expected, observed);
    if points.len() + primitives.len() > MOST {
        return None;
    }
    let mut words = Vec::new();
    let counts = |listing: &Listing| [listing.output.points.len(), listing.primitives().count()];
    let (has, should) = (counts(observed), counts(expected));
    for (k, letter) in ["P", "T"].into_iter().enumerate().filter(|&(k, _)| has[k] != should[k]) {
        words.push(format!("{letter}{}", has[k]));
    }
    for i in points.into_iter().filter(|&i| i < has[0]) {
        let DomainPoint { u, v } = observed.output.points[i];
        words.push(format!("p{i}.{:x}.{:x}", u.to_bits(), v.to_bits()));
    }
    let mut rows = observed.primitives();
    let mut next = 0;
    for t in primitives.into_iter().filter(|&t| t < has[1]) {
        let mut word = format!("t{t}");
        for index in rows.nth(t - next).unwrap_or_default() {
            // Writing to a String does not fail.
            _ = write!(word, ".{index}");
        }
        next = t + 1;
        words.push(word);
    }
    Some(words.join("-"))
}

#[wasm_bindgen]
impl PatchView {
    /// The listing that differs so from this patch; nothing if the words are malformed.
    pub fn with_differences(&self, words: &str) -> Option<Self> {
        let Listing { case, output, .. } = &self.listing;
        let mut output = output.clone();
        for word in words.split('-') {
            apply(&mut output, case.primitive_size(), word)?;
        }
        Some(Self::of(*case, output))
    }
}

/// Makes one difference.
fn apply(output: &mut Tessellation, size: usize, word: &str) -> Option<()> {
    let (kind, rest) = word.split_at_checked(1)?;
    let mut fields = rest.split('.');
    let number: usize = fields.next()?.parse().ok()?;
    match kind {
        "P" if number <= MAX_POINTS => output.points.resize(number, DomainPoint::from_bits(0, 0)),
        "T" if number <= MAX_INDICES / size => output.indices.resize(number * size, 0),
        "p" => {
            let mut bits = || u32::from_str_radix(fields.next()?, 16).ok();
            *output.points.get_mut(number)? = DomainPoint::from_bits(bits()?, bits()?);
        }
        "t" => {
            let first = number.checked_mul(size)?;
            for index in output.indices.get_mut(first..first.checked_add(size)?)? {
                *index = fields.next()?.parse().ok()?;
            }
        }
        _ => return None,
    }
    fields.next().is_none().then_some(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_verify::Case;

    fn model() -> PatchView {
        let line = "case quad integer triangle_cw ruler 40400000 40400000 40400000 40400000 40400000 40400000";
        let case: Case = line.parse().expect("a case");
        PatchView::of(case, case.patch().tessellate())
    }

    #[test]
    fn differences_come_back_from_their_words() {
        let model = model();
        let mut longer = model.clone();
        longer.listing.output.points.push(DomainPoint::from_bits(0x1234, 0xffff_ffff));
        longer.listing.output.indices.extend([16, 2, 4_000_000_000]);
        let mut shorter = model.clone();
        shorter.listing.output.points.truncate(9);
        shorter.listing.output.indices.truncate(30);
        shorter.listing.output.indices.swap(3, 4);
        shorter.listing.output.indices.swap(28, 29);
        for observed in [
            &model.with_mistake("a bit of a point is wrong: the lowest of the middle u"),
            &longer,
            &shorter,
        ] {
            let words = difference_words(&model, observed).expect("few");
            let back = model.with_differences(&words).expect("well-formed");
            assert_eq!(back.listing, observed.listing, "{words}");
        }
    }

    #[test]
    fn malformed_words_are_refused() {
        for words in [
            "",
            "x1",
            "p",
            "p7",
            "p7.1",
            "p7.1.2.3",
            "p99.1.1",
            "t0.1.2",
            "t99.1.2.3",
            "P9999999",
            "T9999999",
            "T18446744073709551615",
            "T6148914691236517206",
            "T1431655766",
            "é",
        ] {
            assert!(model().with_differences(words).is_none(), "{words:?}");
        }
    }
}
