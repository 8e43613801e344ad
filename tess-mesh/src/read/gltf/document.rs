//! The part of a glTF document that affects triangles: its JSON, and the rules for single values.
//!
//! The source is the glTF 2.0 Specification of the Khronos Group: sections 3.2 (asset), 3.5
//! (scenes), 3.6 (binary data) and 3.7 (geometry); section 5 has the properties. An object is
//! checked when something that is shown needs it. Everything else in a document may be anything.

use crate::budget::Budget;
use crate::repair::tally::Tally;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer};
use serde_json::Value;
use std::cell::{OnceCell, RefCell};
use std::collections::BTreeMap;

/// The message for a rule that a document breaks: the JSON path of the value, and its fault.
pub(crate) fn broken(path: impl std::fmt::Display, what: impl std::fmt::Display) -> String {
    format!("{path}: {what}")
}

/// The message about an index into one of the document's lists.
pub(crate) fn out_of_range(index: usize, count: usize, what: &str) -> String {
    format!("{index} is out of range: there are {count} {what}")
}

/// One of the root object's lists, whose objects are parsed when they are needed.
#[derive(Debug)]
pub(crate) struct List<T> {
    name: &'static str,
    values: Vec<Value>,
    parsed: Vec<OnceCell<Result<T, String>>>,
}

impl<T: DeserializeOwned> List<T> {
    /// Takes the list out of the root object. Errors: it is there, but not a list.
    fn take(root: &mut Value, name: &'static str) -> Result<Self, String> {
        let values = match root.get_mut(name).map(Value::take) {
            None => Vec::new(),
            Some(Value::Array(values)) => values,
            Some(_) => return Err(broken(name, "it must be a list")),
        };
        let parsed = values.iter().map(|_| OnceCell::new()).collect();
        Ok(Self { name, values, parsed })
    }

    pub(crate) const fn len(&self) -> usize {
        self.values.len()
    }

    /// The object of this number, to which the value at `path` refers. Errors: there is none, with
    /// that path; it is malformed, with its own path.
    pub(crate) fn get(&self, number: usize, path: impl std::fmt::Display) -> Result<&T, String> {
        let Some(parsed) = self.parsed.get(number) else {
            let noun = if self.name == "bufferViews" { "buffer views" } else { self.name };
            return Err(broken(path, out_of_range(number, self.len(), noun)));
        };
        let parse = || {
            serde_path_to_error::deserialize(&self.values[number]).map_err(|error| {
                let path = error.path().to_string();
                let below = if path == "." { String::new() } else { format!(".{path}") };
                broken(format!("{}[{number}]{below}", self.name), error.inner())
            })
        };
        parsed.get_or_init(parse).as_ref().map_err(Clone::clone)
    }

    /// The objects as JSON.
    pub(crate) fn values(&self) -> &[Value] {
        &self.values
    }
}

/// The root object.
#[derive(Debug)]
pub(crate) struct Document {
    extensions_required: Vec<String>,
    extensions_used: Vec<String>,
    pub(crate) scene: Option<usize>,
    pub(crate) scenes: List<SceneRoots>,
    pub(crate) skins: List<Skin>,
    pub(crate) animations: usize,
    pub(crate) nodes: List<Node>,
    pub(crate) meshes: List<Mesh>,
    pub(crate) accessors: List<Accessor>,
    pub(crate) buffer_views: List<BufferView>,
    pub(crate) buffers: List<GltfBuffer>,
    /// What describes materials.
    pub(crate) materials: MaterialLists,
    /// Places that break a rule which nothing that is shown needs.
    pub(crate) irregular: RefCell<Tally>,
}

/// The lists that describe materials, as JSON.
#[derive(Debug, Default)]
pub(crate) struct MaterialLists {
    pub(crate) materials: Vec<Value>,
    pub(crate) textures: Vec<Value>,
    pub(crate) samplers: Vec<Value>,
    pub(crate) images: Vec<Value>,
}

/// The names in the root object's lists of extensions.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
struct Extensions {
    #[serde(default)]
    extensions_required: Vec<String>,
    #[serde(default)]
    extensions_used: Vec<String>,
    #[serde(default, deserialize_with = "present")]
    scene: Option<usize>,
}

/// The root nodes of a scene.
#[derive(Debug, Deserialize)]
pub(crate) struct SceneRoots {
    #[serde(default)]
    pub(crate) nodes: Vec<usize>,
}

