// Factors by distance: one thread per edge of the grid, then one per patch that gathers the
// factors of its edges. Neighbours read the same number, so they agree to the bit.

const GRID = 32u; // patches along x and z, one unit each
const EDGES_OF_ONE_KIND = GRID * (GRID + 1u);
const CAMERA = vec3<f32>(16.0, 7.0, 4.0);
const WRONG_PATCH = 0xffffffffu; // a test names a patch here

@group(0) @binding(0) var<storage, read_write> edges: array<f32>;
@group(0) @binding(1) var<storage, read_write> factors: array<f32>;

fn factor_at(x: f32, z: f32) -> f32 {
    return clamp(110.0 / distance(vec3<f32>(x, 0.0, z), CAMERA), 2.0, 64.0);
}

// Edges along x come first, then edges along z.
@compute @workgroup_size(64)
fn measure_edges(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < EDGES_OF_ONE_KIND {
        let x = f32(id.x % GRID);
        let z = f32(id.x / GRID);
        edges[id.x] = factor_at(x + 0.5, z);
        edges[EDGES_OF_ONE_KIND + id.x] = factor_at(z, x + 0.5);
    }
}

@compute @workgroup_size(64)
fn gather_factors(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= GRID * GRID {
        return;
    }
    let x = id.x % GRID;
    let z = id.x / GRID;
    let u0 = edges[EDGES_OF_ONE_KIND + x * GRID + z];
    let u1 = edges[EDGES_OF_ONE_KIND + (x + 1u) * GRID + z];
    let v0 = edges[z * GRID + x];
    var v1 = edges[(z + 1u) * GRID + x];
    if id.x == WRONG_PATCH {
        v1 = 2.0;
    }
    let at = 6u * id.x;
    factors[at] = u0;
    factors[at + 1u] = v0;
    factors[at + 2u] = u1;
    factors[at + 3u] = v1;
    factors[at + 4u] = 0.5 * (v0 + v1);
    factors[at + 5u] = 0.5 * (u0 + u1);
}
