//! The contents of a batch's buffers, by the golden model.

use super::device::{POISON, Written};
use tess_core::{DomainPoint, Patch, PatchFactors};
use tess_gpu::{IndexType, Numbering, PointFormat, Setup};
use tess_simd::{Output, Tessellator};

/// The words of both buffers, and the first words of each patch.
#[derive(Debug)]
pub(crate) struct Expected<'a> {
    setup: Setup,
    patches: &'a [PatchFactors],
    points: Vec<u32>,
    indices: Vec<u32>,
    /// First point word and first index word of each patch.
    begins: Vec<(usize, usize)>,
}

impl<'a> Expected<'a> {
    pub(crate) fn new(setup: Setup, patches: &'a [PatchFactors]) -> Self {
        let mut own =
            Self { setup, patches, points: Vec::new(), indices: Vec::new(), begins: Vec::new() };
        for (number, &factors) in (0..).zip(patches) {
            own.begins.push((own.points.len(), own.indices.len()));
            let base = u32::try_from(own.points.len() / 2).expect("a test's points");
            let base = if setup.numbering == Numbering::PerBatch { base } else { 0 };
            let whole = Patch::new(setup.config, factors).tessellate_in(setup.order);
            let words = |&point: &DomainPoint| point_words(setup.point_format, point, number);
            own.points.extend(whole.points.iter().flat_map(words));
            own.indices.extend(whole.indices.iter().map(|index| base + index));
        }
        own
    }

    /// The numbers of words of points and of indices; the latter are whole 8 bytes.
    pub(crate) fn words(&self) -> (u32, u32) {
        let (points, indices) = self.counts();
        (points, (indices * self.setup.index_type.bytes()).next_multiple_of(8) / 4)
    }

    /// The words of points, and the indices.
    pub(crate) fn output(&self) -> [&[u32]; 2] {
        [&self.points, &self.indices]
    }

    /// The patch of each point with the bits of u and v, and of each primitive with its indices
    /// within the patch.
    pub(crate) fn elements(&self) -> [Vec<(u32, Vec<u32>)>; 2] {
        let mut all = [Vec::new(), Vec::new()];
        for (number, &factors) in (0..).zip(self.patches) {
            let whole = Patch::new(self.setup.config, factors).tessellate_in(self.setup.order);
            let points = whole.points.iter().map(|point| point.to_f32().map(f32::to_bits).to_vec());
            all[0].extend(points.map(|words| (number, words)));
            let each = self.setup.indices_per_primitive() as usize;
            all[1].extend(whole.indices.chunks(each).map(|indices| (number, indices.to_vec())));
        }
        all
    }

    /// The first point and the first primitive of each patch, and the numbers after the last patch.
    pub(crate) fn begins(&self) -> Vec<[u32; 2]> {
        let per_primitive = self.setup.indices_per_primitive() as usize;
        let end = (self.points.len(), self.indices.len());
        let all = self.begins.iter().chain([&end]);
        let number = |words: usize| u32::try_from(words).expect("a test's output");
        all.map(|&(points, indices)| [number(points / 2), number(indices / per_primitive)])
            .collect()
    }

    /// The number of words of points, and of indices.
    fn counts(&self) -> (u32, u32) {
        let count = |words: &[u32]| u32::try_from(words.len()).expect("a test's output");
        (count(&self.points), count(&self.indices))
    }

    /// The first difference, including guard words.
    pub(crate) fn compare(&self, written: &Written) -> Result<(), String> {
        let Written { status, draw, points, indices } = written;
        let (point_words, index_words) = self.counts();
        let halves: Vec<u32>;
        let (indices, poison) = match self.setup.index_type {
            IndexType::U32 => (indices, POISON),
            IndexType::U16 => {
                halves = indices.iter().flat_map(|word| [word & 0xFFFF, word >> 16]).collect();
                (&halves, POISON & 0xFFFF)
            }
        };
        let per_primitive = self.setup.indices_per_primitive();
        let counts = (status.points(), status.primitives(), draw.index_count);
        let expected =
            (u64::from(point_words / 2), u64::from(index_words / per_primitive), index_words);
        let elements = self
            .first_difference("point", (&self.points, POISON), points, |begins| begins.0)
            .and_then(|()| {
                self.first_difference("index", (&self.indices, poison), indices, |begins| begins.1)
            });
        if counts != expected || !status.fits() || draw.instance_count != 1 {
            let first = elements.err().unwrap_or_else(|| "no element differs".into());
            return Err(format!(
                "{first}; points, primitives, indices {counts:?}, expected {expected:?}; {status:?}, {draw:?}"
            ));
        }
        elements
    }

