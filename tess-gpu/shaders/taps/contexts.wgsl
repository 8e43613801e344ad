// needs: stages/factor_context
// Contexts alone, of 15.16 factors and their parities.

@group(0) @binding(0) var<storage, read> tap_in: array<vec2<u32>>;
@group(0) @binding(1) var<storage, read_write> tap_out: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> tables: array<u32>;

fn tap(number: u32) {
    if number < arrayLength(&tap_in) {
        tap_out[number] = make_context(tap_in[number].x, tap_in[number].y);
    }
}
