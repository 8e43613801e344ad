//! Bounds on the distance between a patch and the triangles that replace it.
//!
//! Consider a triangle whose corners are on a surface and whose domain triangle has extents a in u
//! and b in v. No point of it is further from the surface's point with the same domain coordinates
//! than (a^2 Muu + 2 a b Muv + b^2 Mvv) / 8, where M are the largest lengths of the second
//! derivatives (D. Filip, R. Magedson, R. Markot, *Surface algorithms using bounds on derivatives*,
//! Computer Aided Geometric Design 3(4), 1986). Because 2ab <= a^2 + b^2, it is enough that a^2
//! (Muu + Muv) and b^2 (Mvv + Muv) are each at most 4 tolerance, which separates the two axes. The
//! derivatives are bounded by their control points. The control points' positions of a rational
//! patch are treated as those of a polynomial one, so its bounds are only estimates.

use crate::bezier::BezierPatch;
use crate::patch::Surface;
use crate::pn::PnTriangle;
use crate::sides::Sides;
use glam::Vec3;

/// Bounds of a patch's second derivatives, one along u and one along v.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// The bound along u: Muu + Muv.
    pub u: f32,
    /// The bound along v: Mvv + Muv.
    pub v: f32,
}

/// The largest extent of a tessellated quad's triangles, in segments of the coarsest factor. It is
/// one segment if factors are powers of two. (With other factors it is up to five: the stitch
/// between two rows advances in ruler order, which then runs ahead of the positions.)
const QUAD_EXTENT: f32 = 1.0;

/// The same for triangle patches, whose inside rings are shifted by a third of a segment: 4/3, and
/// a little more for the rounding of points.
const TRIANGLE_EXTENT: f32 = 1.334;

impl Bend {
    /// The bounds of a plane.
    pub const ZERO: Self = Self { u: 0.0, v: 0.0 };

    /// The bounds of a surface.
    #[must_use]
    pub fn of(surface: &Surface) -> Self {
        match surface {
            Surface::FlatTriangle(_) => Self::ZERO,
            Surface::Bilinear([a, b, c, d]) => Self::quad(0.0, (*a - *b + *c - *d).length(), 0.0),
            Surface::Bezier(patch) => Self::bicubic(patch),
            Surface::PnQuad(quad) => Self::bicubic(&quad.patch),
            Surface::PnTriangle(triangle) => Self::cubic_triangle(triangle),
        }
    }

    /// The bound along the running coordinate of edge `edge` of a patch with these sides; for a
    /// triangle, the larger of the two bounds.
    #[must_use]
    pub fn along(&self, sides: &Sides<()>, edge: usize) -> f32 {
        match (sides, edge) {
            (Sides::Triangle(_), _) => self.u.max(self.v),
            (Sides::Quad(_), 0 | 2) => self.v,
            (Sides::Quad(_), _) => self.u,
        }
    }

    fn quad(uu: f32, uv: f32, vv: f32) -> Self {
        const SCALE: f32 = QUAD_EXTENT * QUAD_EXTENT;
        Self { u: (uu + uv) * SCALE, v: (vv + uv) * SCALE }
    }

    fn bicubic(patch: &BezierPatch) -> Self {
        let points = patch.points.map(|row| row.map(crate::math::project));
        let columns: [[Vec3; 4]; 4] = core::array::from_fn(|i| points.map(|row| row[i]));
        let second = |lines: &[[Vec3; 4]; 4]| {
            let bends = lines.iter().flat_map(|&[a, b, c, d]| [a - b * 2.0 + c, b - c * 2.0 + d]);
            6.0 * longest(bends)
        };
        let twists = (0..9).map(|k| {
            let (i, j) = (k % 3, k / 3);
            (points[j + 1][i + 1] - points[j + 1][i]) - (points[j][i + 1] - points[j][i])
        });
        Self::quad(second(&points), 9.0 * longest(twists), second(&columns))
    }

    /// Second derivatives of a cubic triangle by u and v are 6 times second differences of its
    /// net, interpolated.
    fn cubic_triangle(triangle: &PnTriangle) -> Self {
        let ([u, v, w], [[wv, vw], [wu, uw], [vu, uv]], center) = triangle.net();
        // Net points by their distance from w: `wu` is one step from w to u, `uw` two.
        let uu = [u - uw * 2.0 + wu, uw - wu * 2.0 + w, uv - center * 2.0 + wv];
        let vv = [v - vw * 2.0 + wv, vw - wv * 2.0 + w, vu - center * 2.0 + wu];
        let mixed = [uv - uw - center + wu, vu - center - vw + wv, center - wu - wv + w];
        let [uu, vv, mixed] = [uu, vv, mixed].map(|bends| 6.0 * longest(bends.into_iter()));
        const SCALE: f32 = TRIANGLE_EXTENT * TRIANGLE_EXTENT;
        Self { u: (uu + mixed) * SCALE, v: (vv + mixed) * SCALE }
    }
}

fn longest(vectors: impl Iterator<Item = Vec3>) -> f32 {
    vectors.map(Vec3::length).fold(0.0, f32::max)
}
