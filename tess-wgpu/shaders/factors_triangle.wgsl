
// The factors of a patch that are drawn: those that `hull` returned, or scaled down so that everything fits.
fn tess_factors(number: u32) -> TriFactors {
    let at = 4u * number;
    return TriFactors(
        vec3<f32>(tess_drawn_factors[at], tess_drawn_factors[at + 1u], tess_drawn_factors[at + 2u]),
        tess_drawn_factors[at + 3u]);
}
