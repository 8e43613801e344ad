//! The tessellation stage in a browser: a page calls `draw_terrain`, and nothing in it blocks.
#![cfg(target_arch = "wasm32")]

mod terrain;

use std::fmt::Display;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_wgpu::{Gpu, TessellationStage};
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

/// Output of the stage.
#[wasm_bindgen]
#[derive(Debug)]
pub struct StageReport {
    /// Frames until everything fitted.
    pub frames: u32,
    /// Scale of the factors in the first frame, whose room was too little.
    pub first_scale: f32,
    /// Points of the last frame.
    pub points: u32,
    /// Triangles of the last frame.
    pub triangles: u32,
    difference: String,
    pixels: Vec<u8>,
}

#[wasm_bindgen]
impl StageReport {
    /// The first difference between what the stage stored and the model; nothing if every bit is
    /// equal.
    pub fn difference(&self) -> String {
        self.difference.clone()
    }

    /// The picture, RGBA, 256 by 256.
    pub fn pixels(&self) -> Vec<u8> {
        self.pixels.clone()
    }
}

/// Draws frames of a displaced terrain until the stage has room for it.
///
/// `wgsl_fault` is put in front of the user's WGSL; with `is_wrong` the model is asked about other
/// factors, as a planted fault.
///
/// # Errors
/// The stage's error, in words.
#[wasm_bindgen]
pub async fn draw_terrain(wgsl_fault: String, is_wrong: bool) -> Result<StageReport, JsError> {
    let gpu = Gpu::open().await.map_err(thrown)?;
    let source = wgsl_fault + terrain::WGSL;
    let stage = TessellationStage::builder(&source, Domain::Quad, config(), terrain::PATCHES)
        .order(tess_gpu::Order::Specification)
        .build_async(&gpu.device)
        .await
        .map_err(thrown)?;
    let material = stage.material(&source).target(terrain::FORMAT).build_async();
    let material = material.await.map_err(thrown)?;
    terrain::draw(&gpu, (stage, material), is_wrong).await.map_err(thrown)
}

const fn config() -> Config {
    Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw)
}

/// An error that a person reads, as JavaScript throws it.
fn thrown(error: impl Display) -> JsError {
    JsError::new(&error.to_string())
}
