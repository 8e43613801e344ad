//! OBJ files: polygons with texture coordinates, normals, colours, names and materials.
//!
//! A line is refused only if the surface needs it: a face's corner whose position is not there or
//! is not a number. Everything else that cannot be read is left out and counted: points, lines,
//! free-form surfaces, unknown keywords, faces with fewer than three corners. Texture coordinates
//! and normals that are not there are dropped later, from the faces that refer to them
//! ([`crate::repair::faces`]). Polygons of more than four corners are cut into triangles.

use crate::budget::{Budget, FACE, VERTEX};
use crate::parts::{Channel, ChannelKind, Materials, Part};
use crate::read::text::{TextLines, any_float, integer, number, quoted, without_mark, words};
use crate::repair::polygon::{self, Corner, triangles};
use crate::repair::tally::Tally;
use glam::{Vec2, Vec3};
use std::borrow::Cow;
use std::collections::BTreeMap;
use tess_surface::PolygonMesh;

/// Keywords of lines that do not affect the surface.
const SKIPPED: &str = "mg usemap maplib lod bevel c_interp d_interp shadow_obj trace_obj";

/// Keywords of free-form curves and surfaces.
const FREE_FORM: &str = "vp cstype deg bmat step curv curv2 surf parm trim hole scrv sp end con \
     ctech stech bsp bzp cdc cdp res";

/// The index of a value that is not there.
const MISSING: u32 = u32::MAX;

/// The number of lines between two reports of progress.
const REPORTED: usize = 1 << 14;

/// The contents of a file.
#[derive(Debug, Default)]
pub(crate) struct Obj {
    /// The faces of all objects and groups, with every index of a position in range.
    pub(crate) mesh: PolygonMesh,
    /// The line of each face, from 1.
    pub(crate) lines: Vec<usize>,
    /// The first face of each run with one smoothing group, and the group: 0 is none, and `None`
    /// that the file says nothing.
    pub(crate) smoothing: Vec<(usize, Option<u32>)>,
    /// The first face of each run with one part, and the part.
    pub(crate) parts: Vec<(usize, Part)>,
    /// The colours of positions, if there are any.
    pub(crate) colors: Option<Channel>,
    /// The materials, by name.
    pub(crate) materials: Materials,
    /// Notes on the parts that were cut or left out.
    pub(crate) notes: Vec<String>,
}

/// Lines that were left out or changed.
#[derive(Debug, Default)]
struct Skipped {
    lines: Tally,
    free_form: Tally,
    unknown: Tally,
    values: Tally,
    short: Tally,
}

/// A file during reading.
#[derive(Debug)]
struct Reader<'a> {
    obj: Obj,
    budget: &'a Budget,
    /// Polygons of more than four corners. `mesh` holds one triangle in place of each, with this
    /// number.
    polygons: Vec<(usize, Vec<Corner>)>,
    /// The positions that are not numbers: the number, the line and the fault of each.
    wrong: Vec<(usize, usize, String)>,
    /// The state that lines set for the faces after them.
    smoothing: Option<u32>,
    part: Part,
    /// Whether the part has changed since the last face.
    is_new_part: bool,
    /// The number of each material.
    materials: BTreeMap<String, usize>,
    skipped: Skipped,
}

/// Parses a file. `progress` gets the number of bytes that have been read. Errors: the first face
/// that needs a position which is not there.
pub(crate) fn parse(
    bytes: &[u8],
    budget: &Budget,
    progress: &dyn Fn(usize),
) -> Result<Obj, String> {
    let mut reader = Reader {
        obj: Obj::default(),
        budget,
        polygons: Vec::new(),
        wrong: Vec::new(),
        smoothing: None,
        part: Part::default(),
        is_new_part: true,
        materials: BTreeMap::new(),
        skipped: Skipped::default(),
    };
    let mut text = TextLines(without_mark(bytes));
    let mut read = 0;
    while let Some(line) = text.next() {
        let number = read + 1;
        let line = joined(line, &mut text, &mut read);
        read += 1;
        reader
            .line(number, &line)
            .map_err(|what| format!("line {number}: {}: {what}", quoted(&line)))?;
        if read % REPORTED == 0 {
            progress(bytes.len() - text.0.len());
        }
    }
    reader.check_positions()?;
    Ok(reader.finish())
}

