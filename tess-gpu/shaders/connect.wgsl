// Which stitch a triangle belongs to, and that stitch's rows (spec sections 7.1 and 8); what lines
// and points are made of. Everything in closed form.

// Where triangle t of a regular patch is.
fn triangle_spot(shape: Shape, t: u32) -> Spot {
    let transitions = shape.boundary + shape.along - 3u * EDGES;
    if t < transitions {
        return spot_on_edges(
            1u, t, shape.before_1 + shape.v - 4u, shape.before_2 + shape.sides - 8u,
            outer_of(shape, 2u) + shape.v - 4u);
    }
    let end = stitch_ring_end(shape) - 2u;
    let form = 2u * shape.along - 6u * EDGES;
    let k = last_before(t - transitions, end, form, 2u * EDGES);
    let rest = t - transitions - k * (form - 2u * EDGES * k);
    if k == end {
        return Spot(k + 2u, 0u, rest);
    }
    return spot_on_ring(
        k + 2u, rest, 2u * shape.v - 4u * (k + 2u), 2u * shape.u - 4u * (k + 2u));
}

// The stitch of a spot; `base` is the index of the patch's first vertex.
fn stitch_at(shape: Shape, spot: Spot, base: u32) -> Stitch {
    if spot.ring == 1u {
        return transition_stitch(shape, spot.edge, base);
    }
    if spot.ring == stitch_ring_end(shape) {
        return centre_stitch(shape, base);
    }
    return ring_stitch(shape, spot, base);
}

// Between an edge of the patch and ring 1.
fn transition_stitch(shape: Shape, edge: u32, base: u32) -> Stitch {
    let outer_points = outer_of(shape, edge);
    let inner_points = along_of(shape, edge) - 2u;
    let ring = base + shape.boundary;
    return rows(
        shape, 1u, edge,
        outer_points + inner_points - 2u,
        64u * outer_points + inner_points - 128u,
        base, base + outer_sum(shape, edge) - edge,
        ring, ring + along_sum(shape, edge) - 3u * edge);
}

// Between two interior rings.
fn ring_stitch(shape: Shape, spot: Spot, base: u32) -> Stitch {
    let ring = spot.ring;
    let inner_points = along_of(shape, spot.edge) - 2u * ring;
    let inner_ring = base + first_of_ring(shape, ring);
    let outer_ring = inner_ring - ring_points(shape, ring - 1u);
    let skip = along_sum(shape, spot.edge) - 2u * ring * spot.edge;
    return rows(
        shape, ring, spot.edge,
        2u * inner_points, RING_BLOCK + inner_points,
        outer_ring, outer_ring + skip + spot.edge,
        inner_ring, inner_ring + skip - spot.edge);
}

// A stitch between two rings that begin at these vertices, and on them from others on.
fn rows(
    shape: Shape, ring: u32, edge: u32, size: u32, block: u32,
    outer_ring: u32, outer: u32, inner_ring: u32, inner: u32,
) -> Stitch {
    let points = ring_points(shape, ring);
    // A ring that is a row of points: the walk around it comes back over it.
    let walks_back = shape.short == 2u * ring + 1u;
    return Stitch(
        size, steps_of(block), outer, inner,
        edge == EDGES - 1u || walks_back,
        inner_ring, inner_ring + outer_ring,
        inner_ring + select(points, points >> 1u, walks_back), 2u * inner_ring + points);
}

// A stitch whose rows don't turn.
fn straight(size: u32, block: u32, outer: u32, inner: u32) -> Stitch {
    return Stitch(size, steps_of(block), outer, inner, false, 0u, 0u, 0u, 0u);
}

// Two triangles of a quad, or one, around their last vertex.
fn minimum_stitch(base: u32) -> Stitch {
    return straight(EDGES - 2u, FAN_BLOCK, base, base + EDGES - 1u);
}

// Inside the innermost ring: a triangle, or a strip between two of the ring's sides.
fn centre_stitch(shape: Shape, base: u32) -> Stitch {
    let first = base + first_of_ring(shape, stitch_ring_end(shape) - 1u);
    if DOMAIN == TRIANGLE {
        return straight(1u, FAN_BLOCK, first, first + 2u);
    }
    let quads = max(shape.u, shape.v) - shape.short + 1u;
    let along_u = select(0u, 1u, shape.u > shape.v);
    let is_mirrored = shape.u <= shape.v && (shape.v & 1u) == 0u;
    return Stitch(
        2u * quads,
        steps_of(select(STRIP_BLOCK, MIRRORED_BLOCK + quads, is_mirrored)),
        first + along_u, first,
        true,
        NEVER, 0u,
        first + along_u, 2u * first + 2u * quads + 1u + along_u);
}

// Where the steps of a block begin.
fn steps_of(block: u32) -> u32 {
    return STEPS_AT + 128u * block;
}

// The first index of primitive t, for lines and points: they join the points in order.
fn sequence_first(topology: vec2<u32>, t: u32, base: u32) -> u32 {
    if DOMAIN == ISOLINE && OUTPUT != OUTPUT_POINT {
        return base + t + t / (outer_points(topology, 1u) - 1u);
    }
    return base + t;
}
