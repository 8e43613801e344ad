//! OBJ: positions, texture coordinates, normals and triangles, block by block.

use super::MeshBlock;
use super::Sink;
use crate::output::OutputFile;
use std::io::{self, BufWriter, Write};

/// A text file that grows block by block.
pub(super) struct Obj(pub(super) BufWriter<OutputFile>);

impl Sink for Obj {
    fn block(&mut self, block: &MeshBlock<'_>) -> io::Result<()> {
        for vertex in block.vertices {
            let ([x, y, z], [s, t]) = (vertex.position.to_array(), vertex.texcoord.to_array());
            let [nx, ny, nz] = vertex.normal.to_array();
            writeln!(self.0, "v {x} {y} {z}\nvt {s} {t}\nvn {nx} {ny} {nz}")?;
        }
        for triangle in block.indices.as_chunks::<3>().0 {
            let [a, b, c] = triangle.map(|index| block.first_vertex + u64::from(index) + 1);
            writeln!(self.0, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}")?;
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        self.0.into_inner().map_err(io::IntoInnerError::into_error)?.finish()
    }
}
