//! glTF files, and a reader that walks the JSON directly, one number at a time.

use super::{mesh_words, models};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::Value;
use tess_mesh::tess_surface::glam::{Mat3, Mat4, Quat, Vec2, Vec3};
use tess_mesh::tess_surface::{Face, PolygonMesh, Sides};
use tess_mesh::{Format, LoadOptions, raw};

/// The most bytes: files of fuzz targets are small, but may repeat their contents.
const MOST: u64 = 1 << 22;

/// Compares one file. Errors: the first difference, or a message that names no place.
pub(crate) fn check(data: &[u8]) -> Result<(), String> {
    let options = LoadOptions { max_memory: MOST, ..LoadOptions::default() };
    let read = raw::gltf(data, &options).map_err(|error| error.to_string());
    models(data, Format::Gltf)?;
    let has_texcoords = read.as_ref().is_ok_and(|mesh| !mesh.texcoords.is_empty());
    let again = || {
        let mut mesh = naive(data)?;
        // Texture coordinates that break a rule are left out; this reader knows no rules.
        if !has_texcoords {
            mesh.texcoords.clear();
            mesh.faces.iter_mut().for_each(|face| face.texcoords = None);
        }
        Some(mesh)
    };
    super::check(read, mesh_words, names_a_place, again)
}

