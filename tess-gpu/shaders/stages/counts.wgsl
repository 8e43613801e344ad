// needs: layout/setup, layout/topology
// How many points and primitives a patch has, by formula (spec section 12.6).

fn interior_points(topology: vec2<u32>) -> u32 {
    let u = inside_u(topology);
    if DOMAIN == QUAD {
        return (u - 2u) * (inside_v(topology) - 2u);
    }
    let half = u >> 1u;
    return select(3u * (half - 1u) * (half - 1u), 3u * half * (half - 1u) + 1u, (u & 1u) == 1u);
}

fn triangles_of(points: u32, topology: vec2<u32>) -> u32 {
    return 2u * points - 2u - boundary(topology);
}

// Points and primitives.
fn counts(topology: vec2<u32>) -> vec2<u32> {
    if state_of(topology) == CULLED {
        return vec2<u32>(0u, 0u);
    }
    if DOMAIN == ISOLINE {
        let lines = outer_points(topology, 0u) - 1u;
        let along = outer_points(topology, 1u);
        return lines * vec2<u32>(along, along - select(1u, 0u, OUTPUT == OUTPUT_POINT));
    }
    var points = EDGES;
    var triangles = EDGES - 2u;
    if state_of(topology) == REGULAR {
        points = boundary(topology) + interior_points(topology);
        triangles = triangles_of(points, topology);
    }
    if OUTPUT == OUTPUT_POINT {
        return vec2<u32>(points, points);
    }
    return vec2<u32>(points, select(triangles, points - 1u, OUTPUT == OUTPUT_LINE));
}
