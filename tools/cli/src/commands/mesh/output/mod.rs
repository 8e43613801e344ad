//! The destination of the result: a mesh or a picture that exists whole or not at all.

mod gltf;
mod picture;
mod raster;

use super::view::CameraView;
use crate::failure::Failure;
use crate::output::OutputFile;
use crate::output::form::FileForm;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};
use tess_mesh::parts::{Channel, ChannelKind, Parts};
use tess_mesh::write::{Glb, Gltf, GltfOptions, Obj, Sink, WriteAt};

/// An output in one of the forms.
pub(crate) struct MeshFile<'a> {
    path: PathBuf,
    form: Form<'a>,
}

enum Form<'a> {
    Obj(Obj<'a, BufWriter<OutputFile>>),
    Gltf(Gltf<'a, OutputFile, OutputFile>),
    Glb(Glb<'a, OutputFile>),
    Png(Box<picture::PngPicture>),
}

impl<'a> MeshFile<'a> {
    /// Begins an output. Errors: a place that cannot be written to.
    pub(crate) fn open(
        path: &Path,
        form: ResultForm,
        options: &Options<'a>,
    ) -> Result<Self, Failure> {
        let form = match form {
            ResultForm::Obj => {
                let file = BufWriter::with_capacity(1 << 20, OutputFile::create(path)?);
                let obj = Obj::new(file);
                Form::Obj(match options.gltf.parts {
                    Some(parts) => obj.with_parts(parts, options.prefix),
                    None => obj,
                })
            }
            ResultForm::Gltf => Form::Gltf(gltf::create(path, options.gltf)?),
            ResultForm::Glb => Form::Glb(Glb::new(OutputFile::create(path)?, options.gltf)),
            ResultForm::Png => Form::Png(Box::new(picture::PngPicture::create(path, options)?)),
        };
        Ok(Self { path: path.to_owned(), form })
    }

    /// What takes the blocks.
    pub(crate) fn sink(&mut self) -> &mut (dyn Sink + 'a) {
        match &mut self.form {
            Form::Obj(obj) => obj,
            Form::Gltf(gltf) => gltf,
            Form::Glb(glb) => glb,
            Form::Png(picture) => &mut **picture,
        }
    }

    /// Ends the output and moves it into its place. After an error the place is as it was before.
    pub(crate) fn finish(self) -> Result<(), Failure> {
        let Self { path, form } = self;
        let finish = || match form {
            Form::Obj(obj) => {
                let file = obj.finish()?.into_inner().map_err(io::IntoInnerError::into_error)?;
                file.finish()
            }
            Form::Gltf(gltf) => {
                let (json, binary) = gltf.finish()?;
                binary.finish()?;
                json.finish()
            }
            Form::Glb(glb) => glb.finish()?.finish(),
            Form::Png(picture) => picture.finish(),
        };
        finish().map_err(|error| Failure::write(&path, error))
    }
}

impl WriteAt for OutputFile {
    fn write_at(&self, bytes: &[u8], offset: u64) -> io::Result<()> {
        self.file().write_at(bytes, offset)
    }
}

/// Options for writing the result.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Options<'a> {
    /// The camera of pictures.
    pub(crate) view: CameraView,
    /// Whether pictures show the triangles' edges.
    pub(crate) wireframe: bool,
    /// The way from the output's folder to the model's.
    pub(crate) prefix: &'a str,
    /// The options of glTF.
    pub(crate) gltf: GltfOptions<'a>,
}

/// Notes on what the format of the result cannot keep.
pub(crate) fn notes_of_losses(form: ResultForm, parts: &Parts) -> impl Iterator<Item = String> {
    let materials = &parts.materials;
    let is_obj = form == ResultForm::Obj;
    let has_more = |channel: &Channel| channel.kind != ChannelKind::Color(0);
    let kept = parts.list.iter().any(|part| part.material.is_some());
    let notes = [
        (is_obj && kept && materials.libraries.is_empty() && !materials.document.is_empty()).then(
            || "materials: OBJ keeps only their names; .gltf and .glb keep them whole".to_owned(),
        ),
        (is_obj && parts.channels.iter().any(has_more)).then(|| {
            "tangents and further texture coordinates and colours: OBJ has none; .gltf and .glb \
             keep them"
                .to_owned()
        }),
    ];
    let is_gltf = matches!(form, ResultForm::Gltf | ResultForm::Glb);
    let of_libraries = materials.losses.iter().filter(move |_| is_gltf).cloned();
    notes.into_iter().flatten().chain(of_libraries)
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
