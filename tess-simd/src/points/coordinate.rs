//! What the coordinates of a run of a quad's points are.

/// One coordinate of the points of a run.
#[derive(Clone, Copy, Debug)]
pub(super) enum Coordinate<H> {
    /// The same for all of them.
    Held(H),
    /// The locations from here on, one for each point.
    Along(Place),
}

/// A point along a factor's edge or axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) factor: usize,
    pub(super) point: u32,
    /// Whether it is seen from the other end: its location is `ONE` minus the one in the table.
    pub(super) mirrored: bool,
}

/// The locations from point `point` of a factor on.
pub(super) const fn along<H>(factor: usize, point: u32) -> Coordinate<H> {
    Coordinate::Along(Place { factor, point, mirrored: false })
}

/// The same, seen from the other end.
pub(super) const fn back<H>(factor: usize, point: u32) -> Coordinate<H> {
    Coordinate::Along(Place { factor, point, mirrored: true })
}

/// Takes the runs of points that a quad has, in order.
pub(super) trait Walker {
    /// A coordinate that all points of a run have.
    type Held: Copy;

    /// A 16.16 number that every patch has: 0, `ONE` or `HALF`.
    fn fixed(&self, number: u32) -> Coordinate<Self::Held>;

    /// The location of a point.
    fn at(&self, place: Place) -> Coordinate<Self::Held>;

    /// Takes a run of `length` points. One coordinate is held.
    fn run(&mut self, length: u32, u: Coordinate<Self::Held>, v: Coordinate<Self::Held>);
}
