//! A mesh between the file and the model. Its faces may be cut or dropped, and remember their
//! places in the file.

use crate::parts::Channel;
use crate::repair::polygon::Corner;
use glam::Vec3;
use tess_surface::{Face, PolygonMesh};

/// The place of each face of a mesh in its file.
#[derive(Debug)]
pub(crate) enum FacePlaces {
    /// The line of each face.
    Lines(Vec<usize>),
    /// The first face of each run of triangles, and the name of the run.
    Runs(Vec<(usize, String)>),
}

impl FacePlaces {
    /// The place of a face, such as `line 12`.
    fn of(&self, face: usize) -> String {
        match self {
            Self::Lines(lines) => format!("line {}", lines[face]),
            Self::Runs(runs) => {
                let after = runs.partition_point(|&(first, _)| first <= face);
                let (first, name) = &runs[after - 1];
                format!("{name}, triangle {}", face - first)
            }
        }
    }
}

/// A mesh during its repairs.
#[derive(Debug)]
pub(crate) struct Draft {
    pub(crate) mesh: PolygonMesh,
    places: FacePlaces,
    /// The number of each face in the file; empty while no face has changed.
    originals: Vec<usize>,
    /// Further values at the positions.
    pub(crate) channels: Vec<Channel>,
    /// Notes on the changes to the mesh.
    pub(crate) notes: Vec<String>,
}

impl Draft {
    pub(crate) const fn new(mesh: PolygonMesh, places: FacePlaces) -> Self {
        Self { mesh, places, originals: Vec::new(), channels: Vec::new(), notes: Vec::new() }
    }

    pub(crate) fn note(&mut self, note: Option<String>) {
        self.notes.extend(note);
    }

    /// The place of a face in the file.
    pub(crate) fn place(&self, face: usize) -> String {
        self.places.of(self.original(face))
    }

    /// The number of a face in the file.
    pub(crate) fn original(&self, face: usize) -> usize {
        self.originals.get(face).copied().unwrap_or(face)
    }

    /// Replaces every face by those that `with` returns for it. `with` receives the mesh, the face,
    /// and a function that returns the face's place.
    pub(crate) fn replace_faces(
        &mut self,
        mut with: impl FnMut(&PolygonMesh, &Face, &dyn Fn() -> String) -> Vec<Face>,
    ) {
        let mut faces = Vec::with_capacity(self.mesh.faces.len());
        let mut originals = Vec::with_capacity(self.mesh.faces.len());
        for (number, face) in self.mesh.faces.iter().enumerate() {
            faces.extend(with(&self.mesh, face, &|| self.place(number)));
            originals.resize(faces.len(), self.original(number));
        }
        (self.mesh.faces, self.originals) = (faces, originals);
    }

    /// A new corner at a place on the edge between two corners of a face. Its values are those of
    /// the ends, interpolated.
    pub(crate) fn corner_between(&mut self, ends: [Corner; 2], at: Vec3) -> Corner {
        let mesh = &mut self.mesh;
        let [a, b] = ends.map(|corner| mesh.positions[corner.position as usize]);
        let t = (at - a).dot(b - a) / (b - a).length_squared();
        let t = if t.is_finite() { t.clamp(0.0, 1.0) } else { 0.0 };
        let last = |length: usize| u32::try_from(length - 1).unwrap_or(u32::MAX);
        let [a, b] = ends;
        for channel in &mut self.channels {
            channel.push_between(a.position as usize, b.position as usize, t);
        }
        mesh.positions.push(at);
        let position = last(mesh.positions.len());
        let texcoord = a.texcoord.zip(b.texcoord).map(|(a, b)| {
            let between = mesh.texcoords[a as usize].lerp(mesh.texcoords[b as usize], t);
            mesh.texcoords.push(between);
            last(mesh.texcoords.len())
        });
        let normal = a.normal.zip(b.normal).map(|(a, b)| {
            let [a, b] = [a, b].map(|normal| mesh.normals[normal as usize].normalize_or_zero());
            mesh.normals.push(a.lerp(b, t));
            last(mesh.normals.len())
        });
        Corner { position, texcoord, normal }
    }
}
