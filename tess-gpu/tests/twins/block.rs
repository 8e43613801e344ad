//! shared/block.wgsl: the results of factor processing for a block of 256 patches.

use super::buffers::{Bound, Pass, counts, sum};
use super::catalogue::{self, Catalogue};
use tess_core::{Patch, PatchFactors, ProcessedFactor, ProcessedPatch};
use tess_gpu::Resource::{Contexts, Offsets, Topologies};
use tess_gpu::layout::pack_context;

/// Writes topologies, contexts, offsets within the block, and the topology that all its patches
/// have, or 0. That topology holds the slot of the catalogue; if there is none, each patch's own
/// does. Returns the counts of the block.
pub(crate) fn process_block(
    pass: &Pass<'_>,
    block: u32,
    catalogue: Option<&Catalogue>,
    b: &mut Bound<'_>,
) -> [u32; 2] {
    let first = 256 * block;
    let mut all = [0; 2];
    let mut topologies = Vec::new();
    for (at, patch) in (first..).zip(block_of(pass, block)) {
        topologies.push(topology_left(patch, at, b));
        write_contexts(pass, patch, at, b);
        b.set_pair(Offsets, at, all);
        all = sum(all, counts(patch));
    }
    let is_alike = topologies.iter().all(|topology| *topology == topologies[0]);
    // The slot is in the second word; 0 if there is none.
    let slot = |at: usize, b: &mut Bound<'_>| {
        let patch = &block_of(pass, block)[at];
        catalogue.map_or(0, |it| it.slot_of(topologies[at], counts(patch), b)) << 14
    };
    let common = match is_alike {
        true => {
            let copies = catalogue::has_copied_points(pass.setup);
            let slot = if copies { 0 } else { slot(0, b) };
            [topologies[0][0], topologies[0][1] | slot]
        }
        false => [0, 0],
    };
    for (number, &[low, high]) in (0..).zip(&topologies) {
        let slot = if is_alike { 0 } else { slot(number as usize, b) };
        b.set_pair(Topologies, first + number, [low, high | slot]);
    }
    b.set_pair(Offsets, pass.job.alike_at + block, common);
    all
}

/// The patches of a block; the portion's last block may have fewer.
fn block_of<'a>(pass: &Pass<'a>, block: u32) -> &'a [Patch] {
    pass.patches.chunks(256).nth(block as usize).unwrap_or_default()
}

/// layout/topology.wgsl: the numbers of points along edges and axes, and the state.
pub(crate) fn topology(patch: &Patch) -> [u32; 2] {
    let (state, factors) = match patch.processed() {
        ProcessedPatch::Culled => return [0, 0],
        ProcessedPatch::Minimum(factors) => (1, factors),
        ProcessedPatch::Regular(factors) => (2, factors),
    };
    let points = |factor: ProcessedFactor| factor.context.points;
    let outer = (0..)
        .zip(factors.outer())
        .fold(state << 28, |word, (edge, factor)| word | points(factor) << (7 * edge));
    let inside = match *factors {
        PatchFactors::Isoline(_) => 0,
        PatchFactors::Triangle(it) => points(it.inside) | points(it.inside) << 7,
        PatchFactors::Quad(it) => points(it.inside_u) | points(it.inside_v) << 7,
    };
    [outer, inside]
}

/// The same, but in a culled patch only the state is defined; its points are as the device left
/// them.
fn topology_left(patch: &Patch, at: u32, b: &Bound<'_>) -> [u32; 2] {
    match patch.processed() {
        ProcessedPatch::Culled => {
            let [low, high] = [0, 1].map(|word| b.left(Topologies, 2 * at + word));
            [low & 0xFFF_FFFF, high & 0x3FFF]
        }
        _ => topology(patch),
    }
}

/// Writes the contexts of regular patches with fractional factors; no others are read.
fn write_contexts(pass: &Pass<'_>, patch: &Patch, at: u32, b: &mut Bound<'_>) {
    let ProcessedPatch::Regular(factors) = patch.processed() else { return };
    if pass.setup.has_integer_factors() {
        return;
    }
    for (number, factor) in (0..).zip(factors.iter()) {
        b.set_pair(Contexts, at + number * pass.job.stride, pack_context(&factor.context));
    }
}
