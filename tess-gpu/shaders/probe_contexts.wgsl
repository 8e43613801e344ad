// needs: make_context
// Contexts alone, of 15.16 factors and their parities.

@group(0) @binding(0) var<storage, read> probe_in: array<vec2<u32>>;
@group(0) @binding(1) var<storage, read_write> probe_out: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> tables: array<u32>;

fn probe(number: u32) {
    if number < arrayLength(&probe_in) {
        probe_out[number] = make_context(probe_in[number].x, probe_in[number].y);
    }
}