/// A node: a place in the scene.
#[derive(Debug, Default, Deserialize)]
pub(crate) struct Node {
    /// A name of another type than text is none.
    #[serde(default)]
    name: Value,
    #[serde(default)]
    pub(crate) children: Vec<usize>,
    #[serde(default, deserialize_with = "present")]
    pub(crate) mesh: Option<usize>,
    #[serde(default, deserialize_with = "present")]
    pub(crate) matrix: Option<[f32; 16]>,
    #[serde(default, deserialize_with = "present")]
    pub(crate) translation: Option<[f32; 3]>,
    #[serde(default, deserialize_with = "present")]
    pub(crate) rotation: Option<[f32; 4]>,
    #[serde(default, deserialize_with = "present")]
    pub(crate) scale: Option<[f32; 3]>,
    #[serde(default, deserialize_with = "present")]
    pub(crate) skin: Option<usize>,
    /// The weights of morph targets; they replace the mesh's.
    #[serde(default, deserialize_with = "present")]
    pub(crate) weights: Option<Vec<f32>>,
    #[serde(default)]
    pub(crate) extensions: BTreeMap<String, Value>,
}

/// A skin: joints that move the vertices of a mesh.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Skin {
    /// An accessor with one matrix per joint.
    #[serde(default, deserialize_with = "present")]
    pub(crate) inverse_bind_matrices: Option<usize>,
    /// The nodes that are joints.
    pub(crate) joints: Vec<usize>,
}

#[derive(Debug, Deserialize)]
pub(crate) struct Mesh {
    #[serde(default)]
    name: Value,
    pub(crate) primitives: Vec<Primitive>,
    /// The weights of morph targets.
    #[serde(default, deserialize_with = "present")]
    pub(crate) weights: Option<Vec<f32>>,
}

/// Attributes: accessors by name.
pub(crate) type Attributes = BTreeMap<String, usize>;

/// Triangles, lines or points.
#[derive(Debug, Deserialize)]
pub(crate) struct Primitive {
    pub(crate) attributes: Attributes,
    #[serde(default, deserialize_with = "present")]
    pub(crate) indices: Option<usize>,
    #[serde(default = "triangles")]
    pub(crate) mode: u32,
    #[serde(default)]
    material: Value,
    /// The morph targets, which are scaled by their weights.
    #[serde(default)]
    pub(crate) targets: Vec<Attributes>,
    #[serde(default)]
    pub(crate) extensions: BTreeMap<String, Value>,
}

/// An accessor: elements in a buffer view, some of which may be replaced.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Accessor {
    #[serde(default, deserialize_with = "present")]
    pub(crate) buffer_view: Option<usize>,
    #[serde(default, deserialize_with = "present")]
    pub(crate) byte_offset: Option<u64>,
    pub(crate) component_type: ComponentType,
    #[serde(default)]
    pub(crate) normalized: bool,
    pub(crate) count: u64,
    #[serde(rename = "type")]
    pub(crate) kind: ElementKind,
    #[serde(default, deserialize_with = "present")]
    pub(crate) sparse: Option<Sparse>,
}

