//! The model: a toy animal, which is written as a glTF file in memory and read back.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::Vec3;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::error::Error;

/// The cubes that the animal is made of: x to the right, y to the back, z up.
const CUBES: [[i8; 3]; 40] = [
    // Feet and legs.
    [0, -1, 0],
    [2, -1, 0],
    [0, 0, 0],
    [2, 0, 0],
    [0, 0, 1],
    [2, 0, 1],
    // Body, tail.
    [0, 0, 2],
    [1, 0, 2],
    [2, 0, 2],
    [0, 0, 3],
    [1, 0, 3],
    [2, 0, 3],
    [0, 0, 4],
    [1, 0, 4],
    [2, 0, 4],
    [1, 1, 2],
    [1, 2, 2],
    // Arms.
    [-1, 0, 4],
    [-2, 0, 4],
    [3, 0, 4],
    [4, 0, 4],
    // Neck and head.
    [1, 0, 5],
    [0, 0, 6],
    [1, 0, 6],
    [2, 0, 6],
    [0, 0, 7],
    [1, 0, 7],
    [2, 0, 7],
    [0, -1, 6],
    [1, -1, 6],
    [2, -1, 6],
    [0, -1, 7],
    [1, -1, 7],
    [2, -1, 7],
    [0, 0, 8],
    [1, 0, 8],
    [2, 0, 8],
    // Snout and ears.
    [1, -2, 6],
    [0, 0, 9],
    [2, 0, 9],
];
/// The size of a cube.
const SIZE: f32 = 0.33;

/// Triangles with smooth normals.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Mesh {
    pub(crate) positions: Vec<[f32; 3]>,
    pub(crate) normals: Vec<[f32; 3]>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

/// The faces of the cubes that no other cube covers, smoothed.
pub(crate) fn animal() -> Mesh {
    let mut numbers = BTreeMap::new();
    let mut mesh = Mesh::default();
    for cube in CUBES {
        for face in 0..6 {
            let (axis, side) = (face % 3, i8::from(face >= 3));
            let mut beside = cube;
            beside[axis] += 2 * side - 1;
            if CUBES.contains(&beside) {
                continue;
            }
            let quad = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[a, b]: [i8; 2]| {
                let mut at = cube;
                at[axis] += side;
                // Counter-clockwise as seen from outside.
                at[(axis + 1) % 3] += if side == 1 { a } else { b };
                at[(axis + 2) % 3] += if side == 1 { b } else { a };
                *numbers.entry(at).or_insert_with(|| {
                    mesh.positions.push(at.map(|c| SIZE * f32::from(c)));
                    u32::try_from(mesh.positions.len() - 1).unwrap_or(u32::MAX)
                })
            });
            let [a, b, c, d] = quad;
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    for _ in 0..2 {
        smooth(&mut mesh);
    }
    mesh.normals = normals(&mesh);
    mesh
}

/// Moves each corner half of the way to the mean of its neighbours.
fn smooth(mesh: &mut Mesh) {
    let mut sums = vec![(Vec3::ZERO, 0.0); mesh.positions.len()];
    for &[a, b, c] in &mesh.triangles {
        for (corner, beside) in [(a, b), (b, c), (c, a)] {
            let (sum, count) = &mut sums[corner as usize];
            *sum += Vec3::from(mesh.positions[beside as usize]);
            *count += 1.0;
        }
    }
    for (position, (sum, count)) in mesh.positions.iter_mut().zip(sums) {
        *position = Vec3::from(*position).lerp(sum / count, 0.5).to_array();
    }
}

/// The mean normal of the triangles around each corner, weighted by area.
fn normals(mesh: &Mesh) -> Vec<[f32; 3]> {
    let mut sums = vec![Vec3::ZERO; mesh.positions.len()];
    for &triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|corner| Vec3::from(mesh.positions[corner as usize]));
        for corner in triangle {
            sums[corner as usize] += (b - a).cross(c - a);
        }
    }
    sums.into_iter().map(|sum| sum.normalize_or(Vec3::Z).to_array()).collect()
}

/// A mesh as a glTF 2.0 file with its buffer inside.
pub(crate) fn write(mesh: &Mesh) -> String {
    let mut bytes: Vec<u8> = bytemuck::cast_slice(&mesh.positions).to_vec();
    bytes.extend_from_slice(bytemuck::cast_slice(&mesh.normals));
    bytes.extend_from_slice(bytemuck::cast_slice(&mesh.triangles));
    let vectors = 12 * mesh.positions.len();
    let low =
        mesh.positions.iter().fold([f32::MAX; 3], |low, p| [0, 1, 2].map(|k| low[k].min(p[k])));
    let high =
        mesh.positions.iter().fold([f32::MIN; 3], |high, p| [0, 1, 2].map(|k| high[k].max(p[k])));
    let view = |offset: usize, length: usize| {
        let buffer = 0;
        json!({"buffer": buffer, "byteOffset": offset, "byteLength": length})
    };
    let count = mesh.positions.len();
    let vector = |view: usize| {
        let (float, kind) = (5126, "VEC3");
        json!({"bufferView": view, "componentType": float, "count": count, "type": kind})
    };
    let mut positions = vector(0);
    positions["min"] = json!(low);
    positions["max"] = json!(high);
    let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(&bytes));
    let file = json!({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2}]}],
        "accessors": [
            positions,
            vector(1),
            {"bufferView": 2, "componentType": 5125, "count": 3 * mesh.triangles.len(), "type": "SCALAR"},
        ],
        "bufferViews": [
            view(0, vectors), view(vectors, vectors), view(2 * vectors, 12 * mesh.triangles.len()),
        ],
        "buffers": [{"byteLength": bytes.len(), "uri": uri}],
    });
    file.to_string()
}

/// The first mesh of a glTF file of the form that [`write`] writes: with one embedded buffer,
/// positions, normals and 32-bit indices.
pub(crate) fn read(text: &str) -> Result<Mesh, Box<dyn Error>> {
    let file: Value = serde_json::from_str(text)?;
    let uri = file["buffers"][0]["uri"].as_str().ok_or("the file has no buffer inside")?;
    let (_, data) = uri.split_once(";base64,").ok_or("the buffer is not in base64")?;
    let bytes = STANDARD.decode(data)?;
    let primitive = &file["meshes"][0]["primitives"][0];
    let of = |accessor: &Value| -> Result<&[u8], Box<dyn Error>> {
        let number = |value: &Value| value.as_u64().and_then(|n| usize::try_from(n).ok());
        let accessor = number(accessor).ok_or("the mesh lacks positions, normals or indices")?;
        let view = number(&file["accessors"][accessor]["bufferView"]).ok_or("no buffer view")?;
        let view = &file["bufferViews"][view];
        let begin = number(&view["byteOffset"]).unwrap_or(0);
        let length = number(&view["byteLength"]).ok_or("a buffer view has no length")?;
        Ok(bytes
            .get(begin..begin.saturating_add(length))
            .ok_or("a buffer view ends behind the buffer")?)
    };
    let mesh = Mesh {
        positions: bytemuck::pod_collect_to_vec(of(&primitive["attributes"]["POSITION"])?),
        normals: bytemuck::pod_collect_to_vec(of(&primitive["attributes"]["NORMAL"])?),
        triangles: bytemuck::pod_collect_to_vec(of(&primitive["indices"])?),
    };
    let corners = mesh.triangles.as_flattened();
    if mesh.normals.len() != mesh.positions.len()
        || corners.iter().any(|&corner| corner as usize >= mesh.positions.len())
    {
        return Err("positions and normals differ in number, or an index is out of range".into());
    }
    Ok(mesh)
}
