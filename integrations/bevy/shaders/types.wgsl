// The plugin's bindings and the structure that a domain function returns. The bind group's number replaces TESS_GROUP.
// render/layout.rs has the structs TessView and TessInstance in Rust.

struct TessView {
    clip_from_world: mat4x4<f32>,
    eye: vec3<f32>,
    // Pixels of a length of 1 at distance 1; with an orthographic projection at any distance.
    pixels_per_unit: f32,
    is_orthographic: u32,
    reserved_0: u32,
    reserved_1: u32,
    reserved_2: u32,
    // A surface behind one of them is not seen and casts no shadow that is seen.
    planes: array<vec4<f32>, 6>,
}

struct TessInstance {
    world_from_local: mat4x4<f32>,
    // The inverse transpose; its upper left 3 x 3 part is used.
    normal_from_local: mat4x4<f32>,
    // To the place in the previous frame.
    previous_from_world: mat4x4<f32>,
    // The factor rule: its kind and its amount.
    rule: vec4<f32>,
    first_patch: u32,
    first_word: u32,
    first_value: u32,
    reserved: u32,
}

// In world space.
struct Vertex {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    // Linear; multiplies the base colour.
    @location(3) color: vec4<f32>,
    @location(4) @interpolate(flat) instance: u32,
}

// Binding 0 is Bevy's `mesh`, for its fragment functions.
@group(TESS_GROUP) @binding(1) var<uniform> tess_camera: TessView;
@group(TESS_GROUP) @binding(2) var<storage, read> tess_instances: array<TessInstance>;
