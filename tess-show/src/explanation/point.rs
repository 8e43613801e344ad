//! The origin of one domain point (spec section 6).

use super::Fixed;
use super::factors::{name, named};
use super::placement::Placement;
use std::fmt;
use tess_core::fixed_point::{HALF, TWO_THIRDS};
use tess_core::{Patch, PatchFactors, PointOrigin};
use tess_core::{ProcessedFactor, QuadFactors, TriangleFactors};

/// One point: its place in the walk, and the placements that make up its coordinates.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(crate) struct PointReport {
    point: u32,
    location: String,
    u: Fixed,
    v: Fixed,
    placements: Vec<Placement>,
    /// The rule that derives the coordinates from the placements.
    rule: String,
}

impl PointReport {
    /// Explains point `i`; `None` if the patch has no such point.
    pub(crate) fn new(patch: &Patch, i: u32) -> Option<Self> {
        let location = patch.locate_point(i)?;
        let point = patch.point(i)?;
        let (placements, rule) = match patch.processed().factors()? {
            PatchFactors::Isoline(factors) => isoline(factors, location),
            PatchFactors::Triangle(factors) => triangle(factors, location),
            PatchFactors::Quad(factors) => quad(factors, location),
        };
        Some(Self {
            point: i,
            location: describe(location, patch.processed().factors()),
            u: Fixed::new(point.u.to_bits()),
            v: Fixed::new(point.v.to_bits()),
            placements,
            rule,
        })
    }
}

type Origin = (Vec<Placement>, String);

fn isoline(factors: &tess_core::IsolineFactors<ProcessedFactor>, location: PointOrigin) -> Origin {
    let PointOrigin::Line { line, p } = location else {
        return corner();
    };
    let u = Placement::new("detail", &factors.detail.context, p);
    let v = Placement::new("density", &factors.density.context, line);
    (vec![u, v], "(u, v) = the two places".to_owned())
}

fn triangle(factors: &TriangleFactors<ProcessedFactor>, location: PointOrigin) -> Origin {
    match location {
        PointOrigin::OuterEdge { edge, p } => {
            let (name, factor) = named(&PatchFactors::Triangle(*factors))[edge as usize];
            let context = factor.context;
            let position = if edge == 1 { p } else { context.points - 1 - p };
            let rule = ["(0, q)", "(q, 0)", "(q, 1 - q)"][edge as usize];
            let q = Placement::new(name, &context, position);
            (vec![q], format!("(u, v) = {rule}"))
        }
        PointOrigin::Ring { ring, edge, p } => triangle_ring(factors, ring, edge, p),
        PointOrigin::Centre { .. } => {
            (vec![], "the centre of an even inside: one third each".to_owned())
        }
        PointOrigin::Corner { .. } | PointOrigin::Line { .. } => corner(),
    }
}

fn triangle_ring(
    factors: &TriangleFactors<ProcessedFactor>,
    ring: u32,
    edge: u32,
    p: u32,
) -> Origin {
    let context = &factors.inside.context;
    let end = context.points - 1 - ring;
    let along = if edge == 1 { ring + p } else { end - p };
    let across = Placement::new("inside", context, ring);
    let place = Placement::new("inside", context, along);
    let perp = (across.location() * TWO_THIRDS + HALF) >> 16;
    let shift = perp.div_ceil(2);
    let rule = ["(perp, q)", "(q, perp)", "(q, 1 - q - perp)"][edge as usize];
    let rule = format!(
        "perp = two thirds of the first place = {perp:05x}, shift = half of it = {shift:05x}, \
         q = the second place - shift; (u, v) = {rule}"
    );
    (vec![across, place], rule)
}

