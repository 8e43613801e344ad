//! Corners and edges of the two domains, and the one that a domain point belongs to.

use tess_core::Domain;

/// One `T` per edge, or per corner, of a patch: three for a triangle, four for a quad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sides<T> {
    /// A triangle's edges u = 0, v = 0, w = 0, or its corners u = 1, v = 1, w = 1.
    Triangle([T; 3]),
    /// A quad's edges u = 0, v = 0, u = 1, v = 1, or its corners (0,0), (1,0), (1,1), (0,1).
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

    /// The values in order, mutable.
    pub const fn as_mut_slice(&mut self) -> &mut [T] {
        match self {
            Self::Triangle(values) => values,
            Self::Quad(values) => values,
        }
    }

    /// The values with `f` applied to each.
    #[inline]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Sides<U> {
        // The standard library's `map` of arrays is a loop that is not inlined.
        match self {
            Self::Triangle([a, b, c]) => Sides::Triangle([f(a), f(b), f(c)]),
            Self::Quad([a, b, c, d]) => Sides::Quad([f(a), f(b), f(c), f(d)]),
        }
    }

    /// The values with `f` applied to the number of each and the value.
    #[inline]
    pub(crate) fn map_numbered<U>(self, mut f: impl FnMut(usize, T) -> U) -> Sides<U> {
        match self {
            Self::Triangle([a, b, c]) => Sides::Triangle([f(0, a), f(1, b), f(2, c)]),
            Self::Quad([a, b, c, d]) => Sides::Quad([f(0, a), f(1, b), f(2, c), f(3, d)]),
        }
    }

    /// The domain: triangle or quad.
    pub const fn domain(&self) -> Domain {
        match self {
            Self::Triangle(_) => Domain::Triangle,
            Self::Quad(_) => Domain::Quad,
        }
    }
}

/// The numbers of the corners at both ends of each edge, in the direction in which the edge's
/// running coordinate grows: u on the edges v = 0, v = 1 and w = 0; v on u = 0 and u = 1.
#[must_use]
pub const fn edge_corners<T>(sides: &Sides<T>) -> &'static [[usize; 2]] {
    match sides {
        Sides::Triangle(_) => &[[2, 1], [2, 0], [1, 0]],
        Sides::Quad(_) => &[[0, 3], [0, 1], [1, 2], [3, 2]],
    }
}

/// Whether an edge's running coordinate grows from a corner to the next one. Otherwise it grows to
/// the previous one.
pub(crate) fn runs_onwards<T>(sides: &Sides<T>, edge: usize) -> bool {
    let [start, end] = edge_corners(sides)[edge];
    end == (start + 1) % sides.as_slice().len()
}

/// The domain coordinates (u, v) of the corners.
#[must_use]
pub const fn corner_coordinates<T>(sides: &Sides<T>) -> Sides<[f32; 2]> {
    match sides {
        Sides::Triangle(_) => Sides::Triangle([[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]),
        Sides::Quad(_) => Sides::Quad([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]),
    }
}

/// A corner, an edge or the inside of a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// The corner of this number.
    Corner(usize),
    /// The edge of this number, except its ends, at this value in (0, 1) of its running coordinate.
    Edge(usize, f32),
    /// The inside of the patch.
    Inside,
}

impl Place {
    /// The place of the domain point (u, v) on a patch with these sides. Exact: domain points are
    /// multiples of 2^-16, for which 1 - u - v does not round.
    #[must_use]
    pub fn of<T>(sides: &Sides<T>, u: f32, v: f32) -> Self {
        match sides {
            Sides::Triangle(_) => on_triangle(u, v),
            Sides::Quad(_) => on_quad(u, v),
        }
    }
}

fn on_triangle(u: f32, v: f32) -> Place {
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

fn on_quad(u: f32, v: f32) -> Place {
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
