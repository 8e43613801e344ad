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
use super::answer::{Answer, Place, TOLERANCE, show};
use super::division::divisions;
use super::edge::spaced;
use super::lengths::VANISHING;
use super::levels::{TessellationLevel, is_minimum, vertices_inside};
use super::lines::{Grid, inner_lines, outline, with_ends};
use super::rings::{Ring, Rings, by_depth, too_close};
use tess_core::Domain;
use tess_core::fixed_point::ONE;

/// The inside has the columns and rows, or the rings, of the specified answer, or those that the
/// inner levels ask for.
pub(super) fn inner_levels(answer: &Answer, specified: Option<&Answer>) -> Judged {
    if answer.is_empty() || answer.is_exact() && specified.is_none() {
        return None;
    }
    // Vulkan does not say what an inner level is that is NaN, nor whether other levels of 1 then
    // leave the patch without an inside.
    let is_unknown = |level: f32| level.is_nan() && !answer.is_exact();
    if answer.case.factors.inside().any(is_unknown) && is_minimum(&answer.case) {
        return None;
    }
    let judged = match answer.case.domain() {
        Domain::Isoline => return None,
        Domain::Quad => columns_and_rows(answer, specified),
        Domain::Triangle => vertices_of_rings(answer, specified)?,
    };
    let is_touching = answer.touches && !answer.is_exact();
    Some(judged.and_then(|()| if is_touching { near_the_outline(answer) } else { Ok(()) }))
}

fn columns_and_rows(answer: &Answer, specified: Option<&Answer>) -> Result<(), String> {
    let grid = Grid::new(answer);
    let specified = specified.map(Grid::new);
    let axis = |grid: &Grid, axis: usize| [&grid.columns, &grid.rows][axis].len() + 1;
    for (number, what) in ["columns", "rows"].into_iter().enumerate() {
        let level = TessellationLevel::inner(&answer.case, number);
        let asked = match (&specified, level) {
            (Some(grid), _) => axis(grid, number),
            (None, _) if is_minimum(&answer.case) => 1,
            (None, Some(level)) => level.segments() as usize,
            // No sentence says how many: the level is NaN.
            (None, None) => continue,
        };
        let found = axis(&grid, number);
        if found > asked || found < asked && !answer.touches {
            let raw = answer.case.factors.inside().nth(number).unwrap_or_default();
            let level = format!("inner level {} is {raw} and asks for {asked} {what}", number + 1);
            return Err(format!("{level}; there are {found}"));
        }
    }
    let crossings = grid.columns.len() * grid.rows.len();
    if grid.vertices == crossings || answer.touches {
        return Ok(());
    }
    Err(empty_crossing(answer, &grid))
}

fn empty_crossing(answer: &Answer, grid: &Grid) -> String {
    let crossings = grid.columns.iter().flat_map(|&u| grid.rows.iter().map(move |&v| [u, v]));
    let mut empty = crossings.filter(|place| answer.places.binary_search(place).is_err());
    let place = empty.next().map(show).unwrap_or_default();
    format!("a column and a row cross at {place}, where there is no vertex")
}

/// An inner level of at most 1 counts as just above 1, which puts the outermost column, row or ring
/// close to the outline. Only there may vertices of the inside be on it.
const NEAR: u32 = ONE / VANISHING + TOLERANCE;

const fn is_near_an_end(x: u32) -> bool {
    x <= NEAR || x >= ONE - NEAR
}

/// Vertices inside and those on the outline that are not its own are where levels of at most 1 put
/// them, if vertices of the inside are on the outline.
fn near_the_outline(answer: &Answer) -> Result<(), String> {
    let (case, inside) = (&answer.case, answer.inside());
    let is_low = |number: usize| {
        TessellationLevel::inner(case, number).is_some_and(|level| level.raw <= 1.0)
    };
    let not_near = |what: &str, place: Place| {
        Err(format!(
            "an inner level is at most 1, and {what} {} is not near the outline",
            show(place)
        ))
    };
    let is_far = match case.domain() {
        Domain::Triangle => |place: &&Place, low: [bool; 2]| {
            let [u, v] = **place;
            let largest = u.max(v).max(ONE.saturating_sub(u).saturating_sub(v));
            low[0] && largest < ONE - 2 * NEAR
        },
        _ => |place: &&Place, low: [bool; 2]| {
            (0..2).any(|axis| low[axis] && !is_near_an_end(place[axis]))
        },
    };
    let low = [is_low(0), is_low(1)];
    if let Some(place) = inside.iter().find(|place| is_far(place, low)) {
        return not_near("the vertex", *place);
    }
    let edges = 0..case.domain().outer_factors();
    edges.map(|edge| near_the_edge(answer, edge, low)).find(Result::is_err).unwrap_or(Ok(()))
}

