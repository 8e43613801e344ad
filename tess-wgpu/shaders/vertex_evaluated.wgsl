// The vertex shader for vertices that the evaluation has written: LOADED are their members, VERTEX puts them together.

@vertex
fn tess_vertex(LOADED BUILTINS) -> Vertex {
    BEGIN
    return PROJECT(VERTEX);
}
