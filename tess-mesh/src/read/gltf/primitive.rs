//! Primitives: the triangles of a mesh in its pose, and the further values at their vertices.

use super::accessor::{Data, is_index};
use super::document::{Accessor, ComponentType, ElementKind, Primitive, broken};
use super::pose::{Matrices, Pose, moved_normal};
use crate::budget::{FACE, VERTEX};
use crate::parts::{Channel, ChannelKind};
use crate::repair::tally::Tally;
use glam::{Mat3, Vec2, Vec3};
use tess_surface::{Face, PolygonMesh, Sides};

/// How vertices form triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Triangles {
    List,
    Strip,
    Fan,
}

/// A primitive with its place and pose.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedPrimitive<'a, 'd> {
    pub(crate) data: &'a Data<'d>,
    pub(crate) primitive: &'a Primitive,
    /// Its JSON path.
    pub(crate) path: &'a str,
    pub(crate) pose: &'a Pose,
    /// Whether the surface has normals.
    pub(crate) uses_normals: bool,
}

/// What the primitives of a scene are appended to.
#[derive(Debug, Default)]
pub(crate) struct Appended {
    pub(crate) mesh: PolygonMesh,
    pub(crate) channels: Vec<Channel>,
    pub(crate) skipped: Skipped,
}

/// Counts of primitives that are left out, wholly or in part.
#[derive(Debug, Default)]
pub(crate) struct Skipped {
    /// Primitives of points or lines.
    pub(crate) lines: Tally,
    /// Primitives without positions.
    pub(crate) unplaced: Tally,
    /// Primitives with indices after the last whole triangle.
    pub(crate) rest: Tally,
    /// Attributes that cannot be read, and that the surface does not need.
    pub(crate) attributes: Tally,
}

impl PlacedPrimitive<'_, '_> {
    /// Appends the triangles, and returns the numbers of the channels that the vertices have;
    /// `None` if there are none. Errors: a broken rule, with the JSON path.
    pub(crate) fn append(&self, to: &mut Appended) -> Result<Option<Vec<usize>>, String> {
        let Self { data, primitive, path, pose, .. } = *self;
        let Some(triangles) = self.mode()? else {
            to.skipped.lines.add(|| path.to_owned());
            return Ok(None);
        };
        if self.attribute("POSITION").is_none() {
            to.skipped.unplaced.add(|| path.to_owned());
            return Ok(None);
        }
        self.refuse_compressed()?;
        let count = self.check_attributes()?;
        let charged = data.budget.charge(count as u64, VERTEX, "vertices");
        charged.map_err(|what| broken(path, what))?;
        let indices = self.indices(triangles, count, &mut to.skipped)?;
        if indices.is_empty() {
            return Ok(None);
        }
        let below = |what| format!("{path}.{what}");
        let matrices = pose.matrices(data, &primitive.attributes).map_err(below)?;
        let mesh = &mut to.mesh;
        let first = [mesh.positions.len(), mesh.normals.len(), mesh.texcoords.len()];
        for (vertex, position) in self.vectors("POSITION")?.into_iter().enumerate() {
            mesh.positions.push(matrices.of(vertex).transform_point3(position));
        }
        let has_normals = self.uses_normals && self.attribute("NORMAL").is_some();
        if has_normals {
            for (vertex, normal) in self.vectors("NORMAL")?.into_iter().enumerate() {
                mesh.normals.push(moved_normal(matrices.of(vertex), normal));
            }
        }
        let texcoords = self.optional("TEXCOORD_0", count, &mut to.skipped);
        let texcoords = texcoords.map(|number| data.numbers::<2>(number)).transpose()?;
        if let Some(texcoords) = &texcoords {
            // glTF has (0, 0) at the upper left of the image.
            mesh.texcoords.extend(texcoords.iter().map(|[u, v]| Vec2::new(*u, 1.0 - v)));
        }
        let form = FaceForm { first, has_normals, has_texcoords: texcoords.is_some() };
        mesh.faces.extend(indices.into_iter().map(|corners| form.face(corners, &matrices)));
        self.append_channels(to, first[0], count, &matrices).map(Some)
    }

