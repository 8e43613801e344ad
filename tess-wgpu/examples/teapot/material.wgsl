// The one colour of the teapot.

fn material() -> vec3f {
    return vec3f(0.36, 0.52, 0.70);
}
