//! Mistakes: coordinates that are exchanged, mirrored, moved or rounded, and triangles that turn
//! the other way.

use super::places::*;
use super::*;

pub(super) fn all() -> Vec<Mistake> {
    [exchanged(), turned(), moved(), rounded()].into_iter().flatten().collect()
}

/// A change of places, in the domains to which it applies.
type Change = fn(Domain, [u32; 2]) -> Option<[u32; 2]>;

/// The triangles turn as the change turns them, or are turned back.
fn both_ways(name: &'static str, change: Change) -> Mistake {
    [false, true].into_iter().fold(Mistake::new(name), |mistake, is_turned| {
        let label = if is_turned { "turned back" } else { "as it is" };
        mistake.answers(label, move |case, output| {
            let domain = case.domain();
            if change(domain, [0, 0]).is_none() {
                return;
            }
            move_all(output, |place| change(domain, place).unwrap_or(place));
            if is_turned {
                turn_all(case, output);
            }
        })
    })
}

const fn is_triangle(domain: Domain) -> bool {
    matches!(domain, Domain::Triangle)
}

fn exchanged() -> Vec<Mistake> {
    let u_mirrored: Change = |domain, [u, v]| (!is_triangle(domain)).then_some([ONE - u, v]);
    vec![
        both_ways("u and v are exchanged", |_, [u, v]| Some([v, u])),
        both_ways("v and w are exchanged", |domain, [u, v]| {
            is_triangle(domain).then(|| [u, ONE - u - v])
        }),
        both_ways("u and w are exchanged", |domain, [u, v]| {
            is_triangle(domain).then(|| [ONE - u - v, v])
        }),
        both_ways("u, v and w are rotated", |domain, [u, v]| {
            is_triangle(domain).then(|| [v, ONE - u - v])
        }),
        both_ways("u is mirrored", u_mirrored).vulkan_allows(
            "isoline",
            "the order of a segment's vertices is implementation-dependent (22.8)",
        ),
        both_ways("v is mirrored", |domain, [u, v]| (!is_triangle(domain)).then_some([u, ONE - v])),
        both_ways("u and v are mirrored", |domain, [u, v]| {
            (!is_triangle(domain)).then_some([ONE - u, ONE - v])
        }),
    ]
}

fn turned() -> Vec<Mistake> {
    let all = Mistake::new("all triangles turn the other way, as with the other domain origin")
        .answers("all", turn_all);
    let clockwise = Mistake::new("triangles are clockwise whatever the winding").answers(
        "clockwise",
        |case, output| {
            if case.config.output == OutputPrimitive::TriangleCcw {
                turn_all(case, output);
            }
        },
    );
    let some = [0, 1, 2].into_iter().fold(
        Mistake::new("one triangle turns the other way"),
        |mistake, which| {
            mistake.answers(["first", "middle", "last"][which], move |case, output| {
                let triangles = output.indices.len() / 3;
                if case.primitive_size() == 3 && triangles > 0 {
                    let number = [0, triangles / 2, triangles - 1][which];
                    output.indices.swap(3 * number + 1, 3 * number + 2);
                }
            })
        },
    );
    let edge = (0..4).fold(
        Mistake::new("the points of an edge are numbered from its other end"),
        |mistake, edge| {
            mistake.answers(format!("edge {edge}"), move |case, output| {
                if case.primitive_size() == 3 && edge < outer(case) {
                    let points = edge_points(case, output, edge);
                    let inner = points.len().saturating_sub(2);
                    for k in 0..inner / 2 {
                        output.points.swap(points[1 + k], points[inner - k]);
                    }
                }
            })
        },
    );
    vec![all, clockwise, some, edge]
}

