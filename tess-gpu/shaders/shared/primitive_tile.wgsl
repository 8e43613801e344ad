// needs: shared/alike, {catalogue}, stages/connect, stages/cache_order, {elements}, shared/expand, {indices}, shared/offsets, layout/packed_triangle, stages/rings, layout/setup, stages/stitch, shared/tile, layout/topology; bindings: job, status
// A tile of primitives: a workgroup writes the indices of 2048 consecutive primitives of the batch, or of fewer for a
// short batch. The entry points `expand_primitives` and `expand_short` call `write_primitive_tile`.
//
// Thread t takes the pair of elements 2t and 2t + 1, then the pair 2 THREADS further on. A primitive follows from only
// its number:
//
//     element --find_patch--> patch --location_of--> ring, edge, step --stitch_from--> rows --stitch_triangles--> indices
//
// The second of a pair is the next step of the same stitch, or begins the next edge or patch (`first_triangle`). Four ways
// to fill a tile, the first that can be taken:
//
//     copy_triangles           all patches alike, of at most 2 SCRATCH triangles: one is kept in `scratch`, then copied
//     write_listed_triangles   every patch of the round is in the catalogue
//     write_triangles          any other triangles
//     write_sequences          points and lines
//
//     scratch, kept    triangle i of the patch: scratch[i].x, and scratch[i - SCRATCH].y from SCRATCH on; three
//                      vertices of 10 bits (layout/packed_triangle.wgsl)
//
// Patches like (3, 4.5, 5, 6; 4, 7) have 62 triangles each, and 33 of them 2046:
//
//   tile 1 begins with element 2048, triangle 2 of patch 33: begins[0] is -2, and thread 0 makes triangles 2 and 3
//   index 100 of a copied tile 0 is corner 1 of its triangle 33: (100 * 43691) >> 17 = 33, and 100 - 99 = 1
//
// What must hold:
// - Pairs begin at even elements, counted from the tile's base, so a pair is one aligned store of six indices; of 16
//   bits they are three words. Indices are stored in variants/indices_u32.wgsl and variants/indices_u16.wgsl.
// - An element outside of round.begin..round.end is not written: it is another round's or portion's.
// - All threads of a workgroup call `write_primitive_tile`: `load_round` and `copy_triangles` have barriers.
// - In the vertex-cache order the next element may not be the next step, so `drawn_next` finds it.
//
// The simpler form computes each triangle. On an H100 `uniform-16` takes 684 microseconds without copies instead of 460,
// `character` 1053 without the catalogue instead of 709 (benches/records/gpu-ablation.json).

// The patch that elements are taken from.
struct Source {
    // Within the round.
    number: u32,
    begin: u32,
    base: u32,
    is_regular: bool,
    rings: Rings,
}

fn load_source(round: Round, number: u32) -> Source {
    let patch_index = round.first + number;
    let topology = scratch[number];
    let base = select(0u, patch_offset(patch_index).x, NUMBERING == PER_BATCH);
    return Source(
        number, u32(begins[number]), base, state_of(topology) == REGULAR, rings_of(topology));
}

fn location_of(source: Source, t: u32) -> RingLocation {
    if source.is_regular {
        return triangle_location(source.rings, t);
    }
    return RingLocation(1u, 0u, t);
}

fn stitch_from(source: Source, location: RingLocation) -> Stitch {
    if !source.is_regular {
        return minimum_stitch(source.base);
    }
    return stitch_at(source.rings, location, source.base);
}

fn write_triangles(round: Round, thread: u32, out: u32) {
    var source: Source;
    source.number = NEVER;
    for (var element = 2u * thread; element < tile_size(); element += 2u * THREADS) {
        if element + 1u < round.begin || element >= round.end {
            continue;
        }
        // An even element and the one after it are stored together. At either end of the round one of the two belongs
        // to other patches, which another round or tile writes.
        let first = max(element, round.begin);
        let number = find_patch(round, first);
        if number != source.number {
            source = load_source(round, number);
        }
        let location = location_of(source, first - source.begin);
        let stitch = stitch_from(source, location);
        let pair = stitch_triangles(stitch, location.step);
        let at = (out + element) >> 1u;
        let is_whole = first == element && element + 1u < round.end;
        // Two steps of one stitch share two of their vertices, so both come at the price of one.
        if is_whole && ORDER == SPECIFICATION && location.step + 1u < stitch.size {
            write_triangle_pair(at, pair.first, pair.second);
        } else {
            write_triangle(at, first != element, pair.first);
            if is_whole {
                write_triangle(at, true, first_triangle(round, source, location, element + 1u));
            }
        }
    }
}

// The triangle of an element that begins a stitch: the one after a location, or the first of a patch. In the
// vertex-cache order, the triangle of any element.
fn first_triangle(round: Round, before: Source, location: RingLocation, element: u32) -> vec3<u32> {
    var source = before;
    var next = RingLocation(1u, 0u, 0u);
    let number = next_patch(round, before.number, element);
    if number != before.number {
        source = load_source(round, number);
    } else if ORDER == SPECIFICATION {
        next = next_edge(location);
    } else {
        next = drawn_next(source, location, element);
    }
    return stitch_triangles(stitch_from(source, next), next.step).first;
}

// In the vertex-cache order, the location of the element after the one at a location of the same patch.
fn drawn_next(source: Source, location: RingLocation, element: u32) -> RingLocation {
    if source.is_regular {
        let next = drawn_behind(source.rings, location);
        if next.ring != NEVER {
            return next;
        }
    }
    return location_of(source, element - source.begin);
}

