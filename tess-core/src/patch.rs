//! One patch: the entry point of the model.

use crate::cache_order;
use crate::closed_form::counts::{Counts, counts};
use crate::closed_form::locate;
use crate::closed_form::locate::origin::PointOrigin;
use crate::closed_form::locate::origin::PrimitiveOrigin;
use crate::error::{Buffer, BufferTooSmallError};
use crate::model::factors::{ProcessedPatch, process};
use crate::model::output::DomainPoint;
use crate::model::output::Primitive;
use crate::model::patch_factors::PatchFactors;
use crate::model::sink::{Sink, Slices};
use crate::model::state::Config;
use crate::model::stitch::Stitch;
use crate::model::{connect, points};

/// An order in which a patch's triangles are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Order {
    /// The specification's order (sections 7 and 8).
    #[default]
    Specification,
    /// The same triangles, ordered for a vertex cache ([`cache_order`]). Domain points keep their
    /// order and numbers. Line and point primitives keep the specification's order.
    VertexCache,
}

/// A patch whose factors have been processed, ready to be tessellated or probed.
///
/// Every input is valid: any bit pattern of any factor gives a patch. A culled patch has no points
/// and no primitives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patch {
    config: Config,
    processed: ProcessedPatch,
    counts: Counts,
}

impl Patch {
    /// Processes the raw factors of a patch (spec sections 3 and 4).
    #[must_use]
    pub fn new(config: Config, factors: impl Into<PatchFactors>) -> Self {
        let processed = process(config, factors.into());
        Self { config, processed, counts: counts(config, &processed) }
    }

    /// The configuration that the patch was made with.
    #[must_use]
    pub const fn config(&self) -> Config {
        self.config
    }

    /// The processed factors and their contexts.
    #[must_use]
    pub const fn processed(&self) -> &ProcessedPatch {
        &self.processed
    }

    /// How many points, primitives and indices the patch has.
    #[must_use]
    pub const fn counts(&self) -> Counts {
        self.counts
    }

    /// Walks the patch in the specification's order: all points, then all primitives.
    pub fn emit(&self, sink: &mut impl Sink) {
        points::emit(&self.processed, sink);
        connect::emit(self.config, &self.processed, self.counts.points, sink);
    }

    /// Sends the stitches of a triangle or quad patch to `emit`, in order: the two rows of each,
    /// and the rule of its steps. Minimum, culled and isoline patches have none.
    pub fn stitches(&self, emit: impl FnMut(Stitch)) {
        if let ProcessedPatch::Regular(factors) = &self.processed {
            connect::stitches(factors, emit);
        }
    }

    /// Writes points and indices to the start of the caller's buffers.
    ///
    /// # Errors
    /// [`BufferTooSmallError`] if either buffer is shorter than [`Self::counts`]; then nothing is
    /// written.
    pub fn write(
        &self,
        points: &mut [DomainPoint],
        indices: &mut [u32],
    ) -> Result<Counts, BufferTooSmallError> {
        let points = prefix(points, self.counts.points, Buffer::Points)?;
        let indices = prefix(indices, self.counts.indices, Buffer::Indices)?;
        self.emit(&mut Slices::new(points, indices));
        Ok(self.counts)
    }

    /// The whole patch in vectors.
    #[cfg(feature = "alloc")]
    #[must_use]
    pub fn tessellate(&self) -> crate::Tessellation {
        let mut out = crate::Tessellation {
            points: alloc::vec::Vec::with_capacity(self.counts.points as usize),
            indices: alloc::vec::Vec::with_capacity(self.counts.indices as usize),
        };
        self.emit(&mut out);
        out
    }

    /// The whole patch in vectors, with its triangles in this order.
    #[cfg(feature = "alloc")]
    #[must_use]
    pub fn tessellate_in(&self, order: Order) -> crate::Tessellation {
        let mut out = self.tessellate();
        if order == Order::VertexCache && self.counts.indices == 3 * self.counts.primitives {
            let specified = out.indices.clone();
            for (t, triangle) in (0..).zip(specified.chunks_exact(3)) {
                if let Some(at) = self.cache_position(t) {
                    out.indices[3 * at as usize..][..3].copy_from_slice(triangle);
                }
            }
        }
        out
    }

    /// Where point `i` comes from; `None` if the patch has no such point. Constant time.
    #[must_use]
    pub fn locate_point(&self, i: u32) -> Option<PointOrigin> {
        (i < self.counts.points).then(|| locate::point::locate(&self.processed, i))
    }

    /// Point `i`; `None` if the patch has no such point. Constant time.
    #[must_use]
    pub fn point(&self, i: u32) -> Option<DomainPoint> {
        locate::point::point(&self.processed, self.locate_point(i)?)
    }

    /// Where primitive `t` comes from; `None` if the patch has no such primitive. Constant time.
    #[must_use]
    pub fn locate_primitive(&self, t: u32) -> Option<PrimitiveOrigin> {
        (t < self.counts.primitives)
            .then(|| locate::primitive::locate(self.config, &self.processed, t))
    }

    /// Primitive `t`; `None` if the patch has no such primitive. Constant time.
    #[must_use]
    pub fn primitive(&self, t: u32) -> Option<Primitive> {
        let location = self.locate_primitive(t)?;
        locate::primitive::primitive(self.config, &self.processed, location)
    }

    /// Where primitive `t` is in the [vertex-cache order](crate::cache_order); `None` if the patch
    /// has no such primitive. Constant time.
    #[must_use]
    pub fn cache_position(&self, t: u32) -> Option<u32> {
        Some(cache_order::cache_position(&self.processed, self.locate_primitive(t)?, t))
    }

    /// All points in order, each by random access.
    pub fn points(&self) -> impl Iterator<Item = DomainPoint> {
        (0..self.counts.points).filter_map(|i| self.point(i))
    }

    /// All primitives in order, each by random access.
    pub fn primitives(&self) -> impl Iterator<Item = Primitive> {
        (0..self.counts.primitives).filter_map(|t| self.primitive(t))
    }
}

/// The first `needed` elements of a caller's buffer.
fn prefix<T>(
    slice: &mut [T],
    needed: u32,
    buffer: Buffer,
) -> Result<&mut [T], BufferTooSmallError> {
    let (needed, got) = (needed as usize, slice.len());
    slice.get_mut(..needed).ok_or(BufferTooSmallError { buffer, needed, got })
}
