//! glTF and GLB files, read by the `gltf` crate: the triangles of all meshes of the scene.

use super::refused;
use crate::failure::Failure;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use glam::{Mat3, Mat4, Vec2, Vec3};
use gltf::buffer::Source;
use gltf::mesh::Mode;
use gltf::{Buffer, Gltf, Node, Primitive};
use std::path::Path;
use tess_surface::{Face, Model, PolygonMesh, Sides, Style};

/// The mesh so far, and where each primitive's faces begin.
struct Reader<'a> {
    path: &'a Path,
    buffers: Vec<Vec<u8>>,
    mesh: PolygonMesh,
    starts: Vec<(usize, String)>,
}

/// Reads the default scene, or the first one, with its nodes' transforms applied.
pub(super) fn load(path: &Path, style: Style) -> Result<Model, Failure> {
    let failure = |message: String| Failure::bad_input(format!("{}: {message}", path.display()));
    let bytes = super::read(path)?;
    let read = Gltf::from_slice(&bytes);
    let Gltf { document, mut blob } = read.map_err(|error| failure(error.to_string()))?;
    drop(bytes);
    let mut buffers = Vec::new();
    for buffer in document.buffers() {
        buffers.push(load_buffer(path, &buffer, &mut blob).map_err(&failure)?);
    }
    let mut reader = Reader { path, buffers, mesh: PolygonMesh::default(), starts: Vec::new() };
    let scene = document.default_scene().or_else(|| document.scenes().next());
    let scene = scene.ok_or_else(|| reader.failure("it has no scene"))?;
    for node in scene.nodes() {
        reader.node(&node, Mat4::IDENTITY)?;
    }
    let Reader { mesh, starts, .. } = reader;
    Model::polygons(mesh, style).map_err(|error| {
        refused(path, error, |face| {
            let after = starts.partition_point(|(start, _)| *start <= face);
            let (start, name) = &starts[after - 1];
            format!("{name}, triangle {}", face - start + 1)
        })
    })
}

/// A buffer from the file itself, from base64 in it, or from a file beside it.
fn load_buffer(
    path: &Path,
    buffer: &Buffer<'_>,
    blob: &mut Option<Vec<u8>>,
) -> Result<Vec<u8>, String> {
    let index = buffer.index();
    let data = match buffer.source() {
        Source::Bin => blob.take().ok_or_else(|| format!("buffer {index} has no content"))?,
        Source::Uri(uri) => match uri.strip_prefix("data:") {
            Some(data) => {
                let (_, text) = data.split_once(";base64,").unwrap_or_default();
                let decoded = BASE64_STANDARD.decode(text);
                decoded.map_err(|error| format!("buffer {index}: {error}"))?
            }
            None => {
                let beside = path.with_file_name(uri.replace("%20", " "));
                let read = std::fs::read(&beside);
                read.map_err(|error| format!("cannot read buffer {}: {error}", beside.display()))?
            }
        },
    };
    if data.len() < buffer.length() {
        let (got, needed) = (data.len(), buffer.length());
        return Err(format!("buffer {index} has {got} of its {needed} bytes"));
    }
    Ok(data)
}

impl Reader<'_> {
    fn failure(&self, message: &str) -> Failure {
        Failure::bad_input(format!("{}: {message}", self.path.display()))
    }

    fn node(&mut self, node: &Node<'_>, parent: Mat4) -> Result<(), Failure> {
        let transform = parent * Mat4::from_cols_array_2d(&node.transform().matrix());
        if let Some(mesh) = node.mesh() {
            for primitive in mesh.primitives() {
                let name = format!("mesh {}, primitive {}", mesh.index(), primitive.index());
                self.primitive(&primitive, transform, name)?;
            }
        }
        node.children().try_for_each(|child| self.node(&child, transform))
    }

    fn primitive(
        &mut self,
        primitive: &Primitive<'_>,
        transform: Mat4,
        name: String,
    ) -> Result<(), Failure> {
        if primitive.mode() != Mode::Triangles {
            let mode = primitive.mode();
            return Err(self.failure(&format!("{name}: mode {mode:?}; only triangles are read")));
        }
        let reader =
            primitive.reader(|buffer| self.buffers.get(buffer.index()).map(|data| &data[..]));
        let Some(positions) = reader.read_positions() else {
            return Err(self.failure(&format!("{name} has no positions")));
        };
        let positions: Vec<Vec3> =
            positions.map(|p| transform.transform_point3(Vec3::from_array(p))).collect();
        let to_normal = Mat3::from_mat4(transform).inverse().transpose();
        let normals: Vec<Vec3> = reader
            .read_normals()
            .map(|normals| normals.map(|n| to_normal * Vec3::from_array(n)).collect())
            .unwrap_or_default();
        // glTF has (0, 0) at the upper left of the image.
        let texcoords: Vec<Vec2> = reader
            .read_tex_coords(0)
            .map(|t| t.into_f32().map(|[u, v]| Vec2::new(u, 1.0 - v)).collect())
            .unwrap_or_default();
        let indices: Vec<u32> = match reader.read_indices() {
            Some(indices) => indices.into_u32().collect(),
            None => (0..u32::try_from(positions.len()).unwrap_or(u32::MAX)).collect(),
        };
        let (triangles, rest) = indices.as_chunks::<3>();
        if !rest.is_empty() {
            let message = format!("{name}: {} indices are no whole triangles", indices.len());
            return Err(self.failure(&message));
        }
        if triangles.iter().flatten().any(|&index| index as usize >= positions.len()) {
            return Err(self.failure(&format!("{name}: an index is out of range")));
        }
        self.starts.push((self.mesh.faces.len(), name));
        let mirrored = transform.determinant() < 0.0;
        let mesh = &mut self.mesh;
        let first = [&mesh.positions, &mesh.normals].map(Vec::len);
        let first_texcoord = mesh.texcoords.len();
        mesh.faces.extend(triangles.iter().map(|&[a, b, c]| {
            let corners = if mirrored { [a, c, b] } else { [a, b, c] };
            let numbers = |first: usize| {
                let first = u32::try_from(first).unwrap_or(u32::MAX);
                Sides::Triangle(corners.map(|index| index.saturating_add(first)))
            };
            Face {
                positions: numbers(first[0]),
                normals: (!normals.is_empty()).then(|| numbers(first[1])),
                texcoords: (!texcoords.is_empty()).then(|| numbers(first_texcoord)),
            }
        }));
        mesh.positions.extend(positions);
        mesh.normals.extend(normals);
        mesh.texcoords.extend(texcoords);
        Ok(())
    }
}
