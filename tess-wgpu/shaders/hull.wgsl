// Runs the user's hull function, one thread per patch. Patches past the frame's number are culled. The bind group's
// number replaces GROUP.

struct TessFrame {
    patches: u32,
}

@group(GROUP) @binding(0) var<storage, read_write> tess_written_factors: array<f32>;
@group(GROUP) @binding(1) var<storage, read> tess_frame: TessFrame;

@compute @workgroup_size(64)
fn tess_hull(
    @builtin(workgroup_id) tess_workgroup: vec3<u32>,
    @builtin(num_workgroups) tess_workgroups: vec3<u32>,
    @builtin(local_invocation_index) tess_thread: u32,
) {
    let number = (tess_workgroup.x + tess_workgroup.y * tess_workgroups.x) * 64u + tess_thread;
    let at = number * TESS_FACTORS;
    if at < arrayLength(&tess_written_factors) {
        tess_write_factors(number, at, number < tess_frame.patches);
    }
}
