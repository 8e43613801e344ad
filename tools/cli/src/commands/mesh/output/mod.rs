//! Where the result goes: a mesh or a picture, there whole or not at all.

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
    /// How many vertices came before.
    pub(crate) first_vertex: u64,
    /// The vertices.
    pub(crate) vertices: &'a [Sample],
    /// Three numbers for each triangle, counted from this block's first vertex.
    pub(crate) indices: &'a [u32],
}

/// How much there will be.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Totals {
    /// Vertices of all blocks.
    pub(crate) vertices: u64,
    /// Three for each triangle.
    pub(crate) indices: u64,
}

/// Takes the result block by block. Errors: the output cannot be written, or the form cannot hold
/// so much.
trait Sink {
    /// Takes how much there will be, before the first block.
    fn begin(&mut self, _totals: Totals) -> io::Result<()> {
        Ok(())
    }

    /// The next vertices and triangles.
    fn block(&mut self, block: &MeshBlock<'_>) -> io::Result<()>;

    /// Ends the output and puts it in its place; after an error nothing is there, or what was there
    /// before.
    fn finish(self: Box<Self>) -> io::Result<()>;
}

/// The output, whose errors name its file.
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

/// Width of the indices in glTF.
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

/// How the result is written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Options {
    /// Which way is up in the model.
    pub(crate) up: Up,
    /// Width of the indices in glTF.
    pub(crate) indices: IndexWidth,
    /// The camera of pictures.
    pub(crate) view: CameraView,
    /// Whether pictures show the triangles' edges.
    pub(crate) wireframe: bool,
}

/// The forms of the result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum ResultForm {
    /// A mesh as text
    Obj,
    /// A mesh in two files: JSON, and the binary part beside it
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

/// The second file of a form that has two: the binary part of glTF.
pub(crate) fn part_beside(path: &Path, form: ResultForm) -> Option<PathBuf> {
    (form == ResultForm::Gltf).then(|| path.with_extension("bin"))
}
