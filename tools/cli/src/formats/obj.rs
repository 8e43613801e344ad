//! A Wavefront OBJ file of the flat patch: x = u, y = v, z = 0.

use super::OnePatch;
use std::fmt::Write;
use tess_verify::vectors::primitive_size;

pub(super) fn render(patch: &OnePatch) -> String {
    let mut text = format!("# {}\n", patch.case().command());
    for point in &patch.output().points {
        let [u, v] = point.to_f32();
        // Writing to a String does not fail. 16.16 numbers are exact in 16 decimals.
        _ = writeln!(text, "v {u} {v} 0");
    }
    let element = ["p", "l", "f"][primitive_size(patch.case()) - 1];
    for primitive in patch.listing.primitives() {
        let indices: Vec<_> = primitive.iter().map(|index| (index + 1).to_string()).collect();
        _ = writeln!(text, "{element} {}", indices.join(" "));
    }
    text
}