/// Moves one point of a patch.
fn moves(
    mistake: Mistake,
    name: &'static str,
    is_moved: fn(usize) -> bool,
    which: fn(&Case, &Tessellation) -> Option<usize>,
    by: u32,
) -> Mistake {
    mistake.spoils(name, move |cases, i, output| {
        if let Some(point) = which(&cases[i], output).filter(|_| is_moved(i)) {
            let [u, v] = [output.points[point].u.to_bits(), output.points[point].v.to_bits()];
            // The point moves along the edge, so that it stays on it.
            let moved = match [u, v] {
                [0, v] => [0, v.saturating_sub(by)],
                [u, 0] => [u.saturating_sub(by), 0],
                [u, v] => [u.saturating_sub(by), v],
            };
            output.points[point] = DomainPoint::from_bits(moved[0], moved[1]);
        }
    })
}

fn moved() -> Vec<Mistake> {
    fn on_edge(case: &Case, output: &Tessellation) -> Option<usize> {
        let is_new = |i: &usize| {
            let [u, v] = [output.points[*i].u.to_bits(), output.points[*i].v.to_bits()];
            u == 0 && v > 0 && v < ONE
        };
        let edges = case.domain() != Domain::Isoline && has_primitives(case);
        (0..output.points.len()).find(|i| edges && is_new(i))
    }
    fn inside(case: &Case, output: &Tessellation) -> Option<usize> {
        let is_inside = |i: &usize| {
            let [u, v] = [output.points[*i].u.to_bits(), output.points[*i].v.to_bits()];
            let is_quad = case.domain() == Domain::Quad;
            u > 0 && v > 0 && if is_quad { u < ONE && v < ONE } else { u + v < ONE }
        };
        let has_inside = case.domain() != Domain::Isoline && has_primitives(case);
        (0..output.points.len()).find(|i| has_inside && is_inside(i))
    }
    fn on_line(case: &Case, output: &Tessellation) -> Option<usize> {
        let u = |i: &usize| output.points[*i].u.to_bits();
        let is_isoline = case.domain() == Domain::Isoline;
        (0..output.points.len()).find(|i| is_isoline && u(i) > 0 && u(i) < ONE)
    }
    let equal = "no sentence says how equal \"equal\" is; see [Tolerance](#the-rules)";
    let sometimes = |i: usize| i % 7 == 3;
    let edge = Mistake::new("a vertex of an edge is moved by 1/65536");
    let edge = moves(edge, "always", |_| true, on_edge, 1);
    let edge = moves(edge, "in some patches", sometimes, on_edge, 1);
    let inner = moves(
        Mistake::new("a vertex inside is moved by 1/65536 in some patches"),
        "sometimes",
        sometimes,
        inside,
        1,
    );
    let inner_always = moves(
        Mistake::new("a vertex inside is moved by 1/65536 in every patch"),
        "always",
        |_| true,
        inside,
        1,
    );
    let line = moves(
        Mistake::new("a vertex of an isoline is moved by 1/65536"),
        "always",
        |_| true,
        on_line,
        1,
    )
    .vulkan_allows("", equal);
    let far = Mistake::new("a vertex is moved by 1/256");
    let far = moves(far, "on an edge", |_| true, on_edge, 256);
    let far = moves(far, "inside", |_| true, inside, 256);
    let far = moves(far, "on a line", |_| true, on_line, 256);
    vec![edge, inner, inner_always, line, far]
}

/// Coordinates that are rounded to fewer bits.
fn rounded() -> Vec<Mistake> {
    let to = |name: &'static str, label: &'static str, round: fn(u32) -> u32| {
        Mistake::new(name).answers(label, move |_, output| {
            move_all(output, |place| place.map(round));
        })
    };
    vec![
        to("coordinates are rounded through binary16", "binary16", |x| {
            // 11 significant bits.
            let drop = (32 - x.leading_zeros()).saturating_sub(11);
            if drop == 0 { x } else { (x + (1 << drop >> 1)) >> drop << drop }
        }),
        to("coordinates are rounded to 1/256", "8 bits", |x| (x + 128) & !255),
        to("coordinates are multiples of 1/65535", "unorm16", |x| x - x / 0x8001),
    ]
}
