//! The origin of one primitive (spec sections 7 and 8).

use super::{PointReport, structure};
use std::fmt;
use tess_core::{Patch, PrimitiveOrigin};

/// One primitive: its place in the walk, and its vertices.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(crate) struct PrimitiveReport {
    primitive: u32,
    location: String,
    /// The number of the primitive within its line, stitch or centre.
    step: u32,
    vertices: Vec<PointReport>,
}

impl PrimitiveReport {
    /// Explains primitive `t`; `None` if the patch has no such primitive.
    pub(crate) fn new(patch: &Patch, t: u32) -> Option<Self> {
        let location = patch.locate_primitive(t)?;
        let primitive = patch.primitive(t)?;
        let vertices = primitive.indices().iter().map(|&index| PointReport::new(patch, index));
        Some(Self {
            primitive: t,
            location: structure::describe(location),
            step: step(location),
            vertices: vertices.collect::<Option<_>>()?,
        })
    }
}

const fn step(location: PrimitiveOrigin) -> u32 {
    match location {
        PrimitiveOrigin::Line { segment: step, .. }
        | PrimitiveOrigin::Sequence { step }
        | PrimitiveOrigin::Minimum { step }
        | PrimitiveOrigin::Transition { step, .. }
        | PrimitiveOrigin::Ring { step, .. }
        | PrimitiveOrigin::Centre { step } => step,
    }
}

impl fmt::Display for PrimitiveReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "primitive {}: {}, step {}", self.primitive, self.location, self.step)?;
        self.vertices.iter().try_for_each(|vertex| write!(f, "{vertex}"))
    }
}
