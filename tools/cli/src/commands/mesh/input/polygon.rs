//! Polygons of any number of corners, and their division into triangles.
//!
//! Ears are cut off one after another (G. H. Meisters, *Polygons Have Ears*, American Mathematical
//! Monthly 82(6), 1975). An ear is a triangle of three consecutive corners that contains no other
//! corner. The roundest ear is cut first. So a corner on the straight line between its neighbours
//! remains until it belongs to a triangle with area, and it meets the corner of a neighbouring face
//! at the same place.
//!
//! Rounding moves such corners off the line, so that half of them have an ear without area. The
//! library earcut cuts those ears too: it leaves a triangle whose normal is noise in 522 of 1000
//! turned squares with corners on their sides.

use glam::{DVec2, DVec3, Vec3};
use tess_surface::{Face, Sides};

/// The indices of one corner, counted from 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Corner {
    pub(super) position: u32,
    pub(super) texcoord: Option<u32>,
    pub(super) normal: Option<u32>,
}

/// A face of three or four corners, all of which have the same kinds of indices; `None` for other
/// numbers of corners.
pub(super) fn face(corners: &[Corner]) -> Option<Face> {
    let sides = match *corners {
        [a, b, c] => Sides::Triangle([a, b, c]),
        [a, b, c, d] => Sides::Quad([a, b, c, d]),
        _ => return None,
    };
    let all = |index: fn(Corner) -> Option<u32>| {
        index(corners[0]).is_some().then(|| sides.map(|corner| index(corner).unwrap_or_default()))
    };
    Some(Face {
        positions: sides.map(|corner| corner.position),
        texcoords: all(|corner| corner.texcoord),
        normals: all(|corner| corner.normal),
    })
}

/// The corners of a face.
pub(super) fn corners(face: &Face) -> Vec<Corner> {
    let at = |sides: Option<Sides<u32>>, corner: usize| Some(sides?.as_slice()[corner]);
    let positions = face.positions.as_slice().iter().enumerate();
    positions
        .map(|(corner, &position)| Corner {
            position,
            texcoord: at(face.texcoords, corner),
            normal: at(face.normals, corner),
        })
        .collect()
}

/// The triangles into which a polygon is cut.
pub(super) fn triangles(corners: &[Corner], positions: &[Vec3]) -> Vec<Face> {
    let places: Vec<Vec3> =
        corners.iter().map(|corner| positions[corner.position as usize]).collect();
    // A polygon that crosses itself has no inside, so a fan is as good as any other set of
    // triangles.
    let cut = cut(&places).unwrap_or_else(|| (2..corners.len()).map(|k| [0, k - 1, k]).collect());
    cut.into_iter().filter_map(|triangle| face(&triangle.map(|corner| corners[corner]))).collect()
}

/// The triangles of a polygon's inside, as numbers of its corners, each in the polygon's direction.
/// Every corner is used, even one on the straight line between its neighbours. `None` for a polygon
/// that has no area or crosses itself.
fn cut(corners: &[Vec3]) -> Option<Vec<[usize; 3]>> {
    let plane = flattened(corners)?;
    let mut left: Vec<usize> = (0..plane.len()).collect();
    let mut triangles = Vec::with_capacity(plane.len().saturating_sub(2));
    while left.len() > 3 {
        let ear = roundest_ear(&plane, &left, THIN).or_else(|| roundest_ear(&plane, &left, 0.0))?;
        triangles.push(neighbours(&left, ear));
        left.remove(ear);
    }
    let last = neighbours(&left, 1);
    triangles.push(last);
    (roundness(last.map(|corner| plane[corner])) >= 0.0).then_some(triangles)
}

/// The remaining corner at this position, between its remaining neighbours.
fn neighbours(left: &[usize], at: usize) -> [usize; 3] {
    let count = left.len();
    [left[(at + count - 1) % count], left[at], left[(at + 1) % count]]
}

/// The roundness up to which a triangle may be one without area, rounded.
const THIN: f64 = 1e-5;

/// The position of the corner with the roundest ear. The ear must be rounder than `thin`, and must
/// contain no other corner even if it is widened by this part of its size.
fn roundest_ear(plane: &[DVec2], left: &[usize], thin: f64) -> Option<usize> {
    let triangle = |at: usize| neighbours(left, at).map(|corner| plane[corner]);
    let mut ears: Vec<(f64, usize)> =
        (0..left.len()).map(|at| (roundness(triangle(at)), at)).collect();
    ears.retain(|&(roundness, _)| roundness > thin);
    // Most corners have ears, so only few need to be examined.
    ears.sort_by(|a, b| b.0.total_cmp(&a.0));
    let is_empty = |at: usize| {
        let ear = triangle(at);
        let others = left.iter().map(|&corner| plane[corner]).filter(|point| !ear.contains(point));
        !others.into_iter().any(|point| is_in(ear, point, thin))
    };
    ears.into_iter().map(|(_, at)| at).find(|&at| is_empty(at))
}

/// Twice the area of a triangle, divided by the sum of the squares of its sides; negative for a
/// clockwise triangle.
fn roundness([a, b, c]: [DVec2; 3]) -> f64 {
    let sides = (b - a).length_squared() + (c - b).length_squared() + (a - c).length_squared();
    (b - a).perp_dot(c - a) / sides.max(f64::MIN_POSITIVE)
}

