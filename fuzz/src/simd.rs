//! The batch backend, at every CPU level of this machine, against the core.

use crate::compare_with_model;
use crate::input::Bytes;
use std::cell::RefCell;
use std::collections::HashMap;
use tess_core::{Config, DomainPoint, PatchFactors, Tessellation};
use tess_simd::{ExactOutput, Level, Numbering, Output, OwnedBatch, Tessellator};
use tess_verify::Case;

/// The most patches in a batch: more than three chunks of 64 patches, the last of which is not
/// full.
const MOST: usize = 200;

thread_local! {
    /// Tessellators hold tables that take milliseconds to make.
    static MADE: RefCell<HashMap<(Config, Level), Tessellator>> = RefCell::new(HashMap::new());
}

/// Compares a batch at every level, in both index formats and numberings. Errors: the first
/// difference.
pub fn check(data: &[u8]) -> Result<(), String> {
    let (config, patches) = Bytes(data).batch(MOST);
    let model: Vec<Tessellation> =
        patches.iter().map(|&factors| Case { config, factors }.patch().tessellate()).collect();
    for level in Level::ALL.into_iter().filter(|level| level.is_available()) {
        MADE.with_borrow_mut(|made| {
            let tessellator = made.entry((config, level)).or_insert_with(|| {
                Tessellator::with_level(config, level).expect("the level is available")
            });
            check_level(tessellator, &patches, &model)
        })?;
    }
    Ok(())
}

fn check_level(
    tessellator: &mut Tessellator,
    patches: &[PatchFactors],
    model: &[Tessellation],
) -> Result<(), String> {
    const BASE: u32 = 70_000; // beyond 16 bits
    let mut wide = ExactOutput::new();
    let mut narrow: Output<DomainPoint, u16> = Output::new();
    let mut numbered = ExactOutput::new();
    let across = Numbering::PerBatch { base_vertex: BASE };
    let refused = |error| format!("simd refused a batch: {error}");
    let owned = OwnedBatch::try_from(patches).map_err(refused)?;
    tessellator.tessellate(owned.batch(), Numbering::PerPatch, &mut wide).map_err(refused)?;
    tessellator.tessellate(patches, Numbering::PerPatch, &mut narrow).map_err(refused)?;
    tessellator.tessellate(owned.batch(), across, &mut numbered).map_err(refused)?;
    let (config, level) = (tessellator.config(), tessellator.level());
    for (i, (&factors, model)) in patches.iter().zip(model).enumerate() {
        let case = Case { config, factors };
        let missing = || format!("simd at {level} has no patch {i}");
        let (points, indices) = wide.patch(i).ok_or_else(missing)?;
        let observed = Tessellation { points: points.to_vec(), indices: indices.to_vec() };
        let name = format!("simd at {level}, patch {i} of {}", patches.len());
        compare_with_model(&name, &case, observed, model)?;

        let (points, indices) = narrow.patch(i).ok_or_else(missing)?;
        let indices = indices.iter().map(|&index| u32::from(index)).collect();
        let observed = Tessellation { points: points.to_vec(), indices };
        compare_with_model(&format!("{name}, 16 bits"), &case, observed, model)?;

        let first = numbered.ranges().get(i).ok_or_else(missing)?.first_point;
        let (points, indices) = numbered.patch(i).ok_or_else(missing)?;
        let indices = indices.iter().map(|index| index.wrapping_sub(BASE + first)).collect();
        let observed = Tessellation { points: points.to_vec(), indices };
        compare_with_model(&format!("{name}, numbered across"), &case, observed, model)?;
    }
    Ok(())
}
