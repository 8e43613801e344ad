// needs: stages/cache_order, stages/rings, layout/setup, stages/stitch, layout/topology
// The triangles of a patch (spec sections 7.1 and 8): any triangle from its number, in closed form.
//
// Tiles, the catalogue and `Pull` ask for triangle t. Every triangle belongs to a stitch between two rows of
// vertices, so the answer is a location, then the stitch's rows (this file), then one step of it
// (stages/stitch.wgsl). Lines and points join the points in order and need no stitch.
//
//     t -> RingLocation(ring, edge, step)      triangle_location: the specification's order or the vertex-cache order
//       -> Stitch                              stitch_at, by ring:
//            ring 1                 transition_stitch   an outer edge and ring 1
//            2 .. stitch_ring_end   ring_stitch         rings `ring` - 1 and `ring`
//            stitch_ring_end        centre_stitch       what is left: a triangle or a strip of quads
//
//     outer row   index `outer` + k, until `outer_turn`: from there `outer_mirror` - index
//     inner row   the same with `inner`
//
// A row turns where it closes its ring, or where the inner ring is a single row of points that the stitch walks
// along and back. `turns` is false for three of four edges, which skip the four selects.
//
// The quad patch (3, 4.5, 5, 6; 4, 7) has 62 triangles: 38 in the transitions, 24 between ring 1 and the row in the
// centre.
//
//   triangle 40: ring 2, edge 0, step 2, vertices [23, 24, 39]
//
// Vertices 22 to 37 are ring 1, 38 to 42 the row.
//
// What must hold:
// - A transition between `outer` and `inner` points is stitch TRANSITION_STRIDE * (outer - 2) + inner of the
//   tables, a ring stitch RING_STITCH + inner; src/tables.rs makes all of them from the core's steps.
// - `first_of_ring` counts the points of all rings before, as stages/points.wgsl places them.
// - The last edge of a ring is the one that closes it, in both rows.
//
// The simpler form walks the stitches from the patch's first triangle, one thread per patch. It takes 1.7 to 13
// times as long on an H100 (docs/performance.md, table gpu-one-thread). A stitch's steps come from a table instead of
// the specification's cases: transitions, ring stitches and strips then differ only in their numbers.

// Where triangle t of a regular patch is, in the order of the setup.
fn triangle_location(rings: Rings, t: u32) -> RingLocation {
    if ORDER == VERTEX_CACHE {
        return drawn_location(rings, t);
    }
    return specified_location(rings, t);
}

// The same in the specification's order.
fn specified_location(rings: Rings, t: u32) -> RingLocation {
    let transitions = rings.boundary + rings.along - 3u * EDGES;
    if t < transitions {
        return location_on_edges(
            1u, t, rings.before_1 + rings.v - 4u, rings.before_2 + rings.sides - 8u,
            outer_of(rings, 2u) + rings.v - 4u);
    }
    let end = stitch_ring_end(rings) - 2u;
    let form = 2u * rings.along - 6u * EDGES;
    let k = last_before(t - transitions, end, form, 2u * EDGES);
    let rest = t - transitions - k * (form - 2u * EDGES * k);
    if k == end {
        return RingLocation(k + 2u, 0u, rest);
    }
    return location_on_ring(
        k + 2u, rest, 2u * rings.v - 4u * (k + 2u), 2u * rings.u - 4u * (k + 2u));
}

// Triangle t of a patch; the indices count from its first point.
fn triangle_of(topology: vec2<u32>, t: u32) -> vec3<u32> {
    if state_of(topology) == MINIMUM {
        return stitch_triangles(minimum_stitch(0u), t).first;
    }
    let rings = rings_of(topology);
    let location = triangle_location(rings, t);
    return stitch_triangles(stitch_at(rings, location, 0u), location.step).first;
}

// The stitch at a location; `base` is the index of the patch's first vertex.
fn stitch_at(rings: Rings, location: RingLocation, base: u32) -> Stitch {
    if location.ring == 1u {
        return transition_stitch(rings, location.edge, base);
    }
    if location.ring == stitch_ring_end(rings) {
        return centre_stitch(rings, base);
    }
    return ring_stitch(rings, location, base);
}

