//! Patches of one domain, owned.

use crate::data::batch::Batch;
use crate::data::error::Error;
use alloc::vec::Vec;
use core::ops::Range;
use tess_core::{Domain, IsolineFactors, PatchFactors, QuadFactors, TriangleFactors};

/// Owned patches of one domain, in the layout that is fastest to read: one structure of that domain
/// per patch.
///
/// A [`Batch`] of any layout can be converted. Tessellating [`PatchFactors`] directly needs no
/// copy, but small patches take up to a fifth longer. If you tessellate the same patches
/// repeatedly, copy them once.
///
/// ```
/// use tess_simd::OwnedBatch;
/// use tess_simd::tess_core::{Domain, PatchFactors};
///
/// let patches = [PatchFactors::uniform(Domain::Triangle, 3.0); 10];
/// let owned = OwnedBatch::try_from(&patches[..])?;
/// assert_eq!(owned.batch().len(), 10);
/// assert_eq!(owned.get(2..5).map(|part| part.len()), Some(3));
/// # Ok::<(), tess_simd::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct OwnedBatch(Structures);

#[derive(Clone, Debug, PartialEq)]
enum Structures {
    Isolines(Vec<IsolineFactors>),
    Triangles(Vec<TriangleFactors>),
    Quads(Vec<QuadFactors>),
}

impl OwnedBatch {
    /// An empty batch of this domain.
    #[must_use]
    pub const fn new(domain: Domain) -> Self {
        Self(match domain {
            Domain::Isoline => Structures::Isolines(Vec::new()),
            Domain::Triangle => Structures::Triangles(Vec::new()),
            Domain::Quad => Structures::Quads(Vec::new()),
        })
    }

    /// Adds a patch.
    ///
    /// # Errors
    /// [`Error::MixedDomains`] if the patch has another domain; then it is not added.
    pub fn push(&mut self, patch: PatchFactors) -> Result<(), Error> {
        match (&mut self.0, patch) {
            (Structures::Isolines(all), PatchFactors::Isoline(factors)) => all.push(factors),
            (Structures::Triangles(all), PatchFactors::Triangle(factors)) => all.push(factors),
            (Structures::Quads(all), PatchFactors::Quad(factors)) => all.push(factors),
            (_, patch) => {
                let (number, expected) = (self.batch().len(), self.batch().domain());
                return Err(Error::MixedDomains { patch: number, found: patch.domain(), expected });
            }
        }
        Ok(())
    }

    /// All patches.
    #[must_use]
    pub fn batch(&self) -> Batch<'_> {
        match &self.0 {
            Structures::Isolines(all) => all.into(),
            Structures::Triangles(all) => all.into(),
            Structures::Quads(all) => all.into(),
        }
    }

    /// The patches of a range; `None` if it exceeds the batch.
    #[must_use]
    pub fn get(&self, range: Range<usize>) -> Option<Batch<'_>> {
        self.batch().get(range)
    }
}

impl TryFrom<Batch<'_>> for OwnedBatch {
    type Error = Error;

    /// Copies a batch of any layout.
    fn try_from(batch: Batch<'_>) -> Result<Self, Error> {
        batch.check()?;
        let mut all = Self::new(batch.domain());
        (0..batch.len()).filter_map(|i| batch.patch(i)).try_for_each(|patch| all.push(patch))?;
        Ok(all)
    }
}

impl TryFrom<&[PatchFactors]> for OwnedBatch {
    type Error = Error;

    /// Copies patches of one domain. Without patches the domain is quad.
    fn try_from(patches: &[PatchFactors]) -> Result<Self, Error> {
        Batch::from(patches).try_into()
    }
}
