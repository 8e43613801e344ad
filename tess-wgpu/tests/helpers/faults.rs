//! Faults of the helpers, each a text of their WGSL and a wrong one. The table of `helper` must see it.

/// A fault to plant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fault {
    /// The table that sees it.
    pub(crate) helper: &'static str,
    right: &'static str,
    wrong: &'static str,
}

impl Fault {
    /// The shader with the fault. Its text is in the shader once.
    pub(crate) fn plant(&self, source: &str) -> String {
        assert_eq!(source.matches(self.right).count(), 1, "{} is there once", self.right);
        source.replace(self.right, self.wrong)
    }
}

const fn fault(helper: &'static str, right: &'static str, wrong: &'static str) -> Fault {
    Fault { helper, right, wrong }
}

pub(crate) const ALL: &[Fault] = &[
    fault("tess_in_range", "min(factor, 64.0)", "min(factor, 63.0)"),
    fault("tess_in_range", "min(factor, 64.0)", "factor"),
    fault("tess_in_range", "if factor > 1.0 {", "if factor > 1.00001 {"),
    fault("tess_in_range", "if factor > 1.0 {", "if !(factor <= 1.0) {"),
    fault("tess_quotient", "dividend * 0.015625 >= divisor", "dividend * 0.0157 >= divisor"),
    fault("tess_quotient", "return tess_in_range(dividend / divisor)", "return dividend"),
    fault(
        "tess_root_quotient",
        "dividend * 0.000244140625 >= divisor",
        "dividend * 0.00025 >= divisor",
    ),
    fault(
        "tess_root_quotient",
        "tess_in_range(sqrt(dividend / divisor))",
        "tess_in_range(dividend / divisor)",
    ),
    fault("tess_edge_by_screen_size", "(a + b) * 0.5) * segment", "a) * segment"),
    fault("tess_edge_by_screen_size", "(a + b) * 0.5) * segment", "(a + b) * 0.5)"),
    fault("tess_edge_by_screen_size", "distance(a, b) * pixels_per_unit", "pixels_per_unit"),
    fault(
        "tess_edge_by_distance",
        "tess_quotient(scale, distance(eye, (a + b) * 0.5))",
        "tess_quotient(scale, max(distance(eye, (a + b) * 0.5), 1e-6))",
    ),
    fault(
        "tess_edge_by_distance",
        "tess_quotient(scale, distance(eye, (a + b) * 0.5))",
        "tess_quotient(scale, distance(eye, a + (b - a) * 0.5))",
    ),
    fault("tess_edge_by_curvature", "0.75 * bend", "0.74 * bend"),
    fault("tess_edge_by_curvature", "max(length((a + near_b)", "min(length((a + near_b)"),
    fault(
        "tess_edge_by_curvature",
        "tess_pn_edge_point(b, normal_b, a)",
        "tess_pn_edge_point(b, normal_a, a)",
    ),
    fault("tess_pn_edge_point", "(near * 2.0 + far - normal", "(near * 2.0 + far + normal"),
    fault("tess_pn_edge_point", "(near * 2.0 + far - normal", "(far * 2.0 + near - normal"),
    fault("tess_edge_by_flatness", "4.0 * tolerance", "8.0 * tolerance"),
    fault("tess_edge_by_flatness", "while factor < needed", "while factor < 0.9 * needed"),
    fault("tess_edge_by_flatness", "while factor < needed", "while factor <= needed"),
    fault("edges of tess_quad_factors", "QuadFactors(edges, ", "QuadFactors(edges.yxzw, "),
    fault(
        "tess_quad_factors",
        "edges.y + edges.w, edges.x + edges.z",
        "edges.x + edges.z, edges.y + edges.w",
    ),
    fault(
        "tess_quad_factors",
        "edges.y + edges.w, edges.x + edges.z",
        "edges.y + edges.x, edges.w + edges.z",
    ),
    fault("tess_quad_factors", "0.5 * vec2<f32>(edges", "0.501 * vec2<f32>(edges"),
    fault(
        "tess_tri_factors",
        "((edges.y - edges.x) + (edges.z - edges.x)) / 3.0",
        "((edges.y - edges.x) + (edges.z - edges.x)) / 2.0",
    ),
    fault(
        "tess_tri_factors",
        "edges.x + ((edges.y - edges.x) + (edges.z - edges.x)) / 3.0",
        "max(edges.x, max(edges.y, edges.z))",
    ),
    fault(
        "tess_tri_factors",
        "edges.x + ((edges.y - edges.x) + (edges.z - edges.x)) / 3.0",
        "(edges.x + edges.y + edges.z) / 3.0",
    ),
    fault("tess_is_outside", "tess_is_behind(rows[3] + rows[0], center, radius)", "false"),
    fault("tess_is_outside", "tess_is_behind(rows[3] - rows[0], center, radius)", "false"),
    fault("tess_is_outside", "tess_is_behind(rows[3] + rows[1], center, radius)", "false"),
    fault("tess_is_outside", "tess_is_behind(rows[3] - rows[1], center, radius)", "false"),
    fault("tess_is_outside", "tess_is_behind(rows[2], center, radius)", "false"),
    fault(
        "tess_is_outside",
        "tess_is_behind(rows[2], center, radius)",
        "tess_is_behind(rows[3] + rows[2], center, radius)",
    ),
    fault("tess_is_outside", "tess_is_behind(rows[3] - rows[2], center, radius)", "false"),
    fault("tess_is_outside", "transpose(clip_from_world)", "clip_from_world"),
    fault("tess_is_outside", "-radius * length(plane.xyz)", "-radius"),
    fault("tess_is_outside", "-radius * length(plane.xyz)", "radius * length(plane.xyz)"),
    fault("tess_is_outside", "-radius * length(plane.xyz)", "-radius * length(plane)"),
    fault("tess_faces_away", "sine * length(seen) + radius", "sine + radius"),
    fault("tess_faces_away", "sine * length(seen) + radius", "sine * length(seen) - radius"),
    fault("tess_faces_away", "sine * length(seen) + radius", "sine * length(seen)"),
    fault("tess_faces_away", "let seen = center - eye;", "let seen = center;"),
    // Without the branch lavapipe's result is exact all the same, so the fault moves the end instead.
    fault(
        "tess_along",
        "if t >= 1.0 {\n        return b;",
        "if t >= 1.0 {\n        return mix(a, b, 0.9999999);",
    ),
    fault(
        "tess_along",
        "if t <= 0.0 {\n        return a;\n    }\n",
        "if t <= 0.0001 {\n        return a;\n    }\n",
    ),
    fault("tess_along", "if tess_is_before(b, a) {", "if false {"),
    fault("tess_along", "i < 4u", "i < 1u"),
    fault("tess_along", "i < 4u", "i < 3u"),
    fault("tess_along", "b + (a - b) * (1.0 - t)", "b + (a - b) * t"),
    fault(
        "tess_on_quad",
        "tess_along(corners[0], corners[3], uv.y)",
        "tess_along(corners[3], corners[0], uv.y)",
    ),
    fault(
        "tess_on_quad",
        "tess_along(corners[1], corners[2], uv.y)",
        "tess_along(corners[2], corners[1], uv.y)",
    ),
    fault(
        "tess_on_quad",
        "tess_along(corners[0], corners[1], uv.x)",
        "tess_along(corners[1], corners[0], uv.x)",
    ),
    fault(
        "tess_on_quad",
        "tess_along(corners[3], corners[2], uv.x)",
        "tess_along(corners[2], corners[3], uv.x)",
    ),
    fault("tess_on_quad", "(corners[2] - corners[3]) * uv.x", "(corners[2] - corners[3]) * uv.y"),
    fault("tess_on_quad", "(high - low) * uv.y", "(high - low) * uv.x"),
    fault(
        "edges of tess_on_quad",
        "tess_along(corners[0], corners[3], uv.y)",
        "corners[0] + (corners[3] - corners[0]) * uv.y",
    ),
    fault(
        "edges of tess_on_quad",
        "tess_along(corners[3], corners[2], uv.x)",
        "corners[3] + (corners[2] - corners[3]) * uv.x",
    ),
    fault(
        "tess_on_triangle",
        "tess_along(corners[2], corners[1], uv.y)",
        "tess_along(corners[1], corners[2], uv.y)",
    ),
    fault(
        "tess_on_triangle",
        "tess_along(corners[2], corners[0], uv.x)",
        "tess_along(corners[0], corners[2], uv.x)",
    ),
    fault(
        "tess_on_triangle",
        "tess_along(corners[1], corners[0], uv.x)",
        "tess_along(corners[0], corners[1], uv.x)",
    ),
    fault(
        "tess_on_triangle",
        "(corners[1] - corners[2]) * uv.y",
        "(corners[1] - corners[2]) * uv.x",
    ),
    fault("edges of tess_on_triangle", "if w <= 0.0 {", "if w < 0.0 {"),
    fault(
        "edges of tess_on_triangle",
        "tess_along(corners[1], corners[0], uv.x)",
        "corners[1] + (corners[0] - corners[1]) * uv.x",
    ),
    fault("tess_sample", "vec2<f32>(size) - 0.5) * 256.0", "vec2<f32>(size)) * 256.0"),
    fault("tess_sample", "round((at", "floor((at"),
    fault(
        "tess_sample",
        "let a = clamp(low, vec2<i32>(0), last)",
        "let a = clamp(low, vec2<i32>(1), last)",
    ),
    fault(
        "tess_sample",
        "let b = clamp(low + 1, vec2<i32>(0), last)",
        "let b = clamp(low + 1, vec2<i32>(1), last)",
    ),
    fault(
        "tess_sample",
        "let b = clamp(low + 1, vec2<i32>(0), last)",
        "let b = clamp(low, vec2<i32>(0), last)",
    ),
    fault("tess_sample", "let last = size - 1", "let last = size - 2"),
    fault("tess_sample", "(low << vec2<u32>(8u))) / 256.0", "(low << vec2<u32>(8u))) / 255.0"),
    fault("tess_sample", "(texels.w - texels.z) * part.x", "(texels.z - texels.w) * part.x"),
    fault("tess_sample", "(below - above) * part.y", "(below - above) * part.x"),
    fault("bezier_edge", "s = min(t, 1.0 - t);", "s = t;"),
    fault("bezier_edge", "if bezier_is_collapsed(points) {", "if false {"),
    fault("bezier_edge", "if direction > 0 {", "if direction != 0 {"),
    fault("bezier_patch_normal", "mix(v, 0.5, 1.0 / 1024.0)", "mix(v, 0.5, 1.0 / 64.0)"),
    fault("bezier_patch_normal", "cross(inside.du, inside.dv)", "cross(inside.dv, inside.du)"),
    fault(
        "bezier_edge_by_distance",
        "distance(eye, bezier_edge(edge, 0.5)));",
        "distance(eye, bezier_project(edge[0])));",
    ),
    fault(
        "bezier_edge_by_screen_size",
        "select(distance(a, b), distance(c, d), reversed)",
        "distance(a, b)",
    ),
    fault("bezier_edge_by_screen_size", "first + distance(b, c) + last", "first + last"),
];
