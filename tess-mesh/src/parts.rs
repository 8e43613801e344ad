//! What a file says about its faces besides their surface: names, materials and further values at
//! the corners.

use serde_json::{Map, Value};

/// Faces that have one name, one material and the same kinds of values at their corners.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Part {
    /// The number of the node or object that it belongs to, counted from 0 in the order of the
    /// file.
    pub node: usize,
    /// The name of the node, or of the object (`o`).
    pub object: Option<String>,
    /// The name of the mesh, or of the groups (`g`).
    pub group: Option<String>,
    /// The number of its material in [`Materials::names`].
    pub material: Option<usize>,
    /// Whether its faces have texture coordinates.
    pub has_texcoords: bool,
    /// The numbers of its further values in [`Parts::channels`].
    pub channels: Vec<usize>,
}

/// The kind of the values of a [`Channel`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum ChannelKind {
    /// A direction along the surface, of length 1, and the side of the bitangent: 1 or -1.
    Tangent,
    /// A further pair of texture coordinates, with its number from 1, as in glTF: (0, 0) is the
    /// upper left corner of an image. The last two numbers are 0.
    Texcoord(u32),
    /// A colour, with its number from 0: red, green, blue and opacity, linear and within 0 and 1.
    Color(u32),
}

/// Values at the vertices of a mesh, one for each position.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Their kind.
    pub kind: ChannelKind,
    /// One for each position; values of vertices that have none are the kind's default.
    pub values: Vec<[f32; 4]>,
}

impl ChannelKind {
    /// The value of vertices that have none.
    pub(crate) const fn default_value(self) -> [f32; 4] {
        match self {
            Self::Tangent => [1.0, 0.0, 0.0, 1.0],
            Self::Texcoord(_) => [0.0; 4],
            Self::Color(_) => [1.0; 4],
        }
    }

    /// The name of the attribute in glTF.
    pub(crate) fn attribute(self) -> String {
        match self {
            Self::Tangent => "TANGENT".to_owned(),
            Self::Texcoord(set) => format!("TEXCOORD_{set}"),
            Self::Color(set) => format!("COLOR_{set}"),
        }
    }

    /// The number of components in files.
    pub(crate) const fn components(self) -> usize {
        match self {
            Self::Texcoord(_) => 2,
            Self::Tangent | Self::Color(_) => 4,
        }
    }
}

impl Channel {
    /// Adds the value between those of two positions.
    pub(crate) fn push_between(&mut self, a: usize, b: usize, t: f32) {
        let (a, b) = (self.values[a], self.values[b]);
        self.values.push(std::array::from_fn(|k| a[k] + (b[k] - a[k]) * t));
    }
}

/// The materials of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Materials {
    /// The name of each, if it has one.
    pub names: Vec<Option<String>>,
    /// The material libraries of an OBJ file (`mtllib`), as the file names them.
    pub libraries: Vec<String>,
    /// The members of a glTF document that describe materials: `materials`, `textures`, `samplers`
    /// and `images`, and the names of the extensions that these use. Those of an OBJ file come from
    /// its material libraries: base colours, opacity and their images, which are not embedded.
    pub document: Map<String, Value>,
    /// The contents of images that are in the file's buffers, by their number in `images`.
    pub images: Vec<(usize, Vec<u8>)>,
    /// Notes on what glTF does not get of the material libraries.
    pub losses: Vec<String>,
}

/// The parts of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parts {
    /// The parts.
    pub list: Vec<Part>,
    /// The part of each patch; empty if there is only one part.
    pub of_patch: Vec<u32>,
    /// Further values at the corners of polygons.
    pub channels: Vec<Channel>,
    /// The materials.
    pub materials: Materials,
}

impl Parts {
    /// The number of a patch's part.
    #[must_use]
    pub fn of(&self, patch: usize) -> usize {
        self.of_patch.get(patch).map_or(0, |&part| part as usize)
    }
}