/// Whether a point is in a counter-clockwise triangle or on one of its sides. It may be outside by
/// `reach` times the length of a side.
fn is_in([a, b, c]: [DVec2; 3], point: DVec2, reach: f64) -> bool {
    [[a, b], [b, c], [c, a]].iter().all(|&[from, to]| {
        let side = to - from;
        side.perp_dot(point - from) >= -reach * side.length_squared()
    })
}

/// The corners in the plane that fits them, where they are counter-clockwise. The plane's normal is
/// M. Newell's: the sum of all corners' cross products.
fn flattened(corners: &[Vec3]) -> Option<Vec<DVec2>> {
    let first = corners.first()?.as_dvec3();
    let points: Vec<DVec3> = corners.iter().map(|corner| corner.as_dvec3() - first).collect();
    let next = |k: usize| points[(k + 1) % points.len()];
    let normal: DVec3 = points.iter().enumerate().map(|(k, point)| point.cross(next(k))).sum();
    let (right, up) = normal.try_normalize()?.any_orthonormal_pair();
    Some(points.iter().map(|point| DVec2::new(point.dot(right), point.dot(up))).collect())
}

/// Whether a quad has a corner pointing inwards, so that its surface would fold over itself.
pub(super) fn is_concave(corners: [Vec3; 4]) -> bool {
    let [a, b, c, d] = corners.map(|corner| corner.as_dvec3());
    let normal = (c - a).cross(d - b);
    let inwards = [[d, a, b], [a, b, c], [b, c, d], [c, d, a]].map(|[before, here, after]| {
        let cross = (here - before).cross(after - here);
        // For a straight corner, rounding decides the sign.
        cross.dot(normal) < -1e-6 * cross.length() * normal.length()
    });
    // With two such corners the quad's edges cross, and neither diagonal would help.
    inwards.iter().filter(|&&inwards| inwards).count() == 1
}

#[cfg(test)]
mod tests {
    use super::{cut, is_concave};
    use glam::Vec3;

    fn points(corners: &[[f32; 2]]) -> Vec<Vec3> {
        // The polygon is tilted, so that no coordinate can be left out.
        corners.iter().map(|&[x, y]| Vec3::new(x, y, 3.0 + x - 2.0 * y)).collect()
    }

    /// The area in the plane of x and y; negative for the other direction.
    fn area(corners: &[Vec3]) -> f32 {
        let next = |k: usize| corners[(k + 1) % corners.len()];
        let twice = corners.iter().enumerate().map(|(k, a)| a.x * next(k).y - a.y * next(k).x);
        0.5 * twice.sum::<f32>()
    }

    #[test]
    fn polygons_become_their_triangles() {
        for polygon in [
            &[[0., 0.], [2., 0.], [3., 2.], [1., 3.], [-1., 2.]][..],
            // A corner on a straight line, which a neighbour may share.
            &[[0., 0.], [1., 0.], [2., 0.], [2., 2.], [0., 2.]],
            // An L, an arrow, and a comb.
            &[[0., 0.], [3., 0.], [3., 1.], [1., 1.], [1., 3.], [0., 3.]],
            &[[0., 0.], [2., 0.], [0.4, 0.4], [0., 2.]],
            &[[0., 0.], [5., 0.], [5., 3.], [4., 1.], [3., 3.], [2., 1.], [1., 3.], [0., 1.]],
            // A square with a hole; a line that is passed twice joins the hole to the outside.
            &[
                [0., 0.],
                [4., 0.],
                [4., 4.],
                [0., 4.],
                [0., 0.],
                [1., 1.],
                [1., 3.],
                [3., 3.],
                [3., 1.],
                [1., 1.],
            ],
        ] {
            for turned in [false, true] {
                let mut corners = points(polygon);
                if turned {
                    corners.reverse();
                }
                let triangles = cut(&corners).expect("it does not cross itself");
                let areas = triangles.iter().map(|t| area(&t.map(|corner| corners[corner])));
                let areas: Vec<f32> = areas.collect();
                let whole = area(&corners);
                assert!(areas.iter().all(|area| area * whole > 0.0), "{polygon:?}: {areas:?}");
                let sum: f32 = areas.iter().sum();
                assert!((sum - whole).abs() < 1e-4, "{polygon:?}: {sum} of {whole}");
                let is_used = |at: &Vec3| triangles.iter().flatten().any(|&c| corners[c] == *at);
                assert!(corners.iter().all(is_used), "{polygon:?}: every corner is used");
            }
        }
    }

    #[test]
    fn polygons_without_an_inside() {
        assert_eq!(
            cut(&points(&[[0., 0.], [1., 0.], [2., 0.], [3., 0.], [4., 0.]])),
            None,
            "a line"
        );
        let bow = points(&[[0., 0.], [2., 2.], [2., 0.], [0., 3.], [-1., 1.]]);
        assert_eq!(cut(&bow), None, "it crosses itself");
    }

    #[test]
    fn concave_quads() {
        for (quad, expected) in [
            ([[0., 0.], [2., 0.], [0.4, 0.4], [0., 2.]], true),
            ([[0., 0.], [2., 0.], [2., 2.], [0., 2.]], false),
            ([[0., 0.], [2., 0.], [1., 1.], [0., 2.]], false), // straight
            ([[0., 0.], [2., 2.], [2., 0.], [0., 2.]], false), // crossed
        ] {
            let corners: [Vec3; 4] = points(&quad).try_into().expect("four");
            assert_eq!(is_concave(corners), expected, "{quad:?}");
        }
    }
}
