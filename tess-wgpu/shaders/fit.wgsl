// Scales a frame's factors down until the output fits. For the buffers, a worked frame and what must hold, see
// src/stage/fit.rs.
//
// The scales are a ladder: step 0 is 1, each step is a little smaller, and the last one leaves no factor above 1. A
// smaller scale never gives more output. Two rounds therefore find the first step that fits: count every 16th step,
// then the 16 steps up to the first of those that fits.

const COARSE = 16u; // steps between two that are counted first
const SLOTS_OF_FIT = 2u * COARSE + 1u;
const LAST_STEP = COARSE * COARSE;
const BITS_OF_1 = 0x3f800000u;
const BITS_OF_64 = 0x42800000u;
const BITS_OF_INFINITY = 0x7f800000u;

struct Fit {
    // The step that the factors are scaled by.
    step: u32,
    reserved_0: u32,
    reserved_1: u32,
    reserved_2: u32,
    // Points and primitives, each in a low and a high word: at step 0, at steps 16, 32, ... 256, and at the 16 steps up
    // to the first of those that fits.
    sums: array<atomic<u32>, 4u * SLOTS_OF_FIT>,
}

// The batch's room, and the ladder.
struct Terms {
    points: u32,
    primitives: u32,
    // Workgroups of a pass over all patches, along x and y.
    workgroups: vec2<u32>,
    ladder: array<f32>,
}

@group(0) @binding(0) var<storage, read_write> factors: array<u32>;
@group(0) @binding(1) var<storage, read_write> fit: Fit;
@group(0) @binding(2) var<storage, read> terms: Terms;
@group(1) @binding(0) var<storage, read_write> arguments: array<u32, 3>;

var<workgroup> sums: array<atomic<u32>, 2u * COARSE>;

// A factor at a step. A factor of at most 1, and NaN, stays as it is.
fn scaled(bits: u32, step: u32) -> u32 {
    if step == 0u || bits <= BITS_OF_1 || bits > BITS_OF_INFINITY {
        return bits;
    }
    return bitcast<u32>(max(1.0, bitcast<f32>(min(bits, BITS_OF_64)) * terms.ladder[step]));
}

// Points and primitives of a patch at a step.
fn counts_at(number: u32, step: u32) -> vec2<u32> {
    var raw: array<u32, 6>;
    for (var i = 0u; i < FACTORS; i++) {
        raw[i] = scaled(factors[number * FACTORS + i], step);
    }
    return tess_counts(vec4<u32>(raw[0], raw[1], raw[2], raw[3]), vec2<u32>(raw[4], raw[5]));
}

// Adds a workgroup's sum to a number of two words. No workgroup's sum reaches 2^32.
fn add(at: u32, amount: u32) {
    let before = atomicAdd(&fit.sums[at], amount);
    if before + amount < before {
        atomicAdd(&fit.sums[at + 1u], 1u);
    }
}

// Counts one patch at `count` steps, `first`, `first + stride`, ..., into as many slots, the first of which is `slot`.
// Called by all threads of a workgroup.
fn count_steps(number: u32, thread: u32, slot: u32, first: u32, stride: u32, count: u32) {
    if number * FACTORS < arrayLength(&factors) {
        for (var i = 0u; i < count; i++) {
            let own = counts_at(number, first + i * stride);
            atomicAdd(&sums[2u * i], own.x);
            atomicAdd(&sums[2u * i + 1u], own.y);
        }
    }
    workgroupBarrier();
    if thread < 2u * count {
        add(4u * slot + 2u * thread, atomicLoad(&sums[thread]));
    }
}

fn fits(slot: u32) -> bool {
    let at = 4u * slot;
    return atomicLoad(&fit.sums[at + 1u]) == 0u && atomicLoad(&fit.sums[at + 3u]) == 0u
        && atomicLoad(&fit.sums[at]) <= terms.points && atomicLoad(&fit.sums[at + 2u]) <= terms.primitives;
}

// The number of the first of 16 slots that fits, or of the last one.
fn first_that_fits(first: u32) -> u32 {
    var found = 0u;
    while found + 1u < COARSE && !fits(first + found) {
        found++;
    }
    return found;
}

fn number_of(workgroup: vec3<u32>, workgroups: vec3<u32>, thread: u32) -> u32 {
    return (workgroup.x + workgroup.y * workgroups.x) * 64u + thread;
}

@compute @workgroup_size(64)
fn count_whole(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    count_steps(number_of(workgroup, workgroups, thread), thread, 0u, 0u, 0u, 1u);
}

// The other passes run only if the unscaled factors give too much.
@compute @workgroup_size(1)
fn decide() {
    arguments[0] = select(terms.workgroups.x, 0u, fits(0u));
    arguments[1] = terms.workgroups.y;
    arguments[2] = 1u;
}

@compute @workgroup_size(64)
fn count_coarse(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    count_steps(number_of(workgroup, workgroups, thread), thread, 1u, COARSE, COARSE, COARSE);
}

@compute @workgroup_size(64)
fn count_fine(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let first = COARSE * first_that_fits(1u) + 1u;
    count_steps(number_of(workgroup, workgroups, thread), thread, 1u + COARSE, first, 1u, COARSE);
}

@compute @workgroup_size(64)
fn scale_factors(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let step = COARSE * first_that_fits(1u) + 1u + first_that_fits(1u + COARSE);
    let number = number_of(workgroup, workgroups, thread);
    if number == 0u {
        fit.step = step;
    }
    let first = number * FACTORS;
    if first >= arrayLength(&factors) {
        return;
    }
    for (var at = first; at < first + FACTORS; at++) {
        factors[at] = scaled(factors[at], step);
    }
}
