//! A patch's output as vertices by place, and the rules that need nothing else.

use super::Judged;
use super::levels::{inside_asked, may_touch_outline};
use super::standard::Specification;
use crate::case::Case;
use tess_core::fixed_point::ONE;
use tess_core::{Domain, OutputPrimitive, Tessellation};

/// A vertex's u and v as 16.16 numbers.
pub(super) type Place = [u32; 2];

/// The largest allowed distance of a vertex from the place that equal lengths give it, in units of
/// 2^-16. No standard gives a number; the model's largest deviation from k/n is 12.26 units, at n =
/// 53. A length has two ends, so it may be off by twice this.
pub(super) const TOLERANCE: u32 = 16;

/// A patch's primitives by the places of their vertices.
#[derive(Debug)]
pub(super) struct Answer {
    pub(super) case: Case,
    /// The standard by which it is judged.
    pub(super) specification: Specification,
    /// The vertices of the primitives, in order.
    pub(super) vertices: Vec<Place>,
    /// The distinct places of vertices, ascending.
    pub(super) places: Vec<Place>,
    /// The number of each vertex's place among `places`.
    numbers: Vec<u32>,
    /// Whether vertices of the inside are on the outline, where a standard allows that.
    pub(super) touches: bool,
}

impl Answer {
    /// Looks up the vertices of the primitives.
    ///
    /// # Errors
    /// A description of an index without a point, or of a primitive that is not whole.
    pub(super) fn new(
        case: &Case,
        output: &Tessellation,
        specification: Specification,
    ) -> Result<Self, String> {
        let mut is_used = vec![false; output.points.len()];
        for &index in &output.indices {
            let used = is_used.get_mut(index as usize);
            *used.ok_or_else(|| format!("index {index} of {} points", output.points.len()))? = true;
        }
        let (number, size) = (output.indices.len(), case.primitive_size());
        if !number.is_multiple_of(size) {
            return Err(format!("{number} indices do not make whole primitives of {size}"));
        }
        let all: Vec<Place> =
            output.points.iter().map(|p| [p.u.to_bits(), p.v.to_bits()]).collect();
        let used = all.iter().zip(is_used).filter(|(_, is_used)| *is_used);
        let mut places: Vec<Place> = used.map(|(place, _)| *place).collect();
        places.sort_unstable();
        places.dedup();
        let number = |place| places.binary_search(place).map_or(0, |number| number);
        let of_points: Vec<u32> =
            all.iter().map(|place| u32::try_from(number(place)).unwrap_or(u32::MAX)).collect();
        let numbers: Vec<u32> = output.indices.iter().map(|i| of_points[*i as usize]).collect();
        let vertices = output.indices.iter().map(|i| all[*i as usize]).collect();
        let (case, touches) = (*case, false);
        let mut answer = Self { case, specification, vertices, places, numbers, touches };
        // Where all vertices of the inside are off the outline, nothing needs an excuse.
        answer.touches = may_touch_outline(&case, specification)
            && inside_asked(&case).is_none_or(|asked| answer.inside().len() != asked);
        Ok(answer)
    }

    /// Whether the standard specifies every place.
    pub(super) fn is_exact(&self) -> bool {
        self.specification == Specification::D3d11
    }

    /// The size of this answer as an example: its number of vertices.
    pub(super) const fn size(&self) -> usize {
        self.vertices.len()
    }

    /// Whether there are no primitives.
    pub(super) const fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    /// Whether the primitives are triangles.
    pub(super) const fn has_triangles(&self) -> bool {
        self.case.primitive_size() == 3
    }

    /// Whether the primitives are points.
    pub(super) const fn has_points(&self) -> bool {
        matches!(self.case.config.output, OutputPrimitive::Point)
    }

    /// The triangles; none for other primitives.
    pub(super) fn triangles(&self) -> impl Iterator<Item = [Place; 3]> {
        let (triangles, _) = self.vertices.as_chunks::<3>();
        triangles.iter().copied().filter(|_| self.has_triangles())
    }

    /// The triangles by the numbers of their vertices' places.
    pub(super) fn numbered_triangles(&self) -> impl Iterator<Item = [u32; 3]> {
        let (triangles, _) = self.numbers.as_chunks::<3>();
        triangles.iter().copied().filter(|_| self.has_triangles())
    }

    /// Every vertex is in the domain.
    pub(super) fn range(&self) -> Judged {
        let is_triangle = self.case.domain() == Domain::Triangle;
        let is_outside = |&&[u, v]: &&Place| {
            let sum = u64::from(u) + u64::from(v);
            u > ONE || v > ONE || (is_triangle && sum > u64::from(ONE))
        };
        let stray = self.places.iter().find(is_outside);
        (!self.places.is_empty()).then(|| match stray {
            Some(place) => Err(format!("vertex {} is outside the domain", show(*place))),
            None => Ok(()),
        })
    }

    /// A patch has no primitives if an outer level is not above 0, and has some if all are above 0.
    /// With a denormal level, either is allowed.
    pub(super) fn discard(&self) -> Judged {
        let mut outer = self.case.factors.outer();
        let discards = outer.clone().any(|level| level.is_nan() || level <= 0.0);
        if !discards && outer.any(f32::is_subnormal) {
            return None;
        }
        Some(match (discards, self.is_empty()) {
            (true, false) => Err("primitives of a patch that is to be discarded".to_owned()),
            (false, true) => Err("no primitive, though all outer levels are above 0".to_owned()),
            _ => Ok(()),
        })
    }

    /// [`distance_along`] of each vertex on outer edge `edge`, ascending.
    pub(super) fn along(&self, edge: usize) -> Vec<u32> {
        let domain = self.case.domain();
        let mut along: Vec<u32> =
            self.places.iter().filter_map(|&place| distance_along(domain, edge, place)).collect();
        along.sort_unstable();
        along
    }

    /// The distinct places of vertices inside the outline, ascending.
    pub(super) fn inside(&self) -> Vec<Place> {
        self.places.iter().copied().filter(|place| !self.is_on_outline(*place)).collect()
    }

    /// Whether a place is on some outer edge.
    pub(super) fn is_on_outline(&self, place: Place) -> bool {
        let domain = self.case.domain();
        (0..domain.outer_factors()).any(|edge| distance_along(domain, edge, place).is_some())
    }
}

/// The distance of a place along an outer edge, from the edge's start in a clockwise walk; `None`
/// if the place is not on the edge. The only outer edge of isolines is u = 0.
pub(super) fn distance_along(domain: Domain, edge: usize, [u, v]: Place) -> Option<u32> {
    match (domain, edge) {
        (_, 0) => (u == 0).then(|| ONE.checked_sub(v)).flatten(),
        (Domain::Isoline, _) => None,
        (_, 1) => (v == 0 && u <= ONE).then_some(u),
        (Domain::Triangle, _) => {
            (u.checked_add(v) == Some(ONE)).then(|| ONE.checked_sub(u)).flatten()
        }
        (_, 2) => (u == ONE && v <= ONE).then_some(v),
        _ => (v == ONE).then(|| ONE.checked_sub(u)).flatten(),
    }
}

/// A place in hex, as in listings.
pub(super) fn show([u, v]: Place) -> String {
    format!("({u:05x}, {v:05x})")
}
