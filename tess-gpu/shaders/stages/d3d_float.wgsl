// needs: nothing
// Comparison, clamping and rounding of binary32 factors by their bits. As unsigned numbers, positive
// floats are in order, and NaN and everything with a sign bit are above infinity.

const INFINITY = 0x7f800000u;

fn is_greater_than_zero(bits: u32) -> bool {
    return bits - 1u < INFINITY;
}

// For a positive `low`. A NaN is not greater than anything.
fn is_greater(bits: u32, low: u32) -> bool {
    return bits > low && bits <= INFINITY;
}

// Clamps to low..=high, both positive; NaN and negative numbers give `low`.
fn clamp_factor(bits: u32, low: u32, high: u32) -> u32 {
    return select(clamp(bits, low, high), low, bits > INFINITY);
}

// The ceiling of a number in [1, 64], an integer.
fn ceil_factor(bits: u32) -> u32 {
    let shift = 150u - (bits >> 23u);
    let mantissa = (bits & 0x7fffffu) | 0x800000u;
    return (mantissa + (1u << shift) - 1u) >> shift;
}