/// A part of the binary form, a JSON path, or the line of a text that is not JSON.
fn names_a_place(message: &str) -> bool {
    const MEMBERS: &str = "asset extensionsUsed extensionsRequired scenes scene nodes meshes accessors bufferViews \
         buffers skins animations";
    let place = message.split(": ").next().unwrap_or_default();
    let is_path = MEMBERS.split(' ').any(|name| {
        place.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
    });
    is_path
        || place.starts_with("GLB ")
        || place == "there is no face"
        || message.contains(" at line ")
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
    let mut order = Vec::new();
    let scene = index(&file.json["scene"]).unwrap_or(0);
    match list(&file.json["scenes"]).get(scene) {
        Some(scene) => {
            for root in list(&scene["nodes"]) {
                file.walk(index(root)?, &mut order);
            }
        }
        None => {
            for root in 0..list(&file.json["nodes"]).len() {
                if file.parent(root).is_none() {
                    file.walk(root, &mut order);
                }
            }
        }
    }
    let mut mesh = PolygonMesh::default();
    for number in order {
        file.mesh(number, &mut mesh)?;
    }
    Some(mesh)
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

/// A whole number, also if it is written with a decimal point.
fn index(value: &Value) -> Option<usize> {
    let float = value.as_f64().filter(|float| float.fract() == 0.0 && *float >= 0.0);
    value.as_u64().map_or_else(|| float.map(|float| float as usize), |n| usize::try_from(n).ok())
}

fn number(value: &Value) -> Option<f32> {
    let whole = value.as_u64().map(|n| n as f32).or_else(|| value.as_i64().map(|n| n as f32));
    whole.or_else(|| value.as_f64().map(|n| n as f32))
}

fn numbers(value: &Value) -> Option<Vec<f32>> {
    value.as_array()?.iter().map(number).collect()
}

impl File {
    /// Adds a node and those below it, unless they are there or hidden.
    fn walk(&self, number: usize, order: &mut Vec<usize>) {
        let node = &self.json["nodes"][number];
        let is_hidden = node["extensions"]["KHR_node_visibility"]["visible"] == false;
        if order.contains(&number) || is_hidden {
            return;
        }
        order.push(number);
        list(&node["children"]).iter().filter_map(index).for_each(|child| self.walk(child, order));
    }

    /// The first node that has this one as a child.
    fn parent(&self, number: usize) -> Option<usize> {
        let mut nodes = list(&self.json["nodes"]).iter();
        nodes.position(|node| list(&node["children"]).iter().any(|c| index(c) == Some(number)))
    }

    /// The transform of a node to the scene.
    fn transform(&self, number: usize) -> Option<Mat4> {
        let node = &list(&self.json["nodes"]).get(number)?;
        let own = match numbers(&node["matrix"]) {
            Some(numbers) => Mat4::from_cols_array(numbers.first_chunk()?),
            None => transform(node)?,
        };
        match self.parent(number) {
            Some(parent) => Some(self.transform(parent)? * own),
            None => Some(own),
        }
    }

    /// The primitives of a node's mesh.
    fn mesh(&self, number: usize, mesh: &mut PolygonMesh) -> Option<()> {
        let node = &self.json["nodes"][number];
        let Some(own) = index(&node["mesh"]).map(|number| &self.json["meshes"][number]) else {
            return Some(());
        };
        let weights = [node, own].iter().find_map(|of| numbers(&of["weights"]));
        let joints = index(&node["skin"]).map(|skin| self.joints(skin));
        for primitive in list(&own["primitives"]) {
            let mode = index(&primitive["mode"]).unwrap_or(4);
            if mode < 4 || primitive["attributes"].get("POSITION").is_none() {
                continue;
            }
            let moved = self.matrices(primitive, self.transform(number)?, joints.as_ref())?;
            self.primitive(primitive, mode, &moved, weights.as_deref(), mesh)?;
        }
        Some(())
    }

    fn joints(&self, skin: usize) -> Option<Vec<Mat4>> {
        let skin = &self.json["skins"][skin];
        let inverse = index(&skin["inverseBindMatrices"]).map(|number| self.accessor(number));
        let joint = |(k, node): (usize, &Value)| {
            let transform = self.transform(index(node)?)?;
            let Some(inverse) = &inverse else { return Some(transform * Mat4::IDENTITY) };
            let numbers: Vec<f32> = inverse.as_ref()?.get(k)?.iter().map(|&x| x as f32).collect();
            Some(transform * Mat4::from_cols_array(numbers.first_chunk()?))
        };
        list(&skin["joints"]).iter().enumerate().map(joint).collect()
    }

    /// The matrix of each vertex.
    fn matrices(
        &self,
        primitive: &Value,
        node: Mat4,
        joints: Option<&Option<Vec<Mat4>>>,
    ) -> Option<Vec<Mat4>> {
        let attributes = &primitive["attributes"];
        let count = index(&self.json["accessors"][index(&attributes["POSITION"])?]["count"])?;
        let mut influences: Vec<Vec<(usize, f32)>> = vec![Vec::new(); count];
        for set in 0.. {
            let [joint, weight] =
                ["JOINTS", "WEIGHTS"].map(|name| index(&attributes[format!("{name}_{set}")]));
            let (Some(joint), Some(weight), Some(_)) = (joint, weight, joints) else { break };
            let (joint, weight) = (self.accessor(joint)?, self.accessor(weight)?);
            for (vertex, own) in influences.iter_mut().enumerate() {
                own.extend((0..4).map(|k| (joint[vertex][k] as usize, weight[vertex][k] as f32)));
            }
        }
        let Some(joints) = joints.filter(|_| influences.iter().any(|own| !own.is_empty())) else {
            return Some(vec![node; count]);
        };
        let joints = joints.as_ref()?;
        let blended = influences.iter().map(|own| {
            let mut sum = 0.0f32;
            own.iter().for_each(|(_, weight)| sum += weight);
            if !(sum > 0.0 && sum.is_finite()) {
                return Some(joints.get(own.first()?.0).copied().unwrap_or(Mat4::IDENTITY));
            }
            let mut matrix = Mat4::ZERO;
            for &(joint, weight) in own.iter().filter(|(_, weight)| *weight != 0.0) {
                matrix += *joints.get(joint)? * weight;
            }
            Some(matrix * (1.0 / sum))
        });
        blended.collect()
    }

    /// The vectors of an attribute, moved by the morph targets.
    fn vectors(&self, primitive: &Value, name: &str, weights: Option<&[f32]>) -> Option<Vec<Vec3>> {
        let vector = |xyz: &Vec<f64>| Vec3::new(xyz[0] as f32, xyz[1] as f32, xyz[2] as f32);
        let own = self.accessor(index(&primitive["attributes"][name])?)?;
        let mut vectors: Vec<Vec3> = own.iter().map(vector).collect();
        for (target, &weight) in list(&primitive["targets"]).iter().zip(weights.unwrap_or_default())
        {
            let Some(by) = index(&target[name]).filter(|_| weight != 0.0) else { continue };
            for (vector, by) in vectors.iter_mut().zip(self.accessor(by)?.iter().map(vector)) {
                *vector += by * weight;
            }
        }
        Some(vectors)
    }

    fn primitive(
        &self,
        primitive: &Value,
        mode: usize,
        matrices: &[Mat4],
        weights: Option<&[f32]>,
        mesh: &mut PolygonMesh,
    ) -> Option<()> {
        let attributes = &primitive["attributes"];
        let triangles = self.triangles(primitive, mode, matrices.len())?;
        if triangles.is_empty() {
            return Some(());
        }
        let first = [mesh.positions.len(), mesh.normals.len(), mesh.texcoords.len()];
        let positions = self.vectors(primitive, "POSITION", weights)?;
        let has_normals = attributes.get("NORMAL").is_some();
        let texcoords = self.texcoords(primitive, matrices.len());
        let has_texcoords = texcoords.is_some();
        let placed = positions.iter().zip(matrices).map(|(&xyz, m)| m.transform_point3(xyz));
        mesh.positions.extend(placed);
        if has_normals {
            let normals = self.vectors(primitive, "NORMAL", weights)?;
            mesh.normals.extend(normals.iter().zip(matrices).map(|(&n, matrix)| turned(matrix, n)));
        }
        for t in texcoords.unwrap_or_default() {
            mesh.texcoords.push(Vec2::new(t[0] as f32, 1.0 - t[1] as f32));
        }
        for [a, b, c] in triangles {
            let mirrored = Mat3::from_mat4(matrices[a]).determinant() < 0.0;
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

    /// The vertices of each triangle.
    fn triangles(&self, primitive: &Value, mode: usize, count: usize) -> Option<Vec<[usize; 3]>> {
        let indices: Vec<usize> = match index(&primitive["indices"]) {
            Some(number) => self.accessor(number)?.iter().map(|i| i[0] as usize).collect(),
            None => (0..count).collect(),
        };
        Some(match mode {
            4 => indices.as_chunks().0.to_vec(),
            5 => {
                let odd = |k: usize, [a, b, c]: [usize; 3]| {
                    if k.is_multiple_of(2) { [a, b, c] } else { [a, c, b] }
                };
                let windows = indices.windows(3).enumerate();
                windows.map(|(k, of)| odd(k, [of[0], of[1], of[2]])).collect()
            }
            _ => {
                let rest = indices.get(1..).unwrap_or_default();
                rest.windows(2).map(|of| [of[0], of[1], indices[0]]).collect()
            }
        })
    }

    /// The texture coordinates, if they can be read.
    fn texcoords(&self, primitive: &Value, count: usize) -> Option<Vec<Vec<f64>>> {
        let number = index(&primitive["attributes"]["TEXCOORD_0"])?;
        let accessor = list(&self.json["accessors"]).get(number)?;
        let kind = index(&accessor["componentType"])?;
        let extensions =
            ["extensionsUsed", "extensionsRequired"].map(|name| list(&self.json[name]));
        let is_quantized = extensions.concat().iter().any(|name| name == "KHR_mesh_quantization");
        let normalized = accessor["normalized"] == true;
        let is_right = match kind {
            5126 => true,
            5121 | 5123 => normalized || is_quantized,
            5120 | 5122 => is_quantized,
            _ => false,
        };
        let is_whole =
            is_right && index(&accessor["count"]) == Some(count) && accessor["type"] == "VEC2";
        if is_whole { self.accessor(number) } else { None }
    }

    /// Every element of an accessor; all numbers of 32 bits are exact in `f64`.
    fn accessor(&self, number: usize) -> Option<Vec<Vec<f64>>> {
        let accessor = &self.json["accessors"][number];
        let components = match accessor["type"].as_str()? {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            "MAT4" => 16,
            _ => return None,
        };
        let kind = index(&accessor["componentType"])? as u64;
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
            let at =
                self.element(indices, index(&indices["componentType"])? as u64, false, 1, k)?[0];
            *elements.get_mut(at as usize)? =
                self.element(&sparse["values"], kind, normalized, components, k)?;
        }
        Some(elements)
    }

    /// Element `k` of an object that has a `bufferView` and perhaps a `byteOffset`.
    fn element(
        &self,
        source: &Value,
        kind: u64,
        normalized: bool,
        components: usize,
        k: usize,
    ) -> Option<Vec<f64>> {
        let view = &self.json["bufferViews"][index(&source["bufferView"])?];
        let bytes = self.buffers.get(index(&view["buffer"])?)?;
        let size = match kind {
            5120 | 5121 => 1,
            5122 | 5123 => 2,
            _ => 4,
        };
        let offset = |value: &Value| index(&value["byteOffset"]).unwrap_or(0);
        let stride = index(&view["byteStride"]).filter(|&stride| stride > 0);
        let stride = stride.unwrap_or(size * components);
        let start =
            offset(view).checked_add(offset(source))?.checked_add(k.checked_mul(stride)?)?;
        let component = |c: usize| {
            let mut word = [0; 4];
            word[..size].copy_from_slice(bytes.get(start.checked_add(c * size)?..)?.get(..size)?);
            let whole = u32::from_le_bytes(word);
            Some(match (kind, normalized) {
                (5126, _) => f64::from(f32::from_bits(whole)),
                (5120, true) => f64::from((f32::from(word[0] as i8) / 127.0).max(-1.0)),
                (5120, false) => f64::from(word[0] as i8),
                (5121, true) => f64::from(whole as f32 / 255.0),
                (5122, true) => f64::from((f32::from(whole as i16) / 32767.0).max(-1.0)),
                (5122, false) => f64::from(whole as i16),
                (5123, true) => f64::from(whole as f32 / 65535.0),
                _ => f64::from(whole),
            })
        };
        (0..components).map(component).collect()
    }
}

/// The normal of a face that a matrix moves: the matrix's cofactors, in units of its largest
/// element, times the normal.
fn turned(matrix: &Mat4, n: Vec3) -> Vec3 {
    let m = Mat3::from_mat4(*matrix).to_cols_array();
    let largest = m.iter().fold(0.0f32, |largest, x| largest.max(x.abs()));
    if !(largest > 0.0 && largest.is_finite()) {
        return Vec3::ZERO;
    }
    let [x, y, z] = [0, 3, 6].map(|k| Vec3::new(m[k], m[k + 1], m[k + 2]) / largest);
    let sum = y.cross(z) * n.x + z.cross(x) * n.y + x.cross(y) * n.z;
    if x.dot(y.cross(z)) < 0.0 { -sum } else { sum }
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
