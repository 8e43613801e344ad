//! The worked numbers in the heads of the shaders: computed here from the golden model, and each
//! line found in its file, so that none of them becomes stale. The patch is the one of
//! docs/tour-gpu.md.

use tess_core::place::place;
use tess_core::{
    Config, Domain, OutputPrimitive, Partitioning, Patch, PatchFactors, PointOrigin, Primitive,
    PrimitiveOrigin, ProcessedFactor, QuadFactors, fixed_point,
};
use tess_gpu::layout::{Topology, pack_context};
use tess_gpu::{Capacity, Limits, Plan, Setup};

const CONFIG: Config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);

fn patch() -> Patch {
    let factors: QuadFactors = [3.0, 4.5, 5.0, 6.0, 4.0, 7.0].into();
    Patch::new(CONFIG, factors)
}

/// Its six factors after processing.
fn factors() -> [ProcessedFactor; 6] {
    match patch().processed().factors() {
        Some(&PatchFactors::Quad(factors)) => factors.into(),
        other => panic!("a quad is a quad: {other:?}"),
    }
}

/// Its topology, packed as in layout/topology.wgsl.
fn topology() -> Topology {
    let points = factors().map(|factor| factor.context.points);
    let outer = (0..4).fold(0, |word, edge| word | points[edge] << (7 * edge));
    Topology([outer | 2 << 28, points[4] | points[5] << 7])
}

/// The shader contains every line.
fn assert_lines(file: &str, lines: &[String]) {
    let path = format!("{}/shaders/{file}.wgsl", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).expect(&path);
    for line in lines {
        assert!(text.contains(&format!("//   {line}\n")), "{file}.wgsl lacks the line {line:?}");
    }
}

#[test]
fn topology_and_key() {
    let topology = topology();
    let points = [0, 1, 2, 3].map(|edge| topology.outer_points(edge));
    let [u, v] = topology.inside_points();
    let [low, high] = topology.0;
    assert_lines(
        "layout/topology",
        &[
            format!(
                "outer points {points:?}, inside points [{u}, {v}], state {}",
                topology.state()
            ),
            format!("words {low:#010x} {high:#010x}"),
        ],
    );
    let edges = (0..4).fold(0, |key, edge| key | (points[edge] - 2) << (5 * edge));
    let key = edges | (u - 2) << 20 | (v - 2) << 25 | topology.state() << 30;
    let slot = key.wrapping_mul(0x9e37_79b9) >> (32 - 13);
    assert_lines(
        "shared/catalogue",
        &[format!("key {key:#010x}, first slot tried {slot} of 8192")],
    );
}

#[test]
fn contexts() {
    let lines: Vec<String> = factors()
        .iter()
        .zip(["3  ", "4.5", "5  ", "6  ", "4  ", "7  "])
        .map(|(factor, raw)| {
            let c = factor.context;
            let [low, high] = pack_context(&c);
            format!(
                "{raw} half_points {} split {} inv_floor {:5} inv_ceil {:5} fraction {:5}: {low:#010x} {high:#010x}",
                c.half_points, c.split_position, c.inv_floor, c.inv_ceil, c.fraction
            )
        })
        .collect();
    assert_lines("layout/packed_context", &lines);
}

/// Point 31.
#[test]
fn a_point() {
    let patch = patch();
    let Some(PointOrigin::Ring { ring, edge, p }) = patch.locate_point(31) else {
        panic!("it lies on a ring");
    };
    assert_eq!((ring, edge, p), (1, 2, 1), "shared/described.wgsl names these");
    let [along_u, along_v] = [factors()[4].context, factors()[5].context];
    let (fixed, q) =
        (0x1_0000 - place(&along_u, ring).to_bits(), place(&along_v, ring + p).to_bits());
    let point = patch.point(31).expect("it has 43");
    assert_eq!((fixed, q), (point.u.to_bits(), point.v.to_bits()), "the run places it");
    assert_lines(
        "stages/points",
        &[
            format!("point 31: ring {ring}, edge {edge}, step {p}"),
            format!("fixed {:#x} - {:#x} = {fixed:#x}, q {q:#x}", 0x1_0000, 0x1_0000 - fixed),
        ],
    );
    let described = 5 | 4 << 3 | (ring + p) << 6 | ring << 13 | 1 << 20;
    assert_lines("shared/described", &[format!("point 31: {described:#010x}")]);
}

