//! Strategies of property tests: factors of any domain, and every configuration.

use proptest::prelude::*;
use tess_core::{
    Config, IsolineFactors, OutputPrimitive, Partitioning, PatchFactors, QuadFactors, SplitOrder,
    TriangleFactors,
};

/// Bit patterns of factors: arbitrary ones, and those at boundaries.
pub fn factor() -> impl Strategy<Value = f32> {
    let special = prop::sample::select(vec![
        0x0000_0000, // 0
        0x8000_0000, // -0
        0x0000_0001, // the smallest denormal
        0x007F_FFFF, // the largest denormal
        0x7F80_0000, // infinity
        0xFF80_0000, // -infinity
        0x7FC0_0000, // NaN
        0xFF80_0001, // a signalling NaN
        0x3F80_0040, // 1 + 2^-17
        0x3F80_0041, // just above
        0x3F80_0080, // 1 + 2^-16
        0x427C_0001, // just above 63
        0x4280_0001, // just above 64
        0x7F7F_FFFF, // the largest number
    ]);
    let near_integer = (1u16..=65, -3i32..=3)
        .prop_map(|(integer, ulps)| f32::from(integer).to_bits().wrapping_add_signed(ulps));
    // Just above an integer, where fractions are small and locations coincide.
    let small_fraction =
        (1u32..=64, 0u32..0x600).prop_map(|(integer, sixteenths)| (integer << 16) | sixteenths);
    prop_oneof![
        1 => any::<u32>().prop_map(f32::from_bits),
        1 => special.prop_map(f32::from_bits),
        2 => near_integer.prop_map(f32::from_bits),
        1 => small_fraction.prop_map(from_fixed),
        3 => (0x1_0000u32..0x41_0000).prop_map(from_fixed),
    ]
}

/// The binary32 number of 15.16 bits below 2^24, exactly.
#[must_use]
#[expect(clippy::float_arithmetic, clippy::cast_precision_loss, reason = "24 bits, a power of two")]
pub fn from_fixed(bits: u32) -> f32 {
    bits as f32 / 65536.0
}

/// Factors of any domain, each from [`factor`]; small patches are as likely as large ones.
pub fn factors() -> impl Strategy<Value = PatchFactors> {
    prop_oneof![
        [factor(), factor()].prop_map(|[density, detail]| {
            PatchFactors::Isoline(IsolineFactors { density, detail })
        }),
        [factor(), factor(), factor(), factor()].prop_map(|[u0, v0, w0, inside]| {
            PatchFactors::Triangle(TriangleFactors { u0, v0, w0, inside })
        }),
        [factor(), factor(), factor(), factor(), factor(), factor()].prop_map(
            |[u0, v0, u1, v1, inside_u, inside_v]| {
                PatchFactors::Quad(QuadFactors { u0, v0, u1, v1, inside_u, inside_v })
            }
        ),
    ]
}

/// Every configuration.
pub fn config() -> impl Strategy<Value = Config> {
    let partitioning = prop::sample::select(&Partitioning::ALL[..]);
    let output = prop::sample::select(&OutputPrimitive::ALL[..]);
    let split = prop::sample::select(&SplitOrder::ALL[..]);
    (partitioning, output, split).prop_map(|(partitioning, output, split)| Config {
        partitioning,
        output,
        split,
    })
}
