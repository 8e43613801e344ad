// needs: nothing
// The six numbers that all of point placement uses (spec section 4), in 8 bytes.
//
// word 0: inv_floor in bits 0..16, half_points 17..22, split 23..28, odd 29, top bit of inv_ceil 30
// word 1: low 16 bits of inv_ceil, fraction above them

fn inv_floor_of(context: vec2<u32>) -> u32 {
    return context.x & 0x1ffffu;
}

// The top bit is left out: inv_ceil is ONE for factor 1 alone, where it multiplies position 0.
fn inv_ceil_of(context: vec2<u32>) -> u32 {
    return context.y & 0xffffu;
}

fn fraction_of(context: vec2<u32>) -> u32 {
    return context.y >> 16u;
}

fn half_points_of(context: vec2<u32>) -> u32 {
    return (context.x >> 17u) & 63u;
}

fn split_of(context: vec2<u32>) -> u32 {
    return (context.x >> 23u) & 63u;
}

fn odd_of(context: vec2<u32>) -> u32 {
    return (context.x >> 29u) & 1u;
}
