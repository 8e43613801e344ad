//! Polygons of any number of corners, and their division into triangles.
//!
//! ```text
//!   4-----------3     A polygon with holes passes a line in both directions to reach each of them:
//!   | 8-7  12-11|     1 2 3 4 1 5 8 7 6 5 6 9 12 11 10 9 6 5. The passes over an edge are counted with their
//!   | | |   | | |     direction: 1 for each way onwards, -1 for each way back. Edges whose sum is 0 vanish
//!   | 5-6---9-10|     (1-5, 6-9); the others (5-6: passed three times, sum 1) bound the inside.
//!   1-----------2
//! ```
//!
//! The edges that remain are the constraints of a Delaunay triangulation (L. P. Chew, *Constrained
//! Delaunay Triangulations*, Algorithmica 4, 1989). It uses every corner, even one on the straight
//! line between its neighbours, where the corner of a neighbouring face is at the same place. A
//! triangle without area appears only where nothing else fits, because the smallest angle is the
//! largest possible. The regions between the constraints are inside or outside by their winding
//! number.

use glam::{DVec2, DVec3, Vec3};
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation as _};
use std::collections::{BTreeMap, HashMap};
use tess_surface::{Face, Sides};

/// The indices of one corner, counted from 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Corner {
    pub(crate) position: u32,
    pub(crate) texcoord: Option<u32>,
    pub(crate) normal: Option<u32>,
}

/// A face of three or four corners, all of which have the same kinds of indices; `None` for other
/// numbers of corners.
pub(crate) fn face(corners: &[Corner]) -> Option<Face> {
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
pub(crate) fn corners(face: &Face) -> Vec<Corner> {
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

/// The coordinates of a place as a key, in which -0 equals 0.
pub(crate) type Place = [u32; 3];

pub(crate) fn place(position: Vec3) -> Place {
    (position + Vec3::ZERO).to_array().map(f32::to_bits)
}

/// Triangles that replace a polygon.
pub(crate) struct Triangles {
    pub(crate) faces: Vec<Face>,
    /// Whether the polygon crosses itself, so that it has no inside.
    pub(crate) is_crossed: bool,
}

/// The triangles into which a polygon is cut.
pub(crate) fn triangles(corners: &[Corner], positions: &[Vec3]) -> Triangles {
    let places: Vec<Vec3> =
        corners.iter().map(|corner| positions[corner.position as usize]).collect();
    let cut = cut(&places);
    let is_crossed = cut == Err(NoInside::Crossed);
    // Without an inside, a fan is as good as any other set of triangles.
    let cut = cut.unwrap_or_else(|_| (2..corners.len()).map(|k| [0, k - 1, k]).collect());
    let faces = cut.into_iter().map(|triangle| triangle.map(|corner| corners[corner]));
    Triangles { faces: faces.filter_map(|triangle| face(&triangle)).collect(), is_crossed }
}

/// The reason why a polygon has no inside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NoInside {
    /// It has no area.
    Flat,
    /// Two of its edges cross.
    Crossed,
}

/// A corner in the plane, with its number in the polygon.
struct PlaneCorner {
    at: Point2<f64>,
    number: usize,
}

impl HasPosition for PlaneCorner {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.at
    }
}

type Plane = ConstrainedDelaunayTriangulation<PlaneCorner>;

/// The triangles of a polygon's inside, as numbers of its corners, each in the polygon's direction.
/// Every place of a corner is used.
fn cut(corners: &[Vec3]) -> Result<Vec<[usize; 3]>, NoInside> {
    let Some(points) = flattened(corners) else {
        return Err(if is_line(corners) { NoInside::Flat } else { NoInside::Crossed });
    };
    let mut plane = Plane::new();
    let mut handles: HashMap<Place, FixedVertexHandle> = HashMap::new();
    let mut ring = Vec::with_capacity(points.len());
    for (number, (point, corner)) in points.iter().zip(corners).enumerate() {
        let key = place(*corner);
        let handle = match handles.get(&key) {
            Some(&handle) => handle,
            None => {
                let before = plane.num_vertices();
                let at = spade::mitigate_underflow(Point2::new(point.x, point.y));
                let handle =
                    plane.insert(PlaneCorner { at, number }).map_err(|_| NoInside::Flat)?;
                // Two places that are one in the plane: the polygon is folded there.
                if plane.num_vertices() == before {
                    return Err(NoInside::Crossed);
                }
                handles.insert(key, handle);
                handle
            }
        };
        ring.push(handle);
    }
    let border = border(&ring);
    for &(from, to) in border.keys() {
        let ends = [from, to].map(FixedVertexHandle::from_index);
        if !plane.can_add_constraint(ends[0], ends[1]) {
            return Err(NoInside::Crossed);
        }
        plane.add_constraint(ends[0], ends[1]);
    }
    let triangles = inside(&plane, &border);
    if triangles.is_empty() { Err(NoInside::Flat) } else { Ok(triangles) }
}

