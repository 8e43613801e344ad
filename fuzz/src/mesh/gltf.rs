//! glTF files, and a reader that walks the JSON as it comes, one number at a time.

use super::{mesh_words, models};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use glam::{Mat3, Mat4, Quat, Vec2, Vec3};
use serde_json::Value;
use tess_program::fuzzing;
use tess_surface::{Face, PolygonMesh, Sides};

/// Most vertices and triangles: files of fuzz targets are small, but may repeat what they hold.
const MOST: usize = 1 << 14;

/// Compares one file. Errors: the first difference, or a message that names no place.
pub fn check(data: &[u8]) -> Result<(), String> {
    let read = fuzzing::gltf(data, MOST);
    if let Ok(mesh) = &read {
        models(mesh.clone())?;
        if is_only_skipped(data) {
            return Ok(());
        }
    }
    super::check(read, mesh_words, names_a_place, || naive(data))
}

/// A part of the binary form, a JSON path, or the line of text that is not JSON.
fn names_a_place(message: &str) -> bool {
    const MEMBERS: &str =
        "asset extensionsRequired scenes scene nodes meshes accessors bufferViews buffers";
    let place = message.split(": ").next().unwrap_or_default();
    let is_path = MEMBERS.split(' ').any(|name| {
        place.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
    });
    is_path || place.starts_with("GLB ") || message.contains(" at line ")
}

/// Whether the JSON has what serde_json refuses in a value that it keeps, as the independent reading
/// does with all, but not in one that it skips.
fn is_only_skipped(data: &[u8]) -> bool {
    const FAULTS: [&str; 4] = [
        "number out of range",
        "recursion limit",
        "lone leading surrogate",
        "unexpected end of hex",
    ];
    let message = serde_json::from_slice::<Value>(json_and_blob(data).0);
    let message = message.map_or_else(|error| error.to_string(), |_| String::new());
    FAULTS.iter().any(|fault| message.starts_with(fault))
}

/// The JSON of a file in either form, and the bytes of its binary chunk.
fn json_and_blob(data: &[u8]) -> (&[u8], &[u8]) {
    let length = data.get(12..16).and_then(|bytes| bytes.first_chunk().copied());
    let end = length.map(|length| 20 + u32::from_le_bytes(length) as usize);
    match end {
        Some(end) if data.starts_with(b"glTF") && end <= data.len() => {
            (&data[20..end], data.get(end + 8..).unwrap_or_default())
        }
        _ => (data, &[]),
    }
}

struct File {
    json: Value,
    buffers: Vec<Vec<u8>>,
}

