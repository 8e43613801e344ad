//! Conversion of domain points to pixels, and the sizes of drawn elements.
#![expect(
    clippy::float_arithmetic,
    clippy::cast_precision_loss,
    reason = "positions of a drawing, in pixels"
)]

use crate::picture::Position;
use tess_core::{Domain, DomainPoint};

/// The placement of a domain in a square picture.
///
/// Quads and isolines fill a square, with u to the right and v down. Triangles are equilateral,
/// with w = 1 at the top, u = 1 at the right and v = 1 at the left, so clockwise stays clockwise.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    origin: Position,
    along_u: Position,
    along_v: Position,
    domain: Domain,
}

impl Layout {
    pub(super) fn new(domain: Domain, size: u32) -> Self {
        let size = f64::from(size);
        let margin = size * 0.04;
        let side = size - 2.0 * margin;
        let height = side * 0.75_f64.sqrt();
        match domain {
            Domain::Triangle => Self {
                origin: [size / 2.0, (size - height) / 2.0],
                along_u: [side / 2.0, height],
                along_v: [-side / 2.0, height],
                domain,
            },
            Domain::Isoline | Domain::Quad => {
                Self { origin: [margin; 2], along_u: [side, 0.0], along_v: [0.0, side], domain }
            }
        }
    }

    fn place(&self, u: f64, v: f64) -> Position {
        [0, 1].map(|axis| self.origin[axis] + u * self.along_u[axis] + v * self.along_v[axis])
    }

    /// Points of any bits, so that a faulty point is drawn where it is.
    pub(super) fn place_all(&self, points: &[DomainPoint]) -> Vec<Position> {
        let [u, v] = [|p: &DomainPoint| p.u.to_bits(), |p: &DomainPoint| p.v.to_bits()];
        let unit = |bits: u32| f64::from(bits) / 65536.0;
        points.iter().map(|point| self.place(unit(u(point)), unit(v(point)))).collect()
    }

    /// The corners of the domain.
    pub(super) fn corners(&self) -> Vec<Position> {
        let corners: &[(f64, f64)] = match self.domain {
            Domain::Triangle => &[(0.0, 1.0), (0.0, 0.0), (1.0, 0.0)],
            Domain::Isoline | Domain::Quad => &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)],
        };
        corners.iter().map(|&(u, v)| self.place(u, v)).collect()
    }
}

/// The width of edges: finer meshes have finer edges.
pub(super) fn edge_width(points: usize) -> f64 {
    (18.0 / (points as f64).sqrt()).clamp(0.4, 1.5)
}

/// The radius of points: finer meshes have smaller points.
pub(super) fn dot_radius(points: usize) -> f64 {
    (30.0 / (points as f64).sqrt()).clamp(0.8, 4.0)
}

/// The radius of a mark, which is larger than the point that it surrounds.
pub(super) fn mark_radius(points: usize) -> f64 {
    dot_radius(points) + 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Between the smallest and the largest, sizes fall with the square root of the number of
    /// points.
    #[test]
    fn finer_meshes_are_drawn_finer() {
        let all = [4, 400, 10_000].map(|points| [edge_width(points), dot_radius(points)]);
        let expected = [[1.5, 4.0], [0.9, 1.5], [0.4, 0.8]];
        let near = |(found, expected): (&[f64; 2], &[f64; 2])| {
            found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-9)
        };
        assert!(all.iter().zip(&expected).all(near), "{all:?}");
    }
}
