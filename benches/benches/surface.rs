//! Times the evaluation of surfaces on one thread at every CPU level, and filling as many vertices.
//! Elements are vertices, at the domain points of factor 8. Each level's vertices are compared with
//! evaluation point by point before anything is timed.
#![expect(clippy::float_arithmetic, reason = "heights and corners are floats")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;
use tess_core::{
    Config, OutputPrimitive, Partitioning, PatchFactors, QuadFactors, TriangleFactors,
};
use tess_surface::glam::Vec3;
use tess_surface::{
    DisplacedModel, Displacement, HeightMap, Level, Model, PnCorner, PnTriangle, Sample, Surface,
    SurfacePatch, pn, teapot,
};

/// The domain points of a patch of these factors.
fn domain_points(factors: PatchFactors) -> Vec<[f32; 2]> {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let patch = tess_core::Patch::new(config, factors).tessellate();
    patch.points.iter().map(|point| point.to_f32()).collect()
}

fn pn_triangle() -> Surface {
    let corner = |x, y, z: f32| {
        let normal = Vec3::new(x, y, 2.0).normalize();
        PnCorner { position: Vec3::new(x, y, z), normal }
    };
    let corners = [corner(1.0, 0.0, 0.0), corner(0.0, 1.0, 0.1), corner(0.0, 0.0, 0.3)];
    let [u, v, w] = corners;
    let edges = [pn::edge_points(w, v), pn::edge_points(w, u), pn::edge_points(v, u)];
    Surface::PnTriangle(PnTriangle::new(corners, edges))
}

/// Nanoseconds per vertex: the time of an element.
fn surface(criterion: &mut Criterion) {
    let quad = domain_points(QuadFactors::uniform(8.0).into());
    let triangle = domain_points(TriangleFactors::uniform(8.0).into());
    let bicubic = SurfacePatch::new(Surface::Bezier(teapot::patches()[4]));
    let pn = SurfacePatch::new(pn_triangle());
    let model = Model::bezier(teapot::patches()).expect("the teapot is a model");
    let texels = (0..64 * 64_u16).map(|i| f32::from(i % 97) / 97.0).collect();
    let map = HeightMap::new(64, 64, texels).expect("as many texels");
    let displacement = Displacement::new(map, 0.02).expect("small heights");
    let displaced = DisplacedModel::new(&model, &displacement);
    let displaced = displaced.patch(4);

    let mut samples = vec![Sample::default(); quad.len().max(triangle.len())];
    let mut group = criterion.benchmark_group("surface");
    group.warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(2));
    group.throughput(Throughput::Elements(quad.len() as u64));
    group.bench_function("fill", |bencher| {
        bencher.iter(|| black_box(&mut samples[..quad.len()]).fill(Sample::default()));
    });
    for level in Level::ALL.into_iter().filter(|level| level.is_available()) {
        let one_by_one = |patch: &SurfacePatch, points: &[[f32; 2]]| {
            points.iter().map(|&point| patch.sample(point)).collect::<Vec<_>>()
        };
        check(level, &one_by_one(&bicubic, &quad), |samples| {
            bicubic.samples_at_level(level, &quad, samples)
        });
        check(level, &one_by_one(&pn, &triangle), |samples| {
            pn.samples_at_level(level, &triangle, samples)
        });
        let all: Vec<_> = quad.iter().map(|&point| displaced.sample(point)).collect();
        check(level, &all, |samples| displaced.samples_at_level(level, &quad, samples));
        group.throughput(Throughput::Elements(quad.len() as u64));
        group.bench_function(BenchmarkId::new("bicubic", level), |bencher| {
            bencher.iter(|| bicubic.samples_at_level(level, black_box(&quad), &mut samples));
        });
        group.bench_function(BenchmarkId::new("bicubic, displaced", level), |bencher| {
            bencher.iter(|| displaced.samples_at_level(level, black_box(&quad), &mut samples));
        });
        group.throughput(Throughput::Elements(triangle.len() as u64));
        group.bench_function(BenchmarkId::new("PN triangle", level), |bencher| {
            bencher.iter(|| pn.samples_at_level(level, black_box(&triangle), &mut samples));
        });
    }
}

/// Checks that a level gives the bits that evaluation point by point gives.
fn check<E: std::fmt::Debug>(
    level: Level,
    expected: &[Sample],
    evaluate: impl FnOnce(&mut [Sample]) -> Result<(), E>,
) {
    let mut samples = vec![Sample::default(); expected.len()];
    evaluate(&mut samples).expect("the level is available");
    let bits = |sample: &Sample| {
        let Sample { position, normal, texcoord } = sample;
        let [u, v] = texcoord.to_array();
        [position.to_array(), normal.to_array(), [u, v, 0.0]].map(|all| all.map(f32::to_bits))
    };
    let wrong = samples.iter().zip(expected).position(|(found, right)| bits(found) != bits(right));
    assert_eq!(wrong, None, "{level}, not timed: the first vertex that differs");
}

criterion_group!(benches, surface);
criterion_main!(benches);
