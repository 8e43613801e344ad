// The vertex shader without a point buffer and without indices: one vertex for each corner of a primitive.

@vertex
fn tess_vertex(@builtin(vertex_index) tess_index: u32) -> Vertex {
    let at = tess_primitive_at(tess_index / INDICES);
    let corner = tess_primitive(at.x, at.y)[tess_index % INDICES];
    return domain(at.x, tess_location(at.x, corner));
}
