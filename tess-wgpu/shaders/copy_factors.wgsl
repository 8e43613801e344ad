// Copies factors from the host or from a buffer of the user, bit for bit. Patches past the frame's number are culled.
// The number of factors of a patch replaces FACTORS.

@group(0) @binding(0) var<storage, read_write> factors: array<u32>;
@group(0) @binding(1) var<storage, read> patches: u32;
@group(0) @binding(2) var<storage, read> given: array<u32>;

@compute @workgroup_size(64)
fn copy_factors(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let number = (workgroup.x + workgroup.y * workgroups.x) * 64u + thread;
    let first = number * FACTORS;
    if first >= arrayLength(&factors) {
        return;
    }
    for (var at = first; at < first + FACTORS; at++) {
        factors[at] = select(0u, given[at], number < patches);
    }
}