fn quad(factors: &QuadFactors<ProcessedFactor>, location: PointOrigin) -> Origin {
    let [c_u, c_v] = factors.inside().map(|factor| factor.context);
    let at = |u, v| {
        let u = Placement::new("inside U", &c_u, u);
        let v = Placement::new("inside V", &c_v, v);
        (vec![u, v], "(u, v) = the two places".to_owned())
    };
    match location {
        PointOrigin::OuterEdge { edge, p } => {
            let (name, factor) = named(&PatchFactors::Quad(*factors))[edge as usize];
            let context = factor.context;
            let position = if edge == 1 || edge == 2 { p } else { context.points - 1 - p };
            let rule = ["(0, q)", "(q, 0)", "(1, q)", "(q, 1)"][edge as usize];
            (vec![Placement::new(name, &context, position)], format!("(u, v) = {rule}"))
        }
        PointOrigin::Ring { ring, edge, p } => {
            let (end_u, end_v) = (c_u.points - 1 - ring, c_v.points - 1 - ring);
            match edge {
                0 => at(ring, end_v - p),
                1 => at(ring + p, ring),
                2 => at(end_u, ring + p),
                _ => at(end_u - p, end_v),
            }
        }
        PointOrigin::Centre { p } => {
            let ring = c_u.points.min(c_v.points) / 2;
            if c_u.points > c_v.points {
                at(ring + p, c_v.half_points)
            } else {
                at(c_u.half_points, c_v.points - 1 - ring - p)
            }
        }
        PointOrigin::Corner { .. } | PointOrigin::Line { .. } => corner(),
    }
}

fn corner() -> Origin {
    (vec![], "a corner of the minimum patch".to_owned())
}

/// A description of a location.
fn describe(location: PointOrigin, factors: Option<&PatchFactors<ProcessedFactor>>) -> String {
    let place = place(location, factors);
    match location {
        PointOrigin::Corner { .. } => place,
        PointOrigin::Line { p, .. }
        | PointOrigin::OuterEdge { p, .. }
        | PointOrigin::Ring { p, .. }
        | PointOrigin::Centre { p } => format!("{place}, point {p}"),
    }
}

/// A description of a location's corner, line, edge or centre.
pub(super) fn place(
    location: PointOrigin,
    factors: Option<&PatchFactors<ProcessedFactor>>,
) -> String {
    match location {
        PointOrigin::Corner { corner } => format!("minimum patch, corner {corner}"),
        PointOrigin::Line { line, .. } => format!("line {line}"),
        PointOrigin::OuterEdge { edge, .. } => {
            let names = factors.map_or(&[][..], |factors| factors.domain().factor_names());
            let field = names.get(edge as usize).copied().unwrap_or("?");
            format!("outer edge {edge} ({})", name(field))
        }
        PointOrigin::Ring { ring, edge, .. } => format!("ring {ring}, edge {edge}"),
        PointOrigin::Centre { .. } => "centre".to_owned(),
    }
}

impl fmt::Display for PointReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { point, location, u, v, placements, rule } = self;
        writeln!(f, "point {point}: {location}")?;
        writeln!(f, "  u = {:05x} ({}), v = {:05x} ({})", u.bits, u.value, v.bits, v.value)?;
        for placement in placements {
            writeln!(f, "  {placement}")?;
        }
        writeln!(f, "  {rule}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_core::{Config, OutputPrimitive, Partitioning};

    /// On quads and isolines, where coordinates are places, the places shown equal the coordinates.
    #[test]
    fn places_are_the_coordinates() {
        for partitioning in Partitioning::ALL {
            let config = Config::new(partitioning, OutputPrimitive::TriangleCw);
            for (inside_u, inside_v) in [(4.0, 7.0), (7.0, 4.0), (3.0, 3.0), (6.5, 6.5), (8.0, 1.0)]
            {
                let raw = QuadFactors { u0: 3.0, v0: 4.5, u1: 5.0, v1: 1.0, inside_u, inside_v };
                let patch = Patch::new(config, PatchFactors::Quad(raw));
                for i in 0..patch.counts().points {
                    let report = PointReport::new(&patch, i).expect("the point exists");
                    if let [u, v] = &report.placements[..] {
                        let places = (u.location(), v.location());
                        assert_eq!(places, (report.u.bits, report.v.bits), "{report}");
                    }
                }
            }
        }
    }
}
