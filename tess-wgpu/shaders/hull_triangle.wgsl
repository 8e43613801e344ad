const TESS_FACTORS = 4u;

fn tess_write_factors(number: u32, at: u32, is_drawn: bool) {
    var factors = TriFactors();
    if is_drawn {
        factors = hull(number);
    }
    for (var edge = 0u; edge < 3u; edge++) {
        tess_written_factors[at + edge] = factors.edges[edge];
    }
    tess_written_factors[at + 3u] = factors.inside;
}
