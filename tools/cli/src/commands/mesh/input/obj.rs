//! OBJ files: triangles and quads with texture coordinates and normals.
//!
//! Read are `v`, `vt`, `vn` and `f` with all forms of indices. Comments, names, groups, materials
//! and display attributes do not change a surface and are skipped. Points and lines have none; they
//! are skipped and counted. Every other keyword is an error, so that no misspelt line is lost.

use super::text::{TextLines, integer, number, quoted, without_mark, words};
use glam::{Vec2, Vec3};
use tess_surface::{Face, PolygonMesh, Sides};

/// Keywords of lines that do not change the surface.
const SKIPPED: &str = "o g s mg usemtl mtllib usemap maplib lod bevel c_interp d_interp shadow_obj \
     trace_obj";

/// Keywords of free-form curves and surfaces.
const FREE_FORM: &str = "vp cstype deg bmat step curv curv2 surf parm trim hole scrv sp end con \
     ctech stech bsp bzp cdc cdp res";

/// The content of a file.
#[derive(Debug, Default)]
pub(crate) struct Obj {
    /// The faces of all objects and groups, every index within its list.
    pub(crate) mesh: PolygonMesh,
    /// The line of each face, from 1.
    pub(crate) lines: Vec<usize>,
    /// How many points and lines were skipped.
    pub(crate) skipped: usize,
}

/// The indices of one corner, resolved from 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Corner {
    position: u32,
    texcoord: Option<u32>,
    normal: Option<u32>,
}

/// Reads a file. Errors: the first line that is malformed, or the first face with an index out of range.
pub(crate) fn parse(bytes: &[u8]) -> Result<Obj, String> {
    let mut obj = Obj::default();
    for (number, line) in (1..).zip(TextLines(without_mark(bytes))) {
        let read = obj.line(number, line);
        read.map_err(|what| format!("line {number}: {}: {what}", quoted(line)))?;
    }
    for (face, line) in obj.mesh.faces.iter().zip(&obj.lines) {
        obj.check_range(face).map_err(|what| format!("line {line}: {what}"))?;
    }
    Ok(obj)
}

impl Obj {
    fn line(&mut self, number: usize, line: &[u8]) -> Result<(), String> {
        let mut words = words(line);
        let Some(keyword) = words.next() else { return Ok(()) };
        let words = words.take_while(|word| !word.starts_with(b"#"));
        match keyword {
            b"v" => self.mesh.positions.push(position(words)?),
            b"vt" => self.mesh.texcoords.push(texcoord(words)?),
            b"vn" => self.mesh.normals.push(normal(words)?),
            b"f" => {
                let face = self.face(words)?;
                self.mesh.faces.push(face);
                self.lines.push(number);
            }
            b"l" | b"p" => self.skipped += 1,
            _ => unread(keyword)?,
        }
        Ok(())
    }

    fn face<'a>(&self, words: impl Iterator<Item = &'a [u8]>) -> Result<Face, String> {
        let mut corners = [Corner::default(); 4];
        let mut count = 0;
        for word in words {
            if let Some(corner) = corners.get_mut(count) {
                *corner = self.corner(word)?;
            }
            count += 1;
        }
        if count != 3 && count != 4 {
            return Err(format!(
                "a face with {count} corners; only triangles and quads are read: triangulate the \
                 mesh first"
            ));
        }
        let form = |corner: &Corner| (corner.texcoord.is_some(), corner.normal.is_some());
        if corners[..count].iter().any(|corner| form(corner) != form(&corners[0])) {
            return Err("the corners of a face must all have the same kinds of indices".to_owned());
        }
        let [a, b, c, d] = corners;
        let sides = if count == 3 { Sides::Triangle([a, b, c]) } else { Sides::Quad([a, b, c, d]) };
        let all = |index: fn(Corner) -> Option<u32>| {
            index(a).is_some().then(|| sides.map(|corner| index(corner).unwrap_or_default()))
        };
        Ok(Face {
            positions: sides.map(|corner| corner.position),
            texcoords: all(|corner| corner.texcoord),
            normals: all(|corner| corner.normal),
        })
    }

    /// One of `v`, `v/vt`, `v//vn` and `v/vt/vn`.
    fn corner(&self, word: &[u8]) -> Result<Corner, String> {
        let PolygonMesh { positions, texcoords, normals, .. } = &self.mesh;
        let mut parts = word.split(|&byte| byte == b'/');
        let (v, vt, vn) = (parts.next().unwrap_or_default(), parts.next(), parts.next());
        let no_texcoord = vn.is_some() && vt.is_some_and(<[u8]>::is_empty);
        let vt = vt.filter(|_| !no_texcoord);
        let index = |part: &[u8], what, count| {
            resolve(part, what, count).map_err(|why| format!("corner {}: {why}", quoted(word)))
        };
        if parts.next().is_some() {
            return Err(format!("corner {}: it has more than three indices", quoted(word)));
        }
        Ok(Corner {
            position: index(v, "position", positions.len())?,
            texcoord: vt
                .map(|part| index(part, "texture coordinate", texcoords.len()))
                .transpose()?,
            normal: vn.map(|part| index(part, "normal", normals.len())).transpose()?,
        })
    }

    /// Positive indices may name what comes later in the file, so ranges are checked at its end.
    fn check_range(&self, face: &Face) -> Result<(), String> {
        let PolygonMesh { positions, texcoords, normals, .. } = &self.mesh;
        for (what, indices, count) in [
            ("position", Some(face.positions), positions.len()),
            ("texture coordinate", face.texcoords, texcoords.len()),
            ("normal", face.normals, normals.len()),
        ] {
            let Some(indices) = indices else { continue };
            if let Some(&index) = indices.as_slice().iter().find(|&&i| i as usize >= count) {
                let index = u64::from(index) + 1;
                return Err(format!("{what} index {index} is out of range: there are {count}"));
            }
        }
        Ok(())
    }
}

