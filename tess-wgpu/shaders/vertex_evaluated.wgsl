// The vertex shader for vertices that the evaluation has written. Their members as parameters replace LOADED; the
// expression that makes a `Vertex` of them replaces VERTEX.

@vertex
fn tess_vertex(LOADED BUILTINS) -> Vertex {
    BEGIN
    return PROJECT(VERTEX);
}
