// needs: layout/packed_context, stages/place
// Placing alone: 65 words for each packed context, as many of them written as it has points.

@group(0) @binding(0) var<storage, read> tap_in: array<vec2<u32>>;
@group(0) @binding(1) var<storage, read_write> tap_out: array<u32>;

fn tap(number: u32) {
    if number >= arrayLength(&tap_in) {
        return;
    }
    let context = tap_in[number];
    let points = 2u * half_points_of(context) + 1u - odd_of(context);
    for (var position = 0u; position < min(points, 65u); position++) {
        tap_out[65u * number + position] = place(context, position);
    }
}
