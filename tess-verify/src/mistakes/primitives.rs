//! Mistakes: primitives and points that are missing, repeated, wrong or in another order.

use super::family::Family;
use super::places::{has_primitives, levels, move_all};
use crate::case::Case;
use std::collections::{BTreeMap, BTreeSet};
use tess_core::fixed_point::ONE;
use tess_core::{Domain, DomainPoint, OutputPrimitive, Tessellation};

pub(super) fn all() -> Vec<Family> {
    [listed(), degenerate(), joined(), ordered(), isolines(), isolines_at_1(), points()]
        .into_iter()
        .flatten()
        .collect()
}

/// The first, middle and last primitive: a variant for each, and for each kind of primitive.
fn at_places(name: &'static str, spoil: fn(&mut Vec<u32>, std::ops::Range<usize>)) -> Family {
    let places = ["first", "middle", "last"];
    let sizes = ["point", "line", "triangle"];
    let both = (0..3).flat_map(|place| (1..=3).map(move |size| (place, size)));
    both.fold(Family::new(name), |mistake, (place, size)| {
        let label = format!("the {} {}", places[place], sizes[size - 1]);
        mistake.answers(label, move |case, output| {
            let count = output.indices.len() / size;
            if case.primitive_size() == size && has_primitives(case) && count > 0 {
                let number = [0, count / 2, count - 1][place];
                spoil(&mut output.indices, number * size..(number + 1) * size);
            }
        })
    })
}

fn listed() -> Vec<Family> {
    let names_no_point = Family::new("an index names no point").answers("last", |_, output| {
        if let Some(index) = output.indices.last_mut() {
            *index = u32::try_from(output.points.len()).expect("few points");
        }
    });
    vec![
        at_places("a primitive is missing", |indices, range| drop(indices.drain(range))),
        at_places("a primitive comes twice", |indices, range| indices.extend_from_within(range)),
        at_places("a primitive comes in place of another", |indices, range| {
            let other = if range.start == 0 { indices.len() - range.len() } else { 0 };
            indices.copy_within(other..other + range.len(), range.start);
        }),
        names_no_point,
    ]
}

fn place_of(output: &Tessellation, index: u32) -> [u32; 2] {
    let point = output.points[index as usize];
    [point.u.to_bits(), point.v.to_bits()]
}

fn doubled_area(places: [[u32; 2]; 3]) -> i64 {
    let [[au, av], [bu, bv], [cu, cv]] = places.map(|place| place.map(i64::from));
    (bu - au) * (cv - av) - (cu - au) * (bv - av)
}

fn degenerate() -> Vec<Family> {
    let left_out = Family::new("primitives without area or length are left out").answers(
        "left out",
        |case, output| {
            let size = case.primitive_size();
            if size == 1 || !has_primitives(case) {
                return;
            }
            let own = output.clone();
            let is_whole = |primitive: &&[u32]| match primitive[..] {
                [a, b, c] => doubled_area([a, b, c].map(|i| place_of(&own, i))) != 0,
                [a, b] => place_of(&own, a) != place_of(&own, b),
                _ => true,
            };
            output.indices = own.indices.chunks(size).filter(is_whole).flatten().copied().collect();
        },
    );
    let added = Family::new("a triangle without area is added").answers("added", |case, output| {
        if case.primitive_size() == 3 && !output.indices.is_empty() {
            let [a, b] = [output.indices[0], output.indices[1]];
            output.indices.extend([a, b, b]);
        }
    });
    vec![left_out.vulkan_allows("", "a primitive without area covers nothing (22.6, 22.7)"), added]
}