    fn first_difference(
        &self,
        what: &str,
        (expected, poison): (&[u32], u32),
        observed: &[u32],
        begin: impl Fn(&(usize, usize)) -> usize,
    ) -> Result<(), String> {
        let expected_then_guard = expected.iter().chain(std::iter::repeat(&poison));
        let mut pairs = observed.iter().zip(expected_then_guard);
        let Some(at) = pairs.position(|(observed, expected)| observed != expected) else {
            return Ok(());
        };
        let patch = self.begins.partition_point(|begins| begin(begins) <= at).saturating_sub(1);
        let word = at - self.begins.get(patch).map_or(0, begin);
        let [is, right] = [observed[at], *expected.get(at).unwrap_or(&poison)];
        Err(format!(
            "{what} word {word} of patch {patch} ({}), word {at} of {}: observed {is} = {is:#010x}, \
             expected {right} = {right:#010x}",
            self.origin(what, patch, word),
            expected.len(),
        ))
    }

    /// A patch as a case to run again, and the origin of its element.
    fn origin(&self, what: &str, patch: usize, word: usize) -> String {
        let Some(&factors) = self.patches.get(patch) else { return "behind the last one".into() };
        let model = Patch::new(self.setup.config, factors);
        let number = |words: usize| u32::try_from(word / words).unwrap_or(u32::MAX);
        let size = self.setup.indices_per_primitive() as usize;
        let origin = match what {
            "point" => format!("{:?}", model.locate_point(number(2))),
            // The model locates primitives in its own order.
            _ if self.setup.order == tess_core::Order::Specification => {
                format!("{:?}", model.locate_primitive(number(size)))
            }
            _ => format!("primitive {}", number(size)),
        };
        let case = tess_verify::Case { config: self.setup.config, factors };
        format!("{case}: {origin}")
    }
}

/// The words of points and the indices of patches of one domain as tess-simd makes them.
pub(crate) fn by_simd(setup: Setup, patches: &[PatchFactors]) -> (Vec<u32>, Vec<u32>) {
    let numbering = match setup.numbering {
        Numbering::PerPatch => tess_simd::Numbering::PerPatch,
        Numbering::PerBatch => tess_simd::Numbering::PerBatch { base_vertex: 0 },
    };
    let mut output = Output::<DomainPoint, u32>::new();
    let mut tessellator = Tessellator::new(setup.config);
    tessellator.tessellate(patches, numbering, &mut output).expect("it fits");
    let mut points = Vec::with_capacity(2 * output.points().len());
    for (number, range) in (0..).zip(output.ranges()) {
        let own = &output.points()[range.first_point as usize..][..range.points as usize];
        points.extend(own.iter().flat_map(|&point| point_words(setup.point_format, point, number)));
    }
    (points, output.indices().to_vec())
}

/// A point as the shaders store it.
pub(crate) fn point_words(format: PointFormat, point: DomainPoint, patch: u32) -> [u32; 2] {
    match format {
        PointFormat::F32 => point.to_f32().map(f32::to_bits),
        PointFormat::Packed => {
            let [u, v] = [point.u, point.v].map(|bits| u64::from(bits.to_bits()));
            let packed = u | v << 17 | u64::from(patch) << 34;
            [packed & 0xFFFF_FFFF, packed >> 32].map(|word| u32::try_from(word).unwrap_or(0))
        }
    }
}