fn naive(data: &[u8]) -> Option<PolygonMesh> {
    let (json, blob) = json_and_blob(data);
    let json: Value = serde_json::from_slice(json).ok()?;
    let buffers = list(&json["buffers"]).iter().map(|buffer| match buffer["uri"].as_str() {
        Some(uri) => BASE64_STANDARD.decode(uri.split_once(";base64,")?.1).ok(),
        None => Some(blob.to_vec()),
    });
    let buffers = buffers.collect::<Option<_>>()?;
    let file = File { json, buffers };
    let scene = file.json["scene"].as_u64().unwrap_or(0) as usize;
    let mut mesh = PolygonMesh::default();
    for root in list(&file.json["scenes"][scene]["nodes"]) {
        file.node(index(root)?, Mat4::IDENTITY, &mut mesh)?;
    }
    Some(mesh)
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn index(value: &Value) -> Option<usize> {
    usize::try_from(value.as_u64()?).ok()
}

fn number(value: &Value) -> Option<f32> {
    let whole = value.as_u64().map(|n| n as f32).or_else(|| value.as_i64().map(|n| n as f32));
    whole.or_else(|| value.as_f64().map(|n| n as f32))
}

fn numbers(value: &Value) -> Option<Vec<f32>> {
    value.as_array()?.iter().map(number).collect()
}

impl File {
    fn node(&self, number: usize, parent: Mat4, mesh: &mut PolygonMesh) -> Option<()> {
        let node = &self.json["nodes"][number];
        let own = match numbers(&node["matrix"]) {
            Some(numbers) => Mat4::from_cols_array(numbers.first_chunk()?),
            None => transform(node)?,
        };
        let transform = parent * own;
        if let Some(number) = index(&node["mesh"]) {
            for primitive in list(&self.json["meshes"][number]["primitives"]) {
                self.primitive(primitive, transform, mesh)?;
            }
        }
        list(&node["children"])
            .iter()
            .try_for_each(|child| self.node(index(child)?, transform, mesh))
    }

    fn primitive(&self, primitive: &Value, transform: Mat4, mesh: &mut PolygonMesh) -> Option<()> {
        let attributes = &primitive["attributes"];
        let first = [mesh.positions.len(), mesh.normals.len(), mesh.texcoords.len()];
        let positions = self.accessor(index(&attributes["POSITION"])?)?;
        let has_normals = attributes.get("NORMAL").is_some();
        let has_texcoords = attributes.get("TEXCOORD_0").is_some();
        let linear = Mat3::from_mat4(transform);
        let vector = |xyz: &Vec<f64>| Vec3::new(xyz[0] as f32, xyz[1] as f32, xyz[2] as f32);
        let placed = positions.iter().map(|xyz| transform.transform_point3(vector(xyz)));
        mesh.positions.extend(placed);
        if has_normals {
            let normals = self.accessor(index(&attributes["NORMAL"])?)?;
            let turn = linear.inverse().transpose();
            mesh.normals.extend(normals.iter().map(|xyz| turn * vector(xyz)));
        }
        if has_texcoords {
            for t in self.accessor(index(&attributes["TEXCOORD_0"])?)? {
                mesh.texcoords.push(Vec2::new(t[0] as f32, 1.0 - t[1] as f32));
            }
        }
        let indices: Vec<usize> = match index(&primitive["indices"]) {
            Some(number) => self.accessor(number)?.iter().map(|i| i[0] as usize).collect(),
            None => (0..positions.len()).collect(),
        };
        let mirrored = linear.determinant() < 0.0;
        for &[a, b, c] in indices.as_chunks().0 {
            let corners = if mirrored { [a, c, b] } else { [a, b, c] };
            let from =
                |first: usize| Sides::Triangle(corners.map(|corner| (corner + first) as u32));
            mesh.faces.push(Face {
                positions: from(first[0]),
                normals: has_normals.then(|| from(first[1])),
                texcoords: has_texcoords.then(|| from(first[2])),
            });
        }
        Some(())
    }

    /// Every element of an accessor; all numbers of 32 bits are exact in `f64`.
    fn accessor(&self, number: usize) -> Option<Vec<Vec<f64>>> {
        let accessor = &self.json["accessors"][number];
        let components = match accessor["type"].as_str()? {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            _ => return None,
        };
        let kind = accessor["componentType"].as_u64()?;
        let normalized = accessor["normalized"] == true;
        let count = index(&accessor["count"])?;
        let mut elements = vec![vec![0.0; components]; count];
        if accessor.get("bufferView").is_some() {
            for (k, element) in elements.iter_mut().enumerate() {
                *element = self.element(accessor, kind, normalized, components, k)?;
            }
        }
        let sparse = &accessor["sparse"];
        for k in 0..index(&sparse["count"]).unwrap_or(0) {
            let indices = &sparse["indices"];
            let at = self.element(indices, indices["componentType"].as_u64()?, false, 1, k)?[0];
            elements[at as usize] =
                self.element(&sparse["values"], kind, normalized, components, k)?;
        }
        Some(elements)
    }

    /// Element `k` of whatever has a `bufferView` and perhaps a `byteOffset`.
    fn element(
        &self,
        source: &Value,
        kind: u64,
        normalized: bool,
        components: usize,
        k: usize,
    ) -> Option<Vec<f64>> {
        let view = &self.json["bufferViews"][index(&source["bufferView"])?];
        let bytes = &self.buffers[index(&view["buffer"])?];
        let size = match kind {
            5121 => 1,
            5123 => 2,
            _ => 4,
        };
        let offset = |value: &Value| index(&value["byteOffset"]).unwrap_or(0);
        let stride = index(&view["byteStride"]).unwrap_or(size * components);
        let start = offset(view) + offset(source) + k * stride;
        let component = |c: usize| {
            let mut word = [0; 4];
            word[..size].copy_from_slice(bytes.get(start + c * size..)?.get(..size)?);
            let whole = u32::from_le_bytes(word);
            Some(match (kind, normalized) {
                (5126, _) => f64::from(f32::from_bits(whole)),
                (5121, true) => f64::from(whole as f32 / 255.0),
                (5123, true) => f64::from(whole as f32 / 65535.0),
                _ => f64::from(whole),
            })
        };
        (0..components).map(component).collect()
    }
}

/// Translation times rotation times scale.
fn transform(node: &Value) -> Option<Mat4> {
    let or = |name: &str, default: &[f32]| match node.get(name) {
        Some(value) => numbers(value),
        None => Some(default.to_vec()),
    };
    let translation = Vec3::from_slice(&or("translation", &[0.0; 3])?);
    let rotation = Quat::from_slice(&or("rotation", &[0.0, 0.0, 0.0, 1.0])?);
    let scale = Vec3::from_slice(&or("scale", &[1.0; 3])?);
    Some(Mat4::from_scale_rotation_translation(scale, rotation, translation))
}
