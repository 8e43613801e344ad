//! Captures as outputs.

use crate::capture::Captured;
use tess_core::{DomainPoint, Tessellation};
use tess_verify::vectors::fixed;

/// A captured patch as an output: each vertex is a separate point, in the order of the primitives;
/// `None` if a coordinate is no 16.16 number in 0..=1.
pub(crate) fn output(captured: &Captured) -> Option<Tessellation> {
    let point = |&[u, v, _]: &[u32; 3]| Some(DomainPoint::from_bits(fixed(u)?, fixed(v)?));
    let points: Vec<_> = captured.vertices.iter().map(point).collect::<Option<_>>()?;
    let indices = (0..).take(points.len()).collect();
    Some(Tessellation { points, indices })
}
