//! The workloads of `tess bench` on the CPU backend, one pass at a time.

use crate::{json, thrown};
use std::ops::Range;
use tess_simd::{ExactOutput, Numbering, Tessellator};
use tess_workloads::{IndexWidth, Workload};
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

/// The names of the workloads of batches: JSON.
#[wasm_bindgen]
pub fn workload_names() -> String {
    let named = ["uniform", "terrain", "character", "mosaic", "mosaic-even"];
    let names = named.iter().flat_map(|name| Workload::named(name)).map(|workload| workload.name);
    json(&names.collect::<Vec<_>>())
}

/// A workload, ready to be tessellated by `tess-simd` on this thread.
#[wasm_bindgen]
#[derive(Debug)]
pub struct CpuBench {
    workload: Workload,
    batches: Vec<Range<usize>>,
    tessellator: Tessellator,
    output: ExactOutput,
}

#[wasm_bindgen]
impl CpuBench {
    /// A workload by name. Errors: there is no workload of that name.
    #[wasm_bindgen(constructor)]
    pub fn new(name: &str) -> Result<Self, JsError> {
        let mut all = Workload::named(name);
        match (all.pop(), all.is_empty()) {
            (Some(workload), true) => {
                let tessellator = Tessellator::new(workload.config);
                let batches = workload.cache_batches(IndexWidth::U32);
                Ok(Self { workload, batches, tessellator, output: ExactOutput::new() })
            }
            _ => Err(thrown(format!("{name} is not the name of one workload"))),
        }
    }

    /// Tessellates every patch once, a mebibyte of output at a time; how many primitives there are.
    /// Errors: a batch is too large for this machine.
    pub fn pass(&mut self) -> Result<f64, JsError> {
        let Self { workload, batches, tessellator, output } = self;
        let mut indices = 0;
        for batch in batches {
            let patches = &workload.patches[batch.clone()];
            tessellator.tessellate(patches, Numbering::PerPatch, output).map_err(thrown)?;
            indices += output.indices().len();
        }
        #[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
        Ok((indices / 3) as f64)
    }
}