/// A line with those that follow it, as long as each ends with a backslash that is not in a
/// comment, as at the end of a path. `read` counts them.
fn joined<'a>(line: &'a [u8], text: &mut TextLines<'a>, read: &mut usize) -> Cow<'a, [u8]> {
    let mut whole = Cow::Borrowed(line);
    while let Some(before) = whole.trim_ascii_end().strip_suffix(b"\\") {
        if words(before).any(|word| word.starts_with(b"#")) {
            break;
        }
        let mut longer = before.to_vec();
        longer.push(b' ');
        let Some(next) = text.next() else { return longer.into() };
        longer.extend(next);
        *read += 1;
        whole = longer.into();
    }
    whole
}

impl Reader<'_> {
    fn line(&mut self, number: usize, line: &[u8]) -> Result<(), String> {
        let mut words = words(line);
        let Some(keyword) = words.next() else { return Ok(()) };
        let words = words.take_while(|word| !word.starts_with(b"#"));
        let place = || format!("line {number}");
        match keyword {
            b"v" => self.position(number, line, words)?,
            b"vt" => {
                self.budget.charge(1, VERTEX, "texture coordinates")?;
                let [u, v, _] = self.values(words, 1, place);
                self.obj.mesh.texcoords.push(Vec2::new(u, v));
            }
            b"vn" => {
                self.budget.charge(1, VERTEX, "normals")?;
                // Programs write normals of zero or NaN for faces without area, so a face that
                // uses one is repaired later.
                let normal = self.values(words, 3, place);
                self.obj.mesh.normals.push(Vec3::from_array(normal));
            }
            b"f" => self.face(number, words)?,
            b"l" | b"p" => self.skipped.lines.add(place),
            b"s" => self.smoothing = smoothing(words),
            b"o" | b"g" | b"usemtl" | b"mtllib" => self.name(keyword, line)?,
            _ => self.unread(keyword, place),
        }
        Ok(())
    }

    /// The numbers of a line; those that are missing are 0, as is the second texture coordinate, or
    /// NaN if fewer than `least` are there or one cannot be read.
    fn values<'a>(
        &mut self,
        words: impl Iterator<Item = &'a [u8]>,
        least: usize,
        place: impl FnOnce() -> String,
    ) -> [f32; 3] {
        let mut values = [0.0; 3];
        let mut count = 0;
        let mut is_right = true;
        for (value, word) in values.iter_mut().zip(words) {
            match any_float(word) {
                Ok(number) => *value = number,
                Err(_) => is_right = false,
            }
            count += 1;
        }
        if is_right && count >= least {
            return values;
        }
        self.skipped.values.add(place);
        [f32::NAN; 3]
    }

    /// Reads `v x y z`, which a weight or a colour may follow. Weights are for free-form surfaces.
    fn position<'a>(
        &mut self,
        line: usize,
        text: &[u8],
        words: impl Iterator<Item = &'a [u8]>,
    ) -> Result<(), String> {
        self.budget.charge(1, VERTEX, "positions")?;
        let what = "a position is three numbers";
        let at = self.obj.mesh.positions.len();
        let mut values = [f32::NAN; 7];
        let mut count = 0;
        let mut fault = None;
        for word in words {
            let Some(value) = values.get_mut(count) else { break };
            match number(word) {
                Ok(number) => *value = number,
                Err(why) if count < 3 => fault = Some(format!("{why}; {what}")),
                Err(_) => {}
            }
            count += 1;
        }
        let [x, y, z, a, b, c, d] = values;
        if count < 3 {
            fault = Some(what.to_owned());
        }
        if let Some(fault) = fault {
            self.budget.charge(1, 256, "positions that are not numbers")?;
            self.wrong.push((at, line, format!("{}: {fault}", quoted(text))));
        }
        self.obj.mesh.positions.push(Vec3::new(x, y, z));
        match count {
            6 => self.color(at, [a, b, c, 1.0]),
            7 => self.color(at, [a, b, c, d]),
            _ => Ok(()),
        }
    }

    fn color(&mut self, position: usize, color: [f32; 4]) -> Result<(), String> {
        // A colour that is not a number colours nothing.
        if !color.iter().all(|number| number.is_finite()) {
            return Ok(());
        }
        let kind = ChannelKind::Color(0);
        let channel = self.obj.colors.get_or_insert(Channel { kind, values: Vec::new() });
        let more = (position + 1 - channel.values.len()) as u64;
        self.budget.charge(more, 16, "colours")?;
        channel.values.resize(position, kind.default_value());
        channel.values.push(color);
        Ok(())
    }

    fn face<'a>(
        &mut self,
        line: usize,
        words: impl Iterator<Item = &'a [u8]>,
    ) -> Result<(), String> {
        let mut few = [Corner::default(); 4];
        let mut more = Vec::new();
        let mut count = 0;
        for word in words {
            let corner = self.corner(word)?;
            match few.get_mut(count) {
                Some(place) => *place = corner,
                None => {
                    self.budget.charge(1, FACE, "corners")?;
                    if more.is_empty() {
                        more.extend(few);
                    }
                    more.push(corner);
                }
            }
            count += 1;
        }
        if count < 3 {
            self.skipped.short.add(|| format!("line {line}"));
            return Ok(());
        }
        self.budget.charge(1, FACE, "faces")?;
        let corners = if more.is_empty() { &mut few[..count] } else { &mut more[..] };
        complete(corners);
        let whole = if count > 4 { &corners[..3] } else { corners };
        let face = polygon::face(whole).ok_or("a face of three or four corners")?;
        let number = self.obj.mesh.faces.len();
        if count > 4 {
            self.polygons.push((number, more));
        }
        if self.obj.smoothing.last().is_none_or(|&(_, last)| last != self.smoothing) {
            self.obj.smoothing.push((number, self.smoothing));
        }
        if std::mem::take(&mut self.is_new_part) {
            self.budget.charge(1, 256, "parts")?;
            self.obj.parts.push((number, self.part.clone()));
        }
        self.obj.mesh.faces.push(face);
        self.obj.lines.push(line);
        Ok(())
    }

    /// Parses a corner: `v`, `v/vt`, `v//vn` or `v/vt/vn`. An empty index counts as missing, as in
    /// `v/` and `v/vt/`. Only the position is needed.
    fn corner(&self, word: &[u8]) -> Result<Corner, String> {
        let PolygonMesh { positions, texcoords, normals, .. } = &self.obj.mesh;
        let mut parts = word.split(|&byte| byte == b'/');
        let (v, vt, vn) = (parts.next().unwrap_or_default(), parts.next(), parts.next());
        let optional = |part: Option<&[u8]>, what, count| {
            let part = part.filter(|part| !part.is_empty());
            part.map(|part| resolve(part, what, count).unwrap_or(MISSING))
        };
        if parts.next().is_some() {
            return Err(format!("corner {}: it has more than three indices", quoted(word)));
        }
        let position = resolve(v, "position", positions.len());
        Ok(Corner {
            position: position.map_err(|why| format!("corner {}: {why}", quoted(word)))?,
            texcoord: optional(vt, "texture coordinate", texcoords.len()),
            normal: optional(vn, "normal", normals.len()),
        })
    }

    /// A name of the faces that follow: the rest of the line.
    fn name(&mut self, keyword: &[u8], line: &[u8]) -> Result<(), String> {
        let rest = line.trim_ascii_start().get(keyword.len()..).unwrap_or_default();
        let comment =
            rest.windows(2).position(|pair| pair[0].is_ascii_whitespace() && pair[1] == b'#');
        let rest = &rest[..comment.unwrap_or(rest.len())];
        let name = String::from_utf8_lossy(rest.trim_ascii()).into_owned();
        self.budget.charge(1, 128 + name.len() as u64, "names")?;
        self.is_new_part = true;
        let named = Some(name).filter(|name| !name.is_empty());
        match keyword {
            b"o" => self.part.object = named,
            b"g" => self.part.group = named,
            b"usemtl" => self.part.material = named.map(|name| self.material(name)),
            _ => self.obj.materials.libraries.extend(named),
        }
        Ok(())
    }

    /// The number of a material.
    fn material(&mut self, name: String) -> usize {
        let names = &mut self.obj.materials.names;
        *self.materials.entry(name).or_insert_with_key(|name| {
            names.push(Some(name.clone()));
            names.len() - 1
        })
    }

    /// Counts a keyword that is not read.
    fn unread(&mut self, keyword: &[u8], place: impl FnOnce() -> String) {
        let is_in = |list: &str| list.split(' ').any(|name| name.as_bytes() == keyword);
        if is_in(FREE_FORM) {
            self.skipped.free_form.add(place);
        } else if !keyword.starts_with(b"#") && !is_in(SKIPPED) {
            self.skipped.unknown.add(|| format!("{}, {}", quoted(keyword), place()));
        }
    }

    /// Positive indices may refer to later lines of the file, so positions are checked at its end.
    fn check_positions(&self) -> Result<(), String> {
        let mut polygons = self.polygons.iter().peekable();
        let count = self.obj.mesh.positions.len();
        for (number, (face, line)) in self.obj.mesh.faces.iter().zip(&self.obj.lines).enumerate() {
            let polygon = polygons.next_if(|(first, _)| *first == number);
            let more = polygon.iter().flat_map(|(_, corners)| corners).map(|c| c.position);
            for index in face.positions.as_slice().iter().copied().chain(more) {
                let at = index as usize;
                if at >= count {
                    let index = u64::from(index) + 1;
                    return Err(format!(
                        "line {line}: position index {index} is out of range: there are {count}"
                    ));
                }
                if let Ok(found) = self.wrong.binary_search_by_key(&at, |(number, ..)| *number) {
                    let (_, of_position, fault) = &self.wrong[found];
                    return Err(format!("line {of_position}: {fault}; line {line} uses it"));
                }
            }
        }
        Ok(())
    }

    /// The contents, with each polygon's placeholder replaced by its triangles.
    fn finish(self) -> Obj {
        let Self { mut obj, polygons, skipped, .. } = self;
        if let Some(colors) = &mut obj.colors {
            colors.values.resize(obj.mesh.positions.len(), colors.kind.default_value());
        }
        let (mut cut, mut crossed) = (Tally::default(), Tally::default());
        if !polygons.is_empty() {
            let (mut faces, mut lines) = (Vec::new(), Vec::new());
            let mut firsts = Vec::with_capacity(obj.mesh.faces.len());
            let mut polygons = polygons.into_iter().peekable();
            for (number, (face, &line)) in obj.mesh.faces.iter().zip(&obj.lines).enumerate() {
                firsts.push(faces.len());
                match polygons.next_if(|&(first, _)| first == number) {
                    Some((_, corners)) => {
                        let triangles = triangles(&corners, &obj.mesh.positions);
                        let tally = if triangles.is_crossed { &mut crossed } else { &mut cut };
                        tally.add(|| format!("line {line}"));
                        faces.extend(triangles.faces);
                    }
                    None => faces.push(*face),
                }
                lines.resize(faces.len(), line);
            }
            obj.smoothing.iter_mut().for_each(|(first, _)| *first = firsts[*first]);
            obj.parts.iter_mut().for_each(|(first, _)| *first = firsts[*first]);
            (obj.mesh.faces, obj.lines) = (faces, lines);
        }
        let rest = " of more than four corners";
        let done = "cut into triangles";
        obj.notes.extend(cut.note("polygon", rest, done));
        let done = "cut into triangles around its first corner, as it has no inside";
        obj.notes.extend(crossed.note("polygon", " that crosses itself", done));
        obj.notes.extend(skipped.notes());
        obj
    }
}

