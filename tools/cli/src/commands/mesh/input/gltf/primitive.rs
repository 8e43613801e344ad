//! Primitives: triangles of a mesh, moved by a node's transform.

use super::accessor::{Data, float, is_index, unsigned};
use super::document::{Accessor, ComponentType, ElementKind, Primitive, broken};
use super::scene::out_of_range;
use glam::{Mat3, Mat4, Vec2, Vec3};
use tess_surface::{Face, PolygonMesh, Sides};

/// The mode of separate triangles.
const TRIANGLES: u32 = 4;

/// Where a primitive stands and how it is placed.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlacedPrimitive<'a> {
    pub(super) data: &'a Data<'a>,
    pub(super) primitive: &'a Primitive,
    /// Its JSON path.
    pub(super) path: &'a str,
    pub(super) transform: Mat4,
}

impl PlacedPrimitive<'_> {
    /// Appends the triangles, unless vertices or faces then become more than `most`. Errors: a rule that is broken,
    /// with the JSON path.
    pub(super) fn append(&self, mesh: &mut PolygonMesh, most: usize) -> Result<(), String> {
        let Self { data, primitive, path, transform } = *self;
        if primitive.mode != TRIANGLES {
            let what = format!("mode {}; only triangles (4) are read", primitive.mode);
            return Err(broken(format!("{path}.mode"), what));
        }
        let count = self.check_attributes()?;
        room(mesh.positions.len(), count, most).map_err(|what| broken(path, what))?;
        let indices = self.indices(count, mesh.faces.len(), most)?;
        let linear = Mat3::from_mat4(transform);
        let first = [mesh.positions.len(), mesh.normals.len(), mesh.texcoords.len()];
        if let Some(number) = self.attribute("POSITION") {
            let positions = data.read(number, float)?.into_iter().map(Vec3::from_array);
            mesh.positions.extend(positions.map(|p| transform.transform_point3(p)));
        }
        if let Some(number) = self.attribute("NORMAL") {
            let to_normal = linear.inverse().transpose();
            let normals = data.read(number, float)?.into_iter().map(Vec3::from_array);
            mesh.normals.extend(normals.map(|n| to_normal * n));
        }
        if let Some(number) = self.attribute("TEXCOORD_0") {
            let texcoords = self.texcoords(number)?.into_iter();
            // glTF has (0, 0) at the upper left of the image.
            mesh.texcoords.extend(texcoords.map(|[u, v]| Vec2::new(u, 1.0 - v)));
        }
        let mirrored = linear.determinant() < 0.0;
        mesh.faces.extend(indices.as_chunks::<3>().0.iter().map(|&[a, b, c]| {
            let corners = if mirrored { [a, c, b] } else { [a, b, c] };
            let numbers = |first: usize| {
                let first = u32::try_from(first).unwrap_or(u32::MAX);
                Sides::Triangle(corners.map(|index| index.saturating_add(first)))
            };
            Face {
                positions: numbers(first[0]),
                normals: self.attribute("NORMAL").map(|_| numbers(first[1])),
                texcoords: self.attribute("TEXCOORD_0").map(|_| numbers(first[2])),
            }
        }));
        Ok(())
    }

    fn attribute(&self, name: &str) -> Option<usize> {
        self.primitive.attributes.get(name).copied()
    }

    /// Checks all attributes and gives the number of vertices.
    fn check_attributes(&self) -> Result<usize, String> {
        let path = format!("{}.attributes", self.path);
        let accessors = &self.data.document.accessors;
        for (name, &number) in &self.primitive.attributes {
            let path = format!("{path}.{name}");
            let Some(accessor) = accessors.get(number) else {
                return Err(broken(path, out_of_range(number, accessors.len(), "accessors")));
            };
            self.check_attribute(name, accessor)
                .map_err(|what| broken(path, format!("accessors[{number}] {what}")))?;
        }
        let position = self.attribute("POSITION").ok_or_else(|| broken(&path, "no POSITION"))?;
        let count = accessors[position].count;
        if let Some((name, _)) =
            self.primitive.attributes.iter().find(|(_, number)| accessors[**number].count != count)
        {
            let what = format!("its count is not that of POSITION, {count}");
            return Err(broken(format!("{path}.{name}"), what));
        }
        usize::try_from(count).map_err(|_| broken(path, "too many vertices"))
    }

    fn check_attribute(&self, name: &str, accessor: &Accessor) -> Result<(), String> {
        use ComponentType::{Float, UnsignedByte, UnsignedShort};
        let (kind, component) = (accessor.kind, accessor.component_type);
        let right = match (name, kind, component) {
            ("POSITION" | "NORMAL", ElementKind::Vec3, Float)
            | ("TEXCOORD_0", ElementKind::Vec2, Float) => true,
            ("TEXCOORD_0", ElementKind::Vec2, UnsignedByte | UnsignedShort) => accessor.normalized,
            ("POSITION" | "NORMAL" | "TEXCOORD_0", ..) => false,
            _ => is_semantic(name).then_some(true).ok_or("has a name that is not known")?,
        };
        if !right {
            let rule = match name {
                "TEXCOORD_0" => "VEC2 of Float, or of normalized UnsignedByte or UnsignedShort",
                _ => "VEC3 of Float",
            };
            return Err(format!("is {kind:?} of {component:?}; it must be {rule}"));
        }
        let view = accessor.buffer_view.map(|view| &self.data.document.buffer_views[view]);
        let stride = view.and_then(|view| view.byte_stride).unwrap_or(kind.size(component));
        if !accessor.byte_offset.unwrap_or(0).is_multiple_of(4) || !stride.is_multiple_of(4) {
            return Err("has elements that do not begin at multiples of 4 bytes".to_owned());
        }
        let corners = [&accessor.min, &accessor.max];
        let three = |corner: &&Option<Vec<f64>>| corner.as_ref().is_some_and(|c| c.len() == 3);
        if name == "POSITION" && !corners.iter().all(three) {
            return Err("has no min or no max of three numbers".to_owned());
        }
        Ok(())
    }

    fn texcoords(&self, number: usize) -> Result<Vec<[f32; 2]>, String> {
        // Normalized integers: section 3.6.2.2, the largest is 1.
        match self.data.document.accessors[number].component_type {
            ComponentType::UnsignedByte => self.data.read(number, |b| unsigned(b) as f32 / 255.0),
            ComponentType::UnsignedShort => {
                self.data.read(number, |b| unsigned(b) as f32 / 65535.0)
            }
            _ => self.data.read(number, float),
        }
    }

    /// Three numbers of vertices, less than `count`, for each triangle.
    fn indices(&self, count: usize, faces: usize, most: usize) -> Result<Vec<u32>, String> {
        let Some(number) = self.primitive.indices else {
            whole_triangles(count).map_err(|what| broken(self.path, what))?;
            room(faces, count / 3, most).map_err(|what| broken(self.path, what))?;
            return Ok((0..u32::try_from(count).unwrap_or(u32::MAX)).collect());
        };
        let path = format!("{}.indices", self.path);
        let accessors = &self.data.document.accessors;
        let accessor = accessors
            .get(number)
            .ok_or_else(|| broken(&path, out_of_range(number, accessors.len(), "accessors")))?;
        let wrong = |what| broken(&path, format!("accessors[{number}] {what}"));
        let (kind, component) = (accessor.kind, accessor.component_type);
        if kind != ElementKind::Scalar || !is_index(component) || accessor.normalized {
            let what = format!("is {kind:?} of {component:?}");
            return Err(wrong(format!("{what}; it must be SCALAR of unsigned integers")));
        }
        let view = accessor.buffer_view.map(|view| &self.data.document.buffer_views[view]);
        if view.is_some_and(|view| view.byte_stride.is_some()) {
            return Err(wrong("is in a buffer view with byteStride".to_owned()));
        }
        let length = usize::try_from(accessor.count).unwrap_or(usize::MAX);
        whole_triangles(length).map_err(wrong)?;
        room(faces, length / 3, most).map_err(wrong)?;
        let indices = self.data.read::<_, 1>(number, unsigned)?.into_flattened();
        // The largest value of a type restarts strips; it numbers no vertex.
        let restart = u32::MAX >> (32 - 8 * component.size());
        match indices.iter().position(|&index| index as usize >= count || index == restart) {
            None => Ok(indices),
            Some(at) => {
                let what = format!("is out of range: there are {count} vertices");
                Err(wrong(format!("index {} at {at} {what}", indices[at])))
            }
        }
    }
}

fn whole_triangles(length: usize) -> Result<(), String> {
    let whole = length.is_multiple_of(3);
    whole.then_some(()).ok_or_else(|| format!("{length} indices are no whole triangles"))
}

/// Whether `count` more fit beside `already`.
fn room(already: usize, count: usize, most: usize) -> Result<(), String> {
    let fits = already.checked_add(count).is_some_and(|sum| sum <= most);
    fits.then_some(())
        .ok_or_else(|| format!("the scene has more than {most} vertices or triangles"))
}

/// Section 3.7.2.1: the names that there are. Those of an application begin with an underscore.
fn is_semantic(name: &str) -> bool {
    let numbered = ["TEXCOORD_", "COLOR_", "JOINTS_", "WEIGHTS_"];
    let set = numbered.iter().find_map(|start| name.strip_prefix(start));
    name == "TANGENT" || name.starts_with('_') || set.is_some_and(|set| set.parse::<u32>().is_ok())
}
