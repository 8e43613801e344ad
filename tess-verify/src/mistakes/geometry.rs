//! Mistakes: coordinates that are moved or rounded, and triangles that turn the other way.

use super::family::Family;
use super::places::{edge_points, has_primitives, move_all, outer, turn_all};
use crate::case::Case;
use tess_core::fixed_point::ONE;
use tess_core::{Domain, DomainPoint, OutputPrimitive, Tessellation};

pub(super) fn all() -> Vec<Family> {
    [turned(), moved(), rounded()].into_iter().flatten().collect()
}

fn turned() -> Vec<Family> {
    let all = Family::new("every triangle turns the other way").answers("all", turn_all);
    let clockwise = Family::new("triangles are clockwise whatever the winding").answers(
        "clockwise",
        |case, output| {
            if case.config.output == OutputPrimitive::TriangleCcw {
                turn_all(case, output);
            }
        },
    );
    let some = [0, 1, 2].into_iter().fold(
        Family::new("one triangle turns the other way"),
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
        Family::new("the points of an edge are numbered from its other end"),
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
    mistake: Family,
    name: &'static str,
    is_moved: fn(u64) -> bool,
    which: fn(&Case, &Tessellation) -> Option<usize>,
    by: u32,
) -> Family {
    mistake.spoils(name, move |request, output| {
        if let Some(point) = which(&request.case, output).filter(|_| is_moved(request.number)) {
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

fn moved() -> Vec<Family> {
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
    let sometimes = |number: u64| number % 7 == 3;
    let edge = Family::new("a vertex of an edge is moved by 1/65536");
    let edge = moves(edge, "always", |_| true, on_edge, 1);
    let edge = moves(edge, "in some patches", sometimes, on_edge, 1);
    let inner = moves(
        Family::new("a vertex inside is moved by 1/65536 in some patches"),
        "sometimes",
        sometimes,
        inside,
        1,
    );
    let inner_always = moves(
        Family::new("a vertex inside is moved by 1/65536 in every patch"),
        "always",
        |_| true,
        inside,
        1,
    );
    let line = moves(
        Family::new("a vertex of an isoline is moved by 1/65536"),
        "always",
        |_| true,
        on_line,
        1,
    )
    .vulkan_allows("", equal);
    let far = Family::new("a vertex is moved by 1/256");
    let far = moves(far, "on an edge", |_| true, on_edge, 256);
    let far = moves(far, "inside", |_| true, inside, 256);
    let far = moves(far, "on a line", |_| true, on_line, 256);
    vec![edge, inner, inner_always, line, far]
}

/// Coordinates that are rounded to fewer bits.
fn rounded() -> Vec<Family> {
    let to = |name: &'static str, label: &'static str, round: fn(u32) -> u32| {
        Family::new(name).answers(label, move |_, output| {
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
