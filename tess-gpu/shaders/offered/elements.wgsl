// needs: shared/offsets, layout/setup, shared/tile_size; bindings: job, tiles
// The patch that an element of a batch of one portion belongs to, and the element's number within it: a
// binary search among the patches of its tile. A tile has few patches where patches have many elements.

// `kind` is POINTS or PRIMITIVES; `table_at` is where the kind's tiles begin in the table.
fn element_at(element: u32, kind: u32, table_at: u32) -> vec2<u32> {
    let at = table_at + tile_at(element);
    var low = tiles[at];
    var high = tiles[at + 1u];
    while low < high {
        let middle = (low + high + 1u) >> 1u;
        if patch_offset(middle)[kind] <= element {
            low = middle;
        } else {
            high = middle - 1u;
        }
    }
    return vec2<u32>(low, element - patch_offset(low)[kind]);
}

// The patch of a point of the batch, and the point's number within the patch.
fn tess_point_at(point: u32) -> vec2<u32> {
    return element_at(point, POINTS, 0u);
}

// The same for a primitive.
fn tess_primitive_at(primitive: u32) -> vec2<u32> {
    return element_at(primitive, PRIMITIVES, job.primitive_tiles_at);
}
