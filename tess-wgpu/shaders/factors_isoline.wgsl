
// The factors of a patch that are drawn: those that `hull` returned, or scaled down so that everything fits.
fn tess_factors(number: u32) -> IsolineFactors {
    return IsolineFactors(tess_drawn_factors[2u * number], tess_drawn_factors[2u * number + 1u]);
}