/// Exchanges the diagonal of each pair of triangles whose four vertices are all wanted. A triangle
/// is used in one pair at most.
fn flip(
    case: &Case,
    output: &mut Tessellation,
    at_most: usize,
    is_wanted: impl Fn([[u32; 2]; 4]) -> bool,
) {
    if case.primitive_size() != 3 {
        return;
    }
    let triangles = output.indices.as_chunks::<3>().0.to_vec();
    let sign = if case.config.output == OutputPrimitive::TriangleCw { 1 } else { -1 };
    let mut across: BTreeMap<[u32; 2], (usize, u32)> = BTreeMap::new();
    for (i, &[a, b, c]) in triangles.iter().enumerate() {
        for ([from, to], opposite) in [([a, b], c), ([b, c], a), ([c, a], b)] {
            across.insert([from, to], (i, opposite));
        }
    }
    let mut used = BTreeSet::new();
    for (i, &[a, b, c]) in triangles.iter().enumerate() {
        for [a, b, c] in [[a, b, c], [b, c, a], [c, a, b]] {
            let Some(&(j, d)) = across.get(&[c, b]) else { continue };
            let corners = [a, b, d, c].map(|index| place_of(output, index));
            let is_convex =
                (0..4).all(|k| doubled_area([0, 1, 2].map(|m| corners[(k + m) % 4])) * sign > 0);
            let is_new =
                i < j && !used.contains(&i) && !used.contains(&j) && used.len() / 2 < at_most;
            if is_new && is_convex && is_wanted(corners) {
                output.indices[3 * i..3 * i + 3].copy_from_slice(&[a, b, d]);
                output.indices[3 * j..3 * j + 3].copy_from_slice(&[a, d, c]);
                used.extend([i, j]);
            }
        }
    }
}

/// Triangles that join other vertices than the model's.
fn joined() -> Vec<Family> {
    let is_on = |[u, v]: [u32; 2], domain: Domain| {
        u == 0
            || v == 0
            || match domain {
                Domain::Triangle => u + v == ONE,
                _ => u == ONE || v == ONE,
            }
    };
    let free = "the triangles are implementation-dependent (22.6, 22.7)";
    let diagonals = Family::new("the diagonals of a quad's cells inside are the other ones")
        .answers("all", move |case, output| {
            if case.domain() == Domain::Quad {
                flip(case, output, usize::MAX, |corners| {
                    let is_inside = corners.iter().all(|place| !is_on(*place, Domain::Quad));
                    let [u, v] = [0, 1].map(|axis| {
                        corners.map(|place| place[axis]).into_iter().collect::<BTreeSet<_>>().len()
                    });
                    is_inside && u == 2 && v == 2
                });
            }
        })
        .vulkan_allows("", free);
    let by_outer = Family::new("diagonals inside depend on an outer level").answers(
        "all",
        move |case, output| {
            if case.domain() == Domain::Quad && levels(case)[0] > 5.0 {
                flip(case, output, 1, |corners| {
                    corners.iter().all(|place| !is_on(*place, Domain::Quad))
                });
            }
        },
    );
    let transition = Family::new("some triangles between outline and inside join other vertices")
        .answers("first", move |case, output| {
            let domain = case.domain();
            flip(case, output, 1, |corners| {
                let on = corners.iter().filter(|place| is_on(**place, domain)).count();
                // Two on the outline and two inside, so that neighbours stay joined.
                on == 2
            });
        })
        .vulkan_allows("", free);
    let across = Family::new("triangles join vertices of the outline that are not neighbours")
        .answers("three", move |case, output| {
            let domain = case.domain();
            flip(case, output, 1, |corners| {
                corners.iter().filter(|place| is_on(**place, domain)).count() == 3
            });
        });
    let next = Family::new("a triangle has the next point for one of its vertices").answers(
        "first",
        |case, output| {
            if case.primitive_size() == 3 && !output.indices.is_empty() {
                let count = u32::try_from(output.points.len()).expect("few points");
                output.indices[0] = (output.indices[0] + 1) % count;
            }
        },
    );
    vec![diagonals, by_outer, transition, across, next]
}

fn ordered() -> Vec<Family> {
    let order = "the order of primitives is implementation-dependent (22.4)";
    let vertices = "the order of a primitive's vertices is implementation-dependent (22.6 to 22.8)";
    let primitives =
        Family::new("primitives have another order").answers("reversed", |case, output| {
            let size = case.primitive_size();
            let own = output.indices.clone();
            output.indices = own.chunks(size).rev().flatten().copied().collect();
        });
    let numbers = Family::new("points have other numbers").answers("reversed", |case, output| {
        let count = u32::try_from(output.points.len()).expect("few points");
        if has_primitives(case) && count > 0 {
            output.points.reverse();
            output.indices.iter_mut().for_each(|index| *index = count - 1 - *index);
        }
    });
    let leading =
        Family::new("another vertex leads a triangle").answers("second", |case, output| {
            if case.primitive_size() == 3 {
                output.indices.chunks_mut(3).for_each(|triangle| triangle.rotate_left(1));
            }
        });
    vec![
        primitives.vulkan_allows("", order).d3d11_allows("", "the order is free (13)"),
        numbers.vulkan_allows("", order).d3d11_allows("", "the order is free (13)"),
        leading.vulkan_allows("", vertices).d3d11_allows("", "the leading vertex is free (13)"),
    ]
}

