//! Sizes as functions of a batch, found by asking the plan, so that nothing is stated twice.

use serde::{Serialize, Serializer};
use tess_gpu::sizes::{BLOCK, SECTION, TILE};
use tess_verify::generate::SplitMix64;

/// The variables of sizes.
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
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Patches => "patches",
            Self::Points => "points",
            Self::Primitives => "primitives",
            Self::MaxWorkgroups => "max_workgroups",
        }
    }

    /// The numbers by which sizes can grow in steps, each a multiple of the one before.
    const fn steps(self) -> &'static [u32] {
        match self {
            Self::Patches => &[1, BLOCK, SECTION],
            Self::Points | Self::Primitives => &[1, TILE],
            Self::MaxWorkgroups => &[1],
        }
    }
}

/// One value for each variable, in the order of [`Variable::ALL`].
pub(super) type Batch = [u32; 4];

/// The values that a variable can have, both ends included.
pub(super) type Bounds = [(u32, u32); 4];

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

/// A formula without terms is its number; any other has its text and its parts.
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

impl Formula {
    /// The value for a batch.
    pub(super) fn value(&self, batch: Batch) -> u64 {
        let term = |term: &Term| {
            let variable = batch[term.of as usize];
            term.times * u64::from(variable.div_ceil(term.per))
        };
        (self.constant + self.terms.iter().map(term).sum::<u64>()).next_multiple_of(self.multiple)
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

    /// The formula of a function, if it has one.
    ///
    /// Differences between neighbouring batches say by how much each step counts; then the formula is
    /// compared with the function at the ends of the bounds, next to steps and at random.
    pub(super) fn of(bounds: Bounds, function: impl Fn(Batch) -> u64) -> Option<Self> {
        let candidates = [stepped(bounds, &function), rounded(bounds, &function)];
        let holds =
            |formula: &Self| samples(bounds).all(|batch| formula.value(batch) == function(batch));
        candidates.into_iter().flatten().find(holds)
    }
}

/// The formula of a function that grows in [`Variable::steps`].
fn stepped(bounds: Bounds, function: impl Fn(Batch) -> u64) -> Option<Formula> {
    let base = bounds.map(|(least, _)| least);
    let mut terms = Vec::new();
    for of in Variable::ALL {
        let mut smaller = 0;
        for (i, &per) in of.steps().iter().enumerate() {
            let larger = of.steps().get(i + 1).copied();
            let Some(at) = before_step(bounds[of as usize], per, larger) else { continue };
            let with = |value: u32| {
                let mut batch = base;
                batch[of as usize] = value;
                function(batch)
            };
            let times = with(at + 1).checked_sub(with(at))?.checked_sub(smaller)?;
            smaller += times;
            if times > 0 {
                terms.push(Term { times, of, per });
            }
        }
    }
    let without = Formula { constant: 0, terms, multiple: 1 };
    let constant = function(base).checked_sub(without.value(base))?;
    Some(Formula { constant, ..without })
}

/// The first value in the bounds from which the next one is a step of `per` and of no `larger` one.
fn before_step((least, most): (u32, u32), per: u32, larger: Option<u32>) -> Option<u32> {
    let mut at = least.checked_next_multiple_of(per)?;
    if larger.is_some_and(|larger| at.is_multiple_of(larger)) {
        at = at.checked_add(per)?;
    }
    (at < most).then_some(at)
}

/// The formula of a function that is proportional, but for being rounded up to 8 bytes.
fn rounded(bounds: Bounds, function: impl Fn(Batch) -> u64) -> Option<Formula> {
    const MULTIPLE: u32 = 8;
    let base = bounds.map(|(least, _)| least);
    let slope = |of: Variable| {
        let (least, most) = bounds[of as usize];
        let mut far = base;
        far[of as usize] = least.checked_add(MULTIPLE).filter(|&far| far <= most)?;
        let times = function(far).checked_sub(function(base))? / u64::from(MULTIPLE);
        (times > 0).then_some(Term { times, of, per: 1 })
    };
    let terms = Variable::ALL.into_iter().filter_map(slope).collect();
    Some(Formula { constant: 0, terms, multiple: u64::from(MULTIPLE) })
}

/// Batches within the bounds: their ends, next to steps, and random ones.
fn samples(bounds: Bounds) -> impl Iterator<Item = Batch> {
    const COUNT: usize = 256;
    let mut random = SplitMix64::new(1);
    let mut one = move |of: Variable| {
        let (least, most) = bounds[of as usize];
        let size = most - least;
        // Every magnitude is as likely as any other.
        let bits = random.below(32 - size.leading_zeros() + 1);
        let near = least + random.below(u32::MAX >> (32 - bits.max(1))).min(size);
        let steps = of.steps();
        let step = steps[random.below(3) as usize % steps.len()];
        let value = match random.below(6) {
            0 => least,
            1 => most,
            2 => near / step * step,
            3 => (near / step * step).saturating_add(1),
            _ => near,
        };
        value.clamp(least, most)
    };
    std::iter::repeat_with(move || Variable::ALL.map(&mut one)).take(COUNT)
}
