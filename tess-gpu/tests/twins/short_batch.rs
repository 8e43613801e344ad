//! The pass `short_batch`: in one pass, the results of `factors`, `scan`, `totals` and `partition`
//! for a batch of one portion. The offsets of blocks count from the start of the batch, which is
//! one section.

use super::block::process_block;
use super::buffers::{Bound, Pass, counts, sum};
use super::finish::finish;
use super::totals::write_status;
use tess_gpu::Resource::{Offsets, Tiles};
use tess_gpu::sizes::BLOCK;

pub(crate) fn short_batch(pass: &Pass<'_>, b: &mut Bound<'_>) {
    let job = &pass.job;
    let mut all = [0; 2];
    for block in 0..job.patches.div_ceil(BLOCK) {
        let in_block = process_block(pass, block, None, b);
        b.set_pair(Offsets, job.blocks_at + block, all);
        all = sum(all, in_block);
    }
    b.set_pair(Offsets, job.sections_at, [0; 2]);
    let totals = all.map(u64::from);
    write_status(pass, [0; 2], totals, b);
    finish(pass, totals, b);
    write_tiles(pass, all, b);
}

/// Each patch writes its number for the tiles that begin in it, unless it ends beyond the room. If
/// everything fits, the last patch that has output also writes it after the last tile.
fn write_tiles(pass: &Pass<'_>, all: [u32; 2], b: &mut Bound<'_>) {
    let job = &pass.job;
    let room = [job.point_capacity, job.primitive_capacity];
    let tables = [0, job.primitive_tiles_at];
    let fits = (0..2).all(|kind| all[kind] <= room[kind]);
    let tiles = |end: u32| end.div_ceil(1 << job.tile_bits);
    let mut begin = [0; 2];
    for (number, patch) in (0..).zip(pass.patches) {
        let end = sum(begin, counts(patch));
        for kind in (0..2).filter(|&kind| begin[kind] < end[kind] && end[kind] <= room[kind]) {
            let behind = u32::from(fits && end[kind] == all[kind]);
            for tile in tiles(begin[kind])..tiles(end[kind]) + behind {
                b.set(Tiles, tables[kind] + tile, number);
            }
        }
        begin = end;
    }
}