/// Whether all corners are on one line, except for rounding.
fn is_line(corners: &[Vec3]) -> bool {
    let from_first = || corners.iter().map(|&corner| (corner - corners[0]).as_dvec3());
    let longest = from_first().max_by(|a, b| a.length().total_cmp(&b.length()));
    let longest = longest.unwrap_or_default();
    from_first().all(|to| to.cross(longest).length() <= 1e-6 * longest.length_squared())
}

/// The edges between which the inside is: the numbers of both ends, the lower one first, and how
/// much more often the polygon passes from the first to the second than back, which is not 0.
fn border(ring: &[FixedVertexHandle]) -> BTreeMap<(usize, usize), i32> {
    let mut passes = BTreeMap::new();
    for (k, from) in ring.iter().enumerate() {
        let [from, to] = [from, &ring[(k + 1) % ring.len()]].map(|handle| handle.index());
        if from != to {
            let way = if from < to { 1 } else { -1 };
            *passes.entry((from.min(to), from.max(to))).or_insert(0) += way;
        }
    }
    passes.retain(|_, sum| *sum != 0);
    passes
}

/// The area up to which a region is nothing but rounding. The polygon is within 1 of its first
/// corner.
const LEAST_AREA: f64 = 1e-13;

/// The triangles of the regions around which the border runs counter-clockwise.
fn inside(plane: &Plane, border: &BTreeMap<(usize, usize), i32>) -> Vec<[usize; 3]> {
    let mut triangles = Vec::new();
    let mut is_seen = vec![false; plane.num_all_faces()];
    for first in plane.inner_faces() {
        if is_seen[first.index()] {
            continue;
        }
        is_seen[first.index()] = true;
        let (mut waiting, mut region) = (vec![first], Vec::new());
        while let Some(face) = waiting.pop() {
            region.push(face);
            for edge in face.adjacent_edges().iter().filter(|edge| !edge.is_constraint_edge()) {
                let Some(beyond) = edge.rev().face().as_inner() else { continue };
                if !std::mem::replace(&mut is_seen[beyond.index()], true) {
                    waiting.push(beyond);
                }
            }
        }
        // The largest triangle, so that rounding cannot move its middle over the border. Where a
        // corner is straight, a region without area may be left between it and the hull.
        let largest = region.iter().max_by(|a, b| a.area().total_cmp(&b.area()));
        if largest.is_some_and(|face| {
            face.area() > LEAST_AREA && winding(plane, border, face.center()) > 0
        }) {
            let numbers = region.iter().map(|face| face.vertices().map(|v| v.data().number));
            triangles.extend(numbers);
        }
    }
    triangles
}

/// How often the border runs around a point, counter-clockwise: the passes over the ray from the
/// point to the right.
fn winding(plane: &Plane, border: &BTreeMap<(usize, usize), i32>, point: Point2<f64>) -> i32 {
    let at = |vertex: usize| plane.vertex(FixedVertexHandle::from_index(vertex)).position();
    let passes = border.iter().map(|(&(from, to), &times)| {
        let (a, b) = (at(from), at(to));
        let is_up = a.y <= point.y && point.y < b.y;
        let is_down = b.y <= point.y && point.y < a.y;
        let side = (b.x - a.x) * (point.y - a.y) - (b.y - a.y) * (point.x - a.x);
        match (is_up, is_down) {
            (true, _) if side > 0.0 => times,
            (_, true) if side < 0.0 => -times,
            _ => 0,
        }
    });
    passes.sum()
}

/// The corners in the plane that fits them, where they are counter-clockwise. The plane's normal is
/// M. Newell's: the sum of all corners' cross products.
fn flattened(corners: &[Vec3]) -> Option<Vec<DVec2>> {
    let first = corners.first()?.as_dvec3();
    let points: Vec<DVec3> = corners.iter().map(|corner| corner.as_dvec3() - first).collect();
    let next = |k: usize| points[(k + 1) % points.len()];
    let normal: DVec3 = points.iter().enumerate().map(|(k, point)| point.cross(next(k))).sum();
    let (right, up) = normal.try_normalize()?.any_orthonormal_pair();
    // Within 1, far from where the triangulation's numbers end.
    let size = points.iter().fold(0.0f64, |size, point| size.max(point.abs().max_element()));
    let scaled = points.iter().map(|&point| point / size);
    Some(scaled.map(|point| DVec2::new(point.dot(right), point.dot(up))).collect())
}

