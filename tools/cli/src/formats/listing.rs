//! The listing form of `golden/cases.txt`.

use super::OnePatch;
use std::fmt::Write;

pub(super) fn render(patch: &OnePatch) -> String {
    let mut text =
        format!("# tess-vectors 1 kind=listings count=1 source=tess-{}\n", patch.backend);
    push_case(&mut text, patch);
    text
}

/// One case, from `case` to `end`.
fn push_case(text: &mut String, patch: &OnePatch) {
    let result = &patch.result;
    // Writing to a String does not fail.
    _ = writeln!(text, "{}", patch.case);
    _ = writeln!(text, "points {}", result.points.len());
    for point in &result.points {
        _ = writeln!(text, "{:05x} {:05x}", point.u.to_bits(), point.v.to_bits());
    }
    _ = writeln!(text, "indices {}", result.indices.len());
    for primitive in patch.primitives() {
        let indices: Vec<_> = primitive.iter().map(u32::to_string).collect();
        _ = writeln!(text, "{}", indices.join(" "));
    }
    text.push_str("end\n");
}
