//! Which ring a primitive belongs to, as the model locates it.

use tess_core::{Patch, PrimitiveOrigin};

/// The part of the connectivity that a triangle belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) enum Ring {
    /// None: minimum patches and other outputs than triangles.
    None,
    /// The stitch along this outer edge.
    Transition(u32),
    /// The stitches outside of this ring, from 2.
    Interior(u32),
    /// Inside the innermost ring.
    Centre,
}

/// The rings of the first `count` primitives of a patch.
pub(super) fn rings(patch: &Patch, count: usize) -> Vec<Ring> {
    let ring = |t| match patch.locate_primitive(t) {
        Some(PrimitiveOrigin::Transition { edge, .. }) => Ring::Transition(edge),
        Some(PrimitiveOrigin::Ring { ring, .. }) => Ring::Interior(ring),
        Some(PrimitiveOrigin::Centre { .. }) => Ring::Centre,
        _ => Ring::None,
    };
    (0..).map(ring).take(count).collect()
}
