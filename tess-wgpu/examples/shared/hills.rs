//! Hills: eight octaves of value noise.

/// Heights from 0 to 1, row by row, with this many texels along each side.
pub(crate) fn heights(texels: u32) -> Vec<f32> {
    let mut heights = Vec::new();
    for y in 0..texels {
        for x in 0..texels {
            let mut height = 0.0;
            for octave in 0..8 {
                height += noise([x, y], texels >> (2 + octave)) / (2 << octave) as f32;
            }
            heights.push(height * height * (3.0 - 2.0 * height));
        }
    }
    heights
}

/// Random numbers from 0 to 1 on a lattice with this many texels between its points, smooth in
/// between.
fn noise(at: [u32; 2], cell: u32) -> f32 {
    let cell = cell.max(1);
    let lattice = |x: u32, y: u32| {
        let mut hash = x.wrapping_mul(0x9E37_79B1) ^ y.wrapping_mul(0x85EB_CA77) ^ cell;
        hash = (hash ^ hash >> 15).wrapping_mul(0x2C1B_3C6D);
        hash = (hash ^ hash >> 12).wrapping_mul(0x297A_2D39);
        (hash >> 16) as f32 / 65535.0
    };
    let [x, y] = at.map(|c| c / cell);
    let [s, t] = at.map(|c| (c % cell) as f32 / cell as f32).map(|s| s * s * (3.0 - 2.0 * s));
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    mix(
        mix(lattice(x, y), lattice(x + 1, y), s),
        mix(lattice(x, y + 1), lattice(x + 1, y + 1), s),
        t,
    )
}
