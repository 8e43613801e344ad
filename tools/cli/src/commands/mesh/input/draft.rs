//! A mesh between the file and the model. Its faces may be cut or dropped, and remember their
//! places in the file.

use tess_surface::{Face, PolygonMesh};

/// The place of each face of a mesh in its file.
#[derive(Debug)]
pub(super) enum FacePlaces {
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
pub(super) struct Draft {
    pub(super) mesh: PolygonMesh,
    places: FacePlaces,
    /// The number of each face in the file; empty while no face has changed.
    originals: Vec<usize>,
    /// Notes on the changes to the mesh.
    pub(super) notes: Vec<String>,
}

impl Draft {
    pub(super) const fn new(mesh: PolygonMesh, places: FacePlaces) -> Self {
        Self { mesh, places, originals: Vec::new(), notes: Vec::new() }
    }

    pub(super) fn note(&mut self, note: Option<String>) {
        self.notes.extend(note);
    }

    /// The place of a face in the file.
    pub(super) fn place(&self, face: usize) -> String {
        self.places.of(self.original(face))
    }

    fn original(&self, face: usize) -> usize {
        self.originals.get(face).copied().unwrap_or(face)
    }

    /// Replaces every face by those that `with` returns for it. `with` receives the mesh, the face,
    /// and a function that returns the face's place.
    pub(super) fn replace_faces(
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
}
