//! The user's `struct Vertex` as a vertex buffer holds it.
//!
//! With [`Points::Evaluated`](super::Points::Evaluated) a compute pass writes an array of this
//! struct, and the vertex shader loads its members as attributes, or large structs whole
//! (`loads.rs`). WGSL fixes the offsets of a
//! struct's members, so both see the same bytes:
//!
//! ```text
//! struct Vertex {                                   byte  0        12 16       24   28  32
//!     @builtin(position) position: vec4f,                 | position  | uv     | id | - |
//!     @location(0) uv: vec2f,                       attribute 1         0        4
//!     @location(4) @interpolate(flat) id: u32,      32 bytes a vertex: the end, rounded up to the
//! }                                                 largest alignment, 16
//! ```
//!
//! A member's attribute has the number of its `@location`. The position has the lowest number that
//! is free.
//!
//! The layout is computed from the text, because a browser's compiler does not report it. The test
//! `offsets_are_those_of_the_compiler` compares it with naga's.

use super::StageError;
use super::wgsl::{self, Declaration};
use std::collections::BTreeMap;
use wgpu::VertexFormat as Format;

/// How a vertex shader gets evaluated vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Load {
    /// Each member of `Vertex` is an attribute of a vertex buffer.
    Attributes,
    /// The index of the vertex is its place in a storage buffer of the stage's own bind group.
    Storage,
}

/// The layout of [`TessellationStage::vertices`](super::TessellationStage::vertices).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VertexLayout {
    /// Bytes from one vertex to the next.
    pub array_stride: u64,
    /// Offsets and formats. The `shader_location` of a member of `Vertex` is its `@location`, and
    /// that of the position is the lowest free one. Packed points are one attribute, at location 0.
    pub attributes: Vec<wgpu::VertexAttribute>,
    /// The names of the members, in the order of the attributes.
    names: Vec<String>,
}

impl VertexLayout {
    /// The layout as a render pipeline takes it.
    #[must_use]
    pub fn buffer(&self) -> wgpu::VertexBufferLayout<'_> {
        wgpu::VertexBufferLayout {
            array_stride: self.array_stride,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &self.attributes,
        }
    }

    /// The attribute of a member of `Vertex`.
    #[must_use]
    pub fn member(&self, name: &str) -> Option<&wgpu::VertexAttribute> {
        self.names.iter().position(|own| own == name).map(|at| &self.attributes[at])
    }

    /// Whether both describe the same bytes; names may differ.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        self.array_stride == other.array_stride && self.attributes == other.attributes
    }

    /// Packed points, 8 bytes each ([`tess_gpu::layout::PackedPoint`]).
    pub(super) fn packed() -> Self {
        let format = Format::Uint32x2;
        let attributes = vec![wgpu::VertexAttribute { format, offset: 0, shader_location: 0 }];
        Self { array_stride: 8, attributes, names: vec!["packed".to_owned()] }
    }

    /// The layout of the `struct Vertex` among these declarations.
    ///
    /// # Errors
    /// [`StageError::Wgsl`] if there is none, or if a member cannot be an attribute.
    pub(super) fn of(declared: &[Declaration<'_>]) -> Result<Self, StageError> {
        let is_vertex = |one: &&Declaration<'_>| one.keyword == "struct" && one.name == "Vertex";
        let vertex = declared.iter().find(is_vertex).ok_or_else(|| StageError::Wgsl {
            line: None,
            message: "there is no `struct Vertex`".to_owned(),
        })?;
        let members = members(vertex.text);
        let mut end = 0;
        let mut align_of_all = 4;
        let (mut attributes, mut names) = (Vec::new(), Vec::new());
        let refused = |message| StageError::Wgsl { line: Some(vertex.line), message };
        let taken: Result<Vec<_>, _> = members.iter().map(Member::location).collect();
        let taken = taken.map_err(refused)?;
        let free = (0..).find(|number| !taken.contains(&Some(*number))).unwrap_or(u32::MAX);
        for (member, location) in members.iter().zip(&taken) {
            let (format, align, size) = member.format(declared).map_err(refused)?;
            let offset = u64::next_multiple_of(end, align);
            end = offset + size;
            align_of_all = align_of_all.max(align);
            let shader_location = location.unwrap_or(free);
            attributes.push(wgpu::VertexAttribute { format, offset, shader_location });
            names.push(member.name.to_owned());
        }
        Ok(Self { array_stride: end.next_multiple_of(align_of_all), attributes, names })
    }

    /// The parameters of a vertex shader that loads all members, and the expression that makes a
    /// `Vertex` of them.
    ///
    /// ```text
    /// @location(1) tess_0: vec4<f32>, @location(0) tess_1: vec2<f32>     Vertex(tess_0, tess_1)
    /// ```
    pub(super) fn loads(&self) -> [String; 2] {
        let parameter = |(number, attribute): (usize, &wgpu::VertexAttribute)| {
            let (location, kind) = (attribute.shader_location, wgsl_type(attribute.format));
            format!("@location({location}) tess_{number}: {kind}")
        };
        let parameters: Vec<_> = self.attributes.iter().enumerate().map(parameter).collect();
        let names: Vec<_> = (0..self.attributes.len()).map(|at| format!("tess_{at}")).collect();
        [parameters.join(", "), format!("Vertex({})", names.join(", "))]
    }
}

