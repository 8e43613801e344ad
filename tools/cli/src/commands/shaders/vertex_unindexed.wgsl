// The vertex shader without a point buffer and without indices: one vertex for each corner of a primitive.

@vertex
fn tess_vertex(@builtin(vertex_index) tess_index: u32 BUILTINS) -> Vertex {
    BEGIN
    let at = tess_primitive_at(tess_index / INDICES);
    let corner = tess_primitive(at.x, at.y)[tess_index % INDICES];
    return PROJECT(domain(at.x, tess_location(at.x, corner)));
}
