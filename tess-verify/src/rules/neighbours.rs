//! The rule about triangles between two lines.
//!
//! Vulkan (22.6, 22.7) and OpenGL leave the triangles to the device, with one constraint. Two
//! vertices of each triangle are neighbours on one line, and the third is on the adjacent line,
//! along the same edge: the outline and the rectangle or ring inside it, or two rings. A cell
//! between a quad's columns and rows has two triangles. The innermost ring of a triangle may itself
//! be a triangle.

use super::Judged;
use super::answer::{Answer, Place, distance_along, show};
use super::edge::segments;
use super::inside::inner_levels;
use super::levels::{TessellationLevel, is_minimum};
use super::lines::Grid;
use super::rings::Rings;
use tess_core::Domain;

/// The position of a place on a line. Ring 0 is the outline, ring 1 the first line inside it.
#[derive(Clone, Copy, Debug)]
struct Spot {
    edge: usize,
    ring: u32,
    index: usize,
}

/// The spots of each place, by its number. A corner has two; a centre has one for each edge.
type Spots = Vec<Vec<Spot>>;

/// Each triangle joins two neighbours on one line with a vertex of the next line. A patch is not
/// judged if one of its lines has a wrong number of segments, or if vertices of its inside are on
/// the outline.
pub(super) fn neighbours(answer: &Answer) -> Judged {
    let case = &answer.case;
    let is_right = |judged: Judged| judged.is_some_and(|result| result.is_ok());
    if !answer.has_triangles()
        || is_minimum(case)
        || answer.touches
        || !is_right(segments(answer, None))
        || !is_right(inner_levels(answer, None))
    {
        return None;
    }
    let mut spots = outline(answer);
    let grid = Grid::new(answer);
    let innermost = match case.domain() {
        Domain::Isoline => return None,
        Domain::Quad => {
            rectangle(answer, &grid, &mut spots);
            0
        }
        Domain::Triangle => {
            let n = TessellationLevel::inner(case, 0)?.segments();
            add_rings(answer, &Rings::new(answer.inside(), n)?, &mut spots);
            if n % 2 == 1 { n / 2 } else { 0 }
        }
    };
    let inside: Vec<bool> =
        answer.places.iter().map(|place| !answer.is_on_outline(*place)).collect();
    let is_right = |triangle: &[u32; 3]| {
        let places = || triangle.map(|number| answer.places[number as usize]);
        let is_cell = case.domain() == Domain::Quad
            && triangle.iter().all(|number| inside[*number as usize])
            && in_cell(&grid, &places());
        is_cell || between(&spots, triangle) || is_innermost(&spots, triangle, innermost)
    };
    let wrong = answer.numbered_triangles().enumerate().find(|(_, triangle)| !is_right(triangle));
    Some(wrong.map_or(Ok(()), |(number, triangle)| {
        let [a, b, c] = triangle.map(|number| show(answer.places[number as usize]));
        let rule = "two neighbours of one line with a vertex of the next line";
        Err(format!("triangle {number} does not join {rule}: {a} {b} {c}"))
    }))
}

/// Adds a spot of a place.
fn add(answer: &Answer, spots: &mut Spots, place: Place, spot: Spot) {
    if let Ok(number) = answer.places.binary_search(&place) {
        spots[number].push(spot);
    }
}

fn outline(answer: &Answer) -> Spots {
    let domain = answer.case.domain();
    let mut spots = vec![Vec::new(); answer.places.len()];
    for edge in 0..domain.outer_factors() {
        let along = answer.along(edge);
        for (&place, spots) in answer.places.iter().zip(&mut spots) {
            let found =
                distance_along(domain, edge, place).and_then(|x| along.binary_search(&x).ok());
            spots.extend(found.map(|index| Spot { edge, ring: 0, index }));
        }
    }
    spots
}

/// Adds the four edges of the rectangle that a quad's vertices inside form, in the order of outer
/// edges.
fn rectangle(answer: &Answer, grid: &Grid, spots: &mut Spots) {
    let ends = |along: &[u32]| [along.first().copied(), along.last().copied()];
    let ([first_u, last_u], [first_v, last_v]) = (ends(&grid.columns), ends(&grid.rows));
    for place in answer.inside() {
        let [u, v] = place.map(Some);
        let at = |edge: usize| if edge.is_multiple_of(2) { place[1] } else { place[0] };
        let along = |edge: usize| if edge.is_multiple_of(2) { &grid.rows } else { &grid.columns };
        for (edge, is_on) in
            [u == first_u, v == first_v, u == last_u, v == last_v].into_iter().enumerate()
        {
            if let (true, Ok(index)) = (is_on, along(edge).binary_search(&at(edge))) {
                add(answer, spots, place, Spot { edge, ring: 1, index });
            }
        }
    }
}

fn add_rings(answer: &Answer, rings: &Rings, spots: &mut Spots) {
    for ring in &rings.rings {
        for (edge, vertices) in ring.edges.iter().enumerate() {
            for (index, (_, place)) in vertices.iter().enumerate() {
                add(answer, spots, *place, Spot { edge, ring: ring.number, index });
            }
        }
    }
}

/// Whether a triangle is half of a cell between columns and rows.
fn in_cell(grid: &Grid, triangle: &[Place; 3]) -> bool {
    let spans_one = |along: &[u32], axis: usize| {
        let [a, b, c] = triangle.map(|place| along.binary_search(&place[axis]).unwrap_or_default());
        a.max(b).max(c) - a.min(b).min(c) == 1
    };
    spans_one(&grid.columns, 0) && spans_one(&grid.rows, 1)
}

/// Whether two vertices of a triangle are neighbours on a line and the third is on an adjacent
/// line.
fn between(spots: &[Vec<Spot>], triangle: &[u32; 3]) -> bool {
    let of = |k: usize| spots[triangle[k] as usize].as_slice();
    (0..3).any(|first| {
        let [a, b, c] = [0, 1, 2].map(|k| of((first + k) % 3));
        let pairs = a.iter().flat_map(|one| b.iter().map(move |other| (one, other)));
        let mut neighbours = pairs.filter(|(one, other)| {
            one.edge == other.edge && one.ring == other.ring && one.index.abs_diff(other.index) == 1
        });
        neighbours.any(|(one, _)| {
            c.iter().any(|third| third.edge == one.edge && third.ring.abs_diff(one.ring) == 1)
        })
    })
}

/// Whether a triangle's vertices are three distinct ones of the innermost ring, if that is not a
/// point.
fn is_innermost(spots: &[Vec<Spot>], triangle: &[u32; 3], ring: u32) -> bool {
    let [a, b, c] = *triangle;
    let is_on = |number: &u32| spots[*number as usize].iter().any(|spot| spot.ring == ring);
    ring > 0 && triangle.iter().all(is_on) && a != b && b != c && c != a
}