/// A member of a struct.
#[derive(Debug)]
struct Member<'a> {
    name: &'a str,
    /// The words and signs of its type.
    kind: Vec<&'a str>,
    /// Its attributes by name, with the words and signs in their parentheses.
    attributes: BTreeMap<&'a str, Vec<&'a str>>,
}

/// The members of a struct's declaration.
fn members(text: &str) -> Vec<Member<'_>> {
    let mut words =
        wgsl::tokens(text).map(|(_, word)| word).skip_while(|&word| word != "{").skip(1);
    let mut all = Vec::new();
    let mut attributes = BTreeMap::new();
    let mut last = None;
    while let Some(word) = last.take().or_else(|| words.next()) {
        match word {
            "@" => {
                let name = words.next().unwrap_or_default();
                let next = words.next();
                let mut inner = Vec::new();
                match next {
                    Some("(") => inner.extend(in_parentheses(&mut words)),
                    other => last = other,
                }
                attributes.insert(name, inner);
            }
            "," | "}" | ";" => {}
            name => {
                // The colon, then the type up to a comma outside of angle brackets.
                let mut depth = 0_i32;
                let kind = words.by_ref().skip(1).take_while(|&word| {
                    depth += i32::from(word == "<") - i32::from(word == ">");
                    word != "}" && !(word == "," && depth == 0)
                });
                let kind = kind.collect();
                all.push(Member { name, kind, attributes: std::mem::take(&mut attributes) });
            }
        }
    }
    all
}

/// The words up to the closing parenthesis.
fn in_parentheses<'a>(words: &mut impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut depth = 1_u32;
    words
        .take_while(|&word| {
            depth = match word {
                "(" => depth + 1,
                ")" => depth - 1,
                _ => depth,
            };
            depth > 0
        })
        .collect()
}

impl Member<'_> {
    /// The number of its `@location`, or `None` for the position.
    fn location(&self) -> Result<Option<u32>, String> {
        let builtin = self.attributes.get("builtin").and_then(|words| words.first().copied());
        match (builtin, self.number("location")?) {
            (Some("position"), _) => Ok(None),
            (Some(other), _) => Err(format!(
                "`{}` is `@builtin({other})`, which no vertex buffer can hold; choose another value \
                 of `points` than `Points::Evaluated`",
                self.name
            )),
            (None, Some(number)) => Ok(u32::try_from(number).ok()),
            (None, None) => Err(format!("`{}` has neither `@location` nor `@builtin`", self.name)),
        }
    }

    /// The number in the parentheses of an attribute.
    fn number(&self, attribute: &str) -> Result<Option<u64>, String> {
        let Some(words) = self.attributes.get(attribute) else { return Ok(None) };
        let number = match words[..] {
            [one] => one.trim_end_matches(['i', 'u']).parse().ok(),
            _ => None,
        };
        let refused = || format!("write the `@{attribute}` of `{}` as a number", self.name);
        number.map(Some).ok_or_else(refused)
    }

    /// The format of its attribute, its alignment and its size in bytes.
    fn format(&self, declared: &[Declaration<'_>]) -> Result<(Format, u64, u64), String> {
        let kind = resolved(&self.kind, declared);
        let found = KINDS.iter().find(|one| scalar_and_count(&kind) == Some((one.0, one.1)));
        let &(scalar, count, format, _) = found.ok_or_else(|| {
            let kind = self.kind.concat();
            format!("`{}` has the type `{kind}`, which no vertex attribute has", self.name)
        })?;
        let each = if scalar == "f16" { 2 } else { 4 };
        let natural = each * if count == 3 { 4 } else { count };
        let align = self.number("align")?.unwrap_or(natural).max(1);
        Ok((format, align, self.number("size")?.unwrap_or(each * count)))
    }
}

