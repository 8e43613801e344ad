//! Hard edges: where the smooth normals of a mesh break.

use crate::topology::HalfEdge;

/// The edges of a mesh at which smooth normals break. They matter only to faces without normals of
/// their own.
#[derive(Clone, Copy, Debug)]
pub struct Creases<'a> {
    /// The cosine of the largest angle between the normals of two neighbours that are smooth, where
    /// their groups say nothing. With -1 all are smooth.
    pub least_cosine: f32,
    /// The smoothing group of each face, as in OBJ files: neighbours are smooth if they are in the
    /// same group, and a face in group 0 is flat. `None`, and faces beyond the end of the list,
    /// leave it to the angle.
    pub groups: &'a [Option<u32>],
}

impl Creases<'_> {
    /// No edge is hard.
    pub const NONE: Self = Self { least_cosine: -1.0, groups: &[] };

    /// Whether a face is flat.
    pub(crate) fn is_flat(&self, face: usize) -> bool {
        self.group(face) == Some(0)
    }

    /// Whether the edge between two faces is hard, and if so, whether that is for their angle
    /// alone. `cosine` is that of the angle between their normals.
    pub(crate) fn hardness(&self, one: usize, other: usize, cosine: f32) -> Hardness {
        match (self.group(one), self.group(other)) {
            (Some(0), _) | (_, Some(0)) => Hardness::Group,
            (Some(one), Some(other)) if one == other => Hardness::Smooth,
            (Some(_), Some(_)) => Hardness::Group,
            _ if cosine < self.least_cosine => Hardness::Angle,
            _ => Hardness::Smooth,
        }
    }

    fn group(&self, face: usize) -> Option<u32> {
        self.groups.get(face).copied().flatten()
    }
}

/// Whether an edge is hard, and why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Hardness {
    Smooth,
    /// The faces' groups say so.
    Group,
    /// The angle is too large.
    Angle,
}

/// The normals that were made for a mesh.
pub(crate) struct Smoothed {
    /// A unit normal for each position.
    pub(crate) normals: alloc::vec::Vec<glam::Vec3>,
    /// One side of each edge that is hard for its angle.
    pub(crate) creases: alloc::vec::Vec<HalfEdge>,
}
