//! Families of mistakes, and how they are written down.

use super::{Allowed, Effect, Mistake, Request};
use crate::case::Case;
use crate::rules::Specification;
use tess_core::Tessellation;

/// Mistakes of one name.
pub(super) struct Family {
    pub(super) name: &'static str,
    variants: Vec<(String, Effect)>,
    allowed: Vec<Allowed>,
    is_of_sequence: bool,
}

impl Family {
    pub(super) const fn new(name: &'static str) -> Self {
        Self { name, variants: Vec::new(), allowed: Vec::new(), is_of_sequence: false }
    }

    /// A device that answers as if it were asked other cases.
    pub(super) fn asks(
        self,
        variant: impl Into<String>,
        other: impl Fn(&Case) -> Case + Send + Sync + 'static,
    ) -> Self {
        self.remembers(variant, move |request| other(&request.case))
    }

    /// A device that answers as if it were asked other cases, which depend on those before and
    /// after.
    pub(super) fn remembers(
        mut self,
        variant: impl Into<String>,
        other: impl Fn(&Request) -> Case + Send + Sync + 'static,
    ) -> Self {
        self.variants.push((variant.into(), Effect::Question(Box::new(other))));
        self
    }

    /// A device that changes right answers.
    pub(super) fn answers(
        self,
        variant: impl Into<String>,
        spoil: impl Fn(&Case, &mut Tessellation) + Send + Sync + 'static,
    ) -> Self {
        self.spoils(variant, move |request, output| spoil(&request.case, output))
    }

    /// A device that changes right answers, depending on the patches around.
    pub(super) fn spoils(
        mut self,
        variant: impl Into<String>,
        spoil: impl Fn(&Request, &mut Tessellation) + Send + Sync + 'static,
    ) -> Self {
        let effect = Effect::Answer { may: Box::new(|_| true), spoil: Box::new(spoil) };
        self.variants.push((variant.into(), effect));
        self
    }

    /// A device that changes right answers of the cases for which `may` is true. The answers of
    /// others are not even copied.
    pub(super) fn answers_some(
        mut self,
        variant: impl Into<String>,
        may: impl Fn(&Case) -> bool + Send + Sync + 'static,
        spoil: impl Fn(&Case, &mut Tessellation) + Send + Sync + 'static,
    ) -> Self {
        let effect = Effect::Answer {
            may: Box::new(move |request| may(&request.case)),
            spoil: Box::new(move |request, output| spoil(&request.case, output)),
        };
        self.variants.push((variant.into(), effect));
        self
    }

    /// Mistakes that show only between patches of several domains or configurations.
    pub(super) const fn in_sequence(mut self) -> Self {
        self.is_of_sequence = true;
        self
    }

    pub(super) fn vulkan_allows(self, only: &'static str, because: &'static str) -> Self {
        self.allows(Specification::Vulkan, only, because)
    }

    pub(super) fn d3d11_allows(self, only: &'static str, because: &'static str) -> Self {
        self.allows(Specification::D3d11, only, because)
    }

    fn allows(
        mut self,
        standard: Specification,
        only: &'static str,
        because: &'static str,
    ) -> Self {
        self.allowed.push(Allowed { standard, only, because });
        self
    }

    /// The mistakes. The only variant of a family needs no words of its own.
    pub(super) fn mistakes(self) -> Vec<Mistake> {
        let Self { name, variants, allowed, is_of_sequence } = self;
        let is_only = variants.len() == 1;
        let mistake = |(variant, effect)| Mistake {
            family: name,
            variant: if is_only { String::new() } else { variant },
            effect,
            allowed: allowed.clone(),
            is_of_sequence,
        };
        variants.into_iter().map(mistake).collect()
    }
}

/// The words of a value by which variants are told apart.
pub(super) trait Label {
    fn label(&self) -> String;
}

/// The number of a level or an edge, from 0.
impl Label for usize {
    fn label(&self) -> String {
        format!("number {self}")
    }
}

impl Label for [usize; 2] {
    fn label(&self) -> String {
        format!("numbers {} and {}", self[0], self[1])
    }
}

impl Label for f32 {
    fn label(&self) -> String {
        self.to_string()
    }
}
