//! Corners and edges of the two domains, and where a domain point lies on them.

use tess_core::Domain;

/// One value per edge, or per corner, of a patch: three of a triangle, four of a quad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sides<T> {
    /// Of a triangle: edges u = 0, v = 0, w = 0; corners u = 1, v = 1, w = 1.
    Triangle([T; 3]),
    /// Of a quad: edges u = 0, v = 0, u = 1, v = 1; corners (0,0), (1,0), (1,1), (0,1).
    Quad([T; 4]),
}

impl<T> Sides<T> {
    /// The values in order.
    pub const fn as_slice(&self) -> &[T] {
        match self {
            Self::Triangle(values) => values,
            Self::Quad(values) => values,
        }
    }

    /// The values in order, to change.
    pub const fn as_mut_slice(&mut self) -> &mut [T] {
        match self {
            Self::Triangle(values) => values,
            Self::Quad(values) => values,
        }
    }

    /// Each value changed by `f`.
    pub fn map<U>(self, f: impl FnMut(T) -> U) -> Sides<U> {
        match self {
            Self::Triangle(values) => Sides::Triangle(values.map(f)),
            Self::Quad(values) => Sides::Quad(values.map(f)),
        }
    }

    /// Each value changed by `f`, which is told its number too.
    pub fn map_numbered<U>(self, mut f: impl FnMut(usize, T) -> U) -> Sides<U> {
        let mut number = 0..;
        self.map(|value| f(number.next().unwrap_or_default(), value))
    }

    /// The domain that has so many edges.
    pub const fn domain(&self) -> Domain {
        match self {
            Self::Triangle(_) => Domain::Triangle,
            Self::Quad(_) => Domain::Quad,
        }
    }
}

/// The corners that each edge runs between, in the direction in which its coordinate grows:
/// u on v = 0, v = 1 and w = 0; v on u = 0 and u = 1.
#[must_use]
pub const fn edge_corners<T>(sides: &Sides<T>) -> &'static [[usize; 2]] {
    match sides {
        Sides::Triangle(_) => &[[2, 1], [2, 0], [1, 0]],
        Sides::Quad(_) => &[[0, 3], [0, 1], [1, 2], [3, 2]],
    }
}

/// Where a domain point lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// On this corner.
    Corner(usize),
    /// Inside this edge, at this value in (0, 1) of its running coordinate.
    Edge(usize, f32),
    /// Inside the patch.
    Inside,
}

/// The place of the domain point (u, v). Exact: domain points are multiples of 2^-16, on which
/// 1 - u - v does not round.
#[must_use]
pub fn locate<T>(sides: &Sides<T>, u: f32, v: f32) -> Place {
    match sides {
        Sides::Triangle(_) => locate_triangle(u, v),
        Sides::Quad(_) => locate_quad(u, v),
    }
}

fn locate_triangle(u: f32, v: f32) -> Place {
    let on_edge = [u <= 0.0, v <= 0.0, 1.0 - u - v <= 0.0];
    match on_edge {
        [false, false, false] => Place::Inside,
        [true, false, false] => Place::Edge(0, v),
        [false, true, false] => Place::Edge(1, u),
        [false, false, true] => Place::Edge(2, u),
        [false, true, _] => Place::Corner(0),
        [true, false, true] => Place::Corner(1),
        [true, true, _] => Place::Corner(2),
    }
}

fn locate_quad(u: f32, v: f32) -> Place {
    let (low_u, low_v, high_u, high_v) = (u <= 0.0, v <= 0.0, u >= 1.0, v >= 1.0);
    match (low_u, low_v, high_u, high_v) {
        (true, true, ..) => Place::Corner(0),
        (_, true, true, _) => Place::Corner(1),
        (_, _, true, true) => Place::Corner(2),
        (true, _, _, true) => Place::Corner(3),
        (true, ..) => Place::Edge(0, v),
        (_, true, ..) => Place::Edge(1, u),
        (_, _, true, _) => Place::Edge(2, v),
        (.., true) => Place::Edge(3, u),
        _ => Place::Inside,
    }
}
