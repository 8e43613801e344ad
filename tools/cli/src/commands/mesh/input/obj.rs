//! OBJ files: polygons with texture coordinates and normals.
//!
//! The keywords are `v`, `vt`, `vn` and `f`, with all forms of indices. Comments, names, groups,
//! materials and display attributes do not affect a surface and are skipped. Points and lines have
//! no surface; they are skipped and counted. Any other keyword is an error, so that a misspelt line
//! is not lost. Polygons of more than four corners are cut into triangles.

use super::polygon::{self, Corner, triangles};
use super::tally::Tally;
use super::text::{TextLines, any_float, integer, number, quoted, without_mark, words};
use crate::output::counted;
use glam::{Vec2, Vec3};
use tess_surface::{Face, PolygonMesh};

/// Keywords of lines that do not affect the surface.
const SKIPPED: &str = "o g s mg usemtl mtllib usemap maplib lod bevel c_interp d_interp shadow_obj \
     trace_obj";

/// Keywords of free-form curves and surfaces.
const FREE_FORM: &str = "vp cstype deg bmat step curv curv2 surf parm trim hole scrv sp end con \
     ctech stech bsp bzp cdc cdp res";

/// The contents of a file.
#[derive(Debug, Default)]
pub(crate) struct Obj {
    /// The faces of all objects and groups, with every index in range.
    pub(crate) mesh: PolygonMesh,
    /// The line of each face, from 1.
    pub(crate) lines: Vec<usize>,
    /// Notes on the parts that were cut or left out.
    pub(crate) notes: Vec<String>,
}

/// A file during reading.
#[derive(Debug, Default)]
struct Reader {
    mesh: PolygonMesh,
    lines: Vec<usize>,
    /// Polygons of more than four corners. `mesh` holds one triangle in place of each, with this
    /// number.
    polygons: Vec<(usize, Vec<Corner>)>,
    /// The skipped points and lines.
    skipped: Tally,
}

/// Parses a file. Errors: the first malformed line, or the first face with an index that is out of
/// range.
pub(crate) fn parse(bytes: &[u8]) -> Result<Obj, String> {
    let mut reader = Reader::default();
    for (number, line) in (1..).zip(TextLines(without_mark(bytes))) {
        let read = reader.line(number, line);
        read.map_err(|what| format!("line {number}: {}: {what}", quoted(line)))?;
    }
    reader.check_ranges()?;
    let done = "cut into triangles";
    let lines = &reader.lines;
    let first = || format!("line {}", lines[reader.polygons[0].0]);
    let cut = Tally::of(reader.polygons.len(), first);
    let notes = [
        cut.note("polygon", " of more than four corners", done),
        reader.skipped.note("`l` or `p` line", "", "left out, as points and lines have no surface"),
    ];
    let Reader { mesh, lines, polygons, .. } = reader;
    let (mesh, lines) = with_polygons(mesh, lines, polygons);
    Ok(Obj { mesh, lines, notes: notes.into_iter().flatten().collect() })
}

/// The faces and their lines, with each polygon's placeholder replaced by its triangles.
fn with_polygons(
    mut mesh: PolygonMesh,
    lines: Vec<usize>,
    polygons: Vec<(usize, Vec<Corner>)>,
) -> (PolygonMesh, Vec<usize>) {
    if polygons.is_empty() {
        return (mesh, lines);
    }
    let (mut faces, mut lines_of_faces) = (Vec::new(), Vec::new());
    let mut polygons = polygons.into_iter().peekable();
    for (number, (face, line)) in mesh.faces.iter().zip(lines).enumerate() {
        match polygons.next_if(|&(first, _)| first == number) {
            Some((_, corners)) => faces.extend(triangles(&corners, &mesh.positions)),
            None => faces.push(*face),
        }
        lines_of_faces.resize(faces.len(), line);
    }
    mesh.faces = faces;
    (mesh, lines_of_faces)
}

impl Reader {
    fn line(&mut self, number: usize, line: &[u8]) -> Result<(), String> {
        let mut words = words(line);
        let Some(keyword) = words.next() else { return Ok(()) };
        let words = words.take_while(|word| !word.starts_with(b"#"));
        match keyword {
            b"v" => self.mesh.positions.push(position(words)?),
            b"vt" => self.mesh.texcoords.push(texcoord(words)?),
            b"vn" => self.mesh.normals.push(normal(words)?),
            b"f" => {
                self.face(words)?;
                self.lines.push(number);
            }
            b"l" | b"p" => self.skipped.add(|| format!("line {number}")),
            _ => unread(keyword)?,
        }
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a [u8]>) -> Result<(), String> {
        let mut few = [Corner::default(); 4];
        let mut more = Vec::new();
        let mut count = 0;
        for word in words {
            let corner = self.corner(word)?;
            match few.get_mut(count) {
                Some(place) => *place = corner,
                None if more.is_empty() => more.extend(few.into_iter().chain([corner])),
                None => more.push(corner),
            }
            count += 1;
        }
        let corners = if more.is_empty() { &few[..count] } else { &more };
        let form = |corner: &Corner| (corner.texcoord.is_some(), corner.normal.is_some());
        if corners.iter().any(|corner| form(corner) != form(&corners[0])) {
            return Err("the corners of a face must all have the same kinds of indices".to_owned());
        }
        let whole = if count > 4 { &corners[..3] } else { corners };
        let face = polygon::face(whole).ok_or_else(|| {
            format!("a face with {}; it needs at least three", counted(count as u64, "corner"))
        })?;
        if count > 4 {
            self.polygons.push((self.mesh.faces.len(), more));
        }
        self.mesh.faces.push(face);
        Ok(())
    }

