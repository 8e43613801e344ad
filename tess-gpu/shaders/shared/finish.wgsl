// needs: layout/setup, shared/tile_size; bindings: arguments, job, status
// Results that depend on the totals of a batch: whether the output fits, the draw arguments and the sizes of
// the dispatches. The arguments are draw_indexed_indirect's five numbers, three reserved, then
// dispatch sizes of three numbers: for each portion its partition, its windows of points, its windows
// of primitives.

fn write_dispatch(number: u32, workgroups: u32) {
    let rows = (workgroups + job.max_workgroups - 1u) / job.max_workgroups;
    let at = DISPATCHES_AT + 3u * number;
    arguments[at] = select(job.max_workgroups, workgroups, rows <= 1u);
    arguments[at + 1u] = max(rows, 1u);
    arguments[at + 2u] = 1u;
}

// Tiles that begin..end touches.
fn tiles_between(begin: u32, end: u32) -> u32 {
    return select(0u, tile_end(end) - tile_at(begin), end > begin);
}

// Tiles of begin..end in a window.
fn tiles_in_window(begin: u32, end: u32, window: u32, window_tiles: u32) -> u32 {
    let first = max(tile_at(begin), window * window_tiles);
    let last = min(tile_end(end), (window + 1u) * window_tiles);
    return select(0u, last - first, last > first && end > begin);
}

// Dispatches of a portion.
fn slots() -> u32 {
    return 1u + job.point_windows + job.primitive_windows;
}

// The workgroups of a dispatch; none if the output does not fit.
fn workgroups_of(slot: u32, range: Range, is_overflow: u32) -> u32 {
    if is_overflow != 0u {
        return 0u;
    }
    if slot == 0u {
        let count = tiles_between(range.points_begin, range.points_end)
            + tiles_between(range.primitives_begin, range.primitives_end);
        return (count + 2u + WORKGROUP - 1u) / WORKGROUP; // one more entry for each output: see entry_points/partition.wgsl
    }
    if slot <= job.point_windows {
        return tiles_in_window(
            range.points_begin, range.points_end, slot - 1u, job.point_window_tiles);
    }
    return tiles_in_window(
        range.primitives_begin, range.primitives_end,
        slot - 1u - job.point_windows, job.primitive_window_tiles);
}

// Overflow flags of these many points and primitives, in two words each: bit 0 points, bit 1 indices.
fn overflow(low: vec2<u32>, high: vec2<u32>) -> u32 {
    let points = high.x != 0u || low.x > job.point_capacity;
    let primitives = high.y != 0u || low.y > job.primitive_capacity;
    return select(0u, 1u, points) | select(0u, 2u, primitives);
}

fn write_draw(primitives: u32, is_overflow: u32) {
    status.overflow = is_overflow;
    arguments[0] = select(primitives * INDICES, 0u, is_overflow != 0u);
    arguments[1] = 1u; // instances
    arguments[2] = 0u; // first index
    arguments[3] = 0u; // base vertex
    arguments[4] = 0u; // first instance
}

// For the whole batch: the draw arguments, and the workgroups of every portion in every window.
fn finish(thread: u32) {
    let is_overflow = overflow(
        vec2<u32>(status.points, status.primitives),
        vec2<u32>(status.points_high, status.primitives_high));
    for (var slot = thread; slot < job.portions * slots(); slot += SUMMED) {
        let range = status.ranges[slot / slots()];
        write_dispatch(slot, workgroups_of(slot % slots(), range, is_overflow));
    }
    if thread == 0u {
        write_draw(status.primitives, is_overflow);
    }
}
