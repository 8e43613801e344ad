//! Changes of places, levels and states from which mistakes are made.

use crate::case::Case;
use tess_core::fixed_point::ONE;
use tess_core::{Config, Domain, DomainPoint, OutputPrimitive, PatchFactors, Tessellation};

/// The levels of a case, outer ones first.
pub(super) fn levels(case: &Case) -> Vec<f32> {
    case.factors.iter().collect()
}

/// The number of outer levels.
pub(super) fn outer(case: &Case) -> usize {
    case.domain().outer_factors()
}

/// The case with other levels, which the function returns by position.
pub(super) fn with_levels(case: &Case, level: impl Fn(usize) -> f32) -> Case {
    Case { factors: PatchFactors::from_fn(case.domain(), level), ..*case }
}

/// The case with each level changed; the function receives its position and the level.
pub(super) fn each(case: &Case, change: impl Fn(usize, f32) -> f32) -> Case {
    let levels = levels(case);
    with_levels(case, |position| change(position, levels[position]))
}

/// The case with one level changed, if the domain has it.
pub(super) fn one(case: &Case, position: usize, change: impl Fn(f32) -> f32) -> Case {
    each(case, |p, level| if p == position { change(level) } else { level })
}

/// The case with levels taken from other positions.
pub(super) fn taken(case: &Case, from: impl Fn(usize) -> usize) -> Case {
    let levels = levels(case);
    with_levels(case, |position| levels[from(position)])
}

/// Whether an outer level discards the patch. A device that mixes levels up must not make a patch
/// of such a case.
pub(super) fn is_discarded(case: &Case) -> bool {
    case.factors.outer().any(|level| level.is_nan() || level <= 0.0)
}

/// The case with other state.
pub(super) fn with_config(case: &Case, change: impl Fn(Config) -> Config) -> Case {
    Case { config: change(case.config), ..*case }
}

/// Whether a case is drawn as points, lines or triangles that a standard knows; lines of triangles
/// and quads are a debugging view.
pub(super) fn has_primitives(case: &Case) -> bool {
    case.domain() == Domain::Isoline || case.config.output != OutputPrimitive::Line
}

/// Changes every place of an output.
pub(super) fn move_all(output: &mut Tessellation, place: impl Fn([u32; 2]) -> [u32; 2]) {
    for point in &mut output.points {
        let [u, v] = place([point.u.to_bits(), point.v.to_bits()]);
        *point = DomainPoint::from_bits(u, v);
    }
}

/// Exchanges the second and third vertices of every triangle.
pub(super) fn turn_all(case: &Case, output: &mut Tessellation) {
    if case.primitive_size() == 3 {
        output.indices.chunks_mut(3).for_each(|triangle| triangle.swap(1, 2));
    }
}

/// The numbers of the points on an outer edge, including its ends, in the order of their distance
/// from its start, by coordinates.
pub(super) fn edge_points(case: &Case, output: &Tessellation, edge: usize) -> Vec<usize> {
    let along = |point: &DomainPoint| {
        let [u, v] = [point.u.to_bits(), point.v.to_bits()];
        match (case.domain(), edge) {
            (Domain::Isoline, _) => None,
            (_, 0) => (u == 0).then_some(v),
            (_, 1) => (v == 0).then_some(u),
            (Domain::Triangle, _) => (u + v == ONE).then_some(u),
            (_, 2) => (u == ONE).then_some(v),
            _ => (v == ONE).then_some(u),
        }
    };
    let points = output.points.iter().enumerate();
    let mut on: Vec<_> = points.filter_map(|(i, point)| Some((along(point)?, i))).collect();
    on.sort_unstable();
    on.into_iter().map(|(_, i)| i).collect()
}

/// Moves the points of an outer edge, except its ends, to other places along it.
pub(super) fn place_along(
    case: &Case,
    output: &mut Tessellation,
    edge: usize,
    place: impl Fn(usize, u32) -> u32,
) {
    let points = edge_points(case, output, edge);
    let inner = points.len().saturating_sub(2);
    for (k, &i) in points.iter().enumerate().skip(1).take(inner) {
        let [u, v] = [output.points[i].u.to_bits(), output.points[i].v.to_bits()];
        let [u, v] = match (case.domain(), edge) {
            (_, 0 | 2) if case.domain() == Domain::Quad || edge == 0 => [u, place(k, v)],
            (Domain::Triangle, 2) => [place(k, u), ONE - place(k, u)],
            _ => [place(k, u), v],
        };
        output.points[i] = DomainPoint::from_bits(u, v);
    }
}
