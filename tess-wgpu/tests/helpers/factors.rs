//! Tables of factor rules.

use crate::{Args, Case, Expected, Table, ULP, args, one, vec};
use glam::{Vec3, Vec4};
use tess_surface::{Curve, Edge, FactorRule, PnCorner, factors, pn};
use tess_verify::generate::SplitMix64;

/// The error of a quotient, in ulps: WGSL allows 2.5 for a division.
const OF_A_QUOTIENT: f32 = 3.0;
/// The error of a quotient's root: half of the quotient's, plus 2 of `inverseSqrt` and 2.5 of a
/// division, from which WGSL may compute the root.
const OF_A_ROOT: f32 = 7.0;
/// The error of a rule: a dot product, two roots, a division and some products, each within 5 ulps.
const OF_A_RULE: f32 = 32.0;

pub(crate) fn tables() -> Vec<Table> {
    [ranges_and_quotients(), of_edges(), of_insides(), of_cubics()].into_iter().flatten().collect()
}

fn ranges_and_quotients() -> Vec<Table> {
    let two = |name, call, function: fn(f32, f32) -> f32, ulps| {
        let of = |[a, b]: [f32; 2]| case([[a, b, 0.0, 0.0]], near(function(a, b), ulps));
        Table { name, call, cases: ratios().into_iter().map(of).collect() }
    };
    vec![
        Table {
            name: "tess_clamp_factor",
            call: "vec4(tess_clamp_factor(a[0].x), 0, 0, 0)",
            cases: ranges(),
        },
        two(
            "tess_quotient",
            "vec4(tess_quotient(a[0].x, a[0].y), 0, 0, 0)",
            factors::quotient,
            OF_A_QUOTIENT,
        ),
        two(
            "tess_root_quotient",
            "vec4(tess_root_quotient(a[0].x, a[0].y), 0, 0, 0)",
            factors::root_quotient,
            OF_A_ROOT,
        ),
    ]
}

fn of_edges() -> Vec<Table> {
    vec![
        Table {
            name: "tess_edge_by_screen_size",
            call: "vec4(tess_edge_by_screen_size(a[0].xyz, a[1].xyz, a[2].xyz, a[3].x, a[3].y), 0, 0, 0)",
            cases: by_screen_size(),
        },
        Table {
            name: "tess_edge_by_length",
            call: "vec4(tess_edge_by_length(a[0].xyz, a[1].xyz, a[2].x, a[2].y), 0, 0, 0)",
            cases: by_length(),
        },
        Table {
            name: "tess_at_most",
            call: "vec4(tess_at_most(a[0].x, a[0].y), 0, 0, 0)",
            cases: at_most(),
        },
        Table {
            name: "tess_edge_by_distance",
            call: "vec4(tess_edge_by_distance(a[0].xyz, a[1].xyz, a[2].xyz, a[3].x), 0, 0, 0)",
            cases: by_distance(),
        },
        Table {
            name: "tess_edge_by_curvature",
            call: "vec4(tess_edge_by_curvature(a[0].xyz, a[1].xyz, a[2].xyz, a[3].xyz, a[4].x), 0, 0, 0)",
            cases: by_curvature(),
        },
        Table {
            name: "tess_edge_by_flatness",
            call: "vec4(tess_edge_by_flatness(a[0].x, a[0].y), 0, 0, 0)",
            cases: by_flatness(),
        },
        Table {
            name: "tess_edge_beside_halves",
            call: "vec4(tess_edge_beside_halves(a[0].x), 0, 0)",
            cases: beside_halves(),
        },
    ]
}

fn of_insides() -> Vec<Table> {
    vec![
        Table {
            name: "edges of tess_quad_factors",
            call: "tess_quad_factors(a[0]).edges",
            cases: quads(|e| e),
        },
        Table {
            name: "tess_quad_factors",
            call: "vec4(tess_quad_factors(a[0]).inside, 0, 0)",
            cases: quads(|edges| {
                let [u, v] = factors::inside_quad(edges);
                [u, v, 0.0, 0.0]
            }),
        },
        Table {
            name: "tess_tri_factors",
            call: "vec4(tess_tri_factors(a[0].xyz).edges, tess_tri_factors(a[0].xyz).inside)",
            cases: triangles(),
        },
    ]
}

