//! The golden model as a backend.

use crate::backend::{Answers, Backend};
use tess_core::factors::process;
use tess_core::place::place;
use tess_core::{
    Config, FactorContext, FixedFactor, OutputPrimitive, Parity, Partitioning, Patch, PatchFactors,
    ProcessedFactor, ProcessedPatch, SplitOrder, Tessellation, TriangleFactors,
};

/// `tess-core`, the sequential formulation.
#[derive(Clone, Copy, Debug, Default)]
pub struct CoreBackend;

impl Backend for CoreBackend {
    fn name(&self) -> &'static str {
        "core"
    }

    fn device(&self) -> String {
        "portable".into()
    }

    fn tessellate(&mut self, config: Config, patches: &[PatchFactors]) -> Answers<Tessellation> {
        Ok(patches.iter().map(|&factors| Patch::new(config, factors).tessellate()).collect())
    }

    fn fixed_factors(
        &mut self,
        partitioning: Partitioning,
        values: &[f32],
    ) -> Answers<[FixedFactor; 2]> {
        Ok(values.iter().map(|&value| outer_and_inside(partitioning, value)).collect())
    }

    fn contexts(
        &mut self,
        split: SplitOrder,
        parity: Parity,
        factors: &[FixedFactor],
    ) -> Answers<FactorContext> {
        Ok(factors.iter().map(|&factor| FactorContext::new(factor, parity, split)).collect())
    }

    fn locations(&mut self, contexts: &[FactorContext]) -> Answers<u32> {
        let mut locations = Vec::with_capacity(contexts.iter().map(|c| c.points as usize).sum());
        for context in contexts {
            locations.extend((0..context.points).map(|p| place(context, p).to_bits()));
        }
        Ok(locations)
    }
}

/// The u = 0 factor of the triangle patch (x, 3, 3; x), or zero if it is culled, and the inside
/// factor: that of (3, 3, 3; x) if (x, 3, 3; x) is culled.
fn outer_and_inside(partitioning: Partitioning, x: f32) -> [FixedFactor; 2] {
    let both = TriangleFactors { u0: x, v0: 3.0, w0: 3.0, inside: x };
    if let Some(factors) = processed(partitioning, both) {
        return [factors.u0.fixed, factors.inside.fixed];
    }
    let none = FixedFactor::from_bits(0);
    let inside = processed(partitioning, TriangleFactors { u0: 3.0, ..both });
    [none, inside.map_or(none, |factors| factors.inside.fixed)]
}

/// The processed factors of a triangle patch; `None` if it is culled.
fn processed(
    partitioning: Partitioning,
    factors: TriangleFactors,
) -> Option<TriangleFactors<ProcessedFactor>> {
    let config = Config::new(partitioning, OutputPrimitive::Point);
    match process(config, PatchFactors::Triangle(factors)) {
        ProcessedPatch::Minimum(PatchFactors::Triangle(factors))
        | ProcessedPatch::Regular(PatchFactors::Triangle(factors)) => Some(factors),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_says_what_it_is() {
        assert_eq!((CoreBackend.name(), &*CoreBackend.device()), ("core", "portable"));
    }
}
