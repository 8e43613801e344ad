//! A row of `golden/patches.csv`: counts and digests.

use super::{OnePatch, hex_factors};
use crate::names::Named;
use tess_check::digest::{points_digest, words_digest};

pub(super) fn render(patch: &OnePatch) -> String {
    let (config, result) = (patch.config, &patch.result);
    format!(
        "# tess-vectors 1 kind=patches count=1 source=tess-{}\n\
         domain,partitioning,output,split,factors_f32_hex,\
         points,indices,points_fnv1a64,indices_fnv1a64\n\
         {},{},{},{},{},{},{},{:016x},{:016x}\n",
        patch.backend,
        patch.factors.domain().name(),
        config.partitioning.name(),
        config.output.name(),
        config.split.name(),
        hex_factors(&patch.factors),
        result.points.len(),
        result.indices.len(),
        points_digest(&result.points),
        words_digest(&result.indices),
    )
}
