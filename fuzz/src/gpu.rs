//! The WGSL backend on the first adapter, a software one for example, against the core.

use crate::compare_with_model;
use crate::input::Bytes;
use std::sync::{Mutex, OnceLock, PoisonError};
use tess_core::{Config, Domain, DomainPoint, PatchFactors, Tessellation};
use tess_gpu::{Numbering, PointFormat, Setup};
use tess_verify::Case;
use tess_wgpu::{Gpu, Tessellator};

/// Patches in a batch: small, as a software adapter runs them.
const MOST: usize = 12;

/// Stays to the end of the process: a driver cannot be closed while a thread's locals go.
static DEVICE: OnceLock<Mutex<(Gpu, Tessellator)>> = OnceLock::new();

/// Compares a batch of packed points and indices that count from the patch.
///
/// # Errors
/// The first difference.
///
/// # Panics
/// Without an adapter: nothing passes because nothing ran.
pub fn check(data: &[u8]) -> Result<(), String> {
    let (config, patches) = Bytes(data).batch(MOST);
    let Some(first) = patches.first() else { return Ok(()) };
    let output = {
        let device = DEVICE.get_or_init(|| Mutex::new(open()));
        let mut device = device.lock().unwrap_or_else(PoisonError::into_inner);
        let (gpu, tessellator) = &mut *device;
        run(gpu, tessellator, first.domain(), config, &patches)?
    };
    let (mut points, mut indices) = (&output.0[..], &output.1[..]);
    for (i, &factors) in patches.iter().enumerate() {
        let case = Case { config, factors };
        let model = case.patch().tessellate();
        let observed = Tessellation {
            points: take(&mut points, model.points.len()).to_vec(),
            indices: take(&mut indices, model.indices.len()).to_vec(),
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
    let points = output.points.iter().map(|&[low, high]| unpack(low, high)).collect();
    Ok((points, output.indices))
}

/// u in bits 0..=16, v in bits 17..=33.
fn unpack(low: u32, high: u32) -> DomainPoint {
    const COORDINATE: u64 = 0x1_FFFF;
    let bits = u64::from(high) << 32 | u64::from(low);
    let [u, v] = [bits & COORDINATE, bits >> 17 & COORDINATE];
    let word = |bits| u32::try_from(bits).expect("17 bits");
    DomainPoint::from_bits(word(u), word(v))
}

/// The next `count` elements, or as many as there are.
fn take<'a, T>(list: &mut &'a [T], count: usize) -> &'a [T] {
    let (taken, rest) = list.split_at(count.min(list.len()));
    *list = rest;
    taken
}