/// The shape of a quad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum QuadShape {
    /// No corner points inwards.
    Convex,
    /// One corner points inwards, so that a single surface would fold over itself.
    Concave,
    /// Two opposite edges cross.
    Crossed,
}

impl QuadShape {
    pub(crate) fn of(corners: [Vec3; 4]) -> Self {
        let [a, b, c, d] = corners.map(|corner| corner.as_dvec3());
        let normal = (c - a).cross(d - b);
        let crosses = [[d, a, b], [a, b, c], [b, c, d], [c, d, a]]
            .map(|[before, here, after]| (here - before).cross(after - here));
        // For a straight corner, rounding decides the sign. It is small beside the whole quad, not
        // beside the corner's own edges, of which one may be short.
        let size = (c - a).length() * (d - b).length();
        let is_against =
            |cross: DVec3, normal: DVec3| cross.dot(normal) < -1e-6 * size * normal.length();
        // The diagonals of a crossed quad may be parallel; then there is no normal to compare with,
        // but two corners turn against the first.
        let reference = if normal.length() > 1e-6 * size {
            normal
        } else {
            crosses.into_iter().fold(DVec3::ZERO, |largest, cross| {
                if cross.length() > largest.length() { cross } else { largest }
            })
        };
        match crosses.into_iter().filter(|&cross| is_against(cross, reference)).count() {
            1 => Self::Concave,
            2 => Self::Crossed,
            _ => Self::Convex,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{NoInside, QuadShape, cut};
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
            Err(NoInside::Flat),
            "a line"
        );
        let there_and_back =
            [0, 1, 2, 3, 2, 1].map(|k: u8| Vec3::new(0.1, 0.3, 0.7) * f32::from(k));
        assert_eq!(cut(&there_and_back), Err(NoInside::Flat), "a line, but for rounding");
        // Two corners above each other, twice: the plane that fits is that of x and y.
        let folded =
            [[0., 0., 0.], [4., 0., 1.], [4., 0., -1.], [4., 4., 0.], [0., 4., 1.], [0., 4., -1.]];
        assert_eq!(cut(&folded.map(Vec3::from_array)), Err(NoInside::Crossed), "folded");
        let bow = points(&[[0., 0.], [2., 2.], [2., 0.], [0., 3.], [-1., 1.]]);
        assert_eq!(cut(&bow), Err(NoInside::Crossed), "it crosses itself");
    }

    /// The area of a polygon's triangles, all of which run its way.
    fn cut_area(corners: &[Vec3]) -> f32 {
        let triangles = cut(corners).expect("it does not cross itself");
        let areas = triangles.iter().map(|t| area(&t.map(|corner| corners[corner])));
        let areas: Vec<f32> = areas.collect();
        let whole = area(corners);
        let is_right = |area: &f32| *area != 0.0 && (*area > 0.0) == (whole > 0.0);
        assert!(areas.iter().all(is_right), "{corners:?}: {areas:?}");
        areas.iter().sum()
    }

    /// One place may be there with both zeros, and twice in a row.
    #[test]
    fn places_that_are_repeated() {
        let hole = [[0., 0.], [4., 0.], [4., 4.], [0., 4.], [-0.0, -0.0], [1., 1.], [1., 3.]];
        let hole = points(&[&hole[..], &[[3., 3.], [3., 1.], [1., 1.]]].concat());
        assert!((cut_area(&hole) - 12.0).abs() < 1e-4, "a hole, reached from zeros of two signs");
        let twice =
            points(&[[0., 0.], [2., 0.], [2., 0.], [3., 2.], [1., 3.], [1., 3.], [-1., 2.]]);
        let once = points(&[[0., 0.], [2., 0.], [3., 2.], [1., 3.], [-1., 2.]]);
        assert!((cut_area(&twice) - area(&once)).abs() < 1e-4, "corners in a row");
    }