    /// Appends the further values of the vertices, of which the first is position `first`.
    fn append_channels(
        &self,
        to: &mut Appended,
        first: usize,
        count: usize,
        matrices: &Matrices<'_>,
    ) -> Result<Vec<usize>, String> {
        let mut present = Vec::new();
        for name in self.primitive.attributes.keys() {
            let Some(kind) = channel_kind(name) else { continue };
            let Some(number) = self.optional(name, count, &mut to.skipped) else { continue };
            let mut values = self.values(kind, number)?;
            if !values.iter().flatten().all(|value| value.is_finite()) {
                to.skipped.attributes.add(|| format!("{}.attributes.{name}", self.path));
                continue;
            }
            if kind == ChannelKind::Tangent {
                for (vertex, tangent) in values.iter_mut().enumerate() {
                    let linear = Mat3::from_mat4(matrices.of(vertex));
                    let [x, y, z, side] = *tangent;
                    let moved = (linear * Vec3::new(x, y, z)).normalize_or(Vec3::X);
                    let side = if linear.determinant() < 0.0 { -side } else { side };
                    *tangent = moved.extend(side).to_array();
                }
            }
            let at = to.channels.iter().position(|channel| channel.kind == kind);
            let at = at.unwrap_or_else(|| {
                to.channels.push(Channel { kind, values: Vec::new() });
                to.channels.len() - 1
            });
            let channel = &mut to.channels[at];
            let more = (first + count - channel.values.len()) as u64;
            let charged = self.data.budget.charge(more, 16, "values of attributes");
            charged.map_err(|what| broken(format!("{}.attributes.{name}", self.path), what))?;
            channel.values.resize(first, kind.default_value());
            channel.values.extend(values);
            present.push(at);
        }
        Ok(present)
    }

    /// The values of an attribute with up to four components.
    fn values(&self, kind: ChannelKind, number: usize) -> Result<Vec<[f32; 4]>, String> {
        let data = self.data;
        let accessor = data.accessor(number, self.path)?;
        Ok(match (kind, accessor.kind) {
            (ChannelKind::Texcoord(_), _) => {
                data.numbers::<2>(number)?.into_iter().map(|[u, v]| [u, v, 0.0, 0.0]).collect()
            }
            (_, ElementKind::Vec3) => {
                data.numbers::<3>(number)?.into_iter().map(|[r, g, b]| [r, g, b, 1.0]).collect()
            }
            _ => data.numbers::<4>(number)?,
        })
    }

    /// The accessor of an attribute that the surface does not need. One that cannot be read is
    /// counted, and is then missing.
    fn optional(&self, name: &str, count: usize, skipped: &mut Skipped) -> Option<usize> {
        let number = self.attribute(name)?;
        let path = format!("{}.attributes.{name}", self.path);
        let accessor = self.data.accessor(number, &path).ok();
        let is_right = accessor.is_some_and(|accessor| {
            accessor.count == count as u64 && self.check_type(name, accessor).is_ok()
        });
        if !is_right {
            skipped.attributes.add(|| path);
        }
        is_right.then_some(number)
    }

    /// How vertices form triangles; `None` for points and lines.
    fn mode(&self) -> Result<Option<Triangles>, String> {
        match self.primitive.mode {
            0..=3 => Ok(None),
            4 => Ok(Some(Triangles::List)),
            5 => Ok(Some(Triangles::Strip)),
            6 => Ok(Some(Triangles::Fan)),
            mode => {
                Err(broken(format!("{}.mode", self.path), format!("{mode} is not a mode: 0 to 6")))
            }
        }
    }

    /// Refuses a primitive whose data exists only in compressed form.
    fn refuse_compressed(&self) -> Result<(), String> {
        const DRACO: &str = "KHR_draco_mesh_compression";
        let accessors = &self.data.document.accessors;
        let is_missing = |number: usize| {
            let accessor = accessors.get(number, "");
            accessor.is_ok_and(|a| a.buffer_view.is_none() && a.sparse.is_none())
        };
        let mut numbers = self.primitive.attributes.values().chain(&self.primitive.indices);
        let is_compressed = self.primitive.extensions.contains_key(DRACO);
        if is_compressed && numbers.any(|&number| is_missing(number)) {
            let what =
                "it is compressed with Draco, which is not decoded; export the model without it";
            return Err(broken(format!("{}.extensions.{DRACO}", self.path), what));
        }
        Ok(())
    }

    /// The vectors of an attribute with its morph targets applied; empty if there is no such
    /// attribute.
    fn vectors(&self, name: &str) -> Result<Vec<Vec3>, String> {
        let Some(number) = self.attribute(name) else { return Ok(Vec::new()) };
        let numbers = self.data.numbers::<3>(number)?;
        let mut vectors: Vec<Vec3> = numbers.into_iter().map(Vec3::from_array).collect();
        let morphed = self.pose.morph(self.data, &self.primitive.targets, name, &mut vectors);
        morphed.map_err(|what| format!("{}.{what}", self.path))?;
        Ok(vectors)
    }

