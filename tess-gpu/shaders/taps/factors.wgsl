// needs: stages/factors, layout/topology
// Factor processing alone: of (x, y, z; w) the fixed-point u = 0 factor of the triangle patch
// (x, y, z; y), 0 if it is culled, and the inside factor of (y, y, z; w).

@group(0) @binding(0) var<storage, read> tap_in: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read_write> tap_out: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> tables: array<u32>;

fn tap(number: u32) {
    if number < arrayLength(&tap_in) {
        let given = tap_in[number];
        let outer = process_triangle(given.xyzy);
        let inside = process_triangle(given.yyzw);
        let is_culled = state_of(outer.topology) == CULLED;
        tap_out[number] = vec2<u32>(select(outer.outer.x, 0u, is_culled), inside.inside.x);
    }
}
