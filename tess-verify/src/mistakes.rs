//! Mistakes that a device can make, as one table.
//!
//! A mistake is a function: of the *question*, when a device tessellates another case than it was
//! asked, or of the *answer*, when it changes the output of the right case.
//!
//! ```text
//!  Case ──► Request ──► Mistake::case ──► model ──► Mistake::spoil ──► the device's answer
//!           (request.rs)  of the question            of the answer
//!
//!  all() ──► check::Explainer    which mistake explains every difference of a device
//!        ──► docs/rules.md       which rule of a standard each mistake breaks, or who allows it
//!        ──► test rigs           faults that every comparison must see
//! ```
//!
//! Mistakes come in families, such as every permutation of the outer levels. A family has a name
//! and variants. A device may make a mistake on some patches only: [`Scope`] has these conditions.
//!
//! ```
//! use tess_verify::mistakes::{named, requests};
//! use tess_verify::Case;
//!
//! let case: Case = "case isoline integer line ruler 40000000 40400000".parse()?; // 2 lines of 3
//! let swapped = named("the two levels of isolines are exchanged").expect("in the table");
//! let request = requests([case]).next().expect("one");
//! let right = case.patch().tessellate();
//! let wrong = swapped.wrong_answer(&request, &right).expect("it shows");
//! assert_eq!((right.points.len(), wrong.points.len()), (8, 9)); // 3 lines of 2
//! # Ok::<(), tess_verify::CaseError>(())
//! ```

mod damage;
mod family;
mod geometry;
mod levels;
mod places;
mod primitives;
mod request;
mod rounding;
mod scope;
mod spacing;
mod state;
mod stitches;
mod symmetries;
mod tables;

pub use request::{Request, Sequence, requests};
pub(crate) use scope::Common;
pub use scope::Scope;

use crate::case::Case;
use crate::rules::Specification;
use family::Family;
use std::fmt;
use std::sync::LazyLock;
use tess_core::Tessellation;

/// A mistake: one variant of a family.
pub struct Mistake {
    family: &'static str,
    variant: String,
    effect: Effect,
    allowed: Vec<Allowed>,
    is_of_sequence: bool,
}

/// What a mistake changes.
enum Effect {
    /// The device tessellates this case in place of the one that it was asked.
    Question(Box<Other>),
    /// The device changes the right answer of those requests for which `may` is true.
    Answer { may: Box<May>, spoil: Box<Spoil> },
}

type Other = dyn Fn(&Request) -> Case + Send + Sync;
type May = dyn Fn(&Request) -> bool + Send + Sync;
type Spoil = dyn Fn(&Request, &mut Tessellation) + Send + Sync;

/// A sentence by which a standard allows a mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Allowed {
    /// The standard.
    pub standard: Specification,
    /// Names of a domain or a partitioning to which the sentence is limited; an empty text means
    /// everywhere.
    pub only: &'static str,
    /// The sentence, with its section.
    pub because: &'static str,
}

