//! Rules about the vertices inside the outline: the columns and rows of a quad, and the rings of a
//! triangle.
//!
//! Vulkan (22.6, 22.7) and OpenGL first divide the domain by the inner levels: a quad into columns
//! by the first level and into rows by the second, a triangle into rings. Every crossing of a
//! column and a row is a vertex.
//!
//! ```text
//!  inner levels 4, 3          3 places between columns, 2 between rows: 6 vertices inside
//!    ┌──┬──┬──┬──┐
//!    ├──●──●──●──┤            Vulkan's text lets the first level divide the edges u = 0 and u = 1, along which v
//!    ├──●──●──●──┤            grows. Its figure, its tests and all devices divide along u; so do these rules.
//!    └──┴──┴──┴──┘
//! ```

use super::Judged;
use super::answer::{Answer, TOLERANCE, show};
use super::edge::spaced;
use super::levels::{Level, is_minimum, may_touch_outline};
use super::lines::{Grid, inner_lines};
use super::rings::{Ring, Rings, vertices_inside};
use super::standard::Specification;
use tess_core::Domain;
use tess_core::fixed_point::ONE;

/// The inside has the columns and rows, or the rings, of the specified answer, or those that the
/// inner levels ask for.
pub(super) fn inner_levels(
    answer: &Answer,
    specified: Option<&Answer>,
    specification: Specification,
) -> Judged {
    let is_exact = specification == Specification::D3d11;
    if answer.is_empty() || is_exact && specified.is_none() {
        return None;
    }
    let case = &answer.case;
    // Vertices inside that touch the outline cannot be told from the outline's own.
    let may_be_fewer = !is_exact && !is_minimum(case) && may_touch_outline(case, specification);
    match case.domain() {
        Domain::Isoline => None,
        Domain::Quad => columns_and_rows(answer, specified, may_be_fewer),
        Domain::Triangle => vertices_of_rings(answer, specified, may_be_fewer),
    }
}

fn columns_and_rows(answer: &Answer, specified: Option<&Answer>, may_be_fewer: bool) -> Judged {
    let grid = Grid::new(answer);
    let specified = specified.map(Grid::new);
    let axis = |grid: &Grid, axis: usize| [&grid.columns, &grid.rows][axis].len() + 1;
    for (number, what) in ["columns", "rows"].into_iter().enumerate() {
        let level = Level::inner(&answer.case, number);
        let asked = match &specified {
            Some(grid) => axis(grid, number),
            None if is_minimum(&answer.case) => 1,
            None => level?.segments() as usize,
        };
        let found = axis(&grid, number);
        if found > asked || found < asked && !may_be_fewer {
            let raw = answer.case.factors.inside().nth(number)?;
            let level = format!("inner level {} is {raw} and asks for {asked} {what}", number + 1);
            return Some(Err(format!("{level}; there are {found}")));
        }
    }
    let crossings = grid.columns.len() * grid.rows.len();
    Some(match grid.vertices == crossings || may_be_fewer {
        true => Ok(()),
        false => Err(empty_crossing(answer, &grid)),
    })
}

fn empty_crossing(answer: &Answer, grid: &Grid) -> String {
    let crossings = grid.columns.iter().flat_map(|&u| grid.rows.iter().map(move |&v| [u, v]));
    let mut empty = crossings.filter(|place| answer.places.binary_search(place).is_err());
    let place = empty.next().map(show).unwrap_or_default();
    format!("a column and a row cross at {place}, where there is no vertex")
}

fn vertices_of_rings(answer: &Answer, specified: Option<&Answer>, may_be_fewer: bool) -> Judged {
    let found = answer.inside().len();
    let level = Level::inner(&answer.case, 0);
    let asked = match specified {
        Some(specified) => specified.inside().len(),
        None if is_minimum(&answer.case) => 0,
        None => vertices_inside(level?.segments()),
    };
    if found == asked || found < asked && may_be_fewer {
        return Some(Ok(()));
    }
    let raw = answer.case.factors.inside().next()?;
    let like = (2..=64).find(|n| vertices_inside(*n) == found);
    let like = like.map(|n| format!(", as level {n} asks for")).unwrap_or_default();
    let asks = format!("the inner level is {raw} and asks for {asked} vertices in its rings");
    Some(Err(format!("{asks}; there are {found}{like}")))
}

/// Columns, rows and rings are spaced as the inner levels ask, and the vertices of rings are at the
/// crossings.
pub(super) fn inner_spacing(answer: &Answer, specification: Specification) -> Judged {
    if may_touch_outline(&answer.case, specification) {
        return None;
    }
    let lines = inner_lines(answer);
    if answer.case.domain() != Domain::Triangle {
        return spaced(&lines);
    }
    let n = Level::inner(&answer.case, 0)?.segments();
    let rings = Rings::new(answer.inside(), n)?;
    if rings.outermost().len() + 1 != n as usize {
        return Some(Err(not_perpendicular(rings.rings.first()?, 1)));
    }
    Some(spaced(&lines)?.and_then(|()| perpendicular(&rings, n)))
}

/// The vertices of every ring are on the perpendiculars at the places of the outermost ring's
/// vertices.
fn perpendicular(rings: &Rings, n: u32) -> Result<(), String> {
    let places = rings.outermost();
    // `places` starts at position 1.
    let place = |position: u32| places.get(position.checked_sub(1)? as usize).copied();
    for ring in &rings.rings {
        let number = ring.number;
        let at = place(number).unwrap_or_default();
        let expected = depth_of(at);
        if let Some(depth) =
            ring.depths.into_iter().find(|depth| depth.abs_diff(expected) > TOLERANCE)
        {
            return Err(format!(
                "ring {number} has a vertex {depth:05x} from the outline, its corners ask for {expected:05x}"
            ));
        }
        let is_right = |edge: &Vec<(u32, _)>| {
            edge.len() == (n - 2 * number + 1) as usize
                && (number..).zip(edge).all(|(position, (t, _))| {
                    place(position).is_some_and(|place| place.abs_diff(*t) <= TOLERANCE)
                })
        };
        if let Some(edge) = ring.edges.iter().position(|edge| !is_right(edge)) {
            return Err(not_perpendicular(ring, edge));
        }
    }
    Ok(())
}

/// The depth of the ring whose corners are at `place`: two thirds of its distance from the nearer
/// end.
const fn depth_of(place: u32) -> u32 {
    let nearer = if place > ONE / 2 { ONE - place } else { place };
    nearer * 2 / 3
}

fn not_perpendicular(ring: &Ring, edge: usize) -> String {
    let (number, edge) = (ring.number, Domain::Triangle.factor_names()[edge]);
    format!(
        "ring {number} has a vertex beside edge {edge} that is not on a perpendicular of the outermost ring's vertices"
    )
}
