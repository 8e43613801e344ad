// needs: stages/rings, layout/setup
// The vertex-cache order: the location of triangle t, in closed form.
//
// The specification walks each ring around the patch, so a vertex is used again only a ring later. This order cuts
// the rings along each outer edge into columns of COLUMN cells and walks each column inwards.
// `tess_core::cache_order` defines the order and has the inverse functions; `connect.wgsl` calls this if the setup
// asks for it.
//
//     outer edge   o---o---o---o---o---o---o---o---o     one sector: all stitches along one edge
//     transition   | / | / | / | / | \ | \ | \ | \ |     (a column begins in it at transition_border)
//     ring 1         o---o---o---o---o---o---o
//     ring 2         | / | / | / | \ | \ | \ |           (a column begins in a ring at ring_border)
//                      o---o---o---o---o
//                  column 0        | column 1            then the next edge's sector; last, the centre
//
// A triangle's column is found by a binary search over `columns_before`, its ring by one over `rings_before`. Both
// are sums of borders over rings, in closed form (`borders`).
//
// In the quad patch (3, 4.5, 5, 6; 4, 7) the sector of edge 0 has 20 triangles. Column 0 takes steps 0 to 4 of the
// transition, then steps 0 to 4 of ring 2:
//
//   triangle 7 here is triangle 40 of the specification: ring 2, edge 0, step 2
//
// What must hold:
// - `columns_before` and `rings_before` ascend, or the searches miss.
// - A sector has at most 16 columns, as 64 segments are 16 times COLUMN.
// - The dividend of `transition_border` is below 2^14, so that its multiplication divides exactly.
// - Only the order changes: each triangle keeps its three indices and their rotation.
//
// The specification's order is simpler. An H200 draws it at 1.504 billion triangles per second at factor 64, and
// columns of four at 1.634. Columns of other widths gain at most 1 % and lose up to 15 %; strips lose 1 to 8 %
// (docs/experiments.md, "The order in which triangles are drawn").

// The stitches along one outer edge.
struct Sector {
    edge: u32,
    // Triangles of the transition.
    transition: u32,
    // Points along the inside axis, and one more than the number of rings.
    along: u32,
    end: u32,
    // 2^21 / (2 along - 4), rounded up.
    inverse: u32,
}

fn sector_of(rings: Rings, edge: u32) -> Sector {
    let along = along_of(rings, edge);
    let regular = 2u * along - 4u;
    return Sector(
        edge, outer_of(rings, edge) + along - 4u, along, stitch_ring_end(rings),
        (0x1fffffu + regular) / regular);
}

// The triangles of all sectors before that of `edge`, which is at most EDGES.
fn sectors_before(rings: Rings, edge: u32) -> u32 {
    let end = stitch_ring_end(rings);
    let outer = select(outer_sum(rings, edge), rings.boundary + EDGES, edge == EDGES);
    let along = select(along_sum(rings, edge), rings.along, edge == EDGES);
    return outer + along - 4u * edge + (end - 2u) * 2u * (along - edge * (end + 1u));
}

// Where triangle t of the order is.
fn drawn_location(rings: Rings, t: u32) -> RingLocation {
    let all = sectors_before(rings, EDGES);
    if t >= all {
        return RingLocation(stitch_ring_end(rings), 0u, t - all);
    }
    var edge = select(0u, 1u, t >= sectors_before(rings, 1u));
    edge = select(edge, 2u, t >= sectors_before(rings, 2u));
    if DOMAIN == QUAD {
        edge = select(edge, 3u, t >= sectors_before(rings, 3u));
    }
    return location_in_sector(sector_of(rings, edge), t - sectors_before(rings, edge));
}

fn location_in_sector(sector: Sector, t: u32) -> RingLocation {
    var column = nearer_column(sector, 0u, 8u, t);
    column = nearer_column(sector, column, 4u, t);
    column = nearer_column(sector, column, 2u, t);
    column = nearer_column(sector, column, 1u, t);
    // A column begins with its steps of the transition; its steps of the rings follow.
    let rest = t - columns_before(sector, column);
    let begin = transition_border(sector, column);
    let transition = transition_border(sector, column + 1u) - begin;
    if rest < transition {
        return RingLocation(1u, sector.edge, begin + rest);
    }
    return location_in_column(sector, column, rest - transition);
}

