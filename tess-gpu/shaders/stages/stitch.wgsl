// needs: nothing; bindings: tables
// The triangles between two rows of vertices (spec sections 7.2 to 7.4). Every triangle of a patch
// is a step of a stitch. Transitions, ring stitches and the strips in the centre differ only in their
// rows and in their steps, which are in a table (src/tables.rs).

struct Stitch {
    // The number of its triangles.
    size: u32,
    // Where its steps are in the tables.
    steps_at: u32,
    // The first vertex of each row; vertex k is k further, unless a row turns.
    outer: u32,
    inner: u32,
    // Whether a row closes its ring or walks back over it. Then a vertex at or after the row's turn is
    // replaced: by the row's mirror minus the vertex.
    turns: bool,
    outer_turn: u32,
    outer_mirror: u32,
    inner_turn: u32,
    inner_mirror: u32,
}

fn outer_vertex(stitch: Stitch, at: u32) -> u32 {
    return select(at, stitch.outer_mirror - at, at >= stitch.outer_turn);
}

fn inner_vertex(stitch: Stitch, at: u32) -> u32 {
    return select(at, stitch.inner_mirror - at, at >= stitch.inner_turn);
}

// A triangle from vertex `a` of the outer row, `b` of the inner and the next, `c`, of either.
fn oriented(a: u32, b: u32, c: u32, begins_inner: bool) -> vec3<u32> {
    let first = select(a, b, begins_inner);
    let second = select(c, a, begins_inner);
    let third = select(b, c, begins_inner);
    if OUTPUT == OUTPUT_TRIANGLE_CCW {
        return vec3<u32>(first, third, second);
    }
    return vec3<u32>(first, second, third);
}

// Two triangles in a row.
struct Pair {
    first: vec3<u32>,
    second: vec3<u32>,
}

// Triangles `number` and `number` + 1 of a stitch; `second` is meaningless for the last triangle. A step
// begins at one vertex of each row, `a` and `b`, and advances along one of the rows.
fn stitch_triangles(stitch: Stitch, number: u32) -> Pair {
    let steps = tables[stitch.steps_at + number];
    let first_inner = (steps & 0x80u) != 0u;
    let second_inner = (steps & 0x800000u) != 0u;
    var a = stitch.outer + (steps & 127u);
    var b = stitch.inner + number - (steps & 127u);
    var c = select(a, b, first_inner) + 1u;
    var d = select(select(c, a, first_inner), select(b, c, first_inner), second_inner) + 1u;
    if stitch.turns {
        c = select(outer_vertex(stitch, c), inner_vertex(stitch, c), first_inner);
        d = select(outer_vertex(stitch, d), inner_vertex(stitch, d), second_inner);
        a = outer_vertex(stitch, a);
        b = inner_vertex(stitch, b);
    }
    return Pair(
        oriented(a, b, c, (steps & 0x100u) != 0u),
        oriented(
            select(c, a, first_inner), select(b, c, first_inner), d, (steps & 0x1000000u) != 0u));
}