/// The words of a type, with each alias replaced by what it stands for.
fn resolved<'a>(kind: &[&'a str], declared: &[Declaration<'a>]) -> Vec<&'a str> {
    let mut words = kind.to_vec();
    // Eight rounds resolve aliases of aliases; the compiler refuses a cycle.
    for _ in 0..8 {
        let meaning = |word: &'a str| {
            let is_alias = |one: &&Declaration<'a>| one.keyword == "alias" && one.name == word;
            match declared.iter().find(is_alias) {
                None => vec![word],
                Some(alias) => {
                    let all = wgsl::tokens(alias.text).map(|(_, word)| word);
                    all.skip_while(|&word| word != "=")
                        .skip(1)
                        .filter(|&word| word != ";")
                        .collect()
                }
            }
        };
        words = words.into_iter().flat_map(meaning).collect();
    }
    words
}

/// The words of a type, with aliases replaced and vectors in one form: `vec2<f32>` for `vec2f`.
pub(super) fn plain_type<'a>(kind: &[&'a str], declared: &[Declaration<'a>]) -> Vec<&'a str> {
    let words = resolved(kind, declared);
    let found = KINDS.iter().find(|one| scalar_and_count(&words) == Some((one.0, one.1)));
    found.map_or(words, |one| vec![one.3])
}

/// The scalar of a type, and the number of its components.
fn scalar_and_count<'a>(words: &[&'a str]) -> Option<(&'a str, u64)> {
    let count = |word: &str| word.strip_prefix("vec")?.parse().ok().filter(|n| (2..=4).contains(n));
    match *words {
        [one] if ["f32", "u32", "i32", "f16"].contains(&one) => Some((one, 1)),
        [one] => {
            let (vector, scalar) = one.split_at_checked(one.len().checked_sub(1)?)?;
            let scalar = match scalar {
                "f" => "f32",
                "u" => "u32",
                "i" => "i32",
                "h" => "f16",
                _ => return None,
            };
            Some((scalar, count(vector)?))
        }
        [vector, "<", scalar, ">"] | [vector, "<", scalar, ",", ">"] => {
            Some((scalar, count(vector)?))
        }
        _ => None,
    }
}

/// Scalar, number of components, the attribute's format, and the type in WGSL.
const KINDS: [(&str, u64, Format, &str); 15] = [
    ("f32", 1, Format::Float32, "f32"),
    ("f32", 2, Format::Float32x2, "vec2<f32>"),
    ("f32", 3, Format::Float32x3, "vec3<f32>"),
    ("f32", 4, Format::Float32x4, "vec4<f32>"),
    ("u32", 1, Format::Uint32, "u32"),
    ("u32", 2, Format::Uint32x2, "vec2<u32>"),
    ("u32", 3, Format::Uint32x3, "vec3<u32>"),
    ("u32", 4, Format::Uint32x4, "vec4<u32>"),
    ("i32", 1, Format::Sint32, "i32"),
    ("i32", 2, Format::Sint32x2, "vec2<i32>"),
    ("i32", 3, Format::Sint32x3, "vec3<i32>"),
    ("i32", 4, Format::Sint32x4, "vec4<i32>"),
    ("f16", 1, Format::Float16, "f16"),
    ("f16", 2, Format::Float16x2, "vec2<f16>"),
    ("f16", 4, Format::Float16x4, "vec4<f16>"),
];

/// The type that a member of this format has.
fn wgsl_type(format: Format) -> &'static str {
    KINDS.iter().find(|one| one.2 == format).map_or("u32", |one| one.3)
}

#[cfg(test)]
mod tests {
    use super::*;
    use wgpu::naga::{TypeInner, front};

    /// The struct of these members, with what they need around it.
    fn text(members: &str) -> String {
        format!(
            "enable f16; alias Colour = vec4f; alias Half = f16; alias Three = array<f32, 3>;\n\
             const AT = 3;\nstruct Other {{ a: f32 }}\nstruct Vertex {{ {members} }}\n"
        )
    }

    fn layout(members: &str) -> Result<VertexLayout, StageError> {
        VertexLayout::of(&wgsl::declarations(&text(members)))
    }

