// Factor processing alone: the fixed-point u = 0 and inside factors of triangle patches.

@group(0) @binding(0) var<storage, read> probe_in: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read_write> probe_out: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> tables: array<u32>;

fn probe(number: u32) {
    if number < arrayLength(&probe_in) {
        let processed = process_triangle(probe_in[number]);
        let is_culled = state_of(processed.topology) == CULLED;
        let both = vec2<u32>(processed.outer.x, processed.inside.x);
        probe_out[number] = select(both, vec2<u32>(0u, 0u), is_culled);
    }
}
