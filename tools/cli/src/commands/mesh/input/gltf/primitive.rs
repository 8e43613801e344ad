//! Primitives: the triangles of a mesh in its pose.

use super::super::tally::Tally;
use super::accessor::{Data, is_index};
use super::document::{Accessor, Attributes, ComponentType, ElementKind, Primitive, broken};
use super::pose::{Matrices, Pose, moved_normal};
use super::scene::out_of_range;
use glam::{Vec2, Vec3};
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
pub(super) struct PlacedPrimitive<'a> {
    pub(super) data: &'a Data<'a>,
    pub(super) primitive: &'a Primitive,
    /// Its JSON path.
    pub(super) path: &'a str,
    pub(super) pose: &'a Pose,
}

/// Counts of primitives that are left out, wholly or in part.
#[derive(Debug, Default)]
pub(super) struct Skipped {
    /// Primitives of points or lines.
    pub(super) lines: Tally,
    /// Primitives without positions.
    pub(super) unplaced: Tally,
    /// Primitives with indices after the last whole triangle.
    pub(super) rest: Tally,
}

impl PlacedPrimitive<'_> {
    /// Appends the triangles, unless there would be more than `most` vertices or faces. Errors: a
    /// broken rule, with the JSON path.
    pub(super) fn append(
        &self,
        mesh: &mut PolygonMesh,
        skipped: &mut Skipped,
        most: usize,
    ) -> Result<(), String> {
        let Self { data, primitive, path, pose } = *self;
        let Some(triangles) = self.mode()? else {
            skipped.lines.add(|| path.to_owned());
            return Ok(());
        };
        if self.attribute("POSITION").is_none() {
            skipped.unplaced.add(|| path.to_owned());
            return Ok(());
        }
        self.refuse_compressed()?;
        let count = self.check_attributes()?;
        room(mesh.positions.len(), count, most).map_err(|what| broken(path, what))?;
        let indices = self.indices(triangles, count, mesh.faces.len(), most, skipped)?;
        let below = |what| format!("{path}.{what}");
        let matrices = pose.matrices(data, &primitive.attributes).map_err(below)?;
        let first = [mesh.positions.len(), mesh.normals.len(), mesh.texcoords.len()];
        for (vertex, position) in self.vectors("POSITION")?.into_iter().enumerate() {
            mesh.positions.push(matrices.of(vertex).transform_point3(position));
        }
        for (vertex, normal) in self.vectors("NORMAL")?.into_iter().enumerate() {
            mesh.normals.push(moved_normal(matrices.of(vertex), normal));
        }
        if let Some(number) = self.attribute("TEXCOORD_0") {
            let texcoords = data.numbers::<2>(number)?.into_iter();
            // glTF has (0, 0) at the upper left of the image.
            mesh.texcoords.extend(texcoords.map(|[u, v]| Vec2::new(u, 1.0 - v)));
        }
        mesh.faces.extend(indices.into_iter().map(|corners| self.face(corners, &matrices, first)));
        Ok(())
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
        let is_missing = |&number: &usize| {
            accessors.get(number).is_some_and(|a| a.buffer_view.is_none() && a.sparse.is_none())
        };
        let numbers = self.primitive.attributes.values().chain(&self.primitive.indices);
        if self.primitive.extensions.contains_key(DRACO) && numbers.copied().any(|n| is_missing(&n))
        {
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

    /// The face of a triangle. `first` has the numbers of the primitive's first position, normal
    /// and texture coordinates.
    fn face(&self, [a, b, c]: [u32; 3], matrices: &Matrices<'_>, first: [usize; 3]) -> Face {
        let corners = if matrices.is_mirrored(a as usize) { [a, c, b] } else { [a, b, c] };
        let numbers = |first: usize| {
            let first = u32::try_from(first).unwrap_or(u32::MAX);
            Sides::Triangle(corners.map(|index| index.saturating_add(first)))
        };
        Face {
            positions: numbers(first[0]),
            normals: self.attribute("NORMAL").map(|_| numbers(first[1])),
            texcoords: self.attribute("TEXCOORD_0").map(|_| numbers(first[2])),
        }
    }

    fn attribute(&self, name: &str) -> Option<usize> {
        self.primitive.attributes.get(name).copied()
    }

    /// Checks all attributes, and returns the number of vertices.
    fn check_attributes(&self) -> Result<usize, String> {
        let path = format!("{}.attributes", self.path);
        let accessors = &self.data.document.accessors;
        self.check_types(&self.primitive.attributes, &path, Role::Vertices)?;
        for (number, target) in self.primitive.targets.iter().enumerate() {
            self.check_types(target, &format!("{}.targets[{number}]", self.path), Role::Moves)?;
        }
        let position = self.attribute("POSITION").ok_or_else(|| broken(&path, "no POSITION"))?;
        let count = accessors[position].count;
        let is_other = |(_, number): &(&String, &usize)| accessors[**number].count != count;
        if let Some((name, _)) = self.primitive.attributes.iter().find(is_other) {
            let what = format!("its count is not that of POSITION, {count}");
            return Err(broken(format!("{path}.{name}"), what));
        }
        usize::try_from(count).map_err(|_| broken(path, "too many vertices"))
    }

    fn check_types(&self, attributes: &Attributes, path: &str, role: Role) -> Result<(), String> {
        let accessors = &self.data.document.accessors;
        for (name, &number) in attributes {
            let path = format!("{path}.{name}");
            let Some(accessor) = accessors.get(number) else {
                return Err(broken(path, out_of_range(number, accessors.len(), "accessors")));
            };
            // Other attributes of morph targets are not used.
            if role == Role::Moves && name != "POSITION" && name != "NORMAL" {
                continue;
            }
            let checked = self.check_type(name, accessor, role);
            checked.map_err(|what| broken(path, format!("accessors[{number}] {what}")))?;
        }
        Ok(())
    }

    fn check_type(&self, name: &str, accessor: &Accessor, role: Role) -> Result<(), String> {
        use ComponentType::{Byte, Float, Short, UnsignedByte, UnsignedShort};
        if !is_semantic(name) {
            return Err("has a name that is not known".to_owned());
        }
        let (kind, component) = (accessor.kind, accessor.component_type);
        let is_small = matches!(component, Byte | UnsignedByte | Short | UnsignedShort);
        let is_quantized = is_small && self.data.document.is_quantized();
        let is_fraction = matches!(component, UnsignedByte | UnsignedShort) && accessor.normalized;
        let (wanted, is_component, rule) = match name {
            "POSITION" | "NORMAL" => (ElementKind::Vec3, is_quantized, "VEC3 of Float"),
            "TEXCOORD_0" => (
                ElementKind::Vec2,
                is_quantized || is_fraction,
                "VEC2 of Float, or of normalized UnsignedByte or UnsignedShort",
            ),
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
        let view = accessor.buffer_view.map(|view| &self.data.document.buffer_views[view]);
        let stride = view.and_then(|view| view.byte_stride).unwrap_or(kind.size(component));
        let is_aligned =
            accessor.byte_offset.unwrap_or(0).is_multiple_of(4) && stride.is_multiple_of(4);
        if role == Role::Moves {
            return Ok(());
        }
        if !is_aligned {
            return Err("has elements that do not begin at multiples of 4 bytes".to_owned());
        }
        let corners = [&accessor.min, &accessor.max];
        let three = |corner: &&Option<Vec<f64>>| corner.as_ref().is_some_and(|c| c.len() == 3);
        if name == "POSITION" && !corners.iter().all(three) {
            return Err("has no min or no max of three numbers".to_owned());
        }
        Ok(())
    }

    /// The three indices of each triangle, each less than `count`.
    fn indices(
        &self,
        triangles: Triangles,
        count: usize,
        faces: usize,
        most: usize,
        skipped: &mut Skipped,
    ) -> Result<Vec<[u32; 3]>, String> {
        let path = match self.primitive.indices {
            Some(_) => format!("{}.indices", self.path),
            None => self.path.to_owned(),
        };
        let length = match self.primitive.indices {
            Some(number) => self.check_indices(number).map_err(|what| broken(&path, what))?,
            None => count,
        };
        let whole = triangles.count(length);
        room(faces, whole, most).map_err(|what| broken(&path, what))?;
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
    fn check_indices(&self, number: usize) -> Result<usize, String> {
        let accessors = &self.data.document.accessors;
        let accessor = accessors.get(number);
        let accessor =
            accessor.ok_or_else(|| out_of_range(number, accessors.len(), "accessors"))?;
        let (kind, component) = (accessor.kind, accessor.component_type);
        if kind != ElementKind::Scalar || !is_index(component) || accessor.normalized {
            return Err(format!(
                "accessors[{number}] is {kind:?} of {component:?}; it must be SCALAR of unsigned integers"
            ));
        }
        let view = accessor.buffer_view.map(|view| &self.data.document.buffer_views[view]);
        if view.is_some_and(|view| view.byte_stride.is_some()) {
            return Err(format!("accessors[{number}] is in a buffer view with byteStride"));
        }
        Ok(usize::try_from(accessor.count).unwrap_or(usize::MAX))
    }

    /// The vertices that the indices refer to, each less than `count`.
    fn vertices(&self, number: usize, count: usize) -> Result<Vec<u32>, String> {
        let component = self.data.document.accessors[number].component_type;
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

/// The owner of attributes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    Vertices,
    /// A morph target.
    Moves,
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

/// Checks that `count` more elements fit in addition to `already`.
fn room(already: usize, count: usize, most: usize) -> Result<(), String> {
    let fits = already.checked_add(count).is_some_and(|sum| sum <= most);
    fits.then_some(())
        .ok_or_else(|| format!("the scene has more than {most} vertices or triangles"))
}

/// Whether a name is known (section 3.7.2.1). Names of applications begin with an underscore.
fn is_semantic(name: &str) -> bool {
    let numbered = ["TEXCOORD_", "COLOR_", "JOINTS_", "WEIGHTS_"];
    let set = numbered.iter().find_map(|start| name.strip_prefix(start));
    matches!(name, "POSITION" | "NORMAL" | "TANGENT")
        || name.starts_with('_')
        || set.is_some_and(|set| set.parse::<u32>().is_ok())
}
