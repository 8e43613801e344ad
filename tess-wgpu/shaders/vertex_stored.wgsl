// The vertex shader: a packed point to the user's domain function.

@vertex
fn tess_vertex(@location(0) tess_packed: vec2<u32> BUILTINS) -> Vertex {
    BEGIN
    let point = tess_unpacked(tess_packed);
    return PROJECT(domain(point.number, point.location));
}
