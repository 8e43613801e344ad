//! Where the result goes: a mesh or a picture, there whole or not at all.

mod binary;
mod glb;
mod gltf;
mod obj;
mod picture;
mod raster;

use super::input::Up;
use super::pipeline::Block;
use super::view::View;
use crate::failure::Failure;
use std::path::Path;
use tempfile::{Builder, NamedTempFile};

/// Takes the result block by block.
pub(crate) trait Sink {
    /// The next vertices and triangles.
    ///
    /// # Errors
    /// The output cannot be written, or the form cannot hold so much.
    fn block(&mut self, block: &Block<'_>) -> Result<(), Failure>;

    /// Ends the output and puts it in its place.
    ///
    /// # Errors
    /// As for [`Sink::block`]; then nothing is there, or what was there before.
    fn finish(self: Box<Self>) -> Result<(), Failure>;
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
    pub(crate) view: View,
    /// Whether pictures show the triangles' edges.
    pub(crate) wireframe: bool,
}

/// The sink for a file, by its extension.
///
/// # Errors
/// An extension that is no known form; a folder that cannot be written to.
pub(crate) fn open(path: &Path, options: &Options) -> Result<Box<dyn Sink>, Failure> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
    Ok(match extension.to_ascii_lowercase().as_str() {
        "obj" => Box::new(obj::Obj::create(path)?),
        "gltf" => Box::new(gltf::Gltf::create(path, options)?),
        "glb" => Box::new(glb::Glb::create(path, options)?),
        "png" => Box::new(picture::Picture::create(path, options)?),
        _ => {
            return Err(Failure::bad_input(format!(
                "cannot tell what to write to {}: meshes are .obj, .gltf or .glb files, \
                 pictures .png",
                path.display()
            )));
        }
    })
}

/// A file beside the output that becomes it when it is whole.
fn partial(path: &Path) -> Result<NamedTempFile, Failure> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut builder = Builder::new();
    // The permissions of ordinary files, less the user's mask.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let file = builder.prefix(".tess-").tempfile_in(folder);
    file.map_err(|error| Failure::file("write", path, &error))
}

/// Puts a whole file in its place.
fn persist(file: NamedTempFile, path: &Path) -> Result<(), Failure> {
    let persisted = file.persist(path);
    persisted.map(drop).map_err(|error| Failure::file("write", path, &error.error))
}
