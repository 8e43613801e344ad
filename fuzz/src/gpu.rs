//! The WGSL backend on the first adapter, for example a software one, against the core.

use crate::compare_with_model;
use crate::input::Bytes;
use std::sync::{Mutex, OnceLock, PoisonError};
use tess_core::{Config, Domain, DomainPoint, PatchFactors, Tessellation};
use tess_gpu::layout::PackedPoint;
use tess_gpu::{Numbering, PointFormat, Setup};
use tess_verify::Case;
use tess_wgpu::{Gpu, Tessellator};

/// The most patches in a batch: few, because a software adapter runs them.
const MOST: usize = 12;

/// Lives until the process ends: a driver cannot be closed while a thread's locals are destroyed.
static DEVICE: OnceLock<Mutex<(Gpu, Tessellator)>> = OnceLock::new();

/// Compares a batch of packed points, with indices that count from the patch's first point.
///
/// # Errors
/// The first difference.
///
/// # Panics
/// There is no adapter: nothing must pass because nothing ran.
pub fn check(data: &[u8]) -> Result<(), String> {
    let (config, patches) = Bytes(data).batch(MOST);
    let Some(first) = patches.first() else { return Ok(()) };
    let output = {
        let device = DEVICE.get_or_init(|| Mutex::new(open()));
        let mut device = device.lock().unwrap_or_else(PoisonError::into_inner);
        let (gpu, tessellator) = &mut *device;
        run(gpu, tessellator, first.domain(), config, &patches)?
    };
    let (mut points, mut indices) = output;
    for (i, &factors) in patches.iter().enumerate() {
        let case = Case { config, factors };
        let model = case.patch().tessellate();
        let observed = Tessellation {
            points: points.drain(..model.points.len().min(points.len())).collect(),
            indices: indices.drain(..model.indices.len().min(indices.len())).collect(),
        };
        let name = format!("gpu, patch {i} of {}", patches.len());
        compare_with_model(&name, &case, observed, &model)?;
    }
    if points.is_empty() && indices.is_empty() {
        Ok(())
    } else {
        Err(format!("gpu: {} points and {} indices too many", points.len(), indices.len()))
    }
}

fn open() -> (Gpu, Tessellator) {
    let gpu = pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"));
    let tessellator = Tessellator::new(&gpu.device);
    (gpu, tessellator)
}

fn run(
    gpu: &Gpu,
    tessellator: &mut Tessellator,
    domain: Domain,
    config: Config,
    patches: &[PatchFactors],
) -> Result<(Vec<DomainPoint>, Vec<u32>), String> {
    let (point_format, numbering) = (PointFormat::Packed, Numbering::PerPatch);
    let setup = Setup { point_format, numbering, ..Setup::new(domain, config) };
    let output = tessellator.tessellate(gpu, setup, patches);
    let output = output.map_err(|error| error.to_string())?;
    let points = output.points.iter().map(|&words| PackedPoint(words).point()).collect();
    Ok((points, output.indices))
}
