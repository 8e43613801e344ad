//! Shared by the comparisons: seeded patches, the core's answer, and the first difference.

use tess_core::{
    Config, Domain, DomainPoint, IsolineFactors, OutputPrimitive, Partitioning, Patch,
    PatchFactors, QuadFactors, SplitOrder, Tessellation, TriangleFactors,
};
use tess_simd::{Batch, Error, IndexFormat, Numbering, Order, Output, OutputPoint, Tessellator};
use tess_verify::Case;
use tess_verify::generate::SplitMix64;

/// Every configuration.
pub(crate) fn configs() -> impl Iterator<Item = Config> {
    SplitOrder::ALL.into_iter().flat_map(|split| {
        Partitioning::ALL.into_iter().flat_map(move |partitioning| {
            OutputPrimitive::ALL.into_iter().map(move |output| Config {
                partitioning,
                output,
                split,
            })
        })
    })
}

/// A raw factor: mostly in or near 1..64, sometimes special.
pub(crate) fn factor(random: &mut SplitMix64) -> f32 {
    let specials: [f32; 12] = [
        0.0,
        -0.0,
        -1.0,
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::from_bits(1),
        1.0,
        1.0f32.next_up(),
        64.0,
        65.0,
        1e30,
    ];
    let integer =
        |random: &mut SplitMix64| u8::try_from(1 + random.below(64)).map_or(1.0, f32::from);
    match random.below(64) {
        0 => specials[random.below(12) as usize],
        1..=8 => 1.0,
        9..=16 => 64.0,
        17..=28 => integer(random),
        29..=34 => f32::from_bits(integer(random).to_bits() + random.below(600)),
        35..=48 => f32::from_bits(0x3F80_0000 + random.below(0x0180_0000)), // 1..8
        _ => f32::from_bits(0x3F80_0000 + random.below(0x0300_0000)),       // 1..64, log-uniform
    }
}

/// Factors of one patch: mostly unrelated, often all equal, sometimes all one or culled.
pub(crate) fn patch(random: &mut SplitMix64, domain: Domain) -> PatchFactors {
    let equal = match random.below(8) {
        0 => Some(1.0),
        1 => Some(64.0),
        2 => Some(factor(random)),
        3 => Some(0.0),
        _ => None,
    };
    PatchFactors::from_fn(domain, |_| equal.unwrap_or_else(|| factor(random)))
}

/// Patches of one domain in every layout.
#[derive(Default, Debug)]
pub(crate) struct Patches {
    pub(crate) all: Vec<PatchFactors>,
    isolines: Vec<IsolineFactors>,
    triangles: Vec<TriangleFactors>,
    quads: Vec<QuadFactors>,
    columns: [Vec<f32>; 6],
}

impl Patches {
    pub(crate) fn new(all: Vec<PatchFactors>) -> Self {
        let mut patches = Self::default();
        for patch in &all {
            match *patch {
                PatchFactors::Isoline(factors) => patches.isolines.push(factors),
                PatchFactors::Triangle(factors) => patches.triangles.push(factors),
                PatchFactors::Quad(factors) => patches.quads.push(factors),
            }
            patches.columns.iter_mut().zip(patch.iter()).for_each(|(column, f)| column.push(f));
        }
        Self { all, ..patches }
    }

    pub(crate) fn random(seed: u64, domain: Domain, count: usize) -> Self {
        let mut random = SplitMix64::new(seed);
        Self::new((0..count).map(|_| patch(&mut random, domain)).collect())
    }

    pub(crate) fn structures(&self, domain: Domain) -> Batch<'_> {
        match domain {
            Domain::Isoline => Batch::Isolines(&self.isolines),
            Domain::Triangle => Batch::Triangles(&self.triangles),
            Domain::Quad => Batch::Quads(&self.quads),
        }
    }

    pub(crate) fn columns(&self, domain: Domain) -> Batch<'_> {
        Batch::Columns(PatchFactors::from_fn(domain, |factor| &self.columns[factor][..]))
    }

    pub(crate) fn expected(&self, config: Config) -> Vec<Tessellation> {
        self.expected_in(Order::Specification, config)
    }

    pub(crate) fn expected_in(&self, order: Order, config: Config) -> Vec<Tessellation> {
        self.all.iter().map(|&factors| Patch::new(config, factors).tessellate_in(order)).collect()
    }
}

/// A point or an index as the bits of the core's value.
pub(crate) trait Bits: Copy {
    fn bits(self) -> [u32; 2];
}
impl Bits for DomainPoint {
    fn bits(self) -> [u32; 2] {
        [self.u.to_bits(), self.v.to_bits()]
    }
}
impl Bits for [f32; 2] {
    fn bits(self) -> [u32; 2] {
        self.map(f32::to_bits)
    }
}
impl Bits for u16 {
    fn bits(self) -> [u32; 2] {
        [self.into(), 0]
    }
}
impl Bits for u32 {
    fn bits(self) -> [u32; 2] {
        [self, 0]
    }
}

