//! Tables of cubic edges and of patches' normals.

use crate::factors::{number, point};
use crate::points::places;
use crate::{Case, Expected, Table, ULP, args, one, vec};
use glam::Vec4;
use std::sync::LazyLock;
use tess_surface::{Curve, Edge, teapot};
use tess_verify::generate::SplitMix64;

/// Patches of the teapot's knob and bottom: their edges v = 0 are collapsed.
const COLLAPSED: [usize; 2] = [20, 28];
/// The greatest error of a normal on a collapsed edge, in radians: 0.03 degrees.
const OF_A_LIMIT: f32 = 5e-4;

/// The normal of a patch, by its number, at a place.
static NORMAL: LazyLock<String> = LazyLock::new(|| {
    let net = |number: usize| {
        let net = teapot::patches()[number].points;
        let points = net.as_flattened().iter().map(|point| format!("vec4f{:?}", point.to_array()));
        points.collect::<Vec<_>>().join(", ").replace('[', "(").replace(']', ")")
    };
    let [knob, bottom] = COLLAPSED.map(|number| {
        format!("bezier_patch_normal(array<vec4f, 16>({}), a[0].x, a[0].y)", net(number))
    });
    format!("vec4(select({knob}, {bottom}, a[0].z == 1.0), 0)")
});

pub(crate) fn tables() -> Vec<Table> {
    vec![
        Table {
            name: "bezier_edge",
            call: "vec4(bezier_edge(array<vec4f, 4>(a[0], a[1], a[2], a[3]), a[4].x), 0)",
            cases: edges(),
        },
        Table { name: "bezier_patch_normal", call: &NORMAL, cases: normals() },
    ]
}

/// Curves of every kind: plain, turning back on themselves, collapsed to a point, and equal only at
/// both ends.
fn curve(kind: usize, random: &mut SplitMix64) -> [Vec4; 4] {
    let [a, b, c, d] = [(); 4].map(|()| point(random, 1.0));
    let points = match kind {
        0 => [a, b, c, d],
        1 => [a, b, b, a],
        2 => [a; 4],
        _ => [a, b, c, a],
    };
    let weights = match kind {
        1 => [1.0; 4],
        // Powers of two, so that the points of a collapsed edge are equal.
        2 => [(); 4].map(|()| [0.5, 1.0, 2.0, 4.0][random.below(4) as usize]),
        _ => [(); 4].map(|()| number(random, 0.5, 2.0)),
    };
    std::array::from_fn(|i| (points[i] * weights[i]).extend(weights[i]))
}

/// Points of edges are near the CPU's, and have the same bits from the other side.
fn edges() -> Vec<Case> {
    let (mut all, mut random) = (Vec::new(), SplitMix64::new(31));
    let axis = [0.0, 0.7, 0.7, 0.0].map(|x| Vec4::new(x, x, x, 1.0));
    let curves = (0..200).map(|i| curve(i % 4, &mut random)).chain([axis]).collect::<Vec<_>>();
    for net in curves {
        let edge = Edge::new(Curve::Cubic(net));
        for t in places(&mut random).into_iter().chain([1.0 / 64.0, 63.0 / 64.0]) {
            let by_cpu = vec(edge.position(t), 0.0);
            let expected = if edge.curve.collapsed_to().is_some() {
                Expected::Bits(by_cpu)
            } else {
                Expected::Near(by_cpu, 16.0 * ULP)
            };
            let ways = [
                (net, t, expected),
                ([net[3], net[2], net[1], net[0]], 1.0 - t, Expected::AsBefore),
            ];
            all.extend(ways.map(|(net, t, expected)| {
                let [a, b, c, d] = net.map(|point| point.to_array());
                Case { args: [a, b, c, d, one(t)], expected }
            }));
        }
    }
    all
}

/// Normals inside, and on the collapsed edge.
fn normals() -> Vec<Case> {
    let mut all = Vec::new();
    for (which, number) in [0.0, 1.0].into_iter().zip(COLLAPSED) {
        let patch = teapot::patches()[number];
        for u in [0.0, 0.125, 0.5, 0.75, 1.0] {
            for v in [0.0, 0.25, 0.5, 1.0] {
                let error = if v > 0.0 { 64.0 * ULP } else { OF_A_LIMIT };
                let expected = Expected::Near(vec(patch.normal(u, v), 0.0), error);
                all.push(Case { args: args(&[[u, v, which, 0.0]]), expected });
            }
        }
    }
    all
}
