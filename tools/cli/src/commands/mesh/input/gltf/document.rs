//! The part of a glTF document that makes triangles: its JSON, and the rules for single values.
//!
//! glTF 2.0 Specification, Khronos Group: sections 3.2 (asset), 3.5 (scenes), 3.6 (binary data),
//! 3.7 (geometry); 5 has the properties. Everything else in a document is left alone.

use serde::{Deserialize, Deserializer};
use std::collections::BTreeMap;

/// A rule that a document breaks: the JSON path of the value and what is wrong with it.
pub(super) fn broken(path: impl std::fmt::Display, what: impl std::fmt::Display) -> String {
    format!("{path}: {what}")
}

/// The root object.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Document {
    asset: Asset,
    #[serde(default)]
    extensions_required: Vec<String>,
    #[serde(default, deserialize_with = "present")]
    pub(super) scene: Option<usize>,
    #[serde(default)]
    pub(super) scenes: Vec<SceneRoots>,
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

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
struct Asset {
    version: String,
    #[serde(default, deserialize_with = "present")]
    min_version: Option<String>,
}

/// Root nodes.
#[derive(Debug, Deserialize)]
pub(super) struct SceneRoots {
    #[serde(default)]
    pub(super) nodes: Vec<usize>,
}

/// A place in the scene.
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
}

#[derive(Debug, Deserialize)]
pub(super) struct Mesh {
    pub(super) primitives: Vec<Primitive>,
}

/// Triangles, if the mode is 4.
#[derive(Debug, Deserialize)]
pub(super) struct Primitive {
    pub(super) attributes: BTreeMap<String, usize>,
    #[serde(default, deserialize_with = "present")]
    pub(super) indices: Option<usize>,
    #[serde(default = "triangles")]
    pub(super) mode: u32,
}

/// Elements in a buffer view, some of them replaced.
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

/// How many components an element has.
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
    /// Size in bytes.
    pub(super) const fn size(self) -> u64 {
        match self {
            Self::Byte | Self::UnsignedByte => 1,
            Self::Short | Self::UnsignedShort => 2,
            Self::UnsignedInt | Self::Float => 4,
        }
    }
}

impl ElementKind {
    /// Size of an element in bytes. Columns of matrices begin at multiples of 4 bytes.
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

/// A value that may be absent but not `null`.
fn present<'de, T: Deserialize<'de>, D: Deserializer<'de>>(from: D) -> Result<Option<T>, D::Error> {
    T::deserialize(from).map(Some)
}

/// Reads the JSON. Errors: text that is not JSON, a value of the wrong type, a document for other readers than this.
pub(super) fn parse(json: &[u8]) -> Result<Document, String> {
    // The parser would not look at strings that nobody asks for.
    let json = str::from_utf8(json).map_err(|error| {
        let lines = json[..error.valid_up_to()].split(|&byte| byte == b'\n').count();
        format!("the JSON is not UTF-8 at line {lines}")
    })?;
    let mut text = serde_json::Deserializer::from_str(json);
    let document: Document = serde_path_to_error::deserialize(&mut text)
        .map_err(|error| broken(error.path(), error.inner()))?;
    text.end().map_err(|error| error.to_string())?;
    check_version(&document.asset)?;
    if let Some(name) = document.extensions_required.first() {
        let what = format!("`{name}` is not supported; export the model without it");
        return Err(broken("extensionsRequired[0]", what));
    }
    Ok(document)
}

fn check_version(asset: &Asset) -> Result<(), String> {
    let read = |path: &str, text: &str| {
        let numbers = text.split_once('.');
        let numbers = numbers.and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
        let numbers: Option<(u32, u32)> = numbers;
        numbers.ok_or_else(|| broken(path, format!("`{text}` is not a version such as 2.0")))
    };
    let version = read("asset.version", &asset.version)?;
    if version.0 != 2 {
        return Err(broken("asset.version", format!("{} is not read, only 2.x", asset.version)));
    }
    let Some(text) = &asset.min_version else { return Ok(()) };
    match read("asset.minVersion", text)? {
        (2, 0) => Ok(()),
        _ => Err(broken("asset.minVersion", format!("{text} is needed, but 2.0 is what is read"))),
    }
}
