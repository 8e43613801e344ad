// needs: layout/setup, shared/tile_size; bindings: job, offsets, tiles
// The table of tiles: a binary search on each level of the offsets.

fn offset_at(index: u32, kind: u32) -> u32 {
    return offsets[index][kind];
}

// The number of the last of `count` (1..=SUMMED) ascending entries, from entry `first` on, that is at
// most `goal`. The first one always is.
fn last_at_or_before(first: u32, count: u32, kind: u32, goal: u32) -> u32 {
    var found = 0u;
    if count > 16u {
        found = nearer_entry(found, 128u, first, count, kind, goal);
        found = nearer_entry(found, 64u, first, count, kind, goal);
        found = nearer_entry(found, 32u, first, count, kind, goal);
        found = nearer_entry(found, 16u, first, count, kind, goal);
    }
    if count > 1u {
        found = nearer_entry(found, 8u, first, count, kind, goal);
        found = nearer_entry(found, 4u, first, count, kind, goal);
        found = nearer_entry(found, 2u, first, count, kind, goal);
        found = nearer_entry(found, 1u, first, count, kind, goal);
    }
    return found;
}

fn nearer_entry(found: u32, reach: u32, first: u32, count: u32, kind: u32, goal: u32) -> u32 {
    let next = min(found + reach, count - 1u);
    return select(found, next, offset_at(first + next, kind) <= goal);
}

// The patch that an element of this portion's output belongs to; `kind` is POINTS or PRIMITIVES.
// Among patches that begin together only the last one has elements.
fn patch_of(goal: u32, kind: u32) -> u32 {
    let blocks = (job.patches + BLOCK - 1u) >> BLOCK_BITS;
    let sections = (blocks + SECTION_BLOCKS - 1u) >> SECTION_BLOCK_BITS;
    let section = last_at_or_before(job.sections_at, sections, kind, goal);
    let in_section = goal - offset_at(job.sections_at + section, kind);
    let first_block = job.blocks_at + (section << SECTION_BLOCK_BITS);
    let count = min(SECTION_BLOCKS, blocks - (section << SECTION_BLOCK_BITS));
    let block = (section << SECTION_BLOCK_BITS) + last_at_or_before(first_block, count, kind, in_section);
    let in_block = in_section - offset_at(job.blocks_at + block, kind);
    let patches = min(BLOCK, job.patches - (block << BLOCK_BITS));
    return (block << BLOCK_BITS) + last_at_or_before(block << BLOCK_BITS, patches, kind, in_block);
}

// Entries for begin..end: one per tile and one for the last element.
fn entries(begin: u32, end: u32) -> u32 {
    return select(0u, tile_end(end) - tile_at(begin) + 1u, end > begin);
}

fn entry_of(number: u32, begin: u32, end: u32, kind: u32) -> u32 {
    let element = (tile_at(begin) + number) << job.tile_bits;
    return patch_of(clamp(element, begin, end - 1u), kind);
}

// Writes entry `number` of the table of tiles: those of the points, then those of the primitives.
fn write_entry(number: u32, range: Range) {
    let point_entries = entries(range.points_begin, range.points_end);
    let primitive_entries = entries(range.primitives_begin, range.primitives_end);
    if number < point_entries {
        tiles[number] = entry_of(number, range.points_begin, range.points_end, POINTS);
    } else if number - point_entries < primitive_entries {
        let own = number - point_entries;
        tiles[job.primitive_tiles_at + own] =
            entry_of(own, range.primitives_begin, range.primitives_end, PRIMITIVES);
    }
}