/// The vertices inside that are on an edge, or nearest to it.
fn near_the_edge(answer: &Answer, edge: usize, low: [bool; 2]) -> Result<(), String> {
    let case = &answer.case;
    let is_triangle = case.domain() == Domain::Triangle;
    // The columns of a quad may be on its edges u0 and u1, where its rows end, and its rows on the
    // others. A triangle's ring ends at the corners.
    let (across, along) = if is_triangle { (0, 0) } else { (edge % 2, 1 - edge % 2) };
    let other = TessellationLevel::inner(case, along);
    if let Some(other) = other.filter(|other| !is_triangle && low[across] && other.raw > 1.0) {
        whole_line(answer, edge, other)?;
    }
    let own = outline(answer, edge);
    let is_other = |x: &u32| own.along.binary_search(x).is_err();
    let others: Vec<u32> = answer.along(edge).into_iter().filter(is_other).collect();
    let ends_near = is_triangle || low[along];
    let is_allowed = |x: &u32| low[across] && (!ends_near || is_near_an_end(*x));
    let most = other.map_or(0, |level| level.segments() as usize - 1);
    let wrong = others.iter().find(|x| !is_allowed(x)).or_else(|| others.get(most));
    let is_known = case.factors.inside().all(|level| !level.is_nan());
    match wrong.filter(|_| is_known && own.is_sure) {
        None => Ok(()),
        Some(x) => {
            let asks = "that neither its level nor an inner one asks for";
            Err(format!("{} has a vertex at {x:05x} {asks}", own.name))
        }
    }
}

/// The column or row nearest to a quad's edge, on it or inside, is divided by the inner level of
/// the other axis.
fn whole_line(answer: &Answer, edge: usize, other: TessellationLevel) -> Result<(), String> {
    let (across, along) = (edge % 2, 1 - edge % 2);
    let is_nearest = |place: &&Place| (place[across] < ONE / 2) == (edge < 2);
    let mut inside: Vec<u32> =
        answer.inside().iter().filter(is_nearest).map(|place| place[along]).collect();
    inside.sort_unstable();
    inside.dedup();
    let is_on_edge = inside.is_empty();
    let line = if is_on_edge { answer.along(edge) } else { with_ends(inside) };
    if divisions(&line, other).is_empty() {
        let (name, level) = (answer.case.domain().factor_names()[edge], other.raw);
        return Err(format!("no line near edge {name} is divided as inner level {level} asks"));
    }
    Ok(())
}

fn vertices_of_rings(answer: &Answer, specified: Option<&Answer>) -> Option<Result<(), String>> {
    let found = answer.inside().len();
    let level = TessellationLevel::inner(&answer.case, 0);
    let asked = match specified {
        Some(specified) => specified.inside().len(),
        None if is_minimum(&answer.case) => 0,
        None => vertices_inside(level?.segments()),
    };
    if found == asked || found < asked && answer.touches {
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
pub(super) fn inner_spacing(answer: &Answer) -> Judged {
    let lines = inner_lines(answer);
    if answer.case.domain() != Domain::Triangle {
        return spaced(&lines);
    }
    let level = TessellationLevel::inner(&answer.case, 0).filter(|_| !is_minimum(&answer.case))?;
    let n = level.segments();
    let by_depth = by_depth(answer.inside(), n)?;
    let close: Vec<u32> = too_close(&by_depth).collect();
    match close[..] {
        [] => {}
        [_] if may_have_close_rings(level) => return None,
        [number, ..] => {
            let outer = number - 1;
            return Some(Err(format!("rings {outer} and {number} are equally far inside")));
        }
    }
    let rings = Rings::new(answer.inside(), n)?;
    if rings.outermost().len() + 1 != n as usize {
        return Some(Err(not_perpendicular(rings.rings.first()?, 1)));
    }
    Some(spaced(&lines)?.and_then(|()| perpendicular(&rings, n)))
}

/// Whether the shorter segments may be so short that the two rings at their ends cannot be told
/// apart: up to half the way from one number of segments to the next.
fn may_have_close_rings(level: TessellationLevel) -> bool {
    let lower = level.segments().saturating_sub(2) << 16;
    level.is_fractional() && level.fixed() < lower + ONE
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
