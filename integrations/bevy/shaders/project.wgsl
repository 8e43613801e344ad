// The camera or the light of Bevy's pass: the beginning of its uniform buffer.
@group(0) @binding(0) var<uniform> tess_clip_from_world: mat4x4<f32>;
// Whether the shader moves vertices in front of the near plane onto it, because the device cannot draw them.
override tess_clamps: bool = false;

fn tess_project(world: vec3<f32>) -> vec4<f32> {
    var position = tess_clip_from_world * vec4<f32>(world, 1.0);
    position.z = select(position.z, min(position.z, position.w), tess_clamps);
    return position;
}
