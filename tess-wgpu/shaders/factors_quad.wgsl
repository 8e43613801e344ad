
// The factors of a patch that are drawn: those that `hull` returned, or scaled down so that everything fits.
fn tess_factors(number: u32) -> QuadFactors {
    let at = 6u * number;
    return QuadFactors(
        vec4<f32>(tess_drawn_factors[at], tess_drawn_factors[at + 1u], tess_drawn_factors[at + 2u],
            tess_drawn_factors[at + 3u]),
        vec2<f32>(tess_drawn_factors[at + 4u], tess_drawn_factors[at + 5u]));
}
