//! Batches: factors with the output that the model gives for them.

use tess_core::{Config, Domain, Order, PatchFactors};
use tess_verify::generate::{SplitMix64, random_patch};
use tess_verify::{Case, Named};

/// Patches of one configuration.
pub(crate) struct Batch {
    pub(crate) domain: Domain,
    pub(crate) config: Config,
    pub(crate) patches: Vec<PatchFactors>,
}

/// How the output is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Form {
    pub(crate) is_f32: bool,
    pub(crate) is_narrow: bool,
    pub(crate) is_per_patch: bool,
    pub(crate) is_for_cache: bool,
}

/// The contents of the files that the host must write.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Expected {
    pub(crate) points: Vec<u8>,
    pub(crate) indices: Vec<u8>,
    pub(crate) draw: Vec<u8>,
}

/// The recorded cases, grouped by configuration.
pub(crate) fn recorded() -> Result<Vec<Batch>, String> {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../golden/cases.txt");
    let text = std::fs::read_to_string(file).map_err(|error| error.to_string())?;
    let mut batches: Vec<Batch> = Vec::new();
    for line in text.lines().filter(|line| line.starts_with("case ")) {
        let case: Case = line.parse().map_err(|error| format!("{line}: {error}"))?;
        let (domain, config) = (case.domain(), case.config);
        let own = batches.iter_mut().find(|b| (b.domain, b.config) == (domain, config));
        match own {
            Some(batch) => batch.patches.push(case.factors),
            None => batches.push(Batch { domain, config, patches: vec![case.factors] }),
        }
    }
    Ok(batches)
}

impl Batch {
    /// Random patches of the same configuration.
    pub(crate) fn random(&self, seed: u64, count: usize) -> Self {
        let mut random = SplitMix64::new(seed);
        let patches = (0..count).map(|_| random_patch(self.domain, &mut random)).collect();
        Self { patches, ..*self }
    }

    /// The options of `tess shaders` for the batch.
    pub(crate) fn options(&self, form: Form) -> String {
        let Config { partitioning, output, split } = self.config;
        let pick =
            |choice: bool, yes: &'static str, no: &'static str| if choice { yes } else { no };
        format!(
            "--domain {} --partitioning {} --output {} --split {} --points {} --index-type {} --numbering {} --index-order {}",
            self.domain.name(),
            partitioning.name(),
            output.name(),
            split.name(),
            pick(form.is_f32, "f32", "packed"),
            pick(form.is_narrow, "u16", "u32"),
            pick(form.is_per_patch, "per-patch", "per-batch"),
            pick(form.is_for_cache, "cache", "specification"),
        )
    }

    pub(crate) fn factor_bytes(&self) -> Vec<u8> {
        let factors = self.patches.iter().flat_map(PatchFactors::iter);
        factors.flat_map(|factor| factor.to_bits().to_le_bytes()).collect()
    }

    /// The model's output in this form.
    pub(crate) fn expected(&self, form: Form) -> Expected {
        let (mut points, mut indices) = (Vec::new(), Vec::new());
        let (mut base, mut count) = (0u32, 0u32);
        for (number, &factors) in (0u64..).zip(&self.patches) {
            let order = if form.is_for_cache { Order::VertexCache } else { Order::Specification };
            let whole = Case { config: self.config, factors }.patch().tessellate_in(order);
            for point in &whole.points {
                let (u, v) = (u64::from(point.u.to_bits()), u64::from(point.v.to_bits()));
                let word = if form.is_f32 {
                    u64::from(float_bits(point.u.to_bits()))
                        | u64::from(float_bits(point.v.to_bits())) << 32
                } else {
                    u | v << 17 | number << 34
                };
                points.extend(word.to_le_bytes());
            }
            for index in &whole.indices {
                let index = if form.is_per_patch { *index } else { base + index };
                let width = if form.is_narrow { 2 } else { 4 };
                indices.extend(&index.to_le_bytes()[..width]);
                count += 1;
            }
            base += u32::try_from(whole.points.len()).unwrap_or(u32::MAX);
        }
        let draw = [count, 1, 0, 0, 0].into_iter().flat_map(u32::to_le_bytes).collect();
        Expected { points, indices, draw }
    }
}

/// The bits of the binary32 that exactly equals a 16.16 number up to 1.
fn float_bits(fixed: u32) -> u32 {
    match fixed.checked_ilog2() {
        None => 0,
        Some(top) => (127 + top - 16) << 23 | (fixed << (23 - top)) & 0x7F_FFFF,
    }
}