// Of 16 columns at most, the last one that begins at or before triangle t.
fn nearer_column(sector: Sector, column: u32, reach: u32, t: u32) -> u32 {
    return column + select(0u, reach, columns_before(sector, column + reach) <= t);
}

// The location of triangle t of a column, counted from the first after those of the transition.
fn location_in_column(sector: Sector, column: u32, t: u32) -> RingLocation {
    var ring = 2u;
    if sector.end > 10u {
        ring = nearer_in_column(sector, column, ring, 16u, t);
        ring = nearer_in_column(sector, column, ring, 8u, t);
    }
    ring = nearer_in_column(sector, column, ring, 4u, t);
    ring = nearer_in_column(sector, column, ring, 2u, t);
    ring = nearer_in_column(sector, column, ring, 1u, t);
    let step = ring_border(sector, ring, column) + t - rings_before(sector, column, ring);
    return RingLocation(ring, sector.edge, step);
}

fn nearer_in_column(sector: Sector, column: u32, ring: u32, reach: u32, t: u32) -> u32 {
    let next = ring + reach;
    let is_there = next < sector.end && rings_before(sector, column, next) <= t;
    return select(ring, next, is_there);
}

// The location of the triangle after the one at a location. Its ring is NEVER if that one is the last of its column
// or in the centre.
fn drawn_behind(rings: Rings, location: RingLocation) -> RingLocation {
    if location.ring == stitch_ring_end(rings) {
        return RingLocation(NEVER, 0u, 0u);
    }
    let sector = sector_of(rings, location.edge);
    let step = location.step + 1u;
    // The column of the step at the location, which no search needs: a border solved for its column.
    var column = (location.step + 2u * location.ring - 1u) / (2u * COLUMN);
    if location.ring == 1u {
        column = (((step * (2u * sector.along - 4u) - 1u) / sector.transition) + 1u) / (2u * COLUMN);
    }
    if step < border(sector, location.ring, column + 1u) {
        return RingLocation(location.ring, location.edge, step);
    }
    // The stitch has no more steps in this column: the column goes on in the next ring inwards, if that begins here.
    let ring = location.ring + 1u;
    let first = ring_border(sector, ring, column);
    let is_there = ring < sector.end && first < ring_border(sector, ring, column + 1u);
    return RingLocation(select(NEVER, ring, is_there), location.edge, first);
}

// Triangles of a sector in the columns before this one.
fn columns_before(sector: Sector, column: u32) -> u32 {
    return transition_border(sector, column) + borders(sector, sector.end, column);
}

// Triangles of a column in the rings 2..ring.
fn rings_before(sector: Sector, column: u32, ring: u32) -> u32 {
    return borders(sector, ring, column + 1u) - borders(sector, ring, column);
}

// The first step of a stitch that is in a column or a later one.
fn border(sector: Sector, ring: u32, column: u32) -> u32 {
    if ring == 1u {
        return transition_border(sector, column);
    }
    return ring_border(sector, ring, column);
}

fn ring_border(sector: Sector, ring: u32, column: u32) -> u32 {
    let first = 2u * COLUMN * column + 1u;
    return min(max(first, 2u * ring) - 2u * ring, 2u * (sector.along - 2u * ring));
}

// The quotient is exact, as the dividend is below 2^14.
fn transition_border(sector: Sector, column: u32) -> u32 {
    let first = min(max(2u * COLUMN * column + 1u, 2u) - 2u, 2u * sector.along - 4u);
    return (first * sector.transition * sector.inverse) >> 21u;
}

// The sum of ring_border over the rings 2..end.
fn borders(sector: Sector, end: u32, column: u32) -> u32 {
    let first = 2u * COLUMN * column + 1u;
    // Rings 2..cut are cut by the column, rings complete..top are before it whole; two arithmetic series.
    let half = (max(2u * sector.along + 1u, first) - first) >> 1u;
    let top = max(end, 2u);
    let cut = max(min(min(end, COLUMN * column + 1u), half), 2u);
    let complete = clamp(half, 2u, top);
    return (cut - 2u) * (max(first, cut + 1u) - cut - 1u)
        + (top - complete) * 2u * (sector.along + 1u - complete - top);
}
