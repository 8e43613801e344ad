//! Tessellates on the CPU for a geometry of three.js whose renderer draws with WebGL 2.
#![cfg(target_arch = "wasm32")]

use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_simd::{Numbering, Output, Tessellator};
use tess_verify::Named;
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

/// A tessellator with the output of the batch before, whose memory the next one reuses.
#[wasm_bindgen]
#[derive(Debug)]
pub struct CpuTessellator {
    domain: Domain,
    tessellator: Tessellator,
    output: Output<[f32; 2], u32>,
    patches: usize,
}

#[wasm_bindgen]
impl CpuTessellator {
    /// # Errors
    /// An unknown name.
    #[wasm_bindgen(constructor)]
    pub fn new(domain: &str, partitioning: &str) -> Result<Self, JsError> {
        let (domain, partitioning) =
            (Domain::from_name(domain)?, Partitioning::from_name(partitioning)?);
        let output = match domain {
            Domain::Isoline => OutputPrimitive::Line,
            Domain::Triangle | Domain::Quad => OutputPrimitive::TriangleCw,
        };
        let tessellator = Tessellator::new(Config::new(partitioning, output));
        Ok(Self { domain, tessellator, output: Output::new(), patches: 0 })
    }

    /// The number of factors of a patch.
    pub fn factors_per_patch(&self) -> usize {
        self.domain.factors()
    }

    /// Tessellates patches with these factors, one patch after another.
    ///
    /// # Errors
    /// Factors that are not whole patches; an output that is too large.
    pub fn tessellate(&mut self, factors: &[f32]) -> Result<(), JsError> {
        let each = self.domain.factors();
        let of_patch = |factors| PatchFactors::from_slice(self.domain, factors);
        let patches: Option<Vec<_>> = factors.chunks(each).map(of_patch).collect();
        let patches = patches.ok_or_else(|| {
            JsError::new(&format!("{} factors; a patch of this domain has {each}", factors.len()))
        })?;
        let numbering = Numbering::PerBatch { base_vertex: 0 };
        self.tessellator.tessellate(&patches[..], numbering, &mut self.output)?;
        self.patches = patches.len();
        Ok(())
    }

    /// u, v and the patch's number of each point.
    pub fn positions(&self) -> Vec<f32> {
        let of_patch = |number| {
            let (points, _) = self.output.patch(number)?;
            Some(points.iter().flat_map(move |&[u, v]| [u, v, float(number)]))
        };
        (0..self.patches).filter_map(of_patch).flatten().collect()
    }

    /// The indices of lines or clockwise triangles, from the batch's first point.
    pub fn indices(&self) -> Vec<u32> {
        self.output.indices().to_vec()
    }
}

/// The number of a patch as the attribute holds it, exact up to 2^24.
#[expect(clippy::cast_precision_loss, reason = "the shader rounds it in the same way")]
fn float(number: usize) -> f32 {
    number as f32
}
