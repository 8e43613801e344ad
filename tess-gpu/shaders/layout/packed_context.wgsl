// needs: nothing
// The six numbers that all of point placement uses (spec section 4), in 8 bytes. `factors` writes them for patches with
// fractional factors, `expand_points` reads them, and `layout::pack_context` is the same in Rust.
//
//             31         30                29    28..23   22..17        16..0
//     word 0  (unused)   top of inv_ceil   odd   split    half_points   inv_floor
//     word 1  31..16: fraction                            15..0: the rest of inv_ceil
//
// The six factors of the quad patch (3, 4.5, 5, 6; 4, 7), all even:
//
//   3   half_points 2 split 1 inv_floor 32768 inv_ceil 16384 fraction 32768: 0x00848000 0x80004000
//   4.5 half_points 3 split 1 inv_floor 16384 inv_ceil 10923 fraction 16384: 0x00864000 0x40002aab
//   5   half_points 3 split 1 inv_floor 16384 inv_ceil 10923 fraction 32768: 0x00864000 0x80002aab
//   6   half_points 3 split 4 inv_floor 10923 inv_ceil 10923 fraction     0: 0x02062aab 0x00002aab
//   4   half_points 2 split 3 inv_floor 16384 inv_ceil 16384 fraction     0: 0x01844000 0x00004000
//   7   half_points 4 split 3 inv_floor 10923 inv_ceil  8192 fraction 32768: 0x01882aab 0x80002000

fn inv_floor_of(context: vec2<u32>) -> u32 {
    return context.x & 0x1ffffu;
}

// The top bit is left out: inv_ceil is ONE only for factor 1, where it multiplies position 0.
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
