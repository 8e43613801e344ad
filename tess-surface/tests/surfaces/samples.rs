//! Many vertices at a time: the bits of one at a time, whichever lanes they are in.

use crate::models::{bumps, models, rational_ball};
use tess_core::{Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_surface::{DisplacedModel, Model, Sample};

/// Domain points of a cut whose edges and inside are of several lengths.
fn points(domain: Domain) -> Vec<[f32; 2]> {
    let config = tess_core::Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    let factors = PatchFactors::from_fn(domain, |i| [7.3, 4.0, 9.9, 1.0, 8.2, 5.5][i]);
    let whole = tess_core::Patch::new(config, factors).tessellate();
    whole.points.iter().map(|point| point.to_f32()).collect()
}

fn bits(sample: &Sample) -> Vec<u32> {
    let Sample { position, normal, texcoord } = sample;
    let all = position.to_array().into_iter().chain(normal.to_array()).chain(texcoord.to_array());
    all.map(f32::to_bits).collect()
}

/// Compares in blocks of every length, so that a point comes into every lane.
fn compare(
    name: &str,
    domain: Domain,
    one: impl Fn([f32; 2]) -> Sample,
    many: impl Fn(&[[f32; 2]], &mut [Sample]),
) {
    let points = points(domain);
    let expected: Vec<_> = points.iter().map(|&point| bits(&one(point))).collect();
    for length in [1, 3, 8, 13, points.len()] {
        for (block, expected) in points.chunks(length).zip(expected.chunks(length)) {
            let mut samples = vec![Sample::default(); block.len()];
            many(block, &mut samples);
            let samples: Vec<_> = samples.iter().map(bits).collect();
            assert_eq!(samples, expected, "{name}, blocks of {length}");
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
            compare(name, domain, |at| patch.sample(at), |at, out| patch.samples(at, out));
            let patch = displaced.patch(number);
            compare(name, domain, |at| patch.sample(at), |at, out| patch.samples(at, out));
        }
    }
}
