//! A row of `golden/patches.csv`: counts and digests.

use super::OnePatch;
use tess_check::case::factor_bits;
use tess_check::digest::{points_digest, words_digest};
use tess_check::names::Named;
use tess_check::vectors::Kind;

pub(super) fn render(patch: &OnePatch) -> String {
    let (case, result) = (patch.case(), patch.output());
    let factors: Vec<_> =
        factor_bits(&case.factors).iter().map(|bits| format!("{bits:08x}")).collect();
    format!(
        "{}\n{}\n{},{},{},{},{},{},{},{:016x},{:016x}\n",
        patch.header(Kind::Patches),
        Kind::Patches.columns().unwrap_or_default().join(","),
        case.domain().name(),
        case.config.partitioning.name(),
        case.config.output.name(),
        case.config.split.name(),
        factors.join(" "),
        result.points.len(),
        result.indices.len(),
        points_digest(&result.points),
        words_digest(&result.indices),
    )
}
