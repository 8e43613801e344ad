//! Crack-free: the properties of a shared edge on which neighbouring patches rely.

use super::{Violation, ensure, symmetry};
use tess_core::fixed_point::ONE;
use tess_core::{
    Config, Domain, DomainPoint, IsolineFactors, OutputPrimitive, Patch, ProcessedPatch,
    Tessellation,
};
use tess_verify::Case;

/// 12.5: the points on an outer edge are those of that edge's factor, whatever the other factors
/// and whichever edge it is, and one minus them are the same points in reverse.
///
/// An isoline patch, which has no other factor, gives the points of a factor.
///
/// # Errors
/// The edge that has other points.
pub fn crack_free(case: &Case, output: &Tessellation) -> Result<(), Violation> {
    let domain = case.domain();
    let is_minimum = match case.patch().processed() {
        ProcessedPatch::Culled => return Ok(()),
        ProcessedPatch::Minimum(_) => true,
        ProcessedPatch::Regular(_) => false,
    };
    if domain == Domain::Isoline {
        return Ok(());
    }
    let edge_locations = |factor| locations(case.config, factor);
    let expected: Vec<_> = case.factors.outer().map(edge_locations).collect();
    let boundary = expected.iter().map(|edge| edge.len() - 1).sum();
    let few = || format!("{} points, fewer than the outer edges have", output.points.len());
    ensure(output.points.len() >= boundary, "crack-free", few)?;
    let mut ring = output.points[..boundary].to_vec();
    if is_minimum && domain == Domain::Quad {
        ring.rotate_right(1); // its corners are in another order
    }
    ring.extend(ring.first().copied());
    let mut first = 0;
    for (edge, expected) in expected.iter().enumerate() {
        let points = &ring[first..first + expected.len()];
        first += expected.len() - 1;
        let found: Option<Vec<u32>> = points.iter().map(|&p| along(domain, edge, p)).collect();
        let name = domain.factor_names()[edge];
        ensure(found.as_ref() == Some(expected), "crack-free", || {
            format!("edge {name} has {points:x?}, its factor alone gives {expected:x?}")
        })?;
        symmetry(expected)?;
    }
    Ok(())
}

/// The locations of an edge with this factor, which are those of a line with this detail.
fn locations(config: Config, factor: f32) -> Vec<u32> {
    let config = Config { output: OutputPrimitive::Point, ..config };
    let factors = IsolineFactors { density: 1.0, detail: factor };
    let line = Patch::new(config, factors).tessellate();
    line.points.iter().map(|point| point.u.to_bits()).collect()
}

/// The place of a point along an outer edge, in the direction of the walk; `None` if it is not on
/// the edge.
fn along(domain: Domain, edge: usize, point: DomainPoint) -> Option<u32> {
    let (u, v) = (point.u.to_bits(), point.v.to_bits());
    match (domain, edge) {
        (_, 0) => (u == 0).then(|| ONE.checked_sub(v)).flatten(),
        (_, 1) => (v == 0).then_some(u),
        (Domain::Triangle, _) => {
            (u.checked_add(v) == Some(ONE)).then(|| ONE.checked_sub(u)).flatten()
        }
        (_, 2) => (u == ONE).then_some(v),
        _ => (v == ONE).then(|| ONE.checked_sub(u)).flatten(),
    }
}
