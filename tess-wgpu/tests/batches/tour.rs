//! The numbers of docs/tour-gpu.md as a device writes them; tess-gpu/tests/tour.rs computes the
//! same from the model.

use crate::common::device::Machine;
use crate::common::expected::Expected;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, QuadFactors};
use tess_gpu::layout::PackedPoint;
use tess_gpu::{Setup, Stage};

/// The tour contains a block of words unchanged.
fn assert_words(name: &str, words: &[u32]) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/tour-gpu.md");
    let tour = std::fs::read_to_string(path).expect(path);
    let hexadecimal: Vec<String> = words.iter().map(|word| format!("{word:#010x}")).collect();
    let decimal: Vec<String> = words.iter().map(u32::to_string).collect();
    let forms = [hexadecimal, decimal].map(|form| form.join(" "));
    let is_there = |line: &str| {
        let words = line.split_once("  ").map(|(_, words)| words.trim_start());
        line.trim_start().starts_with(name)
            && words.is_some_and(|own| forms.iter().any(|form| own.ends_with(form)))
    };
    assert!(tour.lines().any(is_there), "docs/tour-gpu.md has no line {name} with {forms:?}");
}

#[test]
fn the_tour_is_what_a_device_writes() {
    let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
    let setup = Setup::new(Domain::Quad, config);
    let patches = [QuadFactors::from([3.0, 4.5, 5.0, 6.0, 4.0, 7.0]).into()];
    let mut machine = Machine::open();
    let expected = Expected::new(setup, &patches);
    let (point_words, index_words) = expected.words();
    let (batch, [points, indices]) = machine.batch(setup, &patches, [point_words, index_words]);
    let stages: Vec<_> = batch.plan().dispatches().map(|dispatch| dispatch.stage()).collect();
    assert_eq!(stages, [Stage::Short, Stage::ExpandShort], "section 2");
    machine.run(&batch);
    assert_words("topology", &machine.words(batch.topologies())[..2]);
    let contexts = machine.words(batch.contexts());
    for (k, name) in QuadFactors::<f32>::NAMES.into_iter().enumerate() {
        let at = 2 * k * batch.plan().portion_patches() as usize;
        assert_words(name, &contexts[at..at + 2]);
    }
    assert_words("status", &machine.words(batch.status())[..8]);
    assert_words("arguments", &machine.words(batch.draw_arguments())[..5]);
    let (points, indices) = (machine.words(&points), machine.words(&indices));
    assert_words("packed", &points[62..64]);
    let runs =
        [(0, 4), (4, 10), (10, 16), (16, 22), (22, 28), (28, 30), (30, 36), (36, 38), (38, 43)];
    for (begin, end) in runs {
        let pairs: Vec<String> = points[2 * begin..2 * end]
            .as_chunks()
            .0
            .iter()
            .map(|&words| PackedPoint(words).point())
            .map(|point| format!("{:05x},{:05x}", point.u.to_bits(), point.v.to_bits()))
            .collect();
        assert_line(begin, end, &pairs);
    }
    for (begin, end) in
        [(0, 10), (10, 18), (18, 30), (30, 38), (38, 48), (48, 50), (50, 60), (60, 62)]
    {
        let triangles: Vec<String> = indices[3 * begin..3 * end]
            .as_chunks()
            .0
            .iter()
            .map(|[a, b, c]| format!("{a},{b},{c}"))
            .collect();
        assert_line(begin, end, &triangles);
    }
}

/// The tour contains a line of points or triangles.
fn assert_line(begin: usize, end: usize, items: &[String]) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/tour-gpu.md");
    let tour = std::fs::read_to_string(path).expect(path);
    let line = format!("    {begin:>2}..{end:<2} {}", items.join(" "));
    assert!(tour.lines().any(|other| other == line), "docs/tour-gpu.md lacks {line:?}");
}
