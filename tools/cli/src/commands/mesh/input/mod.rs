//! Reading models.

mod bpt;
mod gltf;
pub(crate) mod height;
mod obj;

use crate::failure::Failure;
use std::fs;
use std::path::Path;
use tess_surface::{Fault, MeshError, Model, Style, teapot};

/// Which way is up in a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Up {
    /// +y, as in glTF and most OBJ files
    Y,
    /// +z, as in Bezier patch files
    Z,
}

/// A model and what its kind of file implies.
#[derive(Debug)]
pub(crate) struct Input {
    /// The patches.
    pub(crate) model: Model,
    /// Which way is up.
    pub(crate) up: Up,
}

/// Reads a model file, or makes the teapot if there is none.
///
/// # Errors
/// A file that cannot be read, is of no known kind or is malformed; a model that cannot be
/// tessellated. The message has file and line, or file and face.
pub(crate) fn load(path: Option<&Path>, style: Option<Style>) -> Result<Input, Failure> {
    let Some(path) = path else { return embedded_teapot(style) };
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
    let polygon_style = style.unwrap_or(Style::PointNormal);
    match extension.to_ascii_lowercase().as_str() {
        "obj" => obj::load(path, polygon_style).map(|model| Input { model, up: Up::Y }),
        "gltf" | "glb" => gltf::load(path, polygon_style).map(|model| Input { model, up: Up::Y }),
        "bpt" if style.is_some() => Err(style_of_patches(&path.display().to_string())),
        "bpt" => bpt::load(path).map(|model| Input { model, up: Up::Z }),
        _ => Err(Failure::bad_input(format!(
            "cannot tell what {} is: models are .obj, .gltf, .glb or .bpt files",
            path.display()
        ))),
    }
}

fn embedded_teapot(style: Option<Style>) -> Result<Input, Failure> {
    if style.is_some() {
        return Err(style_of_patches("the teapot"));
    }
    let model = Model::bezier(teapot::patches());
    let model = model.map_err(|error| Failure::bad_input(format!("the teapot: {error}")))?;
    Ok(Input { model, up: Up::Z })
}

fn style_of_patches(what: &str) -> Failure {
    Failure::bad_input(format!(
        "--surface is for triangles and quads; {what} is made of Bezier patches"
    ))
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    fs::read(path).map_err(|error| Failure::file("read", path, &error))
}

/// The failure of a model whose faces are named by `place`, such as `line 12`.
fn refused(path: &Path, error: MeshError, place: impl Fn(usize) -> String) -> Failure {
    let file = path.display();
    Failure::bad_input(match error {
        MeshError::Face { face, fault: Fault::NonManifold { others: [a, b] } } => format!(
            "{file}: {}: an edge of this face belongs to two other faces already ({} and {}); \
             a mesh must be manifold",
            place(face),
            place(a),
            place(b)
        ),
        MeshError::Face { face, fault } => format!("{file}: {}: {fault}", place(face)),
        error => format!("{file}: {error}"),
    })
}
