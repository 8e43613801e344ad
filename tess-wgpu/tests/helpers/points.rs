//! Tables of points on lines, quads and triangles, and of heights.

use crate::device::{SIZE, heights};
use crate::factors::{number, point};
use crate::{Case, Expected, Table, ULP, args, one, vec};
use glam::{Vec2, Vec3};
use tess_surface::pn::edge_points;
use tess_surface::sides::edge_corners;
use tess_surface::{Address, Curve, Edge, HeightMap, PnCorner, Sides, Surface, SurfacePatch};
use tess_verify::generate::SplitMix64;

/// The error of a position, in ulps of the largest coordinate: a fused operation rounds once, the
/// CPU twice.
const OF_A_POINT: f32 = 8.0;
/// The largest coordinate of a corner.
const SIZE_OF_A_PATCH: f64 = 1.0;

pub(crate) fn tables() -> Vec<Table> {
    vec![
        Table {
            name: "tess_pn_edge_point",
            call: "vec4(tess_pn_edge_point(a[0].xyz, a[1].xyz, a[2].xyz), 0)",
            cases: control_points(),
        },
        Table { name: "tess_along", call: "tess_along(a[0], a[1], a[2].x)", cases: lines() },
        Table {
            name: "tess_on_quad",
            call: "tess_on_quad(array(a[0], a[1], a[2], a[3]), a[4].xy)",
            cases: patches(&Sides::Quad([(); 4])),
        },
        Table {
            name: "tess_on_triangle",
            call: "tess_on_triangle(array(a[0], a[1], a[2]), a[4].xy)",
            cases: patches(&Sides::Triangle([(); 3])),
        },
        Table { name: "edges of tess_on_quad", call: EDGES_OF_QUADS, cases: edges(4) },
        Table { name: "edges of tess_on_triangle", call: EDGES_OF_TRIANGLES, cases: edges(3) },
        Table {
            name: "tess_sample",
            call: "vec4(tess_sample(map, a[0].xy), 0, 0, 0)",
            cases: samples(),
        },
    ]
}

/// Places along an edge, as a tessellator computes them: multiples of 2^-16.
pub(crate) fn places(random: &mut SplitMix64) -> [f32; 6] {
    let part = |parts: u32| parts as f32 / 65536.0;
    let any = part(1 + random.below(65_535));
    [0.0, part(1), any, 0.5, part(65_535), 1.0]
}

fn near(position: Vec3) -> Expected {
    Expected::Near(vec(position, 0.0), OF_A_POINT * ULP)
}

fn lines() -> Vec<Case> {
    let (mut all, mut random) = (Vec::new(), SplitMix64::new(21));
    for number_of in 0..100 {
        let [a, mut b] = [(); 2].map(|()| point(&mut random, SIZE_OF_A_PATCH));
        // Some ends differ only in their later components, or not at all.
        match number_of % 4 {
            1 => b.x = a.x,
            2 => (b.x, b.y) = (a.x, a.y),
            3 if number_of % 8 == 7 => b = a,
            _ => {}
        }
        let edge = Edge::new(Curve::Line([a, b]));
        for t in places(&mut random) {
            let exact =
                [(0.0_f32, a), (1.0, b)].into_iter().find(|&(end, _)| t.to_bits() == end.to_bits());
            let by_cpu =
                exact.map_or(near(edge.position(t)), |(_, end)| Expected::Bits(vec(end, 0.0)));
            let (a, b) = (vec(a, 0.0), vec(b, 0.0));
            all.push(Case { args: args(&[a, b, one(t)]), expected: by_cpu });
            all.push(Case { args: args(&[b, a, one(1.0 - t)]), expected: Expected::AsBefore });
        }
    }
    lines_of_uneven_ends(&mut all, &mut random);
    // The fourth component also decides the direction, and is interpolated.
    for _ in 0..20 {
        let [a, b] = [(); 2].map(|()| [0.3, 0.7, 0.1, number(&mut random, -1.0, 1.0)]);
        for t in places(&mut random) {
            let fourth = a[3] + (b[3] - a[3]) * t;
            let expected = Expected::Near([0.3, 0.7, 0.1, fourth], OF_A_POINT * ULP);
            all.push(Case { args: args(&[a, b, one(t)]), expected });
            all.push(Case { args: args(&[b, a, one(1.0 - t)]), expected: Expected::AsBefore });
        }
    }
    all
}

/// A number of this size with a full significand, of either sign.
fn of_size(random: &mut SplitMix64, size: f32) -> f32 {
    let sign = if random.below(2) == 0 { 1.0 } else { -1.0 };
    sign * size * number(random, 0.5, 1.0)
}

/// The size of the coordinates at the small end of an uneven line.
const SMALL: f32 = 1.0 / 1_048_576.0;

