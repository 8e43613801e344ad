const TESS_FACTORS = 2u;

fn tess_write_factors(number: u32, at: u32, is_drawn: bool) {
    var factors = IsolineFactors();
    if is_drawn {
        factors = hull(number);
    }
    tess_written_factors[at] = factors.density;
    tess_written_factors[at + 1u] = factors.detail;
}
