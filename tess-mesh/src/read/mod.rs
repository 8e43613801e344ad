//! Readers of files: each takes the bytes, and returns their contents or the fault and its place.

pub(crate) mod beside;
pub(crate) mod bpt;
pub(crate) mod gltf;
pub(crate) mod mtl;
pub(crate) mod obj;
pub(crate) mod text;
