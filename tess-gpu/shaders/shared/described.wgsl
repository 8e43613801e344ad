// needs: {contexts}, stages/points, stages/rings, layout/topology
// A point of a fractional patch in one word, before the factors of its patch are known.
//
// The catalogue keeps a topology once, but with fractional factors two patches of one topology have different
// points. So `list` stores how a point is placed, and `expand_points` places it with the contexts of the patch at
// hand.
//
//     31..22     21          20       19..18   17..13   12..6      5..3                 2..0
//     (unused)   is_centre   is_far   form     ring     position   factor of the        factor that
//                of the constant                                   run's constant       places the point
//
// A run is a row of points along which one coordinate is constant (stages/points.wgsl). Factors have the
// specification's order: the outer edges, then inside u and inside v. `form` decides how the two values become (u, v).
//
// Point 31 of the quad patch (3, 4.5, 5, 6; 4, 7) is on ring 1, edge 2, step 1. Inside v, factor 5, places it at
// position 2; its constant is inside u, factor 4, at ring 1 and measured from the far side:
//
//   point 31: 0x001020a5
//
// What must hold:
// - Position fits 7 bits (0..=64), ring 5 bits (0..=31), a factor 3 bits (0..=5).
// - A description depends only on the topology. Nothing here reads a context; `context_of` of
//   variants/no_contexts.wgsl stands in for it when `list` is compiled.
//
// The simpler form stores points themselves. It serves only integer factors, where equal topologies have equal
// points (`POINT_WORDS` in layout/setup.wgsl is 2 there).

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
