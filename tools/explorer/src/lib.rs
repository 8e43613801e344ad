//! Functions of the libraries for the explorer's page.
//!
//! The page shows nothing that is not computed here, by the code that `tess` uses: patches, texts,
//! pictures, comparisons, and the shaders of `tess-gpu`. Structured answers are JSON.

mod choices;
mod comparison;
mod curiosities;
mod differences;
mod gpu;
mod marks;
mod patch;
mod surface;
mod timing;

pub use choices::{choices, factor_bits, factor_text, step_factor};
pub use comparison::{ListingFile, compare, simd};
pub use curiosities::curiosities;
pub use differences::difference_words;
pub use gpu::{GpuBatch, GpuTables, shader_sources};
pub use patch::PatchView;
pub use surface::SurfaceView;
pub use timing::{CpuBench, workload_names};

use std::fmt::Display;
use wasm_bindgen::JsError;

/// An error that a person reads, as JavaScript throws it.
fn thrown(error: impl Display) -> JsError {
    JsError::new(&error.to_string())
}

/// A document as JSON.
///
/// # Panics
/// If the document has a map whose keys are not text; none here has.
fn json(document: &impl serde::Serialize) -> String {
    serde_json::to_string(document).expect("keys are text")
}