    /// Skylines whose corners are as high as the middles of triangles, and their holes' mirror
    /// images; in the plane of x and y nothing is rounded.
    #[test]
    fn skylines_of_whole_numbers() {
        let mut state = 1u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            3.0 * f32::from(u8::try_from(state >> 28).expect("four bits"))
        };
        for _ in 0..200 {
            let mut skyline = vec![[0., -3.], [63., -3.]];
            for k in (0..21u8).rev() {
                let (high, right) = (next(), 3.0 * f32::from(k));
                skyline.extend([[right + 3.0, high], [right, high]]);
            }
            skyline.dedup();
            let corners: Vec<Vec3> = skyline.iter().map(|&[x, y]| Vec3::new(x, y, 0.0)).collect();
            assert!((cut_area(&corners) - area(&corners)).abs() < 1e-2, "{skyline:?}");
        }
    }

    /// The size of a polygon does not matter, nor a coordinate that is nearly zero.
    #[test]
    fn tiny_and_huge_polygons() {
        for scale in [1e-12f32, 1e-6, 1e6, 1e12] {
            let comb =
                [[0., 0.], [5., 0.], [5., 3.], [4., 1.], [3., 3.], [2., 1.], [1., 3.], [0., 1.]];
            let corners: Vec<Vec3> = points(&comb).iter().map(|&at| at * scale).collect();
            let found = cut_area(&corners) / area(&corners);
            assert!((found - 1.0).abs() < 1e-4, "{scale}: {found}");
        }
        let high = [[0., 0.], [1e4, 1e-40], [1e4, 1e4], [5e3, 1.5e4], [0., 1e4]];
        let corners = high.map(|[x, y]| Vec3::new(x, y, 0.0));
        assert!((cut_area(&corners) / 1.25e8 - 1.0).abs() < 1e-4, "a coordinate of 1e-40");
    }

    /// The polygon of the picture above: the edge between two holes is passed three times.
    #[test]
    fn an_edge_that_is_passed_three_times() {
        let at = [
            [0., 0.],
            [10., 0.],
            [10., 4.],
            [0., 4.],
            [1., 1.],
            [3., 1.],
            [3., 3.],
            [1., 3.],
            [6., 1.],
            [8., 1.],
            [8., 3.],
            [6., 3.],
        ];
        let passed = [1, 2, 3, 4, 1, 5, 8, 7, 6, 5, 6, 9, 12, 11, 10, 9, 6, 5];
        let corners = points(&passed.map(|corner: usize| at[corner - 1]));
        let triangles = cut(&corners).expect("it does not cross itself");
        let areas = triangles.iter().map(|t| area(&t.map(|corner| corners[corner])));
        let areas: Vec<f32> = areas.collect();
        assert!(areas.iter().all(|&area| area > 0.0), "{areas:?}");
        assert!((areas.iter().sum::<f32>() - 32.0).abs() < 1e-4, "{areas:?}");
    }

    /// The time grows little faster than the number of corners: this took 17 seconds once.
    #[test]
    fn a_ring_of_many_corners() {
        let corner = |k: u16, radius: f32| {
            let angle = f32::from(k) * std::f32::consts::TAU / 4000.0;
            [radius * libm::cosf(angle), radius * libm::sinf(angle)]
        };
        let star: Vec<[f32; 2]> =
            (0..4000).flat_map(|k| [corner(k, 10.0), corner(k, 9.0 - f32::from(k % 7))]).collect();
        let corners = points(&star);
        let triangles = cut(&corners).expect("it does not cross itself");
        let areas = triangles.iter().map(|t| area(&t.map(|corner| corners[corner])));
        let (sum, whole) = (areas.sum::<f32>(), area(&corners));
        assert!((sum - whole).abs() < 1e-3 * whole, "{sum} of {whole}");
        assert_eq!(triangles.len(), 8000 - 2, "all corners are used");
    }

    #[test]
    fn shapes_of_quads() {
        for (quad, expected) in [
            ([[0., 0.], [2., 0.], [0.4, 0.4], [0., 2.]], QuadShape::Concave),
            ([[0., 0.], [2., 0.], [2., 2.], [0., 2.]], QuadShape::Convex),
            ([[0., 0.], [2., 0.], [1., 1.], [0., 2.]], QuadShape::Convex), // straight
            ([[0., 0.], [2., 2.], [2., 0.], [0., 2.]], QuadShape::Crossed),
            ([[0., 0.], [2., 2.], [2., 0.], [0., 3.]], QuadShape::Crossed), // unlike halves
        ] {
            let corners: [Vec3; 4] = points(&quad).try_into().expect("four");
            for turn in 0..4 {
                let mut turned = corners;
                turned.rotate_left(turn);
                assert_eq!(QuadShape::of(turned), expected, "{quad:?} from corner {turn}");
            }
        }
        // Straight, but for rounding.
        let (a, c, d) =
            (Vec3::new(0.1, 0.7, -0.3), Vec3::new(2.3, 1.9, 5.7), Vec3::new(4., -3., 1.));
        for k in 1..100u8 {
            let b = a + (c - a) * (f32::from(k) / 100.0);
            assert_eq!(QuadShape::of([a, b, c, d]), QuadShape::Convex, "straight at {k}");
        }
    }
}
