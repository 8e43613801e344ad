// needs: rings, state
// The order for drawing: the column of cells, the ring and the step of a triangle from its number, in closed
// form. `tess_core::drawing` says what the order is and has the same functions the other way round.

// Where triangle t of the order is.
fn drawn_location(rings: Rings, t: u32) -> RingLocation {
    var rest = t;
    for (var edge = 0u; edge < EDGES; edge++) {
        let size = sector_size(rings, edge);
        if rest < size {
            return location_in_sector(rings, edge, rest);
        }
        rest -= size;
    }
    return RingLocation(stitch_ring_end(rings), 0u, rest);
}

fn transition_size(rings: Rings, edge: u32) -> u32 {
    return outer_of(rings, edge) + along_of(rings, edge) - 4u;
}

fn sector_size(rings: Rings, edge: u32) -> u32 {
    let end = stitch_ring_end(rings);
    return transition_size(rings, edge) + (end - 2u) * 2u * (along_of(rings, edge) - end - 1u);
}

fn location_in_sector(rings: Rings, edge: u32, t: u32) -> RingLocation {
    var column = 0u;
    for (var reach = 16u; reach > 0u; reach >>= 1u) {
        column += select(0u, reach, columns_before(rings, edge, column + reach) <= t);
    }
    let rest = t - columns_before(rings, edge, column);
    let begin = transition_border(rings, edge, column);
    let transition = transition_border(rings, edge, column + 1u) - begin;
    if rest < transition {
        return RingLocation(1u, edge, begin + rest);
    }
    return location_in_column(rings, edge, column, rest - transition);
}

// The same for a triangle of a column, behind those of the transition.
fn location_in_column(rings: Rings, edge: u32, column: u32, t: u32) -> RingLocation {
    let along = along_of(rings, edge);
    let end = stitch_ring_end(rings);
    var ring = 2u;
    var before = 0u;
    for (var reach = 16u; reach > 0u; reach >>= 1u) {
        let next = ring + reach;
        let rings_before = borders(along, next, column + 1u) - borders(along, next, column);
        if next < end && rings_before <= t {
            ring = next;
            before = rings_before;
        }
    }
    return RingLocation(ring, edge, ring_border(along, ring, column) + t - before);
}

// Triangles of a sector in the columns before this one.
fn columns_before(rings: Rings, edge: u32, column: u32) -> u32 {
    return transition_border(rings, edge, column)
        + borders(along_of(rings, edge), stitch_ring_end(rings), column);
}

// The first step of a ring stitch that is in a column or behind it.
fn ring_border(along: u32, ring: u32, column: u32) -> u32 {
    let first = 2u * COLUMN * column + 1u;
    return min(max(first, 2u * ring) - 2u * ring, 2u * (along - 2u * ring));
}

// The same for the transition.
fn transition_border(rings: Rings, edge: u32, column: u32) -> u32 {
    let first = max(2u * COLUMN * column + 1u, 2u) - 2u;
    let size = transition_size(rings, edge);
    return min(first * size / (2u * along_of(rings, edge) - 4u), size);
}

// The sum of ring_border over the rings 2..end.
fn borders(along: u32, end: u32, column: u32) -> u32 {
    let first = 2u * COLUMN * column + 1u;
    let half = (max(2u * along + 1u, first) - first) >> 1u;
    let top = max(end, 2u);
    let cut = max(min(min(end, COLUMN * column + 1u), half), 2u);
    let complete = clamp(half, 2u, top);
    return (cut - 2u) * (max(first, cut + 1u) - cut - 1u)
        + (top - complete) * 2u * (along + 1u - complete - top);
}