/// The first difference between an output and the core's patches, with the patch as a case that can
/// be run again.
pub(crate) fn difference<P: OutputPoint + Bits, I: IndexFormat + Bits>(
    (config, patches): (Config, &[PatchFactors]),
    expected: &[Tessellation],
    numbering: Numbering,
    output: &Output<P, I>,
    point: impl Fn(DomainPoint) -> P,
) -> Option<String> {
    if output.ranges().len() != expected.len() {
        return Some(format!("{} ranges for {} patches", output.ranges().len(), expected.len()));
    }
    let (mut first_point, mut first_index) = (0, 0);
    for (i, expected) in expected.iter().enumerate() {
        let range = output.ranges()[i];
        let starts = (range.first_point as usize, range.first_index as usize);
        if starts != (first_point, first_index) {
            return Some(format!("patch {i} starts at {starts:?}"));
        }
        let Some((points, indices)) = output.patch(i) else {
            return Some(format!("patch {i} is not there"));
        };
        let base = match numbering {
            Numbering::PerPatch => 0,
            // One past the largest index, where only culled patches follow.
            Numbering::PerBatch { base_vertex } => {
                base_vertex.wrapping_add(u32::try_from(first_point).unwrap_or(u32::MAX))
            }
        };
        let expected_points = expected.points.iter().map(|&p| point(p).bits()).collect::<Vec<_>>();
        let expected_indices =
            expected.indices.iter().map(|&index| [base + index, 0]).collect::<Vec<_>>();
        let (points, indices) = (points.iter().map(|p| p.bits()), indices.iter().map(|p| p.bits()));
        let what = [
            ("point", first(points, &expected_points)),
            ("index", first(indices, &expected_indices)),
        ];
        for (what, difference) in what {
            let Some((at, difference)) = difference else { continue };
            let case = Case { config, factors: patches[i] };
            let from = match what {
                "point" => {
                    let number = u32::try_from(at).unwrap_or(u32::MAX);
                    format!("{:?}", case.patch().locate_point(number))
                }
                _ => format!("primitive {}", at / case.primitive_size()),
            };
            return Some(format!("patch {i}, {case}: {what} {at} ({from}) {difference}"));
        }
        first_point += expected.points.len();
        first_index += expected.indices.len();
    }
    let ends = (output.points().len(), output.indices().len());
    (ends != (first_point, first_index)).then(|| format!("output ends at {ends:?}"))
}

fn first(
    observed: impl ExactSizeIterator<Item = [u32; 2]>,
    expected: &[[u32; 2]],
) -> Option<(usize, String)> {
    let lengths = (observed.len(), expected.len());
    for (i, (observed, expected)) in observed.zip(expected).enumerate() {
        if observed != *expected {
            let words =
                format!("is {observed:?} = {observed:x?}, expected {expected:?} = {expected:x?}");
            return Some((i, words));
        }
    }
    let words = || (lengths.0.min(lengths.1), format!("ends: {} of {}", lengths.0, lengths.1));
    (lengths.0 != lengths.1).then(words)
}

/// Runs a batch in one pair of formats and compares it.
pub(crate) fn compare<P: OutputPoint + Bits, I: IndexFormat + Bits>(
    tessellator: &mut Tessellator,
    (patches, batch): (&Patches, Batch<'_>),
    expected: &[Tessellation],
    numbering: Numbering,
    point: impl Fn(DomainPoint) -> P,
) {
    let mut output = Output::<P, I>::new();
    let what = format!(
        "{:?} {} {} {numbering:?} {} patches of {} bytes",
        tessellator.config(),
        tessellator.level(),
        std::any::type_name::<(P, I)>(),
        patches.all.len(),
        size_of::<I>(),
    );
    let largest = expected.iter().map(|patch| patch.points.len()).max().unwrap_or(0);
    let total = expected.iter().map(|patch| patch.points.len()).sum::<usize>();
    let end = match numbering {
        Numbering::PerPatch => largest as u64,
        Numbering::PerBatch { base_vertex } if total > 0 => u64::from(base_vertex) + total as u64,
        Numbering::PerBatch { .. } => 0,
    };
    let result = tessellator.tessellate(batch, numbering, &mut output);
    if end.saturating_sub(1) > I::LARGEST {
        let error = Error::IndexTooLarge { largest: end - 1, limit: I::LARGEST };
        assert_eq!(result, Err(error), "{what}");
        assert_eq!(output.ranges().len(), 0, "{what}: nothing written");
        return;
    }
    let counts = result.unwrap_or_else(|error| panic!("{what}: {error}"));
    let counted = tessellator.count(batch).map(|counted| counted.counts());
    assert_eq!(counted, Ok(counts), "{what}: counts");
    let difference =
        difference((tessellator.config(), &patches.all), expected, numbering, &output, point);
    assert_eq!(difference, None, "{what}");
}