fn of_cubics() -> Vec<Table> {
    vec![
        Table {
            name: "bezier_edge_by_distance",
            call: "vec4(bezier_edge_by_distance(array<vec4f, 4>(a[0], a[1], a[2], a[3]), a[4].xyz, 20.0), 0, 0, 0)",
            cases: cubics(|eye| FactorRule::Distance { eye, scale: 20.0 }),
        },
        Table {
            name: "bezier_edge_by_screen_size",
            call: "vec4(bezier_edge_by_screen_size(array<vec4f, 4>(a[0], a[1], a[2], a[3]), a[4].xyz, 100.0, 5.0), 0, 0, 0)",
            cases: cubics(|eye| FactorRule::ScreenSize {
                eye,
                pixels_per_unit: 100.0,
                segment: 5.0,
            }),
        },
    ]
}

fn case(given: impl AsRef<[[f32; 4]]>, expected: Expected) -> Case {
    Case { args: args(given.as_ref()), expected }
}

/// A factor within this many ulps. The ends of the range are exact.
fn near(factor: f32, ulps: f32) -> Expected {
    if factor > 1.0 && factor < 64.0 {
        Expected::Near(one(factor), ulps * 2.0 * ULP * factor)
    } else {
        Expected::Bits(one(factor))
    }
}

/// A number from `low` up to `high`.
#[expect(clippy::cast_possible_truncation, reason = "it is rounded")]
pub(crate) fn number(random: &mut SplitMix64, low: f64, high: f64) -> f32 {
    let part = f64::from(random.below(1 << 24)) / f64::from(1 << 24);
    (low + (high - low) * part) as f32
}

/// A point within `size` of 0 along each axis.
pub(crate) fn point(random: &mut SplitMix64, size: f64) -> Vec3 {
    Vec3::from_array([0; 3].map(|_| number(random, -size, size)))
}

fn ranges() -> Vec<Case> {
    let [one_bits, most] = [1.0_f32, 64.0].map(f32::to_bits);
    let around =
        [one_bits - 1, one_bits, one_bits + 1, most - 1, most, most + 1].map(f32::from_bits);
    let others =
        [f32::NAN, f32::NEG_INFINITY, -3.0, 0.0, 0.5, 1.5, 2.5, 63.5, 65.0, 1e30, f32::INFINITY];
    let all = around.into_iter().chain(others);
    all.map(|x| case([one(x)], Expected::Bits(one(factors::clamp_factor(x))))).collect()
}

/// Dividends and divisors with quotients of all sizes, and those of 0.
fn ratios() -> Vec<[f32; 2]> {
    let mut all = vec![
        [0.0, 0.0],
        [5.0, 0.0],
        [1e-30, 0.0],
        [-1.0, 0.0],
        [-1.0, 2.0],
        [3.0, -2.0],
        [-3.0, -2.0],
        [f32::NAN, 1.0],
        [1.0, f32::NAN],
        [64.0, 1.0],
        [63.999, 1.0],
        [1.0, 1.0],
        [1.001, 1.0],
        [4096.0, 1.0],
        [4095.0, 1.0],
        [1e30, 1e-30],
        [1e-5, 1e-6],
        [3e-4, 1e-5],
    ];
    let mut random = SplitMix64::new(1);
    for _ in 0..300 {
        let divisor = number(&mut random, 1e-3, 10.0);
        all.push([divisor * number(&mut random, 0.5, 70.0), divisor]);
        all.push([divisor * number(&mut random, 64.0, 5000.0), divisor]);
    }
    all
}

/// Each case, and the same from the other end of the edge.
fn both_ways(all: &mut Vec<Case>, [one, other]: [Args; 2], factor: f32, ulps: f32) {
    all.push(Case { args: one, expected: near(factor, ulps) });
    all.push(Case { args: other, expected: Expected::AsBefore });
}

