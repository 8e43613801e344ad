// Random access: any point or primitive of a patch from its number alone, in constant time. Which
// run or segment it belongs to is a binary search over at most 129 of them, each from closed forms.

fn context_of(patch_index: u32, context: u32) -> vec2<u32> {
    return contexts[context * (arrayLength(&contexts) / FACTORS) + patch_index];
}

// Point `i` of a patch, which has that many: u and v, 16.16.
fn tess_point(patch_index: u32, i: u32) -> vec2<u32> {
    let topology = topologies[patch_index];
    let count = point_runs(topology);
    var run = 0u;
    for (var reach = 128u; reach > 0u; reach >>= 1u) {
        let next = run + reach;
        if next < count && point_run(topology, next).start <= i {
            run = next;
        }
    }
    let described = describe_run(patch_index, topology, run);
    return point_of_run(patch_index, described, i - point_run(topology, run).start);
}

// The same as binary32, exactly: the bits are made of integers.
fn tess_location(patch_index: u32, i: u32) -> vec2<f32> {
    let point = tess_point(patch_index, i);
    return vec2<f32>(
        bitcast<f32>(float_bits_from_coordinate(point.x)),
        bitcast<f32>(float_bits_from_coordinate(point.y)),
    );
}

// Primitive `t` of a patch, which has that many: its 1, 2 or 3 indices.
fn tess_primitive(patch_index: u32, t: u32) -> vec3<u32> {
    let topology = topologies[patch_index];
    let count = primitive_segments(topology);
    var segment = 0u;
    for (var reach = 128u; reach > 0u; reach >>= 1u) {
        let next = segment + reach;
        if next < count && primitive_segment(topology, next).start <= t {
            segment = next;
        }
    }
    let step = t - primitive_segment(topology, segment).start;
    let described = describe_segment(topology, segment, 0u);
    if IS_TRIANGLES {
        return stitch_triangle(described, step);
    }
    let first = described.x + step;
    return vec3<u32>(first, first + 1u, 0u);
}
