// The vertex shader without a point buffer: an index is the number of a point of the batch.

@vertex
fn tess_vertex(@builtin(vertex_index) tess_index: u32 BUILTINS) -> Vertex {
    BEGIN
    let at = tess_point_at(tess_index);
    return PROJECT(domain(at.x, tess_location(at.x, at.y)));
}
