//! Tessellates on the CPU for a geometry of three.js whose renderer draws with WebGL 2.
#![cfg(target_arch = "wasm32")]

use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_simd::{Numbering, Output, Tessellator};
use tess_verify::Named;
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

/// Points and indices of a batch.
#[wasm_bindgen]
#[derive(Debug)]
pub struct CpuOutput {
    positions: Vec<f32>,
    indices: Vec<u32>,
}

#[wasm_bindgen]
impl CpuOutput {
    /// u, v and the patch's number of each point.
    pub fn positions(&self) -> Vec<f32> {
        self.positions.clone()
    }

    /// The indices of lines or clockwise triangles, from the batch's first point.
    pub fn indices(&self) -> Vec<u32> {
        self.indices.clone()
    }
}

/// Tessellates patches with these factors, one patch after another.
///
/// # Errors
/// An unknown name; factors that are not whole patches; an output that is too large.
#[wasm_bindgen]
pub fn tessellate(domain: &str, partitioning: &str, factors: &[f32]) -> Result<CpuOutput, JsError> {
    let (domain, partitioning) =
        (Domain::from_name(domain)?, Partitioning::from_name(partitioning)?);
    let output = match domain {
        Domain::Isoline => OutputPrimitive::Line,
        Domain::Triangle | Domain::Quad => OutputPrimitive::TriangleCw,
    };
    let each = domain.factors();
    let patches: Option<Vec<_>> =
        factors.chunks(each).map(|patch| PatchFactors::from_slice(domain, patch)).collect();
    let patches = patches.ok_or_else(|| {
        JsError::new(&format!("{} factors; a patch of this domain has {each}", factors.len()))
    })?;
    let mut output_of: Output<[f32; 2], u32> = Output::new();
    let numbering = Numbering::PerBatch { base_vertex: 0 };
    Tessellator::new(Config::new(partitioning, output)).tessellate(
        &patches[..],
        numbering,
        &mut output_of,
    )?;
    let mut positions = Vec::new();
    for number in 0..patches.len() {
        let Some((points, _)) = output_of.patch(number) else { continue };
        positions.extend(points.iter().flat_map(|&[u, v]| [u, v, float(number)]));
    }
    Ok(CpuOutput { positions, indices: output_of.indices().to_vec() })
}

/// The number of a patch as the attribute holds it, exact up to 2^24.
#[expect(clippy::cast_precision_loss, reason = "the shader rounds it in the same way")]
fn float(number: usize) -> f32 {
    number as f32
}