fn by_screen_size() -> Vec<Case> {
    let (mut all, mut random) = (Vec::new(), SplitMix64::new(2));
    for _ in 0..200 {
        let [a, b] = [(); 2].map(|()| point(&mut random, 1.0));
        let eye = point(&mut random, 4.0);
        let (unit, segment) = (number(&mut random, 50.0, 900.0), number(&mut random, 2.0, 30.0));
        let factor = factors::edge_by_screen_size([a, b], eye, unit, segment);
        let rest = [vec(eye, 0.0), [unit, segment, 0.0, 0.0]];
        let ways =
            [[a, b], [b, a]].map(|[a, b]| args(&[vec(a, 0.0), vec(b, 0.0), rest[0], rest[1]]));
        both_ways(&mut all, ways, factor, OF_A_RULE);
    }
    // The eye in the middle of the edge, and an edge without length there.
    for (b, factor) in [(Vec3::new(0.5, 0.25, -0.25), 64.0), (-Vec3::X, 1.0)] {
        let (a, rest) = (-Vec3::X, [vec((b - Vec3::X) * 0.5, 0.0), [100.0, 5.0, 0.0, 0.0]]);
        let given = args(&[vec(a, 0.0), vec(b, 0.0), rest[0], rest[1]]);
        all.push(Case { args: given, expected: Expected::Bits(one(factor)) });
    }
    all
}

fn by_length() -> Vec<Case> {
    let (mut all, mut random) = (Vec::new(), SplitMix64::new(12));
    for _ in 0..200 {
        let [a, b] = [(); 2].map(|()| point(&mut random, 1.0));
        let (unit, segment) = (number(&mut random, 50.0, 900.0), number(&mut random, 2.0, 30.0));
        let factor = factors::edge_by_length([a, b], unit, segment);
        let rest = [unit, segment, 0.0, 0.0];
        let ways = [[a, b], [b, a]].map(|[a, b]| args(&[vec(a, 0.0), vec(b, 0.0), rest]));
        both_ways(&mut all, ways, factor, OF_A_RULE);
    }
    all
}

fn at_most() -> Vec<Case> {
    let all = [0.0, -1.0, 0.5, 1.0, 3.5, 15.999_999, 16.0, 16.000_002, 17.0, 64.0, 65.0, 1e30];
    let case = |factor: f32| Case {
        args: args(&[[factor, 16.0, 0.0, 0.0]]),
        expected: Expected::Bits(one(factors::at_most(factor, 16.0))),
    };
    all.map(case).into()
}

fn by_distance() -> Vec<Case> {
    let (mut all, mut random) = (Vec::new(), SplitMix64::new(3));
    for number_of in 0..200 {
        // Every second case is in a model whose units are ten million times as small.
        let size = if number_of % 2 == 0 { 1.0 } else { 1e-7 };
        let [a, b] = [(); 2].map(|()| point(&mut random, size));
        let eye = point(&mut random, 4.0 * size);
        let scale = number(&mut random, size, 60.0 * size);
        let factor = factors::edge_by_distance([a, b], eye, scale);
        let ways = [[a, b], [b, a]]
            .map(|[a, b]| args(&[vec(a, 0.0), vec(b, 0.0), vec(eye, 0.0), one(scale)]));
        both_ways(&mut all, ways, factor, OF_A_RULE);
    }
    let at_the_eye = args(&[vec(Vec3::X, 0.0), vec(-Vec3::X, 0.0), [0.0; 4], one(2.0)]);
    all.push(Case { args: at_the_eye, expected: Expected::Bits(one(64.0)) });
    all
}

fn by_curvature() -> Vec<Case> {
    let (mut all, mut random) = (Vec::new(), SplitMix64::new(4));
    for _ in 0..200 {
        let [a, b] = [(); 2].map(|()| PnCorner {
            position: point(&mut random, 1.0),
            normal: (Vec3::Z + point(&mut random, 0.7)).normalize(),
        });
        let tolerance = number(&mut random, 1e-4, 3e-2);
        let factor = factors::edge_by_curvature([a, b], tolerance);
        // The bend is a difference of positions of up to 1.8, each with an error of some ulps.
        let ulps = OF_A_RULE + 8.0 * 1.8 / pn::edge_bend([a, b]);
        let ways = [[a, b], [b, a]].map(|corners| {
            let [[p, n], [q, m]] = corners.map(|c| [vec(c.position, 0.0), vec(c.normal, 0.0)]);
            args(&[p, n, q, m, one(tolerance)])
        });
        both_ways(&mut all, ways, factor, ulps);
    }
    // A straight edge.
    let straight = args(&[
        vec(-Vec3::X, 0.0),
        vec(Vec3::Z, 0.0),
        vec(Vec3::X, 0.0),
        vec(Vec3::Z, 0.0),
        one(1e-4),
    ]);
    all.push(Case { args: straight, expected: Expected::Bits(one(1.0)) });
    all
}