#[derive(Debug, Deserialize)]
pub(crate) struct Sparse {
    pub(crate) count: u64,
    pub(crate) indices: SparseIndices,
    pub(crate) values: SparseValues,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct SparseIndices {
    pub(crate) buffer_view: usize,
    #[serde(default)]
    pub(crate) byte_offset: u64,
    pub(crate) component_type: ComponentType,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct SparseValues {
    pub(crate) buffer_view: usize,
    #[serde(default)]
    pub(crate) byte_offset: u64,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct BufferView {
    pub(crate) buffer: usize,
    #[serde(default)]
    pub(crate) byte_offset: u64,
    pub(crate) byte_length: u64,
    #[serde(default, deserialize_with = "present")]
    pub(crate) byte_stride: Option<u64>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct GltfBuffer {
    #[serde(default, deserialize_with = "present")]
    pub(crate) uri: Option<String>,
    pub(crate) byte_length: u64,
}

/// The type of one component.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(try_from = "u64")]
pub(crate) enum ComponentType {
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
pub(crate) enum ElementKind {
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
    pub(crate) const fn size(self) -> u64 {
        match self {
            Self::Byte | Self::UnsignedByte => 1,
            Self::Short | Self::UnsignedShort => 2,
            Self::UnsignedInt | Self::Float => 4,
        }
    }
}

impl ElementKind {
    /// The size of an element in bytes. Columns of matrices begin at multiples of 4 bytes.
    pub(crate) const fn size(self, component: ComponentType) -> u64 {
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

impl Node {
    pub(crate) fn name(&self) -> Option<String> {
        self.name.as_str().map(str::to_owned)
    }

    /// Whether `KHR_node_visibility` hides the node and all below it.
    pub(crate) fn is_hidden(&self) -> bool {
        let visibility = self.extensions.get("KHR_node_visibility");
        visibility.is_some_and(|extension| extension["visible"] == Value::Bool(false))
    }
}

impl Mesh {
    pub(crate) fn name(&self) -> Option<String> {
        self.name.as_str().map(str::to_owned)
    }
}

impl Primitive {
    /// The number of the material.
    pub(crate) fn material(&self) -> Option<usize> {
        self.material.as_u64().and_then(|number| usize::try_from(number).ok())
    }
}

/// Prefixes of the names of extensions that do not affect triangles, and of those that are read.
const READ: &[&str] = &[
    "KHR_materials_",
    "KHR_texture_",
    "KHR_lights_",
    "KHR_techniques_",
    "KHR_animation_pointer",
    "KHR_node_",
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
    pub(crate) fn is_quantized(&self) -> bool {
        self.extensions_used
            .iter()
            .chain(&self.extensions_required)
            .any(|name| name == QUANTIZATION)
    }

    /// Whether an extension is required.
    pub(crate) fn requires(&self, name: &str) -> bool {
        self.extensions_required.iter().any(|required| required == name)
    }

    /// Counts a place that breaks a rule which nothing that is shown needs.
    pub(crate) fn irregular(&self, place: impl FnOnce() -> String) {
        self.irregular.borrow_mut().add(place);
    }

    fn check_extensions(&self) -> Result<(), String> {
        let is_read =
            |name: &str| name == QUANTIZATION || READ.iter().any(|start| name.starts_with(start));
        match self.extensions_required.iter().enumerate().find(|(_, name)| !is_read(name)) {
            None => Ok(()),
            Some((number, name)) => {
                let what = format!("`{name}` is not supported; export the model without it");
                Err(broken(format!("extensionsRequired[{number}]"), what))
            }
        }
    }
}

/// The bytes charged for a value of the JSON.
const VALUE: u64 = 72;

/// Parses the JSON. Errors: text that is not JSON; a document of another version; a list that is
/// none; an extension that would affect triangles.
pub(crate) fn parse(json: &[u8], budget: &Budget) -> Result<Document, String> {
    let json = json.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(json);
    let json = str::from_utf8(json).map_err(|error| {
        let lines = json[..error.valid_up_to()].split(|&byte| byte == b'\n').count();
        format!("the JSON is not UTF-8 at line {lines}")
    })?;
    let values = json.bytes().filter(|byte| matches!(byte, b',' | b':' | b'[' | b'{')).count();
    budget.charge(json.len() as u64, 1, "bytes of JSON")?;
    budget.charge(values as u64, VALUE, "values").map_err(|what| broken("asset", what))?;
    let mut root: Value = serde_json::from_str(json).map_err(|error| error.to_string())?;
    // Other versions have other types, so errors about types would mislead.
    check_version(&root["asset"])?;
    write_whole_numbers(&mut root);
    let (mut names, mut lists) = (serde_json::Map::new(), root);
    for name in ["extensionsRequired", "extensionsUsed", "scene"] {
        if let Some(value) = lists.get_mut(name) {
            names.insert(name.to_owned(), value.take());
        }
    }
    let names: Extensions = serde_path_to_error::deserialize(Value::Object(names))
        .map_err(|error| broken(error.path(), error.inner()))?;
    let mut plain = |name: &str| match lists.get_mut(name).map(Value::take) {
        Some(Value::Array(values)) => values,
        _ => Vec::new(),
    };
    let materials = MaterialLists {
        materials: plain("materials"),
        textures: plain("textures"),
        samplers: plain("samplers"),
        images: plain("images"),
    };
    let document = Document {
        extensions_required: names.extensions_required,
        extensions_used: names.extensions_used,
        scene: names.scene,
        animations: plain("animations").len(),
        materials,
        scenes: List::take(&mut lists, "scenes")?,
        skins: List::take(&mut lists, "skins")?,
        nodes: List::take(&mut lists, "nodes")?,
        meshes: List::take(&mut lists, "meshes")?,
        accessors: List::take(&mut lists, "accessors")?,
        buffer_views: List::take(&mut lists, "bufferViews")?,
        buffers: List::take(&mut lists, "buffers")?,
        irregular: RefCell::default(),
    };
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
        // Files have versions such as 1.0.1.
        let mut parts = text.split('.').map(|part| part.parse().ok());
        let numbers = parts.next().flatten().zip(parts.next().flatten());
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
        let more = match version.0 {
            1 => ": it is glTF 1; convert the file, or export the model as glTF 2",
            _ => "",
        };
        return Err(broken("asset.version", format!("{text} is not read, only 2.x{more}")));
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
