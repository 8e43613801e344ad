// needs: shared/alike, {catalogue}, shared/described, {elements}, shared/expand, layout/point_format, stages/points, stages/rings, layout/setup, shared/tile, layout/topology; bindings: job, points_out, status
// A tile of points: a workgroup writes 2048 consecutive domain points of the batch, or fewer for a short batch. The entry
// points `expand_points` and `expand_short` call `write_point_tile`.
//
// Thread t takes the pair of elements 2t and 2t + 1, then the pair 2 THREADS further on. A point follows from only its
// number:
//
//     element --find_patch--> patch --location_of_point--> ring, edge, step --run_at--> run --point_of_run--> u, v
//
// A run is a row of points with one constant coordinate, so the second point of a pair is its next step, or begins the next
// run (`first_run`). Three ways to fill a tile, the first that can be taken:
//
//     copy_points           all patches have the same points, at most SCRATCH: one patch is kept in `scratch`, then copied
//     write_listed_points   every patch of the round is in the catalogue, which has points (integer factors) or descriptions
//     write_points          any other points
//
// Patches like (3, 4.5, 5, 6; 4, 7) have 43 points each: begins = [0, 43, 86].
//
//   thread 21 makes elements 42 and 43: point 42 of patch 0, the last of its centre row, and point 0 of patch 1, which
//   begins the edge u = 0
//
// What must hold:
// - An element outside of round.begin..round.end is not written: it is another round's or portion's.
// - Points of equal topologies are equal only with integer factors or in a minimum patch (`has_same_points`): fractional
//   factors with the same number of points have other locations.
// - All threads of a workgroup call `write_point_tile`: `load_round` and `copy_points` have barriers.
//
// The simpler form, one point for each thread, takes 15 % longer with integer factors; without copies `uniform-16` takes
// 684 microseconds on an H100 instead of 460 (docs/experiments.md, benches/records/gpu-ablation.json).

// The patch that points are taken from.
struct PointSource {
    // Within the round.
    number: u32,
    begin: u32,
    topology: vec2<u32>,
    axes: PatchAxes,
}

fn load_point_source(round: Round, number: u32) -> PointSource {
    var source = point_source_of(round.first + number, scratch[number]);
    source.number = number;
    source.begin = u32(begins[number]);
    return source;
}

fn point_source_of(patch_index: u32, topology: vec2<u32>) -> PointSource {
    var source: PointSource;
    source.topology = topology;
    if DOMAIN != ISOLINE && state_of(topology) == REGULAR {
        source.axes = axes_of(patch_index, topology);
    }
    return source;
}

fn location_of_point(source: PointSource, i: u32) -> RingLocation {
    if DOMAIN != ISOLINE && state_of(source.topology) == REGULAR {
        return point_location(source.axes.rings, i);
    }
    return RingLocation(0u, 0u, i);
}

fn run_at(round: Round, source: PointSource, location: RingLocation) -> PointRun {
    if DOMAIN == ISOLINE {
        return line_run(round.first + source.number, source.topology, location.step);
    }
    if state_of(source.topology) == MINIMUM {
        return minimum_run(location.step);
    }
    return run_of(source.axes, location);
}

fn write_points(round: Round, thread: u32, out: u32) {
    var source: PointSource;
    source.number = NEVER;
    let patch_number = job.first_patch + round.first;
    for (var element = 2u * thread; element < tile_size(); element += 2u * THREADS) {
        if element + 1u < round.begin || element >= round.end {
            continue;
        }
        let first = max(element, round.begin);
        let number = find_patch(round, first);
        if number != source.number {
            source = load_point_source(round, number);
        }
        let location = location_of_point(source, first - source.begin);
        var run = run_at(round, source, location);
        points_out[out + first] = format_point(point_of_run(run, run.step), patch_number + number);
        if first == element && element + 1u < round.end {
            // The next point is nearly always of the same run: one edge of a ring. Else it begins a run, of the next edge
            // or of the next patch.
            run.step++;
            if run.step == run.size {
                let next = next_patch(round, number, element + 1u);
                if next != number {
                    source = load_point_source(round, next);
                }
                run = first_run(round, source, location, next != number, element + 1u);
            }
            points_out[out + element + 1u] =
                format_point(point_of_run(run, run.step), patch_number + source.number);
        }
    }
}

// The run that begins with an element: the one after a location, or the first of a patch.
fn first_run(round: Round, source: PointSource, location: RingLocation, is_next_patch: bool, element: u32) -> PointRun {
    if DOMAIN == ISOLINE {
        return run_at(round, source, RingLocation(0u, 0u, element - source.begin));
    }
    var next = next_edge(location);
    if is_next_patch {
        next = RingLocation(0u, 0u, 0u);
    }
    return run_at(round, source, next);
}

// A point of the catalogue for a patch of the round.
fn listed_point(round: Round, number: u32, element: u32) -> vec2<u32> {
    let at = listed[number].x + POINT_WORDS * element;
    let patch_index = round.first + number;
    let patch_number = job.first_patch + patch_index;
    if IS_INTEGER {
        return numbered(
            vec2<u32>(catalogue_word(at), catalogue_word(at + 1u)), patch_number);
    }
    return format_point(placed_point(catalogue_word(at), patch_index), patch_number);
}

fn write_listed_points(round: Round, thread: u32, out: u32) {
    for (var element = 2u * thread; element < tile_size(); element += 2u * THREADS) {
        if element + 1u < round.begin || element >= round.end {
            continue;
        }
        let first = max(element, round.begin);
        let number = find_patch(round, first);
        points_out[out + first] = listed_point(round, number, first);
        if first == element && element + 1u < round.end {
            let next = next_patch(round, number, element + 1u);
            points_out[out + element + 1u] = listed_point(round, next, element + 1u);
        }
    }
}

// Whether patches of one topology have the same points.
fn has_same_points(topology: vec2<u32>) -> bool {
    return IS_INTEGER || state_of(topology) == MINIMUM;
}

fn copy_points(tile: Tile, repeat: Repeat, thread: u32, out: u32) {
    let source = point_source_of(tile.first_patch, repeat.topology);
    let round = Round(tile.first_patch, 1u, 0u, 0u, false);
    for (var i = thread; i < repeat.size; i += THREADS) {
        let run = run_at(round, source, location_of_point(source, i));
        scratch[i] = format_point(point_of_run(run, run.step), 0u);
    }
    workgroupBarrier();
    let end = tile.end - tile.base;
    for (var element = tile.begin - tile.base + thread; element < end; element += THREADS) {
        let position = element + repeat.before;
        let number = patch_at(repeat, position);
        points_out[out + element] = numbered(
            scratch[position - number * repeat.size],
            job.first_patch + tile.first_patch + number);
    }
}

// Writes tile `number` of the window. Called by all threads of a workgroup.
fn write_point_tile(number: u32, thread: u32) {
    let range = status.ranges[job.portion];
    let tile = tile_of(number, range.points_begin, range.points_end, 0u);
    if tile.end == 0u || status.overflow != 0u {
        return;
    }
    let out = tile.base - (job.window_first << job.tile_bits);
    let repeat = repeat_of(tile, POINTS, SCRATCH);
    if repeat.size > 0u && has_same_points(repeat.topology) {
        copy_points(tile, repeat, thread, out);
        return;
    }
    for (var first = tile.first_patch; first <= tile.last_patch; first += ROUND) {
        let round = load_round(tile, first, POINTS, thread);
        if round.is_listed {
            write_listed_points(round, thread, out);
        } else {
            write_points(round, thread, out);
        }
    }
}
