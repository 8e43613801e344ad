//! The digest of a batch's output.

use tess_core::{DomainPoint, Tessellation};
use tess_gpu::Setup;
use tess_gpu::layout::PackedPoint;
use tess_verify::vectors::Fnv1a;
use tess_wgpu::ReadBack;

/// The digest of whole patches, as [`tess_workloads::Workload::digest`] computes it; `None`
/// if the output is not consistent.
pub(crate) fn digest(output: &ReadBack, setup: Setup) -> Option<u64> {
    let each = setup.indices_per_primitive() as usize;
    let mut ends = output.begins.iter().skip(1).map(|begin| begin.map(|at| at as usize));
    let mut digest = Fnv1a::default();
    for begin in &output.begins {
        let begin = begin.map(|at| at as usize);
        let end = ends.next().unwrap_or([output.points.len(), output.indices.len() / each]);
        let points = output.points.get(begin[0]..end[0])?;
        let points: Vec<DomainPoint> = points.iter().map(|&p| PackedPoint(p).point()).collect();
        let indices = output.indices.get(begin[1] * each..end[1] * each)?.to_vec();
        digest.patch(&Tessellation { points, indices });
    }
    Some(digest.finish())
}
