// needs: stages/counts, stages/factors
// Points and primitives of a patch from the bits of its raw factors.

// The factors in the specification's order, four of them and the next two; a domain with fewer ignores
// the others.
fn tess_counts(raw: vec4<u32>, raw_inside: vec2<u32>) -> vec2<u32> {
    if DOMAIN == ISOLINE {
        return counts(process_isoline(raw.xy).topology);
    }
    if DOMAIN == TRIANGLE {
        return counts(process_triangle(raw).topology);
    }
    return counts(process_quad(raw, raw_inside).topology);
}
