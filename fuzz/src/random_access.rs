//! The sequential formulation against random access, and against the invariants of every output.

use crate::input::Bytes;
use crate::{compare_with_model, repeatable};
use tess_core::Tessellation;
use tess_testkit::invariants;

/// Compares every point and primitive of one patch. Errors: the first difference or violated
/// invariant.
pub fn check(data: &[u8]) -> Result<(), String> {
    let case = Bytes(data).case();
    let patch = case.patch();
    let sequential = patch.tessellate();
    let mut random = Tessellation { points: patch.points().collect(), indices: Vec::new() };
    for primitive in patch.primitives() {
        random.indices.extend_from_slice(primitive.indices());
    }
    compare_with_model("random access", &case, random, &sequential)?;
    let counts = patch.counts();
    if patch.point(counts.points).is_some() || patch.primitive(counts.primitives).is_some() {
        return Err(repeatable(&case, "there is an element behind the last"));
    }
    invariants::all(&case, &sequential)
        .map_err(|violation| repeatable(&case, &format!("core violates {violation}")))
}