/// Lines between a large and a small end. Their difference is rounded to the large end's unit, so a
/// point near the small end has other bits if it is computed from the large end, whether a device
/// rounds once or twice. That shows the direction, which the components decide one after another.
fn lines_of_uneven_ends(all: &mut Vec<Case>, random: &mut SplitMix64) {
    for number_of in 0..64 {
        let equal = number_of % 4;
        let ends = uneven_ends(random, equal);
        let [a, b] = if number_of % 8 < 4 { ends } else { [ends[1], ends[0]] };
        for t in places(random) {
            let expected = std::array::from_fn(|i| a[i] + (b[i] - a[i]) * t);
            let expected = Expected::Near(expected, OF_A_POINT * ULP);
            all.push(Case { args: args(&[a, b, one(t)]), expected });
            all.push(Case { args: args(&[b, a, one(1.0 - t)]), expected: Expected::AsBefore });
        }
    }
}

/// A large and a small end that differ in all components after the first `equal` ones.
fn uneven_ends(random: &mut SplitMix64, equal: usize) -> [[f32; 4]; 2] {
    let large: [f32; 4] = std::array::from_fn(|_| of_size(random, 1.0));
    let small = std::array::from_fn(|i| if i < equal { large[i] } else { of_size(random, SMALL) });
    [large, small]
}

/// Inner control points of edges. The sums have terms of up to 6, and the quotient by 3 an error
/// of 2.5 ulps.
fn control_points() -> Vec<Case> {
    let mut random = SplitMix64::new(25);
    let case = |_| {
        let [a, b] = [(); 2].map(|()| PnCorner {
            position: point(&mut random, SIZE_OF_A_PATCH),
            normal: (Vec3::Z + point(&mut random, 0.7)).normalize(),
        });
        let [near_a, _] = edge_points(a, b);
        let given = [vec(a.position, 0.0), vec(a.normal, 0.0), vec(b.position, 0.0)];
        Case { args: args(&given), expected: Expected::Near(vec(near_a, 0.0), 16.0 * ULP) }
    };
    (0..100).map(case).collect()
}

/// The domain point on an edge at its running coordinate.
fn on_edge(sides: &Sides<()>, edge: usize, t: f32) -> [f32; 2] {
    match (sides, edge) {
        (_, 0) => [0.0, t],
        (_, 1) => [t, 0.0],
        (Sides::Triangle(_), _) => [t, 1.0 - t],
        (Sides::Quad(_), 2) => [1.0, t],
        (Sides::Quad(_), _) => [t, 1.0],
    }
}

/// A patch with these corners, of which a triangle has three.
fn patch(sides: &Sides<()>, [a, b, c, d]: [Vec3; 4]) -> SurfacePatch {
    SurfacePatch::new(match sides {
        Sides::Triangle(_) => Surface::FlatTriangle([a, b, c]),
        Sides::Quad(_) => Surface::Bilinear([a, b, c, d]),
    })
}

/// Points of the whole domain, compared with the CPU's. Corners are exact.
fn patches(sides: &Sides<()>) -> Vec<Case> {
    let (mut all, mut random) = (Vec::new(), SplitMix64::new(22));
    for _ in 0..30 {
        let corners = [(); 4].map(|()| point(&mut random, SIZE_OF_A_PATCH));
        let patch = patch(sides, corners);
        let mut push = |uv: [f32; 2], expected| {
            let [a, b, c, d] = corners.map(|corner| vec(corner, 0.0));
            let fourth = if sides.as_slice().len() == 4 { d } else { [0.0; 4] };
            all.push(Case { args: [a, b, c, fourth, [uv[0], uv[1], 0.0, 0.0]], expected });
        };
        for (edge, [from, to]) in edge_corners(sides).iter().enumerate() {
            push(on_edge(sides, edge, 0.0), Expected::Bits(vec(corners[*from], 0.0)));
            push(on_edge(sides, edge, 1.0), Expected::Bits(vec(corners[*to], 0.0)));
            for t in places(&mut random) {
                let uv = on_edge(sides, edge, t);
                push(uv, near(patch.position(uv)));
            }
        }
        for _ in 0..10 {
            let [u, v] = [(); 2].map(|()| (1 + random.below(32_766)) as f32 / 65536.0);
            push([u, v], near(patch.position([u, v])));
        }
    }
    all
}

/// A point of a quad where `a[4].w` is 1, or else a point between `a[0]` and `a[1]`.
const EDGES_OF_QUADS: &str = "select(tess_along(a[0], a[1], a[4].z), \
    tess_on_quad(array(a[0], a[1], a[2], a[3]), a[4].xy), a[4].w == 1.0)";
