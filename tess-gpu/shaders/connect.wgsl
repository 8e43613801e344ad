// The primitives of a patch as segments (spec sections 7.1 and 8), in output order: the stitches
// of each ring edge by edge, then the centre; or sequences of points or lines.

fn primitive_segments(topology: vec2<u32>) -> u32 {
    let state = state_of(topology);
    if state == CULLED {
        return 0u;
    }
    if DOMAIN == ISOLINE && OUTPUT != OUTPUT_POINT {
        return outer_points(topology, 0u) - 1u;
    }
    if !IS_TRIANGLES || state == MINIMUM {
        return 1u;
    }
    return EDGES * (stitch_ring_end(topology) - 1u) + 1u;
}

// Quads of the centre strip of a quad patch; 0 if its shorter axis is even.
fn centre_quads(topology: vec2<u32>) -> u32 {
    let long = max(inside_u(topology), inside_v(topology));
    let short = min(inside_u(topology), inside_v(topology));
    let long_is_odd = 1u - (long & 1u);
    return select(2u * ((long >> 1u) - (short >> 1u)) + 2u - long_is_odd, 0u, (short & 1u) == 1u);
}

fn centre_triangles(topology: vec2<u32>) -> u32 {
    if DOMAIN == TRIANGLE {
        return 1u - (inside_u(topology) & 1u);
    }
    return 2u * centre_quads(topology);
}

fn transition_triangles(topology: vec2<u32>) -> u32 {
    return boundary(topology) + along_before(topology, EDGES) - 3u * EDGES;
}

fn primitive_segment(topology: vec2<u32>, segment: u32) -> Segment {
    if DOMAIN == ISOLINE && OUTPUT != OUTPUT_POINT {
        let along = outer_points(topology, 1u) - 1u;
        return Segment(segment * along, along);
    }
    if !IS_TRIANGLES || state_of(topology) == MINIMUM {
        return Segment(0u, counts(topology).y);
    }
    let ring = segment / EDGES + 1u;
    let edge = segment % EDGES;
    let along = along_points(topology, edge);
    let before = along_before(topology, edge);
    if ring == stitch_ring_end(topology) {
        return Segment(
            transition_triangles(topology) + triangles_before_ring(topology, ring),
            centre_triangles(topology));
    }
    if ring == 1u {
        return Segment(
            outer_before(topology, edge) + before - 4u * edge,
            outer_points(topology, edge) + along - 4u);
    }
    return Segment(
        transition_triangles(topology) + triangles_before_ring(topology, ring)
            + 2u * before - 4u * ring * edge,
        2u * along - 4u * ring);
}

// The first vertex of a ring; ring 0 is the outer one.
fn first_of_ring(topology: vec2<u32>, ring: u32) -> u32 {
    if ring == 0u {
        return 0u;
    }
    return boundary(topology) + points_before_ring(topology, ring);
}

// Describes a segment of a patch whose first vertex has the index `base`: for triangles a stitch
// (stitch.wgsl), else the index that its first primitive begins with.
fn describe_segment(topology: vec2<u32>, segment: u32, base: u32) -> vec3<u32> {
    if DOMAIN == ISOLINE && OUTPUT != OUTPUT_POINT {
        return vec3<u32>(base + segment * outer_points(topology, 1u), 0u, 0u);
    }
    if !IS_TRIANGLES {
        return vec3<u32>(base, 0u, 0u);
    }
    if state_of(topology) == MINIMUM {
        return make_centre(base, select(CENTRE_TRIANGLE, CENTRE_MINIMUM_QUAD, DOMAIN == QUAD), 1u);
    }
    let ring = segment / EDGES + 1u;
    if ring == stitch_ring_end(topology) {
        return describe_centre(topology, base + first_of_ring(topology, ring - 1u));
    }
    return describe_stitch(topology, ring, segment % EDGES, base);
}

fn make_centre(first: u32, form: u32, quads: u32) -> vec3<u32> {
    return vec3<u32>(first, quads | (form << 7u) | (KIND_CENTRE << 28u), 0u);
}

fn describe_centre(topology: vec2<u32>, first: u32) -> vec3<u32> {
    let u = inside_u(topology);
    let v = inside_v(topology);
    var form = CENTRE_TRIANGLE;
    if DOMAIN == QUAD {
        let along_v = select(CENTRE_ALONG_V, CENTRE_ALONG_V_MIRRORED, (v & 1u) == 0u);
        form = select(along_v, CENTRE_ALONG_U, u > v);
    }
    return make_centre(first, form, centre_quads(topology));
}

fn describe_stitch(topology: vec2<u32>, ring: u32, edge: u32, base: u32) -> vec3<u32> {
    let is_transition = ring == 1u;
    let before = along_before(topology, edge);
    let inner_points = along_points(topology, edge) - 2u * ring;
    let outer_row = select(inner_points + 2u, outer_points(topology, edge), is_transition);
    // From the first vertex of each ring to the first of this edge.
    let inner_skip = before - edge * (2u * ring + 1u);
    let outer_skip = select(
        before - edge * (2u * ring - 1u), outer_before(topology, edge) - edge, is_transition);
    let outer_first = first_of_ring(topology, ring - 1u) + outer_skip;
    let inner_first = first_of_ring(topology, ring) + inner_skip;
    // The inner ring is a row of points that this edge walks back over.
    let across = along_points(topology, edge + 1u);
    let walks_back = DOMAIN == QUAD && edge >= 2u && across == 2u * ring + 1u;
    let closes = edge == EDGES - 1u;
    let outer_close = select(CLOSES_NOTHING, outer_row - 1u, closes);
    let inner_close = select(CLOSES_NOTHING, inner_points - 1u, closes && !walks_back);
    let kind = select(KIND_RING, KIND_TRANSITION, is_transition);
    return vec3<u32>(
        base + outer_first,
        outer_row | (inner_points << 7u) | (outer_close << 14u) | (inner_close << 21u)
            | (kind << 28u) | (select(0u, 1u, walks_back) << 30u),
        (inner_first - outer_first) | ((outer_skip + outer_row - 1u) << 10u)
            | ((inner_skip + inner_points - 1u) << 19u),
    );
}
