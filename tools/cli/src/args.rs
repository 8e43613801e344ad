//! Arguments shared by several commands: a patch (domain, factors and configuration), generated
//! cases, and names.

use crate::campaign::ShardArgs;
use crate::failure::Failure;
use crate::output::{counted, note};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use tess_core::{Config, Domain, Order, OutputPrimitive, Partitioning, PatchFactors, SplitOrder};
use tess_verify::generate::{GenLevel, Selection};
use tess_verify::{Case, Named, factor};

/// Values with their names on the command line and their help texts.
pub(crate) type Choices<T> = &'static [(&'static str, T, &'static str)];

/// The orders of triangles.
pub(crate) const ORDERS: Choices<Order> = &[
    ("specification", Order::Specification, "That of the specification"),
    (
        "cache",
        Order::VertexCache,
        "The same triangles, in columns that suit the vertex caches of GPUs",
    ),
];

/// The arguments that describe one patch.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct PatchArgs {
    /// Domain of the patch
    #[arg(value_parser = name_of::<Domain>())]
    pub(crate) domain: Domain,
    /// Outer factors: density,detail (isoline); U=0,V=0,W=0 (tri); U=0,V=0,U=1,V=1 (quad)
    ///
    /// Each decimal (nan, inf and -0 too), or the bits of a binary32 such as 0x40490fdb.
    #[arg(long, value_name = "F,F,..", value_delimiter = ',', allow_hyphen_values = true)]
    #[arg(required = true, value_parser = factor)]
    pub(crate) outer: Vec<f32>,
    /// Inside factors: one (tri); along U, along V (quad); none (isoline)
    #[arg(long, value_name = "F,F,..", value_delimiter = ',', allow_hyphen_values = true)]
    #[arg(value_parser = factor)]
    pub(crate) inner: Vec<f32>,
    /// Spacing of the cuts
    #[arg(long, value_name = "NAME", default_value = "integer")]
    #[arg(value_parser = name_of::<Partitioning>())]
    pub(crate) partitioning: Partitioning,
    /// Primitives that the indices describe
    #[arg(long, value_name = "NAME", default_value = "triangle_cw")]
    #[arg(value_parser = name_of::<OutputPrimitive>())]
    pub(crate) output: OutputPrimitive,
    /// Order in which points join an edge
    #[arg(long, value_name = "NAME", default_value = "ruler")]
    #[arg(value_parser = name_of::<SplitOrder>())]
    pub(crate) split: SplitOrder,
}

impl PatchArgs {
    /// The patch: its configuration and raw factors. Errors: the number of outer or inside factors
    /// is not the domain's.
    pub(crate) fn case(&self) -> Result<Case, Failure> {
        let config =
            Config { partitioning: self.partitioning, output: self.output, split: self.split };
        if self.outer.len() != self.domain.outer_factors() {
            return Err(self.wrong_count());
        }
        let all = [&self.outer[..], &self.inner].concat();
        let factors =
            PatchFactors::from_slice(self.domain, &all).ok_or_else(|| self.wrong_count())?;
        Ok(Case { config, factors })
    }

    fn wrong_count(&self) -> Failure {
        let (outer, inner) = self.domain.factor_names().split_at(self.domain.outer_factors());
        let list = |names: &[&str]| {
            format!("{} ({})", names.join(","), counted(names.len() as u64, "factor"))
        };
        let inner = match inner {
            [] => "no --inner".to_owned(),
            names => format!("--inner {}", list(names)),
        };
        Failure::bad_input(format!(
            "domain {} takes --outer {} and {inner}; got {} outer and {} inside factors",
            self.domain.name(),
            list(outer),
            self.outer.len(),
            self.inner.len()
        ))
    }
}

/// The arguments that select generated cases.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct SelectionArgs {
    /// How thorough: 1, 2 or 3
    #[arg(long, value_name = "N", default_value_t = 1)]
    #[arg(value_parser = clap::value_parser!(u8).range(1..=3))]
    level: u8,
    /// Seed of the random cases
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Number of random cases at the end
    #[arg(long, value_name = "N")]
    count: Option<u64>,
    /// Only this domain
    #[arg(long, value_name = "NAME", value_parser = name_of::<Domain>())]
    domain: Option<Domain>,
    /// Only this partitioning
    #[arg(long, value_name = "NAME", value_parser = name_of::<Partitioning>())]
    partitioning: Option<Partitioning>,
    /// Only this output primitive
    #[arg(long, value_name = "NAME", value_parser = name_of::<OutputPrimitive>())]
    output: Option<OutputPrimitive>,
    #[command(flatten)]
    pub(crate) shard: ShardArgs,
}

impl SelectionArgs {
    /// The cases of all shards together.
    pub(crate) const fn selection(&self) -> Selection {
        Selection {
            level: match self.level {
                1 => GenLevel::One,
                2 => GenLevel::Two,
                _ => GenLevel::Three,
            },
            seed: self.seed,
            random: self.count,
            domain: self.domain,
            partitioning: self.partitioning,
            output: self.output,
            split: None,
        }
    }
}

/// Notes on stderr which factors are above the largest factor. They are valid, but count as the
/// largest.
pub(crate) fn note_large_factors(case: &Case) {
    let patch = case.patch();
    let Some(processed) = patch.processed().factors() else { return };
    let factors = case.factors.iter().zip(processed.iter());
    for (name, (raw, factor)) in case.domain().factor_names().iter().zip(factors) {
        let largest = f32::from_bits(factor.clamped);
        if raw > largest {
            note(&format!("note: {name} is {raw} and counts as {largest}, the largest factor"));
        }
    }
}

/// A parser of command-line values that accepts these names and lists them in help and errors.
pub(crate) fn choice<T: Copy + Send + Sync>(all: Choices<T>) -> impl TypedValueParser<Value = T> {
    let names = all.iter().map(|(name, _, help)| PossibleValue::new(name).help(help));
    let find = |name: String| all.iter().find(|(known, ..)| *known == name);
    PossibleValuesParser::new(names)
        .try_map(move |name| find(name).map(|(_, value, _)| *value).ok_or("no such name"))
}

/// The name of a value among these.
pub(crate) fn name_in<T: PartialEq>(all: Choices<T>, value: &T) -> &'static str {
    all.iter().find(|(_, known, _)| known == value).map_or("", |(name, ..)| name)
}

/// A parser of command-line values that accepts the names of `T` and lists them in help and errors.
pub(crate) fn name_of<T: Named + Send + Sync>() -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(T::NAMES.iter().map(|(name, _)| *name))
        .try_map(|name| T::from_name(&name))
}