fn isolines() -> Vec<Family> {
    let reversed =
        Family::new("segments of isolines lead from 1 to 0").answers("reversed", |case, output| {
            if case.domain() == Domain::Isoline && case.primitive_size() == 2 {
                output.indices.chunks_mut(2).for_each(|segment| segment.swap(0, 1));
            }
        });
    let joined = Family::new("the end of an isoline is joined with the next one").answers(
        "joined",
        |case, output| {
            if case.domain() == Domain::Isoline && case.primitive_size() == 2 {
                let count = u32::try_from(output.points.len()).expect("few points");
                output.indices = (1..count).flat_map(|i| [i - 1, i]).collect();
            }
        },
    );
    let short = Family::new("the last segment of each isoline is missing").answers(
        "short",
        |case, output| {
            if case.domain() == Domain::Isoline && case.primitive_size() == 2 {
                let own = output.clone();
                let is_last = |segment: &&[u32]| place_of(&own, segment[1])[0] == ONE;
                let rest = own.indices.chunks(2).filter(|segment| !is_last(segment));
                output.indices = rest.flatten().copied().collect();
            }
        },
    );
    let direction = "the order of a segment's vertices is implementation-dependent (22.8)";
    vec![reversed.vulkan_allows("isoline", direction), joined, short]
}

/// Isolines at the side that has none.
fn isolines_at_1() -> Vec<Family> {
    let last = Family::new("an isoline is drawn at v = 1, and none at v = 0").answers(
        "moved",
        |case, output| {
            if case.domain() == Domain::Isoline {
                move_all(output, |[u, v]| [u, if v == 0 { ONE } else { v }]);
            }
        },
    );
    let more = Family::new("an isoline is drawn at v = 1 too").answers("more", |case, output| {
        if case.domain() == Domain::Isoline && case.primitive_size() == 2 {
            let own = output.clone();
            let first = |segment: &&[u32]| place_of(&own, segment[0])[1] == 0;
            let mut next = u32::try_from(own.points.len()).expect("few points");
            for segment in own.indices.chunks(2).filter(first) {
                for &index in segment {
                    let [u, _] = place_of(&own, index);
                    output.points.push(DomainPoint::from_bits(u, ONE));
                    output.indices.push(next);
                    next += 1;
                }
            }
        }
    });
    vec![last, more]
}

fn points() -> Vec<Family> {
    let is_points = |case: &Case| case.config.output == OutputPrimitive::Point;
    let corners =
        Family::new("corners are points twice").answers("corners", move |case, output| {
            if is_points(case) && case.domain() != Domain::Isoline {
                let own = output.clone();
                let is_corner = |index: &&u32| {
                    let [u, v] = place_of(&own, **index);
                    (u == 0 || u == ONE) && (v == 0 || v == ONE)
                };
                output.indices.extend(own.indices.iter().filter(is_corner));
            }
        });
    let outline = Family::new("only vertices of the outline are points").answers(
        "outline",
        move |case, output| {
            if is_points(case) && case.domain() != Domain::Isoline {
                let own = output.clone();
                let is_on = |index: &&u32| {
                    let [u, v] = place_of(&own, **index);
                    let is_triangle = case.domain() == Domain::Triangle;
                    u == 0
                        || v == 0
                        || if is_triangle { u + v == ONE } else { u == ONE || v == ONE }
                };
                output.indices = own.indices.iter().filter(is_on).copied().collect();
            }
        },
    );
    let uses =
        Family::new("each use of a vertex is a point").answers("uses", move |case, output| {
            if is_points(case) {
                let config =
                    tess_core::Config { output: OutputPrimitive::TriangleCw, ..case.config };
                *output = Case { config, ..*case }.patch().tessellate();
            }
        });
    vec![corners, outline, uses]
}
