const TESS_FACTORS = 6u;

fn tess_write_factors(number: u32, at: u32, is_drawn: bool) {
    var factors = QuadFactors();
    if is_drawn {
        factors = hull(number);
    }
    for (var edge = 0u; edge < 4u; edge++) {
        tess_written_factors[at + edge] = factors.edges[edge];
    }
    tess_written_factors[at + 4u] = factors.inside.x;
    tess_written_factors[at + 5u] = factors.inside.y;
}
