// Runs the user's domain function once for each point of a window; for the buffers, see src/stage/evaluation.rs. The
// bind group's number replaces GROUP.

// The first words of tess_gpu::layout::Status.
struct TessStatus {
    points: u32,
    points_high: u32,
    primitives: u32,
    primitives_high: u32,
    overflow: u32,
}

struct TessWindow {
    // The number of its first point.
    first: u32,
    // The points that it has room for.
    count: u32,
}

@group(GROUP) @binding(0) var<storage, read> tess_packed_points: array<vec2<u32>>;
@group(GROUP) @binding(1) var<storage, read_write> tess_vertices: array<Vertex>;
@group(GROUP) @binding(2) var<storage, read> tess_status: TessStatus;
@group(GROUP) @binding(3) var<storage, read> tess_window: TessWindow;

@compute @workgroup_size(64)
fn tess_evaluate(
    @builtin(global_invocation_id) tess_thread: vec3<u32>,
    @builtin(num_workgroups) tess_workgroups: vec3<u32>,
) {
    let points = select(0u, tess_status.points, tess_status.overflow == 0u);
    let count = min(max(points, tess_window.first) - tess_window.first, tess_window.count);
    for (var at = tess_thread.x; at < count; at += 64u * tess_workgroups.x) {
        let point = tess_unpacked(tess_packed_points[at]);
        tess_vertices[at] = domain(point.number, point.location);
    }
}
