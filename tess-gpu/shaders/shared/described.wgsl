// needs: {contexts}, stages/points, stages/rings, layout/topology
// A point in one word, before the factors of its patch are known; and placed by them.
//
// bits 0..2 the factor that places it, 3..5 that of its run's constant, 6..12 its position, 13..17 its ring,
// 18..19 its form, 20 and 21 the constant's `is_far` and `is_centre`.

// Point i of a patch that is not culled.
fn described_point(topology: vec2<u32>, i: u32) -> u32 {
    if state_of(topology) == MINIMUM {
        return (i << 6u) | (FORM_CORNER << 18u);
    }
    let rings = rings_of(topology);
    let location = point_location(rings, i);
    let shape = shape_of(rings, location);
    let constant = shape.constant;
    let position = shape.first + shape.sign * location.step;
    return shape.factor | (constant.factor << 3u) | (position << 6u) | (constant.ring << 13u)
        | (shape.form << 18u) | select(0u, 1u << 20u, constant.is_far)
        | select(0u, 1u << 21u, constant.is_centre);
}

// The point of a description in a patch: u and v, 16.16.
fn placed_point(described: u32, patch_index: u32) -> vec2<u32> {
    let ring = (described >> 13u) & 31u;
    let constant = Constant(
        0u, ring, (described & (1u << 20u)) != 0u, (described & (1u << 21u)) != 0u);
    let fixed = constant_value(constant, context_of(patch_index, (described >> 3u) & 7u, 0u));
    let context = context_of(patch_index, described & 7u, 0u);
    let run = PointRun(0u, 0u, fixed, (described >> 18u) & 3u, context, 0u, 1u);
    return point_of_run(run, (described >> 6u) & 127u);
}
