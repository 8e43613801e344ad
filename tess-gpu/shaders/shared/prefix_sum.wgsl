// needs: nothing
// Prefix sums within a workgroup of SUMMED threads, which are 256, in a tree of fours.

// Where the sums of 4, 16 and 64 numbers are, and the sum of all.
const FOURS = SUMMED;
const SIXTEENS = FOURS + SUMMED / 4u;
const SIXTY_FOURS = SIXTEENS + SUMMED / 16u;
const WHOLE = SIXTY_FOURS + SUMMED / 64u;

// The threads' numbers, then these sums.
var<workgroup> sums: array<vec2<u32>, WHOLE + 1u>;

struct Sums {
    // Over the threads before this one, and over all threads.
    before: vec2<u32>,
    all: vec2<u32>,
}

// Replaces four numbers by the sum before each, and stores the sum of all four.
fn add_four(from_at: u32, to_at: u32) {
    let first = sums[from_at];
    let second = first + sums[from_at + 1u];
    let third = second + sums[from_at + 2u];
    sums[to_at] = third + sums[from_at + 3u];
    sums[from_at] = vec2<u32>(0u);
    sums[from_at + 1u] = first;
    sums[from_at + 2u] = second;
    sums[from_at + 3u] = third;
}

// The sums of `own`. Called in uniform control flow by all threads. Four steps up the tree; the way down is one sum,
// because each step has left, in place of its four numbers, the sums before them in their group of four.
fn prefix_sums(thread: u32, own: vec2<u32>) -> Sums {
    sums[thread] = own;
    workgroupBarrier();
    if thread < SUMMED / 4u {
        add_four(4u * thread, FOURS + thread);
    }
    workgroupBarrier();
    if thread < SUMMED / 16u {
        add_four(FOURS + 4u * thread, SIXTEENS + thread);
    }
    workgroupBarrier();
    if thread < SUMMED / 64u {
        add_four(SIXTEENS + 4u * thread, SIXTY_FOURS + thread);
    }
    workgroupBarrier();
    if thread == 0u {
        add_four(SIXTY_FOURS, WHOLE);
    }
    workgroupBarrier();
    // Before this thread in its four, before its four in their sixteen, and so on.
    let before = sums[thread] + sums[FOURS + (thread >> 2u)]
        + sums[SIXTEENS + (thread >> 4u)] + sums[SIXTY_FOURS + (thread >> 6u)];
    let all = sums[WHOLE];
    // All have read, so the next call may write.
    workgroupBarrier();
    return Sums(before, all);
}
