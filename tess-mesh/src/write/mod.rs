//! Writers of meshes: OBJ, GLB, and glTF in two files.

mod binary;
mod glb;
mod gltf;
mod obj;
mod share;

use crate::load::Up;
use crate::parts::Parts;
pub use crate::uri::uri_of;
pub use glb::Glb;
pub use gltf::Gltf;
pub use obj::Obj;
use std::fs::File;
use std::io;
use tess_surface::Sample;

/// The size of a result.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Totals {
    /// The number of vertices in all blocks.
    pub vertices: u64,
    /// The number of indices, three per triangle.
    pub indices: u64,
}

/// Some patches of a result.
#[derive(Clone, Copy, Debug)]
pub struct Block<'a> {
    /// The number of the part that the patches belong to. Parts come one after the other.
    pub part: usize,
    /// The vertices.
    pub vertices: &'a [Sample],
    /// Whether the part has texture coordinates.
    pub has_texcoords: bool,
    /// The values of the part's channels, one for each vertex.
    pub channels: &'a [Vec<[f32; 4]>],
    /// Whether each vertex is on the border of its patch, where other patches may have it too.
    pub is_border: &'a [bool],
    /// Three indices per triangle, counted from this block's first vertex.
    pub indices: &'a [u32],
}

/// Takes a result block by block.
pub trait Sink {
    /// Takes the size of each part, before the first block. Writers that share vertices write
    /// fewer.
    ///
    /// # Errors
    /// The format cannot hold this much.
    fn begin(&mut self, parts: &[Totals]) -> io::Result<()>;

    /// Takes the next vertices and triangles.
    ///
    /// # Errors
    /// The output cannot be written.
    fn block(&mut self, block: &Block<'_>) -> io::Result<()>;
}

/// Options for writing glTF.
#[derive(Clone, Copy, Debug)]
pub struct GltfOptions<'a> {
    /// The direction that is up in the model; in glTF it is y.
    pub up: Up,
    /// The width of indices.
    pub indices: IndexWidth,
    /// Names, materials and further values.
    pub parts: Option<&'a Parts>,
    /// What precedes the references to images: it leads from the folder of the output to that of
    /// the model.
    pub image_prefix: &'a str,
}

impl GltfOptions<'_> {
    /// The number of bytes that the binary part cannot exceed.
    #[must_use]
    pub fn most_bytes(&self, totals: Totals) -> u64 {
        let channels = self.parts.iter().flat_map(|parts| &parts.channels);
        let stride: u64 = channels.map(|channel| 4 * channel.kind.components() as u64).sum();
        let images = self.parts.iter().flat_map(|parts| &parts.materials.images);
        let images: u64 = images.map(|(_, bytes)| bytes.len() as u64 + 4).sum();
        let wide = totals.vertices > 65535 || self.indices == IndexWidth::Bits32;
        let index = if wide { 4 } else { 2 };
        // The indices of each part, and the end, are padded to four bytes.
        let parts = self.parts.map_or(1, |parts| parts.list.len().max(1)) as u64;
        totals.vertices * (32 + stride) + totals.indices * index + images + 4 * (parts + 1)
    }
}

/// An output whose parts can be written in any order, from any thread.
pub trait WriteAt: Sync {
    /// Writes all bytes at an offset from the beginning.
    ///
    /// # Errors
    /// They cannot be written.
    fn write_at(&self, bytes: &[u8], offset: u64) -> io::Result<()>;
}

impl WriteAt for File {
    #[cfg(unix)]
    fn write_at(&self, bytes: &[u8], offset: u64) -> io::Result<()> {
        std::os::unix::fs::FileExt::write_all_at(self, bytes, offset)
    }

    #[cfg(windows)]
    fn write_at(&self, mut bytes: &[u8], mut offset: u64) -> io::Result<()> {
        while !bytes.is_empty() {
            let written = std::os::windows::fs::FileExt::seek_write(self, bytes, offset)?;
            if written == 0 {
                return Err(io::ErrorKind::WriteZero.into());
            }
            (bytes, offset) = (&bytes[written..], offset + written as u64);
        }
        Ok(())
    }
}

/// The width of indices in glTF.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum IndexWidth {
    /// 16 bits for parts whose vertices can be numbered with them, counted before they are shared;
    /// else 32.
    #[default]
    Auto,
    /// 16 bits: at most 65535 vertices.
    Bits16,
    /// 32 bits.
    Bits32,
}