/// Whether a keyword is one of those that are skipped.
fn unread(keyword: &[u8]) -> Result<(), String> {
    let is_in = |list: &str| list.split(' ').any(|name| name.as_bytes() == keyword);
    if keyword.starts_with(b"#") || is_in(SKIPPED) {
        return Ok(());
    }
    Err(if is_in(FREE_FORM) {
        "free-form curves and surfaces are not read; convert them to triangles and quads".to_owned()
    } else {
        format!("{} is not a keyword that is read, which are v, vt, vn and f", quoted(keyword))
    })
}

/// Resolves an index: from 1, or from -1 backwards from the last of the `count` so far.
fn resolve(part: &[u8], what: &str, count: usize) -> Result<u32, String> {
    let number = integer(part).ok_or_else(|| {
        format!("{} is not a {what} index; corners are v, v/vt, v//vn or v/vt/vn", quoted(part))
    })?;
    let index = match number {
        0 => return Err("indices begin at 1".to_owned()),
        1.. => number - 1,
        _ => i64::try_from(count).unwrap_or(i64::MAX).saturating_add(number),
    };
    let out_of_range =
        || format!("{what} index {number} is out of range: there are {count} so far");
    u32::try_from(index).map_err(|_| out_of_range())
}

fn position<'a>(words: impl Iterator<Item = &'a [u8]>) -> Result<Vec3, String> {
    let what = "a position is three numbers, perhaps with weight 1 or with a colour of three";
    let (numbers, count) = numbers::<6>(words, what)?;
    let [x, y, z, w, ..] = numbers;
    match count {
        3 | 6 => Ok(Vec3::new(x, y, z)),
        4 if w.to_bits() == 1.0f32.to_bits() => Ok(Vec3::new(x, y, z)),
        _ => Err(what.to_owned()),
    }
}

fn texcoord<'a>(words: impl Iterator<Item = &'a [u8]>) -> Result<Vec2, String> {
    let what = "texture coordinates are one to three numbers";
    match numbers(words, what)? {
        (_, 0) => Err(what.to_owned()),
        ([u, v, _], _) => Ok(Vec2::new(u, v)),
    }
}

fn normal<'a>(words: impl Iterator<Item = &'a [u8]>) -> Result<Vec3, String> {
    let what = "a normal is three numbers";
    match numbers(words, what)? {
        (xyz, 3) => Ok(Vec3::from_array(xyz)),
        _ => Err(what.to_owned()),
    }
}

/// At most `N` numbers and how many there are; zeros fill the rest.
fn numbers<'a, const N: usize>(
    words: impl Iterator<Item = &'a [u8]>,
    what: &str,
) -> Result<([f32; N], usize), String> {
    let mut numbers = [0.0; N];
    let mut count = 0;
    for word in words {
        let place = numbers.get_mut(count).ok_or(what)?;
        *place = number(word).map_err(|why| format!("{why}; {what}"))?;
        count += 1;
    }
    Ok((numbers, count))
}