    fn attribute(&self, name: &str) -> Option<usize> {
        self.primitive.attributes.get(name).copied()
    }

    /// Checks the attributes that the surface needs, and returns the number of vertices.
    fn check_attributes(&self) -> Result<usize, String> {
        let path = format!("{}.attributes", self.path);
        let count = self.checked("POSITION", None)?;
        let is_moved = self.pose.has_joints();
        for name in self.primitive.attributes.keys() {
            let is_joint = name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
            if is_moved && is_joint || self.uses_normals && name == "NORMAL" {
                self.checked(name, Some(count))?;
            } else if !is_semantic(name) {
                self.data.document.irregular(|| format!("{path}.{name}"));
            }
        }
        usize::try_from(count).map_err(|_| broken(path, "too many vertices"))
    }

    /// Checks an attribute, and returns the number of its elements.
    fn checked(&self, name: &str, wanted: Option<u64>) -> Result<u64, String> {
        let path = format!("{}.attributes.{name}", self.path);
        let number = self.attribute(name).ok_or_else(|| broken(&path, "it is missing"))?;
        let accessor = self.data.accessor(number, &path)?;
        let checked = self.check_type(name, accessor);
        checked.map_err(|what| broken(&path, format!("accessors[{number}] {what}")))?;
        match wanted {
            Some(wanted) if wanted != accessor.count => {
                let what = format!("its count is not that of POSITION, {wanted}");
                Err(broken(path, what))
            }
            _ => Ok(accessor.count),
        }
    }

    fn check_type(&self, name: &str, accessor: &Accessor) -> Result<(), String> {
        use ComponentType::{Byte, Float, Short, UnsignedByte, UnsignedShort};
        let (kind, component) = (accessor.kind, accessor.component_type);
        let is_small = matches!(component, Byte | UnsignedByte | Short | UnsignedShort);
        let is_quantized = is_small && self.data.document.is_quantized();
        let is_fraction = matches!(component, UnsignedByte | UnsignedShort) && accessor.normalized;
        let (wanted, is_component, rule) = match name {
            "POSITION" | "NORMAL" => (ElementKind::Vec3, is_quantized, "VEC3 of Float"),
            _ if name.starts_with("TEXCOORD_") => (
                ElementKind::Vec2,
                is_quantized || is_fraction,
                "VEC2 of Float, or of normalized UnsignedByte or UnsignedShort",
            ),
            "TANGENT" => (ElementKind::Vec4, is_quantized, "VEC4 of Float"),
            _ if name.starts_with("COLOR_") && kind == ElementKind::Vec3 => {
                (ElementKind::Vec3, is_fraction, "VEC3 or VEC4 of Float, or of normalized integers")
            }
            _ if name.starts_with("COLOR_") => {
                (ElementKind::Vec4, is_fraction, "VEC3 or VEC4 of Float, or of normalized integers")
            }
            _ if name.starts_with("JOINTS_") => (
                ElementKind::Vec4,
                matches!(component, UnsignedByte | UnsignedShort) && !accessor.normalized,
                "VEC4 of UnsignedByte or UnsignedShort",
            ),
            _ if name.starts_with("WEIGHTS_") => (
                ElementKind::Vec4,
                is_fraction,
                "VEC4 of Float, or of normalized UnsignedByte or UnsignedShort",
            ),
            _ => return Ok(()),
        };
        let is_float = component == Float && !name.starts_with("JOINTS_");
        if kind != wanted || !(is_float || is_component) {
            return Err(format!("is {kind:?} of {component:?}; it must be {rule}"));
        }
        Ok(())
    }