// A triangle of the catalogue for patch `number` of the round.
fn listed_triangle(number: u32, element: u32) -> vec3<u32> {
    let own = listed[number];
    return unpacked_triangle(catalogue_word(own.x + element), own.y);
}

fn write_listed_triangles(round: Round, thread: u32, out: u32) {
    for (var element = 2u * thread; element < tile_size(); element += 2u * THREADS) {
        if element + 1u < round.begin || element >= round.end {
            continue;
        }
        let first = max(element, round.begin);
        let number = find_patch(round, first);
        let triangle = listed_triangle(number, first);
        let at = (out + element) >> 1u;
        if first == element && element + 1u < round.end {
            let next = next_patch(round, number, element + 1u);
            write_triangle_pair(at, triangle, listed_triangle(next, element + 1u));
        } else {
            write_triangle(at, first != element, triangle);
        }
    }
}

fn write_sequences(round: Round, thread: u32, out: u32) {
    for (var pair = 2u * thread; pair < tile_size(); pair += 2u * THREADS) {
        for (var element = pair; element < pair + 2u; element++) {
            if element < round.begin || element >= round.end {
                continue;
            }
            let number = find_patch(round, element);
            let base =
                select(0u, patch_offset(round.first + number).x, NUMBERING == PER_BATCH);
            let t = element - u32(begins[number]);
            let index = sequence_first(scratch[number], t, base);
            if INDICES == 2u {
                write_two(out + element, index, index + 1u);
            } else {
                write_single(out + element, index);
            }
        }
    }
}

// Keeps the triangles of one patch, two in an element, each of three vertices of 10 bits.
fn keep_triangles(repeat: Repeat, thread: u32) {
    let is_regular = state_of(repeat.topology) == REGULAR;
    let source = Source(0u, 0u, 0u, is_regular, rings_of(repeat.topology));
    for (var i = thread; i < repeat.size; i += THREADS) {
        let location = location_of(source, i);
        let triangle = stitch_triangles(stitch_from(source, location), location.step).first;
        let packed = packed_triangle(triangle);
        if i < SCRATCH {
            scratch[i].x = packed;
        } else {
            scratch[i - SCRATCH].y = packed;
        }
    }
}

// Vertex `corner` of triangle `i` of one of the tile's patches.
struct Corner {
    number: u32,
    i: u32,
    corner: u32,
}

// The corner that index `at` of the tile stands for.
fn corner_at(repeat: Repeat, at: u32) -> Corner {
    // A third of it, exactly, as it is below 3 * 2048.
    let element = (at * 43691u) >> 17u;
    let position = element + repeat.before;
    let number = patch_at(repeat, position);
    return Corner(number, position - number * repeat.size, at - 3u * element);
}

fn next_corner(repeat: Repeat, it: Corner) -> Corner {
    let is_last_corner = it.corner == 2u;
    let is_last = is_last_corner && it.i + 1u == repeat.size;
    return Corner(
        it.number + select(0u, 1u, is_last),
        select(it.i + select(0u, 1u, is_last_corner), 0u, is_last),
        select(it.corner + 1u, 0u, is_last_corner));
}

fn kept_index(repeat: Repeat, it: Corner) -> u32 {
    let is_low = it.i < SCRATCH;
    let two = scratch[select(it.i - SCRATCH, it.i, is_low)];
    let vertex = packed_vertex(select(two.y, two.x, is_low), it.corner);
    return vertex + select(0u, repeat.base + it.number * repeat.points, NUMBERING == PER_BATCH);
}

// Writes two indices at a time, even if they belong to two triangles.
fn copy_triangles(tile: Tile, repeat: Repeat, thread: u32, out: u32) {
    keep_triangles(repeat, thread);
    workgroupBarrier();
    // From here on in indices: 16-bit ones are stored in pairs, and a pair may have indices of two triangles.
    let begin = 3u * (tile.begin - tile.base);
    let end = 3u * (tile.end - tile.base);
    for (var at = 2u * thread; at < end; at += 2u * THREADS) {
        if at + 1u < begin {
            continue;
        }
        let first = max(at, begin);
        let here = corner_at(repeat, first);
        let index = kept_index(repeat, here);
        if first == at && at + 1u < end {
            let second = kept_index(repeat, next_corner(repeat, here));
            write_two((3u * out + at) >> 1u, index, second);
        } else {
            write_single(3u * out + first, index);
        }
    }
}

// Writes tile `number` of the window. Called by all threads of a workgroup.
fn write_primitive_tile(number: u32, thread: u32) {
    let range = status.ranges[job.portion];
    let tile = tile_of(
        number, range.primitives_begin, range.primitives_end, job.primitive_tiles_at);
    if tile.end == 0u || status.overflow != 0u {
        return;
    }
    let out = tile.base - (job.window_first << job.tile_bits);
    if IS_TRIANGLES {
        let repeat = repeat_of(tile, PRIMITIVES, 2u * SCRATCH);
        if repeat.size > 0u {
            copy_triangles(tile, repeat, thread, out);
            return;
        }
    }
    for (var first = tile.first_patch; first <= tile.last_patch; first += ROUND) {
        let round = load_round(tile, first, PRIMITIVES, thread);
        if IS_TRIANGLES && round.is_listed {
            write_listed_triangles(round, thread, out);
        } else if IS_TRIANGLES {
            write_triangles(round, thread, out);
        } else {
            write_sequences(round, thread, out);
        }
    }
}