/// Triangle 40.
#[test]
fn a_triangle() {
    let patch = patch();
    let Some(PrimitiveOrigin::Ring { ring, edge, step }) = patch.locate_primitive(40) else {
        panic!("it lies between rings");
    };
    let Some(Primitive::Triangle(vertices)) = patch.primitive(40) else { panic!("a triangle") };
    let position = patch.cache_position(40).expect("it has 62");
    assert_lines(
        "stages/connect",
        &[format!("triangle 40: ring {ring}, edge {edge}, step {step}, vertices {vertices:?}")],
    );
    assert_lines(
        "stages/cache_order",
        &[format!(
            "triangle {position} here is triangle 40 of the specification: ring {ring}, edge {edge}, step {step}"
        )],
    );
}

/// Three such patches.
#[test]
fn three_patches() {
    let counts = patch().counts();
    let (points, triangles) = (counts.points, counts.primitives);
    let begins = [0, points, 2 * points];
    let element = 50;
    let (number, point) = (element / points, element % points);
    assert_lines(
        "shared/expand",
        &[format!("begins {begins:?}: element {element} is point {point} of patch {number}")],
    );
    let (inverse, position) = (inverse_of(triangles), 100);
    let number = (position * inverse) >> 21;
    let triangle = position - number * triangles;
    assert_lines(
        "shared/alike",
        &[format!(
            "size {triangles}, inverse {inverse}: position {position} is triangle {triangle} of patch {number}"
        )],
    );
    let room = Capacity { points: 3 * points, primitives: 3 * triangles };
    let plan = Plan::new(Setup::new(Domain::Quad, CONFIG), 3, room, Limits::WEBGPU);
    assert!(plan.is_short(), "{plan:?}");
    let first_in = |tile: u32| (0..3).find(|&patch| (patch + 1) * points > tile * plan.tile());
    let tiles: Vec<u32> = (0..).map_while(first_in).collect();
    let (end, last) = (3 * points, 2);
    assert_lines(
        "entry_points/short_batch",
        &[format!(
            "points begin at {begins:?}, end at {end}; tiles of points {tiles:?}, then {last} for the last point"
        )],
    );
}

/// The inverse that `repeat_of` computes.
fn inverse_of(size: u32) -> u32 {
    (0x1f_ffff + size) / size
}

/// The claim of shared/alike.wgsl and src/sizes.rs: the multiplication divides exactly and does not
/// overflow.
#[test]
fn divisions_by_an_inverse_are_exact() {
    for size in 1_u32..=640 {
        for position in 0..=2046 + size {
            let product = position.checked_mul(inverse_of(size));
            assert_eq!(product.map(|it| it >> 21), Some(position / size), "{position} / {size}");
        }
    }
}

/// Constants that the shaders have as numbers are those of the model.
#[test]
fn constants_are_those_of_the_model() {
    let bits = |value: f32| value.to_bits();
    let own = [
        ("stages/d3d_float", "INFINITY", bits(f32::INFINITY)),
        ("stages/factors", "BITS_1", bits(1.0)),
        ("stages/factors", "BITS_2", bits(2.0)),
        ("stages/factors", "BITS_63", bits(63.0)),
        ("stages/factors", "BITS_64", bits(64.0)),
        ("stages/factors", "BITS_1_PLUS_2_POW_MINUS_17", bits(1.0) + (1 << (23 - 17))),
        ("stages/factors", "BITS_1_PLUS_2_POW_MINUS_16", bits(1.0) + (1 << (23 - 16))),
        ("stages/fixed_point", "ONE", fixed_point::ONE),
        ("stages/fixed_point", "HALF", fixed_point::HALF),
        ("stages/fixed_point", "ONE_THIRD", fixed_point::ONE_THIRD),
        ("stages/fixed_point", "TWO_THIRDS", fixed_point::TWO_THIRDS),
    ];
    for (file, name, value) in own {
        let path = format!("{}/shaders/{file}.wgsl", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).expect(&path);
        let line = format!("const {name} = ");
        let found = text.lines().find_map(|it| Some(it.strip_prefix(&line)?.split_once("u;")?.0));
        let found =
            found.and_then(|hex| u32::from_str_radix(hex.trim_start_matches("0x"), 16).ok());
        assert_eq!(found, Some(value), "{name} of {file}.wgsl");
    }
    for partitioning in Partitioning::ALL {
        let (low, high) = partitioning.range();
        let bounds = [1.0, 2.0, 63.0, 64.0].map(bits);
        assert!(bounds.contains(&bits(low)) && bounds.contains(&bits(high)), "{partitioning:?}");
    }
}