    /// The stride, and the name and offset of each member.
    type Offsets = (u64, Vec<(String, u64)>);

    fn of_the_compiler(members: &str) -> Offsets {
        let text = text(members);
        let module = front::wgsl::parse_str(&text)
            .unwrap_or_else(|error| panic!("{}", error.emit_to_string(&text)));
        let is_vertex = |ty: &&wgpu::naga::Type| ty.name.as_deref() == Some("Vertex");
        let vertex = module.types.iter().map(|(_, ty)| ty).find(is_vertex).expect("it is there");
        let TypeInner::Struct { members, span } = &vertex.inner else { panic!("{vertex:?}") };
        let name = |member: &wgpu::naga::StructMember| member.name.clone().unwrap_or_default();
        let offset = |member: &wgpu::naga::StructMember| u64::from(member.offset);
        let all = members.iter().map(|member| (name(member), offset(member))).collect();
        ((*span).into(), all)
    }

    #[test]
    fn offsets_are_those_of_the_compiler() {
        let position = "@builtin(position) position: vec4f";
        for rest in [
            "",
            ", @location(0) uv: vec2f, @location(4) @interpolate(flat) id: u32",
            ", @location(0) a: f32, @location(1) b: vec3<f32>, @location(2) c: f32,",
            ", @location(7) a: vec3f, @location(0) /* } */ b: vec3<i32>, @location(1) c: vec2i",
            ", @location(0u) a: Half, @location(1) b: vec2<f16>, @location(2i) c: vec4h",
            ", @align(32) @location(0) a: f32, @size(40) @location(1) b: Colour,",
            ", @location(0) a: vec2<u32,>, @location(1) @interpolate(flat, either) b: vec4<u32>",
            ", @location(0) a: vec2<Half>, @location(3) b: i32, @location(1) c: vec3u, @location(2) d: u32",
        ] {
            let last = format!("{}, {position}", rest.trim_end_matches(','));
            for members in [position.to_owned() + rest, last] {
                let members = members.trim_start_matches([',', ' ']);
                let found = layout(members).unwrap_or_else(|error| panic!("{members}: {error}"));
                let offsets = found.attributes.iter().map(|one| one.offset);
                let own = found.names.iter().cloned().zip(offsets).collect();
                assert_eq!((found.array_stride, own), of_the_compiler(members), "{members}");
            }
        }
    }

    #[test]
    fn the_struct_of_the_head_comment() {
        let members = "@builtin(position) position: vec4f, @location(0) uv: vec2f, \
                       @location(4) @interpolate(flat) id: u32";
        let found = layout(members).expect("a sound struct");
        let all = found.attributes.iter().map(|one| (one.shader_location, one.offset, one.format));
        let expected =
            [(1, 0, Format::Float32x4), (0, 16, Format::Float32x2), (4, 24, Format::Uint32)];
        assert_eq!(all.collect::<Vec<_>>(), expected, "the position has the first free location");
        assert_eq!(found.array_stride, 32, "bytes of a vertex");
        assert_eq!(found.member("id").map(|one| one.offset), Some(24));
        assert_eq!(found.member("normal"), None, "there is none");
        let [parameters, vertex] = found.loads();
        assert_eq!(
            parameters,
            "@location(1) tess_0: vec4<f32>, @location(0) tess_1: vec2<f32>, @location(4) tess_2: u32"
        );
        assert_eq!(vertex, "Vertex(tess_0, tess_1, tess_2)");
    }

    #[test]
    fn members_that_no_attribute_holds_are_named() {
        for (member, says) in [
            ("@location(0) a: Three", "`a` has the type `Three`"),
            ("@location(0) a: vec3<f16>", "`a` has the type `vec3<f16>`"),
            ("@location(0) a: Other", "`a` has the type `Other`"),
            ("@location(0) a: vec5f", "`a` has the type `vec5f`"),
            ("@location(AT) a: f32", "write the `@location` of `a` as a number"),
            ("@location(0) @size(AT) a: f32", "write the `@size` of `a` as a number"),
            ("@builtin(clip_distances) a: array<f32, 1>", "`a` is `@builtin(clip_distances)`"),
            ("a: f32", "`a` has neither `@location` nor `@builtin`"),
        ] {
            let error = layout(member).expect_err(says).to_string();
            assert!(error.starts_with("line 4 of your WGSL: "), "{error}");
            assert!(error.contains(says), "{error}");
        }
    }
}
