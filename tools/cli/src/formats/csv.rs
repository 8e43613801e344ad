//! A row of `golden/patches.csv`: counts and digests.

use super::OnePatch;
use tess_check::case::factor_bits;
use tess_check::digest::{points_digest, words_digest};
use tess_check::names::Named;

pub(super) fn render(patch: &OnePatch) -> String {
    let (case, result) = (patch.case, &patch.result);
    let factors: Vec<_> =
        factor_bits(&case.factors).iter().map(|bits| format!("{bits:08x}")).collect();
    format!(
        "# tess-vectors 1 kind=patches count=1 source=tess-{}\n\
         domain,partitioning,output,split,factors_f32_hex,\
         points,indices,points_fnv1a64,indices_fnv1a64\n\
         {},{},{},{},{},{},{},{:016x},{:016x}\n",
        patch.backend,
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
