//! Sizes as functions of a batch.

use serde::{Serialize, Serializer};

/// The variables of the sizes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Variable {
    Patches,
    Points,
    Primitives,
    MaxWorkgroups,
}

impl Variable {
    pub(super) const ALL: [Self; 4] =
        [Self::Patches, Self::Points, Self::Primitives, Self::MaxWorkgroups];

    /// Its name in both manifests.
    fn name(self) -> String {
        snake(&format!("{self:?}"))
    }
}

/// Converts a name of capitalized words to lower case with `_` between the words.
pub(super) fn snake(name: &str) -> String {
    let mut snake = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
    }
    snake
}

/// `constant` and the sum of `terms`, rounded up to a multiple of `multiple`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Formula {
    pub(super) constant: u64,
    pub(super) terms: Vec<Term>,
    pub(super) multiple: u64,
}

/// `times` the quotient of a variable and `per`, rounded up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub(super) struct Term {
    pub(super) times: u64,
    pub(super) of: Variable,
    pub(super) per: u32,
}

/// A formula without terms is written as a number; any other as its text and its parts.
impl Serialize for Formula {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Parts<'a> {
            text: String,
            constant: u64,
            terms: &'a [Term],
            multiple: u64,
        }
        if self.terms.is_empty() {
            return serializer.serialize_u64(self.constant);
        }
        let Self { constant, terms, multiple } = self;
        let (constant, multiple) = (*constant, *multiple);
        Parts { text: self.text(), constant, terms, multiple }.serialize(serializer)
    }
}

impl From<u64> for Formula {
    fn from(constant: u64) -> Self {
        Self { constant, terms: Vec::new(), multiple: 1 }
    }
}

impl Formula {
    /// `times` the quotient of a variable and `per`, rounded up.
    pub(super) fn term(times: impl Into<u64>, of: Variable, per: u32) -> Self {
        Self { terms: vec![Term { times: times.into(), of, per }], ..Self::from(0) }
    }

    /// The sum of two formulas, neither of which is rounded.
    pub(super) fn and(mut self, more: impl Into<Self>) -> Self {
        let more = more.into();
        self.constant += more.constant;
        self.terms.extend(more.terms);
        self
    }

    fn text(&self) -> String {
        let term = |term: &Term| match term.per {
            1 => format!("{} * {}", term.times, term.of.name()),
            per => format!("{} * ceil({} / {per})", term.times, term.of.name()),
        };
        let mut parts: Vec<String> = self.terms.iter().map(term).collect();
        if self.constant != 0 {
            parts.push(self.constant.to_string());
        }
        let sum = parts.join(" + ");
        if self.multiple == 1 {
            sum
        } else {
            format!("{sum}, up to a multiple of {}", self.multiple)
        }
    }
}
