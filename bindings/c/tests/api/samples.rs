//! Patches to compare with: every configuration, factors of every kind.

use tess_capi::types::{TessConfig, TessContext, TessCounts, TessPoint};
use tess_core::{
    Config, Counts, Domain, DomainPoint, FactorContext, IsolineFactors, OutputPrimitive, Parity,
    Partitioning, Patch, PatchFactors, QuadFactors, SplitOrder, TriangleFactors,
};

/// One patch as C describes it and as the model does.
pub(super) struct Sample {
    pub(super) config: TessConfig,
    pub(super) factors: Vec<f32>,
    pub(super) patch: Patch,
}

/// Factors that go different ways through the stages: ends, exact and nearly exact integers,
/// halves, culled ones.
const KINDS: [f32; 13] = [
    1.0,
    1.0,
    3.0,
    4.5,
    f32::from_bits(0x4000_0001), // just above 2
    f32::from_bits(0x40E0_0040), // 7 + 2^-15
    63.7,
    0.3,
    f32::from_bits(1), // the smallest denormal
    f32::INFINITY,
    17.25,
    f32::NAN,
    -1.0,
];

/// 96 patches for each of the 3 domains: each configuration three times, factors in strides.
pub(super) fn samples() -> Vec<Sample> {
    let mut samples = Vec::new();
    for (d, &domain) in Domain::ALL.iter().enumerate() {
        for n in 0..96 {
            let numbers = [d, n % 4, n / 4 % 4, n / 16 % 2];
            let [domain_number, partitioning, output, split] =
                numbers.map(|number| u32::try_from(number).expect("a small number"));
            let config = TessConfig { domain: domain_number, partitioning, output, split };
            let kind = |i: usize| KINDS[(n * 7 + i * (1 + n / 13)) % KINDS.len()];
            let factors: Vec<f32> = (0..2 * (d + 1)).map(kind).collect();
            let model = Config {
                partitioning: Partitioning::ALL[n % 4],
                output: OutputPrimitive::ALL[n / 4 % 4],
                split: SplitOrder::ALL[n / 16 % 2],
            };
            let patch = Patch::new(model, patch_factors(domain, &factors));
            samples.push(Sample { config, factors, patch });
        }
    }
    let count = |f: fn(&Patch) -> bool| samples.iter().filter(|s| f(&s.patch)).count();
    assert!(count(|p| p.counts().points == 0) > 30, "too few culled patches");
    assert!(count(|p| p.counts().indices > 300) > 30, "too few large patches");
    samples
}

pub(super) fn patch_factors(domain: Domain, factors: &[f32]) -> PatchFactors {
    match (domain, factors) {
        (Domain::Isoline, &[density, detail]) => {
            PatchFactors::Isoline(IsolineFactors { density, detail })
        }
        (Domain::Triangle, &[u0, v0, w0, inside]) => {
            PatchFactors::Triangle(TriangleFactors { u0, v0, w0, inside })
        }
        (Domain::Quad, &[u0, v0, u1, v1, inside_u, inside_v]) => {
            PatchFactors::Quad(QuadFactors { u0, v0, u1, v1, inside_u, inside_v })
        }
        _ => unreachable!("as many factors as the domain has"),
    }
}

/// The model's values in C's structures, field by field and not by the conversions under test.
pub(super) fn point(point: DomainPoint) -> TessPoint {
    TessPoint { u: point.u.to_bits(), v: point.v.to_bits() }
}

pub(super) fn counts(counts: Counts) -> TessCounts {
    TessCounts { points: counts.points, primitives: counts.primitives, indices: counts.indices }
}

pub(super) fn context(context: FactorContext) -> TessContext {
    TessContext {
        parity: u32::from(context.parity == Parity::Odd),
        inv_floor: context.inv_floor,
        inv_ceil: context.inv_ceil,
        fraction: context.fraction,
        half_points: context.half_points,
        split: context.split,
        points: context.points,
    }
}