    /// The three indices of each triangle, each less than `count`.
    fn indices(
        &self,
        triangles: Triangles,
        count: usize,
        skipped: &mut Skipped,
    ) -> Result<Vec<[u32; 3]>, String> {
        let path = match self.primitive.indices {
            Some(_) => format!("{}.indices", self.path),
            None => self.path.to_owned(),
        };
        let length = match self.primitive.indices {
            Some(number) => self.check_indices(number, &path)?,
            None => count,
        };
        let whole = triangles.count(length);
        let charged = self.data.budget.charge(whole as u64, FACE, "triangles");
        charged.map_err(|what| broken(&path, what))?;
        if triangles == Triangles::List && !length.is_multiple_of(3) || whole == 0 {
            skipped.rest.add(|| self.path.to_owned());
        }
        let vertices = match self.primitive.indices {
            Some(number) => self
                .vertices(number, count)
                .map_err(|what| broken(path, format!("accessors[{number}] {what}")))?,
            None => (0..u32::try_from(count).unwrap_or(u32::MAX)).collect(),
        };
        Ok((0..whole).map(|k| triangles.corners(k).map(|at| vertices[at])).collect())
    }

    /// The number of indices. Errors: an accessor that cannot hold indices.
    fn check_indices(&self, number: usize, path: &str) -> Result<usize, String> {
        let accessor = self.data.accessor(number, path)?;
        let (kind, component) = (accessor.kind, accessor.component_type);
        if kind != ElementKind::Scalar || !is_index(component) || accessor.normalized {
            return Err(broken(
                path,
                format!(
                    "accessors[{number}] is {kind:?} of {component:?}; it must be SCALAR of \
                     unsigned integers"
                ),
            ));
        }
        Ok(usize::try_from(accessor.count).unwrap_or(usize::MAX))
    }

    /// The vertices that the indices refer to, each less than `count`.
    fn vertices(&self, number: usize, count: usize) -> Result<Vec<u32>, String> {
        let component = self.data.accessor(number, self.path)?.component_type;
        let indices = self.data.integers::<1>(number)?.into_flattened();
        // The largest value of a type restarts strips, so it is not an index.
        let restart = u32::MAX >> (32 - 8 * component.size());
        match indices.iter().position(|&index| index as usize >= count || index == restart) {
            None => Ok(indices),
            Some(at) => {
                let index = indices[at];
                Err(format!("index {index} at {at} is out of range: there are {count} vertices"))
            }
        }
    }
}

/// The kind of a further value of vertices.
fn channel_kind(name: &str) -> Option<ChannelKind> {
    let set = |start: &str| name.strip_prefix(start).and_then(|set| set.parse::<u32>().ok());
    match name {
        "TANGENT" => Some(ChannelKind::Tangent),
        "TEXCOORD_0" => None,
        _ => set("TEXCOORD_")
            .map(ChannelKind::Texcoord)
            .or_else(|| set("COLOR_").map(ChannelKind::Color)),
    }
}

/// The form of a primitive's faces.
struct FaceForm {
    /// The numbers of the primitive's first position, normal and texture coordinates.
    first: [usize; 3],
    has_normals: bool,
    has_texcoords: bool,
}

impl FaceForm {
    fn face(&self, [a, b, c]: [u32; 3], matrices: &Matrices<'_>) -> Face {
        let corners = if matrices.is_mirrored(a as usize) { [a, c, b] } else { [a, b, c] };
        let numbers = |first: usize| {
            let first = u32::try_from(first).unwrap_or(u32::MAX);
            Sides::Triangle(corners.map(|index| index.saturating_add(first)))
        };
        Face {
            positions: numbers(self.first[0]),
            normals: self.has_normals.then(|| numbers(self.first[1])),
            texcoords: self.has_texcoords.then(|| numbers(self.first[2])),
        }
    }
}

impl Triangles {
    /// The number of triangles that this many vertices form.
    const fn count(self, vertices: usize) -> usize {
        match self {
            Self::List => vertices / 3,
            Self::Strip | Self::Fan => vertices.saturating_sub(2),
        }
    }

    /// The positions of a triangle's corners among the vertices. Every second triangle of a strip
    /// is reversed.
    const fn corners(self, triangle: usize) -> [usize; 3] {
        let k = triangle;
        match self {
            Self::List => [3 * k, 3 * k + 1, 3 * k + 2],
            Self::Strip => [k, k + 1 + k % 2, k + 2 - k % 2],
            Self::Fan => [k + 1, k + 2, 0],
        }
    }
}

/// Whether a name is known (section 3.7.2.1). Names of applications begin with an underscore.
fn is_semantic(name: &str) -> bool {
    let numbered = ["TEXCOORD_", "COLOR_", "JOINTS_", "WEIGHTS_"];
    let set = numbered.iter().find_map(|start| name.strip_prefix(start));
    matches!(name, "POSITION" | "NORMAL" | "TANGENT")
        || name.starts_with('_')
        || set.is_some_and(|set| set.parse::<u32>().is_ok())
}
