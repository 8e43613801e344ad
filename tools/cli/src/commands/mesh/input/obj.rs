//! OBJ files, read by `tobj`, which tells no line numbers: they are found when they are needed.

use super::{read, refused};
use crate::failure::Failure;
use glam::{Vec2, Vec3};
use std::path::Path;
use tess_surface::{Face, Model, PolygonMesh, Sides, Style};
use tobj::{LoadError, LoadOptions};

/// Reads triangles and quads of all objects and groups. Materials are left alone.
pub(super) fn load(path: &Path, style: Style) -> Result<Model, Failure> {
    let bytes = read(path)?;
    let objects = parse(&bytes).map_err(|error| broken(path, &bytes, error))?;
    let mut mesh = PolygonMesh::default();
    for object in &objects {
        append(&mut mesh, &object.mesh)
            .map_err(|(face, arity)| wrong_arity(path, &bytes, face, arity))?;
    }
    drop(objects);
    Model::polygons(mesh, style).map_err(|error| refused(path, error, |face| place(&bytes, face)))
}

fn parse(bytes: &[u8]) -> Result<Vec<tobj::Model>, LoadError> {
    // Default options: faces of any number of corners, one index for each of their attributes.
    let no_materials = |_: &Path| Err(LoadError::GenericFailure);
    let (objects, _) = tobj::load_obj_buf(&mut &bytes[..], &LoadOptions::default(), no_materials)?;
    Ok(objects)
}

/// Adds an object's faces; fails with the number of the first one with the wrong number of corners.
fn append(mesh: &mut PolygonMesh, object: &tobj::Mesh) -> Result<(), (usize, usize)> {
    let (positions, normals) = (vec3s(&object.positions), vec3s(&object.normals));
    let texcoords = object.texcoords.as_chunks().0.iter().map(|&t| Vec2::from_array(t));
    let firsts = [mesh.positions.len(), mesh.texcoords.len(), mesh.normals.len()];
    let triangles = object.indices.len() / 3;
    let arities = if object.face_arities.is_empty() {
        vec![3; triangles]
    } else {
        object.face_arities.clone()
    };
    let mut first_corner = 0;
    for arity in arities.into_iter().map(|arity| arity as usize) {
        let corners = |list: &[u32], first: usize| {
            let numbers = list.get(first_corner..first_corner + arity)?;
            let moved = numbers.iter().map(|&n| n.saturating_add(count(first)));
            sides(&moved.collect::<Vec<_>>())
        };
        let wrong = (mesh.faces.len(), arity);
        mesh.faces.push(Face {
            positions: corners(&object.indices, firsts[0]).ok_or(wrong)?,
            texcoords: corners(&object.texcoord_indices, firsts[1]),
            normals: corners(&object.normal_indices, firsts[2]),
        });
        first_corner += arity;
    }
    mesh.positions.extend(positions);
    mesh.normals.extend(normals);
    mesh.texcoords.extend(texcoords);
    Ok(())
}

fn vec3s(floats: &[f32]) -> impl Iterator<Item = Vec3> {
    floats.as_chunks().0.iter().map(|&v| Vec3::from_array(v))
}

/// Models of 2^32 positions are refused later, as indices out of range.
fn count(length: usize) -> u32 {
    u32::try_from(length).unwrap_or(u32::MAX)
}

fn sides(numbers: &[u32]) -> Option<Sides<u32>> {
    match *numbers {
        [a, b, c] => Some(Sides::Triangle([a, b, c])),
        [a, b, c, d] => Some(Sides::Quad([a, b, c, d])),
        _ => None,
    }
}

fn wrong_arity(path: &Path, bytes: &[u8], face: usize, arity: usize) -> Failure {
    Failure::bad_input(format!(
        "{}: {}: a face with {arity} corners; only triangles and quads are read, others are \
         refused: triangulate the mesh first",
        path.display(),
        place(bytes, face)
    ))
}

/// `line N`, of face number `face` of the file.
fn place(bytes: &[u8], face: usize) -> String {
    let is_face = |line: &&[u8]| matches!(line.trim_ascii_start(), [b'f' | b'l', b' ' | b'\t', ..]);
    let faces = lines(bytes).enumerate().filter(|(_, line)| is_face(line));
    match faces.map(|(number, _)| number + 1).nth(face) {
        Some(line) => format!("line {line}"),
        None => format!("face {}", face + 1),
    }
}

fn lines(bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    bytes.split_inclusive(|&byte| byte == b'\n')
}

/// The line at which reading fails: the end of the shortest beginning of the file that does not
/// read, found by halving.
fn broken(path: &Path, bytes: &[u8], error: LoadError) -> Failure {
    let ends: Vec<usize> = lines(bytes)
        .scan(0, |end, line| {
            *end += line.len();
            Some(*end)
        })
        .collect();
    let first_bad = ends.partition_point(|&end| parse(&bytes[..end]).is_ok());
    let start = first_bad.checked_sub(1).map_or(0, |before| ends[before]);
    let end = ends.get(first_bad).copied().unwrap_or(bytes.len());
    let text = String::from_utf8_lossy(bytes[start..end].trim_ascii());
    Failure::bad_input(format!("{}: line {}: {error}: `{text}`", path.display(), first_bad + 1))
}
