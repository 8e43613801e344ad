// needs: stages/connect, stages/fixed_point, stages/points, layout/setup; bindings: topologies
// Random access: any point or primitive of a patch from its number, in constant time.

// Point i, which the patch must have: u and v, 16.16.
fn tess_point(patch_index: u32, i: u32) -> vec2<u32> {
    let run = run_at_point(patch_index, topologies[patch_index], i);
    return point_of_run(run, run.step);
}

// The same as binary32, exactly: integers make the bits.
fn tess_location(patch_index: u32, i: u32) -> vec2<f32> {
    let point = tess_point(patch_index, i);
    return vec2<f32>(
        bitcast<f32>(float_bits_from_coordinate(point.x)),
        bitcast<f32>(float_bits_from_coordinate(point.y)),
    );
}

// Primitive t, which the patch must have: its 1, 2 or 3 indices.
fn tess_primitive(patch_index: u32, t: u32) -> vec3<u32> {
    let topology = topologies[patch_index];
    if !IS_TRIANGLES {
        let first = sequence_first(topology, t, 0u);
        return vec3<u32>(first, first + 1u, 0u);
    }
    return triangle_of(topology, t);
}