impl Skipped {
    fn notes(&self) -> impl Iterator<Item = String> {
        let free = "left out; convert free-form curves and surfaces to polygons";
        let notes = [
            self.lines.note("`l` or `p` line", "", "left out, as points and lines have no surface"),
            self.free_form.note("line", " of free-form curves or surfaces", free),
            self.unknown.note("line", " with a keyword that is not known", "left out"),
            self.values.note("`vt` or `vn` line", " that is not numbers", "not used"),
            self.short.note("face", " with fewer than three corners", "left out"),
        ];
        notes.into_iter().flatten()
    }
}

/// Marks the values of corners that lack a kind which other corners of the face have.
fn complete(corners: &mut [Corner]) {
    let has_texcoord = corners.iter().any(|corner| corner.texcoord.is_some());
    let has_normal = corners.iter().any(|corner| corner.normal.is_some());
    for corner in corners {
        corner.texcoord = corner.texcoord.or(has_texcoord.then_some(MISSING));
        corner.normal = corner.normal.or(has_normal.then_some(MISSING));
    }
}

/// A smoothing group; `off` is 0. A line that cannot be read says nothing.
fn smoothing<'a>(mut words: impl Iterator<Item = &'a [u8]>) -> Option<u32> {
    match words.next() {
        Some(b"off") => Some(0),
        Some(b"on") => Some(1),
        Some(word) => integer(word).and_then(|number| u32::try_from(number).ok()),
        None => None,
    }
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