// Between an edge of the patch and ring 1.
fn transition_stitch(rings: Rings, edge: u32, base: u32) -> Stitch {
    let outer_points = outer_of(rings, edge);
    let inner_points = along_of(rings, edge) - 2u;
    let ring = base + rings.boundary;
    return rows(
        rings, 1u, edge,
        outer_points + inner_points - 2u,
        TRANSITION_STRIDE * outer_points + inner_points - 2u * TRANSITION_STRIDE,
        base, base + outer_sum(rings, edge) - edge,
        ring, ring + along_sum(rings, edge) - 3u * edge);
}

// Between two interior rings.
fn ring_stitch(rings: Rings, location: RingLocation, base: u32) -> Stitch {
    let ring = location.ring;
    let inner_points = along_of(rings, location.edge) - 2u * ring;
    let inner_ring = base + first_of_ring(rings, ring);
    let outer_ring = inner_ring - ring_points(rings, ring - 1u);
    let skip = along_sum(rings, location.edge) - 2u * ring * location.edge;
    return rows(
        rings, ring, location.edge,
        2u * inner_points, RING_STITCH + inner_points,
        outer_ring, outer_ring + skip + location.edge,
        inner_ring, inner_ring + skip - location.edge);
}

// The stitch between two rows that begin at `outer` and `inner`, on rings that begin at `outer_ring` and
// `inner_ring`.
fn rows(
    rings: Rings, ring: u32, edge: u32, size: u32, number: u32,
    outer_ring: u32, outer: u32, inner_ring: u32, inner: u32,
) -> Stitch {
    let points = ring_points(rings, ring);
    // A ring that is a row of points: the walk around it comes back over it.
    let walks_back = rings.short == 2u * ring + 1u;
    return Stitch(
        size, steps_of(number), outer, inner,
        edge == EDGES - 1u || walks_back,
        inner_ring, inner_ring + outer_ring,
        inner_ring + select(points, points >> 1u, walks_back), 2u * inner_ring + points);
}

// A stitch whose rows don't turn.
fn straight(size: u32, number: u32, outer: u32, inner: u32) -> Stitch {
    return Stitch(size, steps_of(number), outer, inner, false, 0u, 0u, 0u, 0u);
}

// The two triangles of a minimum quad, or the one of a minimum triangle, around their last vertex.
fn minimum_stitch(base: u32) -> Stitch {
    return straight(EDGES - 2u, FAN_STITCH, base, base + EDGES - 1u);
}

// Inside the innermost ring: a triangle, or a strip between two of the ring's sides.
fn centre_stitch(rings: Rings, base: u32) -> Stitch {
    let first = base + first_of_ring(rings, stitch_ring_end(rings) - 1u);
    if DOMAIN == TRIANGLE {
        return straight(1u, FAN_STITCH, first, first + 2u);
    }
    let quads = max(rings.u, rings.v) - rings.short + 1u;
    let along_u = select(0u, 1u, rings.u > rings.v);
    let is_mirrored = rings.u <= rings.v && (rings.v & 1u) == 0u;
    return Stitch(
        2u * quads,
        steps_of(select(PLAIN_STRIP, MIRRORED_STRIP + quads, is_mirrored)),
        first + along_u, first,
        true,
        NEVER, 0u,
        first + along_u, 2u * first + 2u * quads + 1u + along_u);
}

// Where the steps of a stitch begin in the tables, by its number there.
fn steps_of(number: u32) -> u32 {
    return STITCHES_AT + STITCH_WORDS * number;
}

// The first index of primitive t, for lines and points: they join the points in order.
fn sequence_first(topology: vec2<u32>, t: u32, base: u32) -> u32 {
    if DOMAIN == ISOLINE && OUTPUT != OUTPUT_POINT {
        return base + t + t / (outer_points(topology, 1u) - 1u);
    }
    return base + t;
}
