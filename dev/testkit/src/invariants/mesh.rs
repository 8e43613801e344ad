//! Area and manifold: invariants of the triangles of a patch.

use super::{Violation, ensure, has_triangles};
use std::collections::BTreeSet;
use tess_core::fixed_point::ONE;
use tess_core::{Domain, OutputPrimitive, Tessellation};
use tess_verify::Case;

/// 12.3: the signed areas add up to exactly the area of the domain.
///
/// # Errors
/// Another sum, in units of half a coordinate step squared; an index out of range.
pub fn area(case: &Case, output: &Tessellation) -> Result<(), Violation> {
    if !has_triangles(case) || output.points.is_empty() {
        return Ok(());
    }
    let point = |index: u32| {
        let point = output.points.get(index as usize);
        let coordinates =
            |p: &tess_core::DomainPoint| (i64::from(p.u.to_bits()), i64::from(p.v.to_bits()));
        point.map(coordinates).ok_or_else(|| Violation {
            invariant: "area",
            message: format!("index {index} of {} points", output.points.len()),
        })
    };
    let mut sum = 0;
    for triangle in output.indices.chunks_exact(3) {
        let [(u0, v0), (u1, v1), (u2, v2)] =
            [point(triangle[0])?, point(triangle[1])?, point(triangle[2])?];
        sum += (u1 - u0) * (v2 - v0) - (u2 - u0) * (v1 - v0);
    }
    let clockwise = if case.config.output == OutputPrimitive::TriangleCw { 1 } else { -1 };
    let halves = if case.domain() == Domain::Quad { 2 } else { 1 };
    let expected = clockwise * halves * i64::from(ONE) * i64::from(ONE);
    ensure(sum == expected, "area", || format!("the sum is {sum:#x}, not {expected:#x}"))
}

/// 12.4: every directed edge is used once; an edge used in both directions is interior, and the
/// others are the outer ring's; points - edges + triangles = 1.
///
/// # Errors
/// The edge or the sum.
pub fn manifold(case: &Case, output: &Tessellation) -> Result<(), Violation> {
    if !has_triangles(case) || output.points.is_empty() {
        return Ok(());
    }
    let mut directed = BTreeSet::new();
    for (t, triangle) in output.indices.chunks(3).enumerate() {
        for (i, &from) in triangle.iter().enumerate() {
            let edge = (from, triangle[(i + 1) % triangle.len()]);
            let new = edge.0 != edge.1 && directed.insert(edge);
            ensure(new, "manifold", || format!("triangle {t} uses edge {edge:?} again"))?;
        }
    }
    let boundary: Vec<_> = directed.iter().filter(|(a, b)| !directed.contains(&(*b, *a))).collect();
    // Each boundary point has one boundary edge in and one out, so the boundary is closed.
    let starts: BTreeSet<u32> = boundary.iter().map(|(from, _)| *from).collect();
    let ends: BTreeSet<u32> = boundary.iter().map(|(_, to)| *to).collect();
    let closed = starts == ends && starts.len() == boundary.len();
    ensure(closed, "manifold", || format!("the boundary is not a ring: {boundary:?}"))?;
    let edges = (directed.len() + boundary.len()) / 2;
    let (points, triangles) = (output.points.len(), output.indices.len() / 3);
    ensure(points + triangles == edges + 1, "manifold", || {
        format!("{points} points - {edges} edges + {triangles} triangles is not 1")
    })
}
