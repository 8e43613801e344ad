//! Output is reused where a key is equal: that of the same patch again, of a run, of a template. A
//! key must have everything that the output depends on, which `docs/proof.md` needs.
//!
//! Every patch here differs from the one before it in one number: a factor, in every position and
//! with every point count; or the domain, with the same factors. One tessellator writes all of
//! them, so that a key without that number finds the output of the patch before.

use tess_core::{
    Config, Domain, DomainPoint, MAX_INDICES, MAX_POINTS, OutputPrimitive, Partitioning, Patch,
    PatchFactors, QuadFactors, SplitOrder, Tessellation, TriangleFactors,
};
use tess_simd::{Batch, ExactOutput, Level, Numbering, OwnedBatch, Tessellator};

fn levels() -> impl Iterator<Item = Level> {
    Level::ALL.into_iter().filter(|level| level.is_available())
}

fn configs() -> impl Iterator<Item = Config> {
    let output = OutputPrimitive::TriangleCw;
    Partitioning::ALL.into_iter().flat_map(move |partitioning| {
        SplitOrder::ALL.map(|split| Config { partitioning, output, split })
    })
}

fn expected(config: Config, factors: PatchFactors) -> Tessellation {
    Patch::new(config, factors).tessellate()
}

/// Patches with all factors `base`, twice, so that the output of a large one is kept, then twice
/// with another value in one position: in every position, every integer factor, and the factors
/// beside the base.
#[expect(clippy::float_arithmetic, reason = "exact, or rounded to a factor as good")]
fn one_by_one(domain: Domain, base: f32) -> Vec<PatchFactors> {
    let near = [base.next_down(), base.next_up(), base - 0.375, base + 0.375];
    let values: Vec<f32> = (1..=64_u8).map(f32::from).chain(near).collect();
    let mut all = Vec::new();
    for place in 0..domain.factors() {
        for &value in &values {
            let other = PatchFactors::from_fn(domain, |at| if at == place { value } else { base });
            all.extend([[PatchFactors::uniform(domain, base); 2], [other; 2]].as_flattened());
        }
    }
    all
}

/// The factors that all others are: of a minimum patch, of compact ones, of one with a template,
/// and of a large one.
const BASES: [f32; 5] = [1.0, 2.0, 3.5, 17.0, 40.0];

/// A tessellator, and room for any patch.
struct Calls {
    tessellator: Tessellator,
    points: Vec<DomainPoint>,
    indices: Vec<u32>,
}

impl Calls {
    fn new(config: Config, level: Level) -> Self {
        Self {
            tessellator: Tessellator::with_level(config, level).expect("an available level"),
            points: vec![DomainPoint::default(); MAX_POINTS],
            indices: vec![0; MAX_INDICES],
        }
    }

    /// Checks a call for a patch with this output.
    fn check(&mut self, patch: PatchFactors, expected: &Tessellation) {
        let Self { tessellator, points, indices } = self;
        let counts = tessellator.patch(patch, points, indices).expect("enough room");
        let found = (&points[..counts.points as usize], &indices[..counts.indices as usize]);
        let equal = found == (&expected.points[..], &expected.indices[..]);
        let (level, config) = (tessellator.level(), tessellator.config());
        assert!(equal, "{level}, {config:?}: a call with {patch:?}");
    }
}

/// Checks one call for each patch, and a batch of all in each form of a batch.
fn check(config: Config, level: Level, patches: &[PatchFactors]) {
    let mut calls = Calls::new(config, level);
    let all: Vec<Tessellation> = patches.iter().map(|&patch| expected(config, patch)).collect();
    for (&patch, expected) in patches.iter().zip(&all) {
        calls.check(patch, expected);
    }
    let tessellator = &mut calls.tessellator;
    let batch = OwnedBatch::try_from(patches).expect("patches of one domain");
    let domain = patches[0].domain();
    let column = |place| -> Vec<f32> {
        patches.iter().filter_map(|patch| patch.iter().nth(place)).collect()
    };
    let columns: Vec<Vec<f32>> = (0..domain.factors()).map(column).collect();
    let columns = PatchFactors::from_fn(domain, |place| &columns[place][..]);
    for batch in [batch.batch(), Batch::from(patches), Batch::from(columns)] {
        let mut output = ExactOutput::new();
        let written = tessellator.tessellate(batch, Numbering::PerPatch, &mut output);
        written.expect("the output is no larger than memory");
        let of = format!("{level}, {config:?}");
        let (mut points, mut indices) = (output.points(), output.indices());
        for (number, expected) in all.iter().enumerate() {
            let own;
            (own, points) = points.split_at(expected.points.len());
            assert_eq!(own, expected.points, "{of}: patch {number}, {:?}", patches[number]);
            let own;
            (own, indices) = indices.split_at(expected.indices.len());
            assert_eq!(own, expected.indices, "{of}: patch {number}, {:?}", patches[number]);
        }
        assert!(points.is_empty() && indices.is_empty(), "{of}: more output");
    }
}

#[test]
#[ignore = "slow: every factor of every configuration"]
fn a_key_has_every_factor() {
    for level in levels() {
        for config in configs() {
            for domain in [Domain::Triangle, Domain::Quad] {
                for base in BASES {
                    check(config, level, &one_by_one(domain, base));
                }
            }
            check(config, level, &one_by_one(Domain::Isoline, 3.0));
        }
    }
}

/// The patches with small numbers: the factors of quads are 1 to 4, those of triangles 1 to 8.
fn small_patches(domain: Domain) -> Vec<PatchFactors> {
    const FACTORS: [f32; 8] = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];
    let bits = 12 / domain.factors();
    let digit = |number: usize, place: usize| (number >> (bits * place)) & ((1 << bits) - 1);
    let patch = |number| PatchFactors::from_fn(domain, |place| FACTORS[digit(number, place)]);
    (0..4096).map(patch).collect()
}

/// More topologies than the smallest sets of templates have slots for, so that templates are also
/// found by their small numbers.
#[test]
fn a_small_key_has_every_factor() {
    for level in levels() {
        for config in configs().filter(|config| config.split == SplitOrder::Ruler) {
            let quads = small_patches(Domain::Quad);
            let twice = [&quads[..], &quads[..]].concat();
            check(config, level, &twice);
        }
    }
}

/// Triangles after all small quads, then the quads again: both have the same small numbers but for
/// their domain.
#[test]
fn a_small_key_has_the_domain() {
    let patches = [Domain::Quad, Domain::Triangle, Domain::Quad].map(small_patches);
    for level in levels() {
        for config in configs().filter(|config| config.split == SplitOrder::Ruler) {
            let mut calls = Calls::new(config, level);
            for &patch in patches.iter().flatten() {
                calls.check(patch, &expected(config, patch));
            }
        }
    }
}

/// Factors of a triangle and of a quad whose inside factors are 0 are the same six numbers.
#[test]
fn a_key_has_the_domain() {
    for level in levels() {
        for config in configs() {
            let mut calls = Calls::new(config, level);
            for factor in (1..=64_u8).map(f32::from) {
                let [u0, v0, u1, v1] = [factor; 4];
                let quad = QuadFactors { u0, v0, u1, v1, inside_u: 0.0, inside_v: 0.0 };
                let triangle = TriangleFactors { u0, v0, w0: u1, inside: v1 };
                for patch in [PatchFactors::Quad(quad), PatchFactors::Triangle(triangle)] {
                    calls.check(patch, &expected(config, patch));
                }
            }
        }
    }
}
