//! A comparison counts only after it has been seen to fail: damaged shaders are noticed.

mod common;

use common::device::Machine;
use common::expected::Expected;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_gpu::Setup;
use tess_gpu::sizes::SHORT_PATCHES;
use tess_verify::random::SplitMix64;
use tess_wgpu::Tessellator;

#[test]
fn planted_faults_are_seen() {
    let mut machine = Machine::open();
    for (domain, partitioning, faults) in FAULTS {
        let config = Config::new(*partitioning, OutputPrimitive::TriangleCw);
        let setup = Setup::new(*domain, config);
        let mut patches = common::patches::random(*domain, 200, &mut SplitMix64::new(5));
        patches.push(PatchFactors::from_fn(*domain, |_| 1.0));
        machine.tessellator = Tessellator::new(&machine.gpu.device);
        let expected = Expected::new(setup, &patches);
        let (points, indices) = expected.words();
        let written = machine.write(setup, &patches, points, indices);
        assert_eq!(expected.compare(&written), Ok(()), "without a fault");
        for &(right, wrong) in *faults {
            machine.plant(setup, right, wrong);
            let written = machine.write(setup, &patches, points, indices);
            assert!(expected.compare(&written).is_err(), "{setup:?}: {wrong} went unnoticed");
        }
    }
}

/// The search for the patch of a tile, which a short batch does without.
#[test]
fn a_tile_of_another_patch_is_seen() {
    let mut machine = Machine::open();
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    let setup = Setup::new(Domain::Quad, config);
    let count = SHORT_PATCHES + 1;
    let patches = common::patches::random(Domain::Quad, count, &mut SplitMix64::new(5));
    let expected = Expected::new(setup, &patches);
    let (points, indices) = expected.words();
    let written = machine.write(setup, &patches, points, indices);
    assert_eq!(expected.compare(&written), Ok(()), "without a fault");
    machine.plant(setup, "return patch_of(clamp(element, begin, end - 1u), kind);", "return 0u;");
    let written = machine.write(setup, &patches, points, indices);
    assert!(expected.compare(&written).is_err(), "the fault went unnoticed");
}

/// Text of a shader and what to put there.
type Fault = (&'static str, &'static str);

const FAULTS: &[(Domain, Partitioning, &[Fault])] = &[
    (
        Domain::Quad,
        Partitioning::FractionalOdd,
        &[
            ("const HALF = 0x8000u;", "const HALF = 0x8001u;"),
            (
                "(fine - coarse) * fraction_of(context)",
                "(fine - coarse) * (fraction_of(context) | 1u)",
            ),
            ("position > split_of(context)", "position >= split_of(context)"),
            ("u <= rings.v && (rings.v & 1u) == 0u", "u <= rings.v && (rings.v & 1u) == 1u"),
            ("2u * first + 2u * quads + 1u", "2u * first + 2u * quads + 2u"),
            ("(steps & 0x100u) != 0u", "(steps & 0x200u) != 0u"),
            (
                "inner_points - 2u * TRANSITION_STRIDE,",
                "inner_points - 2u * TRANSITION_STRIDE + 1u,",
            ),
            ("next * (form - scale * next) <= goal", "next * (form - scale * next) < goal"),
            ("begins[next] <= i32(element)", "begins[next] < i32(element)"),
            ("sums[SIXTEENS + (thread >> 4u)]", "sums[SIXTEENS + (thread >> 5u)]"),
        ],
    ),
    (
        Domain::Triangle,
        Partitioning::FractionalEven,
        &[
            ("const TWO_THIRDS = 0xaaaau;", "const TWO_THIRDS = 0xaaabu;"),
            ("begins[found + 1u] <= i32(element)", "begins[found + 1u] < i32(element)"),
            ("q -= (fixed + 1u) >> 1u;", "q -= fixed >> 1u;"),
            ("descends = edge != 1u;", "descends = edge != 2u;"),
            ("p == half_points", "p == half_points + 1u"),
        ],
    ),
    (
        Domain::Triangle,
        Partitioning::Integer,
        &[
            ("const ONE_THIRD = 0x5555u;", "const ONE_THIRD = 0x5556u;"),
            (
                "return straight(1u, FAN_STITCH, first, first + 2u);",
                "return straight(1u, FAN_STITCH, first, first + 1u);",
            ),
            ("is_last = location.edge + 1u == EDGES", "is_last = location.edge == EDGES"),
            ("factor == ONE && odd == 0u", "factor == ONE && odd == 1u"),
        ],
    ),
    (
        Domain::Quad,
        Partitioning::Pow2,
        &[
            ("edge == EDGES - 1u || walks_back", "edge == EDGES - 1u"),
            ("points >> 1u, walks_back", "points, walks_back"),
            ("select(x, ONE - x, position > mirror)", "x"),
            ("select(location, HALF, position == mirror)", "location"),
            ("k == end);", "k > end);"),
            ("select(0u, 1u, rings.u > rings.v)", "select(0u, 1u, rings.u < rings.v)"),
            ("number == 1u || number == 2u", "number == 1u || number == 3u"),
        ],
    ),
    (
        Domain::Isoline,
        Partitioning::FractionalOdd,
        &[("t / (outer_points(topology, 1u) - 1u)", "t / outer_points(topology, 1u)")],
    ),
];
