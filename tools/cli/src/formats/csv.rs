//! A row of `golden/patches.csv`: counts and digests.

use super::OnePatch;
use tess_verify::vectors::{Kind, PatchRow, Sizes};

pub(super) fn render(patch: &OnePatch) -> String {
    let header = patch.header(Kind::Patches);
    let columns = Kind::Patches.columns().unwrap_or_default().join(",");
    let row = PatchRow { case: *patch.case(), output: Sizes::of(patch.output()) };
    format!("{header}\n{columns}\n{row}\n")
}
