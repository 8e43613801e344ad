//! Computes every number of docs/tour-gpu.md from the golden model and the layouts of this crate.
//! tess-wgpu/tests/batches/tour.rs compares the same numbers with a device's output.

use std::fmt::Write;
use tess_core::{
    Config, Domain, OutputPrimitive, Partitioning, Patch, PatchFactors, Primitive, ProcessedFactor,
    QuadFactors,
};
use tess_gpu::layout::{PackedPoint, factor_words, pack_context};
use tess_gpu::{Capacity, Limits, Plan, Resource, Setup, Workgroups};

const RAW: [f32; 6] = [3.0, 4.5, 5.0, 6.0, 4.0, 7.0];

fn setup() -> Setup {
    let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
    Setup::new(Domain::Quad, config)
}

fn patch() -> Patch {
    Patch::new(setup().config, QuadFactors::from(RAW))
}

/// Its six factors after processing.
fn factors() -> [ProcessedFactor; 6] {
    match patch().processed().factors() {
        Some(&PatchFactors::Quad(factors)) => factors.into(),
        other => panic!("a quad is a quad: {other:?}"),
    }
}

fn tour() -> String {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/tour-gpu.md");
    std::fs::read_to_string(path).expect(path)
}

/// The tour has this block, word for word.
fn assert_block(lines: &[String]) {
    let block: String = lines.iter().map(|line| format!("    {line}\n")).collect();
    assert!(tour().contains(&format!("\n\n{block}\n")), "docs/tour-gpu.md lacks\n{block}");
}

#[test]
fn raw_and_fixed_factors() {
    let words = factor_words(&[QuadFactors::from(RAW).into()]);
    let names = QuadFactors::<f32>::NAMES;
    let lines: Vec<String> = (0..6)
        .map(|k| {
            let fixed = factors()[k].fixed.to_bits();
            format!("{:<8} {:<3}  bits {:#010x}  15.16 {fixed:#09x}", names[k], RAW[k], words[k])
        })
        .collect();
    assert_block(&lines);
}

#[test]
fn contexts_topology_and_counts() {
    let lines: Vec<String> = factors()
        .iter()
        .zip(QuadFactors::<f32>::NAMES)
        .map(|(factor, name)| {
            let [low, high] = pack_context(&factor.context);
            format!("{name:<8} {} points  {low:#010x} {high:#010x}", factor.context.points)
        })
        .collect();
    assert_block(&lines);
    let points = factors().map(|factor| factor.context.points);
    let outer = (0..4).fold(2 << 28, |word, edge| word | points[edge] << (7 * edge));
    let inside = points[4] | points[5] << 7;
    let counts = patch().counts();
    assert_block(&[
        format!("topology  {outer:#010x} {inside:#010x}"),
        format!("counts    {} points, {} triangles", counts.points, counts.primitives),
    ]);
}

#[test]
fn the_plan() {
    let counts = patch().counts();
    let room = Capacity { points: counts.points, primitives: counts.primitives };
    let plan = Plan::new(setup(), 1, room, Limits::WEBGPU);
    let mut lines: Vec<String> = plan
        .dispatches()
        .map(|dispatch| {
            let Workgroups::Direct([x, ..]) = dispatch.workgroups() else {
                panic!("a short batch")
            };
            let resources: Vec<String> =
                dispatch.bindings().map(|(resource, _)| format!("{resource:?}")).collect();
            format!(
                "{:<12} {x} workgroups: {}",
                dispatch.stage().entry_point(),
                resources.join(" ")
            )
        })
        .collect();
    let sizes = [
        Resource::Factors,
        Resource::Topologies,
        Resource::Contexts,
        Resource::Points,
        Resource::Indices,
    ]
    .map(|resource| format!("{resource:?} {}", plan.buffer_size(resource)));
    lines.push(format!("bytes: {}", sizes.join(", ")));
    lines.push(format!("tile: {} elements", plan.tile()));
    assert_block(&lines);
}

#[test]
fn totals() {
    let counts = patch().counts();
    assert_block(&[
        format!("status     {} 0 {} 0 0 0 0 0", counts.points, counts.primitives),
        format!("arguments  {} 1 0 0 0", 3 * counts.primitives),
    ]);
}

#[test]
fn points() {
    let patch = patch();
    let mut lines = Vec::new();
    for (begin, end) in
        [(0, 4), (4, 10), (10, 16), (16, 22), (22, 28), (28, 30), (30, 36), (36, 38), (38, 43)]
    {
        let mut line = format!("{begin:>2}..{end:<2}");
        for point in (begin..end).filter_map(|i| patch.point(i)) {
            _ = write!(line, " {:05x},{:05x}", point.u.to_bits(), point.v.to_bits());
        }
        lines.push(line);
    }
    assert_block(&lines);
    let point = patch.point(31).expect("it has 43");
    let [low, high] = PackedPoint::new(point, 0).0;
    let [u, v] = point.to_f32().map(f32::to_bits);
    assert_block(&[
        format!("point 31  {:05x},{:05x}", point.u.to_bits(), point.v.to_bits()),
        format!("packed    {low:#010x} {high:#010x}"),
        format!("F32       {u:#010x} {v:#010x}"),
    ]);
}

#[test]
fn triangles() {
    let patch = patch();
    let mut lines = Vec::new();
    for (begin, end) in
        [(0, 10), (10, 18), (18, 30), (30, 38), (38, 48), (48, 50), (50, 60), (60, 62)]
    {
        let mut line = format!("{begin:>2}..{end:<2}");
        for t in begin..end {
            let Some(Primitive::Triangle([a, b, c])) = patch.primitive(t) else { panic!("{t}") };
            _ = write!(line, " {a},{b},{c}");
        }
        lines.push(line);
    }
    assert_block(&lines);
}
