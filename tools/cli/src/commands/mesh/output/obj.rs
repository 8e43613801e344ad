//! OBJ: positions, texture coordinates, normals and triangles, block after block.

use super::Block;
use super::Sink;
use crate::failure::Failure;
use crate::output::OutputFile;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// A text file that grows.
pub(super) struct Obj {
    path: PathBuf,
    file: BufWriter<OutputFile>,
}

impl Obj {
    pub(super) fn create(path: &Path) -> Result<Self, Failure> {
        let file = BufWriter::with_capacity(1 << 20, OutputFile::create(path)?);
        Ok(Self { path: path.to_owned(), file })
    }
}

fn write(file: &mut impl Write, block: &Block<'_>) -> io::Result<()> {
    for vertex in block.vertices {
        let ([x, y, z], [s, t]) = (vertex.position.to_array(), vertex.texcoord.to_array());
        let [nx, ny, nz] = vertex.normal.to_array();
        writeln!(file, "v {x} {y} {z}\nvt {s} {t}\nvn {nx} {ny} {nz}")?;
    }
    for triangle in block.indices.as_chunks::<3>().0 {
        let [a, b, c] = triangle.map(|index| block.first_vertex + u64::from(index) + 1);
        writeln!(file, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}")?;
    }
    Ok(())
}

impl Sink for Obj {
    fn block(&mut self, block: &Block<'_>) -> Result<(), Failure> {
        write(&mut self.file, block).map_err(|error| Failure::write(&self.path, error))
    }

    fn finish(self: Box<Self>) -> Result<(), Failure> {
        let file = self.file.into_inner().map_err(io::IntoInnerError::into_error);
        file.and_then(OutputFile::finish).map_err(|error| Failure::write(&self.path, error))
    }
}
