// The vertex shader for vertices that the evaluation has written, where a draw binds all of them: an index is the number
// of a vertex. The bind group's number replaces GROUP.

@group(GROUP) @binding(0) var<storage, read> tess_vertices: array<Vertex>;

@vertex
fn tess_vertex(@builtin(vertex_index) tess_index: u32 BUILTINS) -> Vertex {
    BEGIN
    return PROJECT(tess_vertices[tess_index]);
}
