//! OBJ: positions, texture coordinates, normals and triangles, block by block, with the names and
//! materials of the parts.

use super::Totals;
use super::share::{Shared, Sharing};
use super::{Block, Sink};
use crate::parts::{ChannelKind, Part, Parts};
use std::io::{self, Write};

/// Writes a text file block by block.
#[derive(Debug)]
pub struct Obj<'a, W> {
    out: W,
    parts: Option<&'a Parts>,
    /// What precedes the names of material libraries: the way from the output to them.
    prefix: String,
    /// The part of the last block.
    part: Option<usize>,
    sharing: Sharing,
    /// The numbers of vertices and texture coordinates in earlier parts.
    before: [u64; 2],
}

impl<'a, W: Write> Obj<'a, W> {
    /// Begins a file. `out` should be buffered.
    pub fn new(out: W) -> Self {
        let sharing = Sharing::default();
        Self { out, parts: None, prefix: String::new(), part: None, sharing, before: [0; 2] }
    }

    /// Names objects, groups and materials. `prefix` precedes the names of material libraries; it
    /// leads from the folder of this file to that of the model.
    #[must_use]
    pub fn with_parts(self, parts: &'a Parts, prefix: &str) -> Self {
        Self { parts: Some(parts), prefix: prefix.to_owned(), ..self }
    }

    /// Ends the file.
    ///
    /// # Errors
    /// What is still buffered cannot be written.
    pub fn finish(mut self) -> io::Result<W> {
        self.out.flush()?;
        Ok(self.out)
    }

    fn described(&self, part: usize) -> Option<&'a Part> {
        self.parts?.list.get(part)
    }

    /// Writes the lines that name a part, where they differ from those of the part before.
    fn begin_part(&mut self, part: usize) -> io::Result<()> {
        let before = self.part.and_then(|part| self.described(part));
        let (Some(described), Some(parts)) = (self.described(part), self.parts) else {
            return Ok(());
        };
        let named = |of: &dyn Fn(&Part) -> Option<String>| {
            of(described).filter(|name| before.and_then(of).as_ref() != Some(name))
        };
        if let Some(object) = named(&|part| part.object.clone()) {
            writeln!(self.out, "o {object}")?;
        }
        if let Some(group) = named(&|part| part.group.clone()) {
            writeln!(self.out, "g {group}")?;
        }
        let material = |part: &Part| parts.materials.names.get(part.material?).cloned().flatten();
        if let Some(material) = named(&material) {
            writeln!(self.out, "usemtl {material}")?;
        }
        Ok(())
    }

    fn write_vertices(&mut self, block: &Block<'_>, shared: &Shared) -> io::Result<()> {
        let color = self.described(block.part).and_then(|part| {
            let kinds =
                part.channels.iter().map(|&channel| self.parts.map(|p| p.channels[channel].kind));
            let mut kinds = kinds;
            kinds.position(|kind| kind == Some(ChannelKind::Color(0)))
        });
        for &at in &shared.new {
            let vertex = &block.vertices[at as usize];
            let [x, y, z] = vertex.position.to_array();
            write!(self.out, "v {x} {y} {z}")?;
            match color.map(|color| block.channels[color][at as usize]) {
                Some([r, g, b, _]) => writeln!(self.out, " {r} {g} {b}")?,
                None => writeln!(self.out)?,
            }
            if block.has_texcoords {
                let [s, t] = vertex.texcoord.to_array();
                writeln!(self.out, "vt {s} {t}")?;
            }
            let [nx, ny, nz] = vertex.normal.to_array();
            writeln!(self.out, "vn {nx} {ny} {nz}")?;
        }
        Ok(())
    }
}

impl<W: Write> Sink for Obj<'_, W> {
    fn begin(&mut self, _: &[Totals]) -> io::Result<()> {
        let libraries = self.parts.map(|parts| &parts.materials.libraries[..]);
        for library in libraries.unwrap_or_default() {
            writeln!(self.out, "mtllib {}{library}", self.prefix)?;
        }
        Ok(())
    }

    fn block(&mut self, block: &Block<'_>) -> io::Result<()> {
        if self.part != Some(block.part) {
            let sharing = std::mem::take(&mut self.sharing);
            let had_texcoords = self.part.is_some_and(|part| {
                self.described(part).is_none_or(|described| described.has_texcoords)
            });
            self.before[0] += u64::from(sharing.count());
            self.before[1] += if had_texcoords { u64::from(sharing.count()) } else { 0 };
            self.begin_part(block.part)?;
            self.part = Some(block.part);
        }
        let shared = self.sharing.number(block);
        self.write_vertices(block, &shared)?;
        let [first, first_texcoord] = self.before;
        for triangle in block.indices.as_chunks::<3>().0 {
            let numbers = triangle.map(|index| u64::from(shared.numbers[index as usize]) + 1);
            let [a, b, c] = numbers.map(|number| first + number);
            if block.has_texcoords {
                let [s, t, u] = numbers.map(|number| first_texcoord + number);
                writeln!(self.out, "f {a}/{s}/{a} {b}/{t}/{b} {c}/{u}/{c}")?;
            } else {
                writeln!(self.out, "f {a}//{a} {b}//{b} {c}//{c}")?;
            }
        }
        Ok(())
    }
}