impl Mistake {
    /// The name of the family: a row of the table in `docs/rules.md`.
    #[must_use]
    pub const fn family(&self) -> &'static str {
        self.family
    }

    /// What distinguishes this mistake in its family; empty if the family has no other.
    #[must_use]
    pub fn variant(&self) -> &str {
        &self.variant
    }

    /// The mistake in words: the family, and the variant if there are several.
    #[must_use]
    pub fn words(&self) -> String {
        match &*self.variant {
            "" => self.family.to_owned(),
            variant => format!("{}: {variant}", self.family),
        }
    }

    /// Whether the device tessellates another case. Otherwise it changes the answer.
    #[must_use]
    pub(crate) const fn is_of_question(&self) -> bool {
        matches!(self.effect, Effect::Question(_))
    }

    /// Whether it shows only in a sequence of patches with several domains or configurations.
    #[must_use]
    pub const fn is_of_sequence(&self) -> bool {
        self.is_of_sequence
    }

    /// The sentences that allow it.
    #[must_use]
    pub fn allowed(&self) -> &[Allowed] {
        &self.allowed
    }

    /// The case that the device tessellates; for a mistake of the answer, the one that was asked.
    #[must_use]
    pub fn case(&self, request: &Request) -> Case {
        match &self.effect {
            Effect::Question(other) => other(request),
            Effect::Answer { .. } => request.case,
        }
    }

    /// Changes the output of the case that the device tessellated; a mistake of the question
    /// changes nothing more.
    pub fn spoil(&self, request: &Request, output: &mut Tessellation) {
        if let Effect::Answer { may, spoil } = &self.effect
            && may(request)
        {
            spoil(request, output);
        }
    }

    /// The device's answer, if it differs from the `right` one, which is the model's.
    #[must_use]
    pub fn wrong_answer(&self, request: &Request, right: &Tessellation) -> Option<Tessellation> {
        let answer = match &self.effect {
            Effect::Question(other) => {
                let case = other(request);
                if case == request.case {
                    return None;
                }
                case.patch().tessellate()
            }
            Effect::Answer { may, .. } if !may(request) => return None,
            Effect::Answer { spoil, .. } => {
                let mut answer = right.clone();
                spoil(request, &mut answer);
                answer
            }
        };
        (answer != *right).then_some(answer)
    }
}

/// Words, and whether the mistake is of the question or of the answer.
impl fmt::Debug for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let of = if self.is_of_question() { "question" } else { "answer" };
        write!(f, "Mistake of the {of} ({})", self.words())
    }
}

/// Every mistake has words of its own.
impl PartialEq for Mistake {
    fn eq(&self, other: &Self) -> bool {
        self.family == other.family && self.variant == other.variant
    }
}

impl Eq for Mistake {}

impl Allowed {
    /// Whether the sentence is about patches of this domain and partitioning, such as `quad
    /// fractional_odd`.
    #[must_use]
    pub fn is_for(&self, group: &str) -> bool {
        self.only.split_whitespace().all(|word| group.split(' ').any(|own| own == word))
    }
}

/// Every mistake, family by family.
#[must_use]
pub fn all() -> &'static [Mistake] {
    static ALL: LazyLock<Vec<Mistake>> = LazyLock::new(|| {
        let families = [
            levels::all(),
            rounding::all(),
            spacing::all(),
            tables::all(),
            stitches::all(),
            state::all(),
            symmetries::all(),
            geometry::all(),
            primitives::all(),
            damage::all(),
        ];
        families.into_iter().flatten().flat_map(Family::mistakes).collect()
    });
    &ALL
}

/// The mistake with these [`Mistake::words`].
#[must_use]
pub fn named(words: &str) -> Option<&'static Mistake> {
    all().iter().find(|mistake| mistake.words() == words)
}

/// The mistakes that change one element of an answer or lose a whole one: the least that a
/// comparison of outputs must see.
pub fn of_one_element() -> impl Iterator<Item = &'static Mistake> {
    static FAMILIES: LazyLock<Vec<&'static str>> =
        LazyLock::new(|| damage::all().iter().map(|family| family.name).collect());
    all().iter().filter(|mistake| FAMILIES.contains(&mistake.family))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Words are names: [`named`] finds each mistake, and docs/rules.md has a row per family.
    #[test]
    fn words_are_unique() {
        let words: BTreeSet<String> = all().iter().map(Mistake::words).collect();
        assert_eq!(words.len(), all().len(), "no words twice");
        for mistake in all() {
            let words = mistake.words();
            assert_eq!(named(&words), Some(mistake), "{words}");
            let is_plain = !words.contains('|') && !words.contains('\n') && !words.ends_with(':');
            assert!(is_plain, "{words:?} fits a cell of a table");
        }
        assert!(of_one_element().count() > 10, "some change one element");
    }
}