/// The same for triangles.
const EDGES_OF_TRIANGLES: &str = "select(tess_along(a[0], a[1], a[4].z), \
    tess_on_triangle(array(a[0], a[1], a[2]), a[4].xy), a[4].w == 1.0)";

/// The bits of points on an edge depend only on the edge's two ends, in either order, so all
/// patches of the edge agree.
fn edges(corners: usize) -> Vec<Case> {
    let sides = if corners == 4 { Sides::Quad([(); 4]) } else { Sides::Triangle([(); 3]) };
    let (mut all, mut random) = (Vec::new(), SplitMix64::new(23));
    for number_of in 0..60 {
        let corners = corners_of(&mut random, number_of);
        let [a, b, c, d] = corners.map(|corner| vec(corner, 0.25));
        let by_cpu = patch(&sides, corners);
        for (edge, &[from, to]) in edge_corners(&sides).iter().enumerate() {
            let [from, to] = [from, to].map(|corner| vec(corners[corner], 0.25));
            for t in places(&mut random) {
                let uv = on_edge(&sides, edge, t);
                let expected = Expected::Near(vec(by_cpu.position(uv), 0.25), OF_A_POINT * ULP);
                all.push(Case { args: [a, b, c, d, [uv[0], uv[1], 0.0, 1.0]], expected });
                for [one, other, t] in [[from, to, [t; 4]], [to, from, [1.0 - t; 4]]] {
                    let place = [0.0, 0.0, t[0], 0.0];
                    let args = [one, other, [0.0; 4], [0.0; 4], place];
                    all.push(Case { args, expected: Expected::AsBefore });
                }
            }
        }
    }
    all
}

/// Corners of any size, or large and small ones in turn: see [`lines_of_uneven_ends`].
fn corners_of(random: &mut SplitMix64, number_of: usize) -> [Vec3; 4] {
    std::array::from_fn(|corner| match number_of % 3 {
        0 => point(random, SIZE_OF_A_PATCH),
        turn => {
            let size = if (corner + turn).is_multiple_of(2) { 1.0 } else { SMALL };
            Vec3::from_array([(); 3].map(|()| of_size(random, size)))
        }
    })
}

/// The two directions of an uneven line give other bits, with an operation that rounds once and
/// with two that round. So a device of either arithmetic shows which end it began at.
#[test]
#[expect(clippy::disallowed_methods, reason = "the arithmetic of a device that rounds once")]
fn uneven_ends_show_the_direction() {
    let mut random = SplitMix64::new(26);
    for number_of in 0..64 {
        let [large, small] = uneven_ends(&mut random, number_of % 4).map(|end| end[3]);
        let t = 65_535.0 / 65_536.0;
        let [forth, back] = [small - large, large - small];
        let twice = [large + forth * t, small + back * (1.0 - t)];
        let once = [forth.mul_add(t, large), back.mul_add(1.0 - t, small)];
        for [from_large, from_small] in [twice, once] {
            assert_ne!(from_large.to_bits(), from_small.to_bits(), "{large} to {small}");
        }
    }
}

/// Heights at places around multiples of 1/256 of a texel, where interpolation between 8-bit texels
/// is exact, and outside of the image, up to infinity.
fn samples() -> Vec<Case> {
    let [width, height] = SIZE.map(usize::from);
    let map = HeightMap::new(width, height, heights()).expect("as many texels");
    let map = map.with_address(Address::Clamp);
    let size = Vec2::from_array(SIZE.map(f32::from));
    let mut random = SplitMix64::new(24);
    let mut parts =
        vec![[0, 0], [128, 128], [8 * 256 - 128, 4 * 256 - 128], [2048, 1024], [-700, 300]];
    parts.extend([[512, -129], [2300, 1100], [5000, 513], [640, 640], [127, 129]]);
    let any = |random: &mut SplitMix64, most: u32| i32::try_from(random.below(most)).unwrap_or(0);
    parts.extend((0..200).map(|_| [any(&mut random, 2600) - 300, any(&mut random, 1500) - 200]));
    let mut all = Vec::new();
    let mut push = |place: Vec2| {
        let expected = Expected::Bits(one(map.height_at(place)));
        all.push(Case { args: args(&[[place.x, place.y, 0.0, 0.0]]), expected });
    };
    for [x, y] in parts {
        let place = Vec2::new(x as f32, y as f32) / 256.0 / size;
        for off in [0.0, 0.3, -0.3, 0.45, 0.7] {
            push(place + off / 256.0 / size);
        }
    }
    let far = [1e9, -1e9, f32::MAX, f32::MIN, f32::INFINITY, f32::NEG_INFINITY];
    for (x, y) in far.into_iter().flat_map(|x| far.map(|y| (x, y))) {
        push(Vec2::new(x, y));
        push(Vec2::new(x, 0.37));
        push(Vec2::new(0.37, y));
    }
    all
}
