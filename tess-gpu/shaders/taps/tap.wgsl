// needs: {tap}
// One thread per tapped value.

@compute @workgroup_size(WORKGROUP)
fn taps(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    tap((workgroup.x + workgroup.y * workgroups.x) * WORKGROUP + thread);
}
