//! The SPIR-V of the shaders, compiled from the GLSL next to it in `shaders/`.

/// The SPIR-V as words.
///
/// # Panics
/// If the length is not a whole number of words.
pub(crate) fn words(bytes: &[u8]) -> Vec<u32> {
    let (words, rest) = bytes.as_chunks();
    assert!(rest.is_empty(), "SPIR-V has whole words");
    words.iter().map(|word| u32::from_le_bytes(*word)).collect()
}

macro_rules! shader {
    ($name:literal) => {
        include_bytes!(concat!("../shaders/", $name, ".spv"))
    };
}

pub(crate) const EMPTY_VERT: &[u8] = shader!("empty.vert");
pub(crate) const FACTORS_TESC: &[u8] = shader!("factors.tesc");
pub(crate) const CAPTURE_TESE: &[u8] = shader!("capture.tese");
pub(crate) const POINTS_TESE: &[u8] = shader!("points.tese");
pub(crate) const EVALUATE_TESE: &[u8] = shader!("evaluate.tese");
pub(crate) const EVALUATE_VERT: &[u8] = shader!("evaluate.vert");
pub(crate) const FLAT_FRAG: &[u8] = shader!("flat.frag");
