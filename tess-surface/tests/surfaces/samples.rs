//! Many vertices at a time have the bits of one at a time, whichever lanes they are in.

use crate::models::{bumps, models, rational_ball};
use tess_core::{Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_surface::{DisplacedModel, Level, LevelUnavailableError, Model, Sample};
use tess_testkit::levels::levels;

/// The domain points of a patch whose edges and inside have several lengths.
fn points(domain: Domain) -> Vec<[f32; 2]> {
    let config = tess_core::Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    let factors = PatchFactors::from_fn(domain, |i| [7.3, 4.0, 9.9, 3.6, 8.2, 5.5][i]);
    let whole = tess_core::Patch::new(config, factors).tessellate();
    let points: Vec<_> = whole.points.iter().map(|point| point.to_f32()).collect();
    let is_inside = |&[u, v]: &[f32; 2]| u > 0.0 && v > 0.0 && u + v < 1.0;
    assert!(points.iter().any(is_inside), "{domain:?}: the formulas of the inside are asked");
    points
}

fn bits(sample: &Sample) -> Vec<u32> {
    let Sample { position, normal, texcoord } = sample;
    let all = position.to_array().into_iter().chain(normal.to_array()).chain(texcoord.to_array());
    all.map(f32::to_bits).collect()
}

/// Compares at every level, in blocks of several lengths, so that points occur in every lane.
fn compare(
    name: &str,
    domain: Domain,
    one: impl Fn([f32; 2]) -> Sample,
    many: impl Fn(Level, &[[f32; 2]], &mut [Sample]) -> Result<(), LevelUnavailableError>,
) {
    let points = points(domain);
    let expected: Vec<_> = points.iter().map(|&point| bits(&one(point))).collect();
    for (level, length) in
        levels().into_iter().flat_map(|level| [1, 3, 8, 13, points.len()].map(|n| (level, n)))
    {
        for (block, expected) in points.chunks(length).zip(expected.chunks(length)) {
            let mut samples = vec![Sample::default(); block.len()];
            many(level, block, &mut samples).expect("the level is there");
            let samples: Vec<_> = samples.iter().map(bits).collect();
            assert_eq!(samples, expected, "{name}, {level}, blocks of {length}");
        }
    }
}

#[test]
fn many_are_one_by_one() {
    let ball = Model::bezier(rational_ball()).expect("a model");
    for (name, model) in models().into_iter().chain([("rational ball", ball)]) {
        let displacement = bumps();
        let displaced = DisplacedModel::new(&model, &displacement);
        for number in 0..model.len() {
            let patch = model.patch(number);
            let domain = patch.domain();
            compare(
                name,
                domain,
                |at| patch.sample(at),
                |level, at, out| patch.samples_at_level(level, at, out),
            );
            let patch = displaced.patch(number);
            compare(
                name,
                domain,
                |at| patch.sample(at),
                |level, at, out| patch.samples_at_level(level, at, out),
            );
        }
    }
}

/// The bits that every machine must give.
#[test]
fn every_machine_has_these_bits() {
    let ball = Model::bezier(rational_ball()).expect("a model");
    let (mut plain, mut displaced) = (Digest::default(), Digest::default());
    // These bits were recorded before there were other models.
    let is_recorded = |(name, _): &(&str, Model)| *name != "leaf" && *name != "fin";
    let recorded = models().into_iter().filter(is_recorded);
    for (_, model) in recorded.chain([("rational ball", ball)]) {
        let displacement = bumps();
        let displaced_model = DisplacedModel::new(&model, &displacement);
        for number in 0..model.len() {
            let patch = model.patch(number);
            let points = points(patch.domain());
            let mut samples = vec![Sample::default(); points.len()];
            patch.samples(&points, &mut samples);
            plain.add(&samples);
            displaced_model.patch(number).samples(&points, &mut samples);
            displaced.add(&samples);
        }
    }
    let found = [plain, displaced].map(|Digest(digest)| format!("{digest:016x}"));
    assert_eq!(found, ["adf62f8ca33c8416", "139ff745216c324f"], "as they are, displaced");
}

/// FNV-1a over words.
struct Digest(u64);

impl Default for Digest {
    fn default() -> Self {
        Self(0xCBF2_9CE4_8422_2325)
    }
}

impl Digest {
    fn add(&mut self, samples: &[Sample]) {
        for word in samples.iter().flat_map(bits) {
            self.0 = (self.0 ^ u64::from(word)).wrapping_mul(0x0000_0100_0000_01B3);
        }
    }
}
