//! The part of a glTF document that affects triangles: its JSON, and the rules for single values.
//!
//! The source is the glTF 2.0 Specification of the Khronos Group: sections 3.2 (asset), 3.5
//! (scenes), 3.6 (binary data) and 3.7 (geometry); section 5 has the properties. Everything else in
//! a document is ignored.

use serde::{Deserialize, Deserializer};
use serde_json::Value;
use std::collections::BTreeMap;

/// The message for a rule that a document breaks: the JSON path of the value, and its fault.
pub(super) fn broken(path: impl std::fmt::Display, what: impl std::fmt::Display) -> String {
    format!("{path}: {what}")
}

/// The root object.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Document {
    #[serde(default)]
    extensions_required: Vec<String>,
    #[serde(default)]
    extensions_used: Vec<String>,
    #[serde(default, deserialize_with = "present")]
    pub(super) scene: Option<usize>,
    #[serde(default, deserialize_with = "present")]
    pub(super) scenes: Option<Vec<SceneRoots>>,
    #[serde(default)]
    pub(super) skins: Vec<Skin>,
    #[serde(default)]
    pub(super) animations: Vec<Value>,
    #[serde(default)]
    pub(super) nodes: Vec<Node>,
    #[serde(default)]
    pub(super) meshes: Vec<Mesh>,
    #[serde(default)]
    pub(super) accessors: Vec<Accessor>,
    #[serde(default)]
    pub(super) buffer_views: Vec<BufferView>,
    #[serde(default)]
    pub(super) buffers: Vec<GltfBuffer>,
}

/// The root nodes of a scene.
#[derive(Debug, Deserialize)]
pub(super) struct SceneRoots {
    #[serde(default)]
    pub(super) nodes: Vec<usize>,
}

/// A node: a place in the scene.
#[derive(Debug, Deserialize)]
pub(super) struct Node {
    #[serde(default)]
    pub(super) children: Vec<usize>,
    #[serde(default, deserialize_with = "present")]
    pub(super) mesh: Option<usize>,
    #[serde(default, deserialize_with = "present")]
    pub(super) matrix: Option<[f32; 16]>,
    #[serde(default, deserialize_with = "present")]
    pub(super) translation: Option<[f32; 3]>,
    #[serde(default, deserialize_with = "present")]
    pub(super) rotation: Option<[f32; 4]>,
    #[serde(default, deserialize_with = "present")]
    pub(super) scale: Option<[f32; 3]>,
    #[serde(default, deserialize_with = "present")]
    pub(super) skin: Option<usize>,
    /// The weights of morph targets; they replace the mesh's.
    #[serde(default, deserialize_with = "present")]
    pub(super) weights: Option<Vec<f32>>,
    #[serde(default)]
    pub(super) extensions: BTreeMap<String, Value>,
}

/// A skin: joints that move the vertices of a mesh.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Skin {
    /// An accessor with one matrix per joint.
    #[serde(default, deserialize_with = "present")]
    pub(super) inverse_bind_matrices: Option<usize>,
    /// The nodes that are joints.
    pub(super) joints: Vec<usize>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Mesh {
    pub(super) primitives: Vec<Primitive>,
    /// The weights of morph targets.
    #[serde(default, deserialize_with = "present")]
    pub(super) weights: Option<Vec<f32>>,
}

/// Attributes: accessors by name.
pub(super) type Attributes = BTreeMap<String, usize>;

/// Triangles, lines or points.
#[derive(Debug, Deserialize)]
pub(super) struct Primitive {
    pub(super) attributes: Attributes,
    #[serde(default, deserialize_with = "present")]
    pub(super) indices: Option<usize>,
    #[serde(default = "triangles")]
    pub(super) mode: u32,
    /// The morph targets, which are scaled by their weights.
    #[serde(default)]
    pub(super) targets: Vec<Attributes>,
    #[serde(default)]
    pub(super) extensions: BTreeMap<String, Value>,
}

