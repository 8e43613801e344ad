//! The receivers of the sequential formulation's output.

use crate::model::output::{DomainPoint, Primitive};

/// Receives a patch: every domain point in order, then every primitive in order.
pub trait Sink {
    /// The next domain point.
    fn point(&mut self, point: DomainPoint);
    /// The next primitive.
    fn primitive(&mut self, primitive: Primitive);
}

/// A sink that only counts what it receives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counter {
    /// Points received.
    pub points: u32,
    /// Primitives received.
    pub primitives: u32,
    /// Indices received.
    pub indices: u32,
}

impl Sink for Counter {
    fn point(&mut self, _: DomainPoint) {
        self.points += 1;
    }

    fn primitive(&mut self, primitive: Primitive) {
        self.primitives += 1;
        self.indices += primitive.size();
    }
}

/// Writes into slices that are known to be large enough.
#[derive(Debug)]
pub(crate) struct Slices<'a> {
    points: core::slice::IterMut<'a, DomainPoint>,
    indices: &'a mut [u32],
}

impl<'a> Slices<'a> {
    pub(crate) fn new(points: &'a mut [DomainPoint], indices: &'a mut [u32]) -> Self {
        Self { points: points.iter_mut(), indices }
    }

    fn put<const N: usize>(&mut self, values: [u32; N]) {
        // The caller checked the size. A slice that is too short would lose output; debug builds
        // assert.
        let indices = core::mem::take(&mut self.indices);
        if let Some((slot, rest)) = indices.split_first_chunk_mut() {
            *slot = values;
            self.indices = rest;
        } else {
            debug_assert!(false, "more indices came than were counted");
        }
    }
}

impl Sink for Slices<'_> {
    fn point(&mut self, point: DomainPoint) {
        let slot = self.points.next();
        debug_assert!(slot.is_some(), "more points came than were counted");
        if let Some(slot) = slot {
            *slot = point;
        }
    }

    fn primitive(&mut self, primitive: Primitive) {
        match primitive {
            Primitive::Point(indices) => self.put(indices),
            Primitive::Line(indices) => self.put(indices),
            Primitive::Triangle(indices) => self.put(indices),
        }
    }
}

/// A whole patch in vectors.
#[cfg(feature = "alloc")]
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tessellation {
    /// Domain points, in order.
    pub points: alloc::vec::Vec<DomainPoint>,
    /// Indices of the primitives, in order.
    pub indices: alloc::vec::Vec<u32>,
}

#[cfg(feature = "alloc")]
impl Sink for Tessellation {
    fn point(&mut self, point: DomainPoint) {
        self.points.push(point);
    }

    fn primitive(&mut self, primitive: Primitive) {
        self.indices.extend_from_slice(primitive.indices());
    }
}
