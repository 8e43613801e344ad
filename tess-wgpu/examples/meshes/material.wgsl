// The colour of the drawn mesh.

@group(1) @binding(0) var<uniform> colour: vec4f;

fn material() -> vec3f {
    return colour.xyz;
}
