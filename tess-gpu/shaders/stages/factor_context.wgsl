// needs: stages/fixed_point, layout/setup; bindings: tables
// From a fixed-point factor to its context (spec sections 4 and 10).

// 1/n with 16 fraction bits, for n in 1..=64.
fn reciprocal(n: u32) -> u32 {
    return tables[RECIPROCALS_AT + n - 1u];
}

// Half of a factor, rounded up; plus HALF if the edge is odd, or if it is even and the factor is 1.
fn half_factor(factor: u32, odd: u32) -> u32 {
    let rounded = (factor + 1u) >> 1u;
    return rounded + select(0u, HALF, odd == 1u || rounded == HALF);
}

// Points along an edge, both ends included: 2..=65.
fn edge_points(factor: u32, odd: u32) -> u32 {
    if IS_INTEGER {
        return select((factor >> 16u) + 1u, 3u, factor == ONE && odd == 0u);
    }
    let half_points = (half_factor(factor, odd) + 0xffffu) >> 16u;
    return 2u * half_points + 1u - odd;
}

fn drop_most_significant_bit(x: u32) -> u32 {
    return x ^ (1u << firstLeadingBit(x));
}

fn split_position(floor_points: u32, ceil_points: u32, odd: u32) -> u32 {
    if floor_points == ceil_points {
        return ceil_points + 1u; // no position reaches it
    }
    if SPLIT == CENTER {
        return ceil_points - 1u - odd;
    }
    if odd == 1u && floor_points == 1u {
        return 0u;
    }
    return 2u * drop_most_significant_bit(floor_points - odd) + 1u;
}

// The packed context of a 15.16 factor in its range; `odd` is 1 or 0.
fn make_context(factor: u32, odd: u32) -> vec2<u32> {
    let half = half_factor(factor, odd);
    let floor_points = half >> 16u;
    let ceil_points = (half + 0xffffu) >> 16u;
    let inv_ceil = reciprocal(2u * ceil_points - odd);
    return vec2<u32>(
        reciprocal(2u * floor_points - odd) | (ceil_points << 17u)
            | (split_position(floor_points, ceil_points, odd) << 23u)
            | (odd << 29u) | ((inv_ceil >> 16u) << 30u),
        (inv_ceil & 0xffffu) | ((half & 0xffffu) << 16u),
    );
}
