//! The patches of a batch, in the caller's array of factors.

use crate::boundary;
use crate::status::{TESS_WRONG_FACTOR_COUNT, TessStatus};
use std::mem::{align_of, size_of};
use tess_core::{Domain, IsolineFactors, QuadFactors, TriangleFactors};
use tess_simd::Batch;

// The structures that the batch backend reads consist of as many floats as a patch has factors.
const _: () = {
    assert!(size_of::<IsolineFactors>() == 2 * size_of::<f32>(), "two factors");
    assert!(size_of::<TriangleFactors>() == 4 * size_of::<f32>(), "four factors");
    assert!(size_of::<QuadFactors>() == 6 * size_of::<f32>(), "six factors");
    assert!(align_of::<IsolineFactors>() == align_of::<f32>(), "isolines are aligned as floats");
    assert!(align_of::<TriangleFactors>() == align_of::<f32>(), "triangles are aligned as floats");
    assert!(align_of::<QuadFactors>() == align_of::<f32>(), "quads are aligned as floats");
};

/// Patches of one domain, one patch's factors after another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patches<'a> {
    domain: Domain,
    factors: &'a [f32],
}

impl<'a> Patches<'a> {
    /// The patches whose factors are in a caller's array.
    ///
    /// # Safety
    /// - If not null and aligned, `factors` points to `factor_count` floats that can be read and
    ///   are not written while the patches live.
    pub(super) unsafe fn new(
        domain: Domain,
        factors: *const f32,
        factor_count: usize,
    ) -> Result<Self, TessStatus> {
        if !factor_count.is_multiple_of(domain.factors()) {
            return Err(TESS_WRONG_FACTOR_COUNT);
        }
        // SAFETY: `factor_count` readable floats, as the caller promises.
        let factors = unsafe { boundary::list(factors, factor_count) }?;
        Ok(Self { domain, factors })
    }

    /// The same patches in parts of `patches` patches, which must not be 0. The last part may have
    /// fewer.
    pub(super) fn parts(self, patches: usize) -> impl Iterator<Item = Self> {
        let Self { domain, factors } = self;
        factors.chunks(patches * domain.factors()).map(move |factors| Self { domain, factors })
    }

    pub(super) fn batch(self) -> Batch<'a> {
        match self.domain {
            // SAFETY: the structure is two floats, as is checked above.
            Domain::Isoline => Batch::Isolines(unsafe { structures(self.factors) }),
            // SAFETY: the structure is four floats, as is checked above.
            Domain::Triangle => Batch::Triangles(unsafe { structures(self.factors) }),
            // SAFETY: the structure is six floats, as is checked above.
            Domain::Quad => Batch::Quads(unsafe { structures(self.factors) }),
        }
    }
}

/// Floats as whole structures of factors.
///
/// # Safety
/// - `T` is a `repr(C)` structure that has only floats.
unsafe fn structures<T>(floats: &[f32]) -> &[T] {
    let count = floats.len() / (size_of::<T>() / size_of::<f32>());
    // SAFETY: `floats` has the floats of `count` structures, with their alignment. Any bits are
    // valid floats, and the borrow is that of `floats`.
    unsafe { std::slice::from_raw_parts(floats.as_ptr().cast(), count) }
}
