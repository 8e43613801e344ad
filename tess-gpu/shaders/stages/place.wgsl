// needs: layout/packed_context, stages/fixed_point
// The location of a point along one dimension (spec section 5).

// The location of a position in the first half; for an even edge's middle, only up to rounding.
//
// No overflow: positions are below 33 and reciprocals at most ONE; both places are at most
// HALF + 10, so the weighted sum, coarse * ONE + (fine - coarse) * fraction modulo 2^32,
// stays below 2^32.
fn place_before_middle(context: vec2<u32>, position: u32) -> u32 {
    let coarse_position = position - select(0u, 1u, position > split_of(context));
    let coarse = coarse_position * inv_floor_of(context);
    let fine = position * inv_ceil_of(context);
    return ((coarse << 16u) + (fine - coarse) * fraction_of(context) + HALF) >> 16u;
}

// The 16.16 location of point `position` of an edge, 0..points-1.
fn place(context: vec2<u32>, position: u32) -> u32 {
    let half_points = half_points_of(context);
    let flip = position >= half_points;
    let p = select(position, 2u * half_points - position - odd_of(context), flip);
    let x = place_before_middle(context, p);
    let location = select(x, ONE - x, flip);
    // The exact middle of an even edge.
    return select(location, HALF, p == half_points);
}