/// An accessor: elements in a buffer view, some of which may be replaced.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    #[serde(default, deserialize_with = "present")]
    pub(super) buffer_view: Option<usize>,
    #[serde(default, deserialize_with = "present")]
    pub(super) byte_offset: Option<u64>,
    pub(super) component_type: ComponentType,
    #[serde(default)]
    pub(super) normalized: bool,
    pub(super) count: u64,
    #[serde(rename = "type")]
    pub(super) kind: ElementKind,
    #[serde(default, deserialize_with = "present")]
    pub(super) sparse: Option<Sparse>,
    #[serde(default, deserialize_with = "present")]
    pub(super) min: Option<Vec<f64>>,
    #[serde(default, deserialize_with = "present")]
    pub(super) max: Option<Vec<f64>>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Sparse {
    pub(super) count: u64,
    pub(super) indices: SparseIndices,
    pub(super) values: SparseValues,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparseIndices {
    pub(super) buffer_view: usize,
    #[serde(default)]
    pub(super) byte_offset: u64,
    pub(super) component_type: ComponentType,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparseValues {
    pub(super) buffer_view: usize,
    #[serde(default)]
    pub(super) byte_offset: u64,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BufferView {
    pub(super) buffer: usize,
    #[serde(default)]
    pub(super) byte_offset: u64,
    pub(super) byte_length: u64,
    #[serde(default, deserialize_with = "present")]
    pub(super) byte_stride: Option<u64>,
    #[serde(default, deserialize_with = "present")]
    pub(super) target: Option<u32>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct GltfBuffer {
    #[serde(default, deserialize_with = "present")]
    pub(super) uri: Option<String>,
    pub(super) byte_length: u64,
}

/// The type of one component.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(try_from = "u64")]
pub(super) enum ComponentType {
    Byte,
    UnsignedByte,
    Short,
    UnsignedShort,
    UnsignedInt,
    Float,
}

/// The number of components of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub(super) enum ElementKind {
    Scalar,
    Vec2,
    Vec3,
    Vec4,
    Mat2,
    Mat3,
    Mat4,
}

impl TryFrom<u64> for ComponentType {
    type Error = String;

    fn try_from(number: u64) -> Result<Self, String> {
        Ok(match number {
            5120 => Self::Byte,
            5121 => Self::UnsignedByte,
            5122 => Self::Short,
            5123 => Self::UnsignedShort,
            5125 => Self::UnsignedInt,
            5126 => Self::Float,
            _ => return Err(format!("{number} is not a component type: 5120 to 5123, 5125, 5126")),
        })
    }
}

impl ComponentType {
    /// The size in bytes.
    pub(super) const fn size(self) -> u64 {
        match self {
            Self::Byte | Self::UnsignedByte => 1,
            Self::Short | Self::UnsignedShort => 2,
            Self::UnsignedInt | Self::Float => 4,
        }
    }
}

impl ElementKind {
    /// The size of an element in bytes. Columns of matrices begin at multiples of 4 bytes.
    pub(super) const fn size(self, component: ComponentType) -> u64 {
        let (columns, rows) = match self {
            Self::Scalar => (1, 1),
            Self::Vec2 => (1, 2),
            Self::Vec3 => (1, 3),
            Self::Vec4 => (1, 4),
            Self::Mat2 => (2, 2),
            Self::Mat3 => (3, 3),
            Self::Mat4 => (4, 4),
        };
        let column = rows * component.size();
        if columns == 1 { column } else { columns * column.next_multiple_of(4) }
    }
}

const fn triangles() -> u32 {
    4
}

/// Reads a value that may be absent, but not `null`.
fn present<'de, T: Deserialize<'de>, D: Deserializer<'de>>(from: D) -> Result<Option<T>, D::Error> {
    T::deserialize(from).map(Some)
}

/// Prefixes of the names of extensions that do not affect triangles: materials, textures and
/// lights.
const NO_GEOMETRY: &[&str] = &[
    "KHR_materials_",
    "KHR_texture_",
    "KHR_lights_",
    "KHR_techniques_",
    "KHR_animation_pointer",
    "KHR_xmp",
    "EXT_materials_",
    "EXT_texture_",
    "EXT_lights_",
    "MSFT_texture_",
    "ADOBE_materials_",
];

/// The extension that allows vertices of 8-bit and 16-bit integers.
const QUANTIZATION: &str = "KHR_mesh_quantization";

impl Document {
    /// Whether attributes may be 8-bit and 16-bit integers.
    pub(super) fn is_quantized(&self) -> bool {
        self.extensions_used
            .iter()
            .chain(&self.extensions_required)
            .any(|name| name == QUANTIZATION)
    }

    fn check_extensions(&self) -> Result<(), String> {
        let is_read = |name: &str| {
            name == QUANTIZATION || NO_GEOMETRY.iter().any(|start| name.starts_with(start))
        };
        match self.extensions_required.iter().enumerate().find(|(_, name)| !is_read(name)) {
            None => Ok(()),
            Some((number, name)) => {
                let what = format!("`{name}` is not supported; export the model without it");
                Err(broken(format!("extensionsRequired[{number}]"), what))
            }
        }
    }
}

/// Parses the JSON. Errors: text that is not JSON; a document of another version; a value of the
/// wrong type; an extension that would affect triangles.
pub(super) fn parse(json: &[u8]) -> Result<Document, String> {
    let json = str::from_utf8(json).map_err(|error| {
        let lines = json[..error.valid_up_to()].split(|&byte| byte == b'\n').count();
        format!("the JSON is not UTF-8 at line {lines}")
    })?;
    let mut value: Value = serde_json::from_str(json).map_err(|error| error.to_string())?;
    // Other versions have other types, so errors about types would mislead.
    check_version(&value["asset"])?;
    write_whole_numbers(&mut value);
    let document: Document = serde_path_to_error::deserialize(value)
        .map_err(|error| broken(error.path(), error.inner()))?;
    document.check_extensions()?;
    Ok(document)
}

/// Rewrites numbers such as `36.0` as `36`, because JSON has only one kind of number.
fn write_whole_numbers(value: &mut Value) {
    match value {
        Value::Number(number) => {
            let float = number.as_f64().filter(|_| number.is_f64());
            // Every whole number up to 2^53 is a float.
            let is_whole = |float: &f64| float.fract() == 0.0 && (0.0..=9e15).contains(float);
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "it is whole and small enough"
            )]
            if let Some(float) = float.filter(is_whole).filter(|float| float.is_sign_positive()) {
                *number = (float as u64).into();
            }
        }
        Value::Array(values) => values.iter_mut().for_each(write_whole_numbers),
        Value::Object(members) => members.values_mut().for_each(write_whole_numbers),
        Value::Null | Value::Bool(_) | Value::String(_) => {}
    }
}

/// Refuses documents of versions other than 2.0. Files of version 1 may have no version.
fn check_version(asset: &Value) -> Result<(), String> {
    let read = |name: &str| {
        let path = format!("asset.{name}");
        let value = &asset[name];
        let text = value.as_str();
        let text =
            text.ok_or_else(|| broken(&path, format!("{value} is not a version such as \"2.0\"")))?;
        let numbers = text.split_once('.');
        let numbers = numbers.and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
        let numbers: Option<(u32, u32)> = numbers;
        let numbers = numbers
            .ok_or_else(|| broken(&path, format!("`{text}` is not a version such as 2.0")))?;
        Ok::<_, String>((numbers, text.to_owned()))
    };
    if asset["version"].is_null() {
        return Err(broken("asset.version", "it is missing; only glTF 2.x is read"));
    }
    let (version, text) = read("version")?;
    if version.0 != 2 {
        return Err(broken("asset.version", format!("{text} is not read, only 2.x")));
    }
    if asset["minVersion"].is_null() {
        return Ok(());
    }
    match read("minVersion")? {
        ((2, 0), _) => Ok(()),
        (_, text) => {
            Err(broken("asset.minVersion", format!("{text} is needed, but 2.0 is what is read")))
        }
    }
}
