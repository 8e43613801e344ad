//! glTF in two files: the JSON, and the binary part beside it with the extension `.bin`.

use super::binary::Binary;
use super::{Options, Sink, partial, persist};
use crate::commands::mesh::pipeline::Block;
use crate::failure::Failure;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// The binary part while it grows.
pub(super) struct Gltf {
    path: PathBuf,
    binary: Binary<NamedTempFile>,
}

impl Gltf {
    pub(super) fn create(path: &Path, options: &Options) -> Result<Self, Failure> {
        let binary = Binary::new(partial(path)?, options);
        let binary = binary.map_err(|error| Failure::file("write", path, &error))?;
        Ok(Self { path: path.to_owned(), binary })
    }
}

impl Sink for Gltf {
    fn block(&mut self, block: &Block<'_>) -> Result<(), Failure> {
        self.binary.block(block).map_err(|error| Failure::file("write", &self.path, &error))
    }

    fn finish(self: Box<Self>) -> Result<(), Failure> {
        let Self { path, binary } = *self;
        let failure = |error: io::Error| Failure::file("write", &path, &error);
        let beside = path.with_extension("bin");
        let layout = binary.layout();
        let uri = beside.file_name().unwrap_or_default().to_string_lossy().replace(' ', "%20");
        let mut json = partial(&path)?;
        let document = crate::output::json(&layout.document(Some(&uri)));
        json.write_all(document.as_bytes()).map_err(failure)?;
        let binary = binary.finish(&layout).map_err(failure)?;
        persist(binary, &beside)?;
        persist(json, &path)
    }
}
