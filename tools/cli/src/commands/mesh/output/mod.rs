//! The destination of the result: a mesh or a picture that exists whole or not at all.

mod binary;
mod glb;
mod gltf;
mod obj;
mod picture;
mod raster;

use super::input::Up;
use super::view::CameraView;
use crate::failure::Failure;
use crate::output::OutputFile;
use crate::output::form::FileForm;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};
use tess_surface::Sample;

/// Part of the result.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MeshBlock<'a> {
    /// The number of vertices in earlier blocks.
    pub(crate) first_vertex: u64,
    /// The vertices.
    pub(crate) vertices: &'a [Sample],
    /// Three indices per triangle, counted from this block's first vertex.
    pub(crate) indices: &'a [u32],
}

/// The size of the result.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Totals {
    /// The number of vertices in all blocks.
    pub(crate) vertices: u64,
    /// The number of indices, three per triangle.
    pub(crate) indices: u64,
}

/// Takes the result block by block. Errors: the output cannot be written, or the format cannot hold
/// this much.
trait Sink {
    /// Takes the size of the result, before the first block.
    fn begin(&mut self, _totals: Totals) -> io::Result<()> {
        Ok(())
    }

    /// The next vertices and triangles.
    fn block(&mut self, block: &MeshBlock<'_>) -> io::Result<()>;

    /// Ends the output and moves it into its place. After an error the place is as it was before.
    fn finish(self: Box<Self>) -> io::Result<()>;
}

/// An output whose errors name its file.
pub(crate) struct MeshFile {
    path: PathBuf,
    sink: Box<dyn Sink>,
}

impl MeshFile {
    /// Begins an output. Errors: a place that cannot be written to.
    pub(crate) fn open(path: &Path, form: ResultForm, options: &Options) -> Result<Self, Failure> {
        let sink: Box<dyn Sink> = match form {
            ResultForm::Obj => {
                Box::new(obj::Obj(BufWriter::with_capacity(1 << 20, OutputFile::create(path)?)))
            }
            ResultForm::Gltf => Box::new(gltf::create(path, options)?),
            ResultForm::Glb => Box::new(glb::create(path, options)?),
            ResultForm::Png => Box::new(picture::PngPicture::create(path, options)?),
        };
        Ok(Self { path: path.to_owned(), sink })
    }

    pub(crate) fn begin(&mut self, totals: Totals) -> Result<(), Failure> {
        self.sink.begin(totals).map_err(|error| Failure::write(&self.path, error))
    }

    pub(crate) fn block(&mut self, block: &MeshBlock<'_>) -> Result<(), Failure> {
        self.sink.block(block).map_err(|error| Failure::write(&self.path, error))
    }

    pub(crate) fn finish(self) -> Result<(), Failure> {
        self.sink.finish().map_err(|error| Failure::write(&self.path, error))
    }
}

/// The width of indices in glTF.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum IndexWidth {
    /// 16 bits if all vertices can be numbered with them, else 32
    Auto,
    /// 16 bits: at most 65535 vertices
    #[value(name = "16")]
    Bits16,
    /// 32 bits
    #[value(name = "32")]
    Bits32,
}

/// Options for writing the result.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Options {
    /// The direction that is up in the model.
    pub(crate) up: Up,
    /// The width of indices in glTF.
    pub(crate) indices: IndexWidth,
    /// The camera of pictures.
    pub(crate) view: CameraView,
    /// Whether pictures show the triangles' edges.
    pub(crate) wireframe: bool,
}

/// The formats of the result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum ResultForm {
    /// A mesh as text
    Obj,
    /// A mesh in two files: JSON, and its binary part
    Gltf,
    /// A mesh in one binary file
    Glb,
    /// A picture
    Png,
}

impl FileForm for ResultForm {
    const DEFAULT: Option<Self> = None;
}

impl ResultForm {
    /// Whether it is text, which a terminal can show.
    pub(crate) const fn is_text(self) -> bool {
        matches!(self, Self::Obj)
    }
}

/// The second file of a format that has two: the binary part of glTF.
pub(crate) fn part_beside(path: &Path, form: ResultForm) -> Option<PathBuf> {
    (form == ResultForm::Gltf).then(|| path.with_extension("bin"))
}