fn by_flatness() -> Vec<Case> {
    let mut random = SplitMix64::new(5);
    let mut given =
        vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [8.0, 0.02], [1e9, 1e-9], [-1.0, 1.0], [4.0, 1.0]];
    given
        .extend((0..200).map(|_| [number(&mut random, 0.0, 60.0), number(&mut random, 1e-3, 1.0)]));
    // Powers of two: on another device, a factor on a limit may be the next one, so no case is on a
    // limit.
    let case = |[bend, tolerance]: [f32; 2]| {
        let factor = factors::edge_by_flatness(bend, tolerance);
        case([[bend, tolerance, 0.0, 0.0]], Expected::Bits(one(factor)))
    };
    given.into_iter().map(case).collect()
}

fn beside_halves() -> Vec<Case> {
    let mut given = vec![-1.0, 0.0, 1.0, 63.9, 64.0, 1e9];
    for power in [1.0f32, 2.0, 4.0, 8.0, 16.0, 32.0] {
        given.extend([power.next_down(), power, power.next_up()]);
    }
    let case = |factor: f32| {
        let [whole, half] = factors::edge_beside_halves(factor);
        case([one(factor)], Expected::Bits([whole, half, 0.0, 0.0]))
    };
    given.into_iter().map(case).collect()
}

/// Factors of edges: integers, fractions, and equal ones.
fn edges() -> Vec<[f32; 4]> {
    let mut random = SplitMix64::new(6);
    // Three times this number is halfway between two floats.
    let awkward = f32::from_bits(1.5_f32.to_bits() + 2);
    let equal = [1.0, 3.0, 5.3, 63.7, 64.0, awkward].map(|factor| [factor; 4]);
    let mut all = vec![[1.0, 2.0, 4.0, 8.0], [64.0, 1.0, 1.0, 1.0], [1.0, 64.0, 64.0, 1.0]];
    all.extend(equal);
    all.extend((0..100).map(|_| [0; 4].map(|_| number(&mut random, 1.0, 64.0))));
    all
}

fn quads(of: fn([f32; 4]) -> [f32; 4]) -> Vec<Case> {
    edges().into_iter().map(|edges| case([edges], Expected::Bits(of(edges)))).collect()
}

fn triangles() -> Vec<Case> {
    let case = |[u, v, w, _]: [f32; 4]| {
        let inside = factors::inside_triangle([u, v, w]);
        let expected = [u, v, w, inside];
        let is_equal = u.to_bits() == v.to_bits() && v.to_bits() == w.to_bits();
        // The quotient of up to 63 has an error of 3 ulps.
        let near = Expected::Near(expected, OF_A_QUOTIENT * 64.0 * ULP);
        case([[u, v, w, 0.0]], if is_equal { Expected::Bits(expected) } else { near })
    };
    edges().into_iter().map(case).collect()
}

fn cubics(rule: fn(Vec3) -> FactorRule) -> Vec<Case> {
    let (mut all, mut random) = (Vec::new(), SplitMix64::new(7));
    for _ in 0..100 {
        let eye = point(&mut random, 4.0);
        let net = [(); 4].map(|()| {
            let weight = number(&mut random, 0.5, 2.0);
            (point(&mut random, 1.0) * weight).extend(weight)
        });
        let factor = rule(eye).edge(&Edge::new(Curve::Cubic(net)).curve, 0.0);
        let ways = [net, [net[3], net[2], net[1], net[0]]].map(|net| {
            let [a, b, c, d] = net.map(|point: Vec4| point.to_array());
            [a, b, c, d, vec(eye, 0.0)]
        });
        both_ways(&mut all, ways, factor, OF_A_RULE);
    }
    all
}
