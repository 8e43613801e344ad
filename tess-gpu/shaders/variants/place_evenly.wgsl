// needs: stages/fixed_point; bindings: tables
// The location of a point along one dimension (spec section 5) if factors are integers: then nothing
// has to be stored, as a context is the number of segments and its reciprocal.

fn context_of(patch_index: u32, factor: u32, points: u32) -> vec2<u32> {
    return vec2<u32>(points - 1u, tables[RECIPROCALS_AT + points - 2u]);
}

// The 16.16 location of point `position` of an edge, 0..points-1.
fn place(context: vec2<u32>, position: u32) -> u32 {
    let mirror = context.x - position;
    let x = min(position, mirror) * context.y;
    let location = select(x, ONE - x, position > mirror);
    return select(location, HALF, position == mirror);
}

// The same for a position in the first half.
fn place_before_middle(context: vec2<u32>, position: u32) -> u32 {
    return position * context.y;
}
