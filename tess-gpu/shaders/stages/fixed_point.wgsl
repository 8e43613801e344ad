// needs: nothing
// Fixed-point numbers and the conversion from binary32 (spec section 2).

const ONE = 0x10000u;
const HALF = 0x8000u;
const ONE_THIRD = 0x5555u;
const TWO_THIRDS = 0xaaaau;

// The 15.16 factor nearest to a binary32 in [1, 64], ties to even, from its bits.
// Its exponent field is 127..133, so the shift is 1..7.
fn fixed_from_bits(bits: u32) -> u32 {
    let shift = 134u - (bits >> 23u);
    let mantissa = (bits & 0x7fffffu) | 0x800000u;
    let quotient = mantissa >> shift;
    let remainder = mantissa & ((1u << shift) - 1u);
    let half = 1u << (shift - 1u);
    let up = remainder > half || (remainder == half && (quotient & 1u) == 1u);
    return quotient + select(0u, 1u, up);
}

// The bits of the binary32 equal to a 16.16 number of at most ONE: 17 bits fit its mantissa.
fn float_bits_from_coordinate(coordinate: u32) -> u32 {
    if coordinate == 0u {
        return 0u;
    }
    let top = firstLeadingBit(coordinate); // 0..16
    let mantissa = (coordinate << (23u - top)) & 0x7fffffu;
    return ((top + 111u) << 23u) | mantissa;
}
