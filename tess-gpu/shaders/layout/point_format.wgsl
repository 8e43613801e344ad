// needs: stages/fixed_point
// How a domain point is stored, in 8 bytes.

// Packed: u in bits 0..16, v in 17..33, the patch in 34..63 of a little-endian 64-bit number.
// F32: u and v as binary32.
fn format_point(point: vec2<u32>, patch_number: u32) -> vec2<u32> {
    if POINT_FORMAT == PACKED {
        return numbered(vec2<u32>(point.x | (point.y << 17u), point.y >> 15u), patch_number);
    }
    return vec2<u32>(float_bits_from_coordinate(point.x), float_bits_from_coordinate(point.y));
}

// A stored point of patch 0 as that of another patch.
fn numbered(stored: vec2<u32>, patch_number: u32) -> vec2<u32> {
    if POINT_FORMAT == PACKED {
        return vec2<u32>(stored.x, stored.y | (patch_number << 2u));
    }
    return stored;
}
