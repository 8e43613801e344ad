//! The expected results of JavaScript's factor rules: `bindings/webgpu/factors.json`, which
//! `bindings/webgpu/try.mjs` compares with `factors.js`.

use glam::Vec3;
use std::fmt::Write as _;
use std::path::Path;
use tess_surface::factors::{
    at_most, clamp_factor, edge_beside_halves, edge_by_distance, edge_by_length,
    edge_by_screen_size, inside_quad, inside_triangle,
};
use tess_verify::generate::SplitMix64;

/// Distances that are 0, equal, tiny and huge, so that results are clamped at both ends; and those
/// that a page should not pass, a negative one and a NaN.
const SCALES: [f32; 10] = [0.0, 1e-30, 0.01, 0.7, 1.0, 5.3, 900.0, f32::INFINITY, -1.3, f32::NAN];

/// A row for each call: the function's name, its arguments and its results, all as bits.
fn table() -> String {
    let mut random = SplitMix64::new(53);
    let mut scale = |_| SCALES[(random.next_u64() % 10) as usize];
    let mut rows = Vec::new();
    let mut row = |name, arguments: &[&[f32]], results: &[f32]| {
        let bits = |numbers: &[f32]| numbers.iter().map(|number| number.to_bits()).collect();
        let arguments: Vec<Vec<u32>> = arguments.iter().map(|numbers| bits(numbers)).collect();
        let results: Vec<u32> = bits(results);
        rows.push(format!("[\"{name}\", {arguments:?}, {results:?}]"));
    };
    let mut place = SplitMix64::new(54);
    // Full significands: each step of a rule rounds, so the order of its steps shows.
    let mut number = || f32::from_bits(0x4080_0000 | place.next_u32() & 0x807F_FFFF);
    for i in 0..240 {
        let [a, b, eye] = [0; 3].map(|_| Vec3::from_array([0; 3].map(|_| number())));
        // Every tenth edge is a point at the eye; some of those are so far away that sums overflow.
        let a = if i % 40 == 0 { a * 4e37 } else { a };
        let (b, eye) = if i % 10 == 0 { (a, a) } else { (b, eye) };
        let points = [a, b, eye].map(|point| point.to_array());
        let [pixels, segment, most] = [0; 3].map(&mut scale);
        let edge = [&points[0][..], &points[1]];
        let seen = [edge[0], edge[1], &points[2]];
        let screen = edge_by_screen_size([a, b], eye, pixels, segment);
        row("edgeByScreenSize", &[&seen[..], &[&[pixels], &[segment]]].concat(), &[screen]);
        let length = edge_by_length([a, b], pixels, segment);
        row("edgeByLength", &[&edge[..], &[&[pixels], &[segment]]].concat(), &[length]);
        let distance = edge_by_distance([a, b], eye, pixels);
        row("edgeByDistance", &[&seen[..], &[&[pixels]]].concat(), &[distance]);
        for [factor, most] in [[length, most], [most, length], [pixels, most]] {
            row("atMost", &[&[factor], &[most]], &[at_most(factor, most)]);
        }
        let edges = [screen, length, distance, number().abs()];
        row("insideQuad", &[&edges], &inside_quad(edges));
        let three = [screen, length, edges[3]];
        row("insideTriangle", &[&three], &[inside_triangle(three)]);
    }
    let awkward = [f32::NAN, f32::NEG_INFINITY, -1.0, 0.0, 1.0f32.next_up(), 32.0f32.next_up()];
    for factor in awkward.into_iter().chain(SCALES) {
        row("clampFactor", &[&[factor]], &[clamp_factor(factor)]);
        row("edgeBesideHalves", &[&[factor]], &edge_beside_halves(factor));
    }
    let mut text = String::from("[\n");
    // Writing to a String cannot fail.
    _ = write!(text, "{}", rows.join(",\n"));
    text + "\n]\n"
}

/// Compares the table, or writes it if `TESS_BLESS` is set.
#[test]
fn the_recorded_table_is_of_these_functions() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../bindings/webgpu/factors.json");
    let table = table();
    if std::env::var_os("TESS_BLESS").is_some() {
        std::fs::write(&file, &table).expect("the table can be written");
    }
    let recorded = std::fs::read_to_string(&file).expect("bindings/webgpu/factors.json");
    assert!(recorded == table, "factors.json is stale: run this test with TESS_BLESS=1");
}
