//! The concentric triangles of a triangle patch, reconstructed from its vertices.
//!
//! Vulkan (22.6) and OpenGL derive them from the inner level's division of an edge, at places t
//! from 0 to 1. The corner of ring r is where two lines meet that are perpendicular to the patch's
//! edges at their r-th places. The ring's edge is divided by the perpendiculars at the other
//! places. In coordinates:
//!
//! ```text
//!         depth of ring r = 2/3 t(r)            n = 5: t = 0, 1/5, 2/5, 3/5, 4/5, 1
//!   on v = depth:  u = t(k) - depth/2           ring 1: depth 2/15, 3 segments; ring 2: depth 4/15, 1 segment
//!                                               places inside: 9 + 3
//!        u=0 ╱╲ w=0
//!           ╱──╲      ring r has n - 2r segments on each edge, so 3(n - 2r) vertices;
//!          ╱╲  ╱╲     for even n the last ring is one vertex, the centre
//!         ╱──╲╱──╲
//!            v=0
//! ```
//!
//! A vertex belongs to a ring by its distance from the outline. Where two rings are so close that
//! rounding might mix them up, no [`Rings`] are made. `inner-spacing` allows that only where the
//! level puts two rings so close.

use super::answer::{Place, TOLERANCE};
use super::levels::{ring_vertices, vertices_inside};
use tess_core::fixed_point::ONE;

/// The vertices of one ring.
#[derive(Debug)]
pub(super) struct Ring {
    /// Its number, from 1.
    pub(super) number: u32,
    /// The smallest and the largest distance of its vertices from the outline, where a distance is
    /// the smallest of u, v and w.
    pub(super) depths: [u32; 2],
    /// The vertices of each edge in the order of a clockwise walk, including both corners, each
    /// with its place t.
    pub(super) edges: [Vec<(u32, Place)>; 3],
}

/// The rings of a patch, outermost first.
#[derive(Debug)]
pub(super) struct Rings {
    pub(super) rings: Vec<Ring>,
}

/// The third barycentric coordinate of a place in the domain.
const fn w([u, v]: Place) -> u32 {
    ONE.saturating_sub(u).saturating_sub(v)
}

fn depth(place: Place) -> u32 {
    place[0].min(place[1]).min(w(place))
}

impl Rings {
    /// The rings of `n` segments that the vertices inside form. `None` if the number of vertices
    /// differs from that of `n` segments, or if rings are too close to tell apart.
    pub(super) fn new(inside: Vec<Place>, n: u32) -> Option<Self> {
        let rings = by_depth(inside, n)?;
        let is_clear = too_close(&rings).next().is_none();
        is_clear.then_some(Self { rings })
    }

    /// The places t of the outermost ring's vertices, from its edge along v = 0.
    pub(super) fn outermost(&self) -> Vec<u32> {
        let edge = self.rings.first().map(|ring| &ring.edges[1]);
        edge.into_iter().flatten().map(|(t, _)| *t).collect()
    }
}

/// The vertices inside as rings of `n` segments, by their distance from the outline; `None` if
/// their number differs from that of `n` segments.
pub(super) fn by_depth(mut inside: Vec<Place>, n: u32) -> Option<Vec<Ring>> {
    if inside.len() != vertices_inside(n) {
        return None;
    }
    inside.sort_by_key(|place| depth(*place));
    let mut rest = inside.as_slice();
    let ring = |number| {
        let (own, others) = rest.split_at_checked(ring_vertices(n, number))?;
        rest = others;
        Ring::new(number, own)
    };
    (1..=n / 2).map(ring).collect()
}

/// The numbers of the rings that are too close to the next outer one to tell their vertices apart.
pub(super) fn too_close(rings: &[Ring]) -> impl Iterator<Item = u32> {
    let is_close = |pair: &&[Ring]| pair[0].depths[1] + 2 * TOLERANCE >= pair[1].depths[0];
    rings.windows(2).filter(is_close).map(|pair| pair[1].number)
}

impl Ring {
    fn new(number: u32, places: &[Place]) -> Option<Self> {
        let least = depth(*places.first()?);
        let most = depth(*places.last()?);
        let edge = |edge: usize| {
            let distance = |place: Place| [place[0], place[1], w(place)][edge];
            let own = places.iter().filter(|place| distance(**place) <= least + TOLERANCE);
            let mut own: Vec<_> = own.map(|&place| (along(edge, place), place)).collect();
            own.sort_unstable();
            own
        };
        Some(Self { number, depths: [least, most], edges: [0, 1, 2].map(edge) })
    }
}

/// The place t on an outer edge whose perpendicular leads to a vertex.
fn along(edge: usize, place: Place) -> u32 {
    let [u, v] = place;
    let half = |distance: u32| distance.div_ceil(2);
    match edge {
        0 => ONE.saturating_sub(v + half(u)),
        1 => u + half(v),
        _ => ONE.saturating_sub(u + half(w(place))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The worked example at the head of this file, and the smallest numbers of vertices.
    #[test]
    fn five_segments() {
        assert_eq!([2, 3, 4, 5, 6].map(vertices_inside), [1, 3, 7, 12, 19]);
        let line = "case tri integer triangle_cw ruler 3f800000 3f800000 3f800000 40a00000";
        let case: crate::Case = line.parse().expect("a case");
        let points = case.patch().tessellate().points;
        let places = points.iter().skip(3).map(|point| [point.u.to_bits(), point.v.to_bits()]);
        let rings = Rings::new(places.collect(), 5).expect("five segments").rings;
        for (ring, (depth, segments)) in rings.iter().zip([(2, 3), (4, 1)]) {
            assert!(ring.depths.iter().all(|d| d.abs_diff(depth * ONE / 15) < 4), "{ring:?}");
            for edge in &ring.edges {
                assert_eq!(edge.len(), segments + 1, "{edge:?}");
                for (k, (t, _)) in (ring.number..).zip(edge) {
                    assert!(t.abs_diff(k * ONE / 5) < 4, "{k}: {t:05x}");
                }
            }
        }
    }
}