    /// Parses a corner: `v`, `v/vt`, `v//vn` or `v/vt/vn`. An empty index counts as missing, as in
    /// `v/` and `v/vt/`.
    fn corner(&self, word: &[u8]) -> Result<Corner, String> {
        let PolygonMesh { positions, texcoords, normals, .. } = &self.mesh;
        let mut parts = word.split(|&byte| byte == b'/');
        let (v, vt, vn) = (parts.next().unwrap_or_default(), parts.next(), parts.next());
        let index = |part: &[u8], what, count| {
            resolve(part, what, count).map_err(|why| format!("corner {}: {why}", quoted(word)))
        };
        let optional = |part: Option<&[u8]>, what, count| {
            let part = part.filter(|part| !part.is_empty());
            part.map(|part| index(part, what, count)).transpose()
        };
        if parts.next().is_some() {
            return Err(format!("corner {}: it has more than three indices", quoted(word)));
        }
        Ok(Corner {
            position: index(v, "position", positions.len())?,
            texcoord: optional(vt, "texture coordinate", texcoords.len())?,
            normal: optional(vn, "normal", normals.len())?,
        })
    }

    /// Positive indices may refer to later lines of the file, so ranges are checked at its end.
    fn check_ranges(&self) -> Result<(), String> {
        let mut polygons = self.polygons.iter().peekable();
        for (number, (face, line)) in self.mesh.faces.iter().zip(&self.lines).enumerate() {
            let corners =
                polygons.next_if(|(first, _)| *first == number).map(|(_, corners)| corners);
            let mut parts =
                corners.into_iter().flat_map(|c| c.windows(3)).filter_map(polygon::face);
            let checked = self.check_range(face);
            let checked = checked.and_then(|()| parts.try_for_each(|part| self.check_range(&part)));
            checked.map_err(|what| format!("line {line}: {what}"))?;
        }
        Ok(())
    }

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

/// Accepts a keyword that is skipped.
fn unread(keyword: &[u8]) -> Result<(), String> {
    let is_in = |list: &str| list.split(' ').any(|name| name.as_bytes() == keyword);
    if keyword.starts_with(b"#") || is_in(SKIPPED) {
        return Ok(());
    }
    Err(if is_in(FREE_FORM) {
        "free-form curves and surfaces are not read; convert them to polygons".to_owned()
    } else {
        format!("{} is not a keyword that is read, which are v, vt, vn and f", quoted(keyword))
    })
}

/// Resolves an index: it counts from 1, or from -1 backwards from the last of the `count` elements
/// so far.
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
    let (numbers, count) = numbers::<6>(words, number, what)?;
    let [x, y, z, w, ..] = numbers;
    match count {
        3 | 6 => Ok(Vec3::new(x, y, z)),
        4 if w.to_bits() == 1.0f32.to_bits() => Ok(Vec3::new(x, y, z)),
        _ => Err(what.to_owned()),
    }
}

fn texcoord<'a>(words: impl Iterator<Item = &'a [u8]>) -> Result<Vec2, String> {
    let what = "texture coordinates are one to three numbers";
    match numbers(words, number, what)? {
        (_, 0) => Err(what.to_owned()),
        ([u, v, _], _) => Ok(Vec2::new(u, v)),
    }
}

/// Parses a normal, which may be zero, NaN or infinite: programs write such normals for faces
/// without area.
fn normal<'a>(words: impl Iterator<Item = &'a [u8]>) -> Result<Vec3, String> {
    let what = "a normal is three numbers";
    match numbers(words, any_float, what)? {
        (xyz, 3) => Ok(Vec3::from_array(xyz)),
        _ => Err(what.to_owned()),
    }
}

/// Parses at most `N` numbers, and returns them with their number; zeros fill the rest.
fn numbers<'a, const N: usize>(
    words: impl Iterator<Item = &'a [u8]>,
    read: fn(&[u8]) -> Result<f32, String>,
    what: &str,
) -> Result<([f32; N], usize), String> {
    let mut numbers = [0.0; N];
    let mut count = 0;
    for word in words {
        let place = numbers.get_mut(count).ok_or(what)?;
        *place = read(word).map_err(|why| format!("{why}; {what}"))?;
        count += 1;
    }
    Ok((numbers, count))
}
