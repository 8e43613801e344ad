// Prefix sums within a workgroup of 256 threads.

var<workgroup> sums: array<vec2<u32>, 512>;

// The sum of `own` over threads 0..=thread. Called in uniform control flow by all 256 threads.
fn inclusive_scan(thread: u32, own: vec2<u32>) -> vec2<u32> {
    var through = own;
    var half = 0u; // two halves take turns, so one barrier a step is enough
    for (var reach = 1u; reach < 256u; reach <<= 1u) {
        sums[half + thread] = through;
        workgroupBarrier();
        if thread >= reach {
            through += sums[half + thread - reach];
        }
        half ^= 256u;
    }
    workgroupBarrier();
    return through;
}
