//! The readers of mesh files, on any bytes: they refuse a file and name the place of the fault, or
//! their result equals that of an independent reader.

pub mod height_png;
#[path = "../../tess-mesh/tests/naive/mod.rs"]
mod naive;
pub mod seeds;

/// Compares an OBJ file. Errors: the first difference, or a message that names no line.
pub fn obj(data: &[u8]) -> Result<(), String> {
    naive::obj::check(data)
}

/// Compares a glTF file. Errors: the first difference, or a message that names no place.
pub fn gltf(data: &[u8]) -> Result<(), String> {
    naive::gltf::check(data)
}

/// Compares a Bezier patch file. Errors: the first difference, or a message that names no line.
pub fn bpt(data: &[u8]) -> Result<(), String> {
    naive::bpt::check(data)
}
