//! Results against the model's, bit by bit.

use crate::patch::PatchView;
use crate::{json, thrown};
use serde_json::json;
use std::cell::RefCell;
use std::collections::HashMap;
use tess_core::{Config, Tessellation};
use tess_show::differing;
use tess_simd::{ExactOutput, Numbering, Tessellator};
use tess_verify::Case;
use tess_verify::check::Mismatch;
use tess_verify::vectors::{Header, Kind, Record, VectorFile};
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

/// Whether two results are equal, the first difference in words, and the numbers of the points and
/// the primitives that differ: JSON.
#[wasm_bindgen]
pub fn compare(expected: &PatchView, observed: &PatchView) -> String {
    let (expected, observed) = (&expected.listing, &observed.listing);
    let first = Mismatch::between(&expected.case, &observed.output, &expected.output);
    let [points, primitives] = differing(expected, observed);
    let first = first.map(|mismatch| mismatch.to_string());
    let equal = first.is_none();
    json(&json!({ "equal": equal, "first": first, "points": points, "primitives": primitives }))
}

/// The result of `tess-simd` for a case line. Errors: the line is no case.
#[wasm_bindgen]
pub fn simd(line: &str) -> Result<PatchView, JsError> {
    let case: Case = line.parse().map_err(thrown)?;
    let output = tessellate(case).map_err(thrown)?;
    Ok(PatchView::of(case, output))
}

thread_local! {
    /// The last configuration's tessellator: making its tables takes longer than a patch.
    static KEPT: RefCell<Option<(Config, Tessellator)>> = const { RefCell::new(None) };
}

fn tessellate(case: Case) -> Result<Tessellation, tess_simd::Error> {
    KEPT.with_borrow_mut(|kept| {
        let kept = match kept {
            Some((config, tessellator)) if *config == case.config => tessellator,
            _ => &mut kept.insert((case.config, Tessellator::new(case.config))).1,
        };
        let mut output = ExactOutput::new();
        kept.tessellate(&[case.factors], Numbering::PerPatch, &mut output)?;
        let (points, indices) = (output.points().to_vec(), output.indices().to_vec());
        Ok(Tessellation { points, indices })
    })
}

/// The listings of a vector file, or of a text that is nothing but listings.
#[wasm_bindgen]
#[derive(Debug)]
pub struct ListingFile {
    lines: Vec<String>,
    listings: HashMap<String, PatchView>,
}

#[wasm_bindgen]
impl ListingFile {
    /// Reads listings. Errors: the text is malformed; the message names line and field.
    #[wasm_bindgen(constructor)]
    pub fn new(text: &str) -> Result<Self, JsError> {
        Self::read(text).map_err(thrown)
    }

    /// The case lines, in order, one a line.
    pub fn cases(&self) -> String {
        self.lines.join("\n")
    }

    /// The listing of a case line.
    pub fn listing(&self, line: &str) -> Option<PatchView> {
        self.listings.get(line).cloned()
    }
}

impl ListingFile {
    fn read(text: &str) -> Result<Self, String> {
        let text = with_header(text);
        let (mut lines, mut listings) = (Vec::new(), HashMap::new());
        let error = |error: tess_verify::vectors::VectorError| error.to_string();
        for record in VectorFile::new("the listing", text.as_bytes()).map_err(error)? {
            let Record::Listing(listing) = record.map_err(error)? else {
                return Err("the file has no listings: `tess patch` writes one".into());
            };
            let line = listing.case.to_string();
            let view = PatchView::of(listing.case, listing.output);
            if listings.insert(line.clone(), view).is_none() {
                lines.push(line);
            }
        }
        Ok(Self { lines, listings })
    }
}

/// The text with the first line of a vector file, if it begins with a listing instead.
fn with_header(text: &str) -> String {
    let text = text.trim_start().replace("\r\n", "\n");
    if !text.starts_with("case ") {
        return text;
    }
    let count = text.lines().filter(|line| line.starts_with("case ")).count() as u64;
    let (kind, source, notes) = (Kind::Listings, "pasted".into(), Vec::new());
    format!("{}\n{text}", Header { kind, count: Some(count), source, notes })
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINE: &str =
        "case tri fractional_odd triangle_cw ruler 40200000 40400000 3f800000 41000000";

    #[test]
    fn a_planted_fault_is_named() {
        let case: Case = LINE.parse().expect("a case");
        let model = PatchView::of(case, case.patch().tessellate());
        let simd = PatchView::of(case, tessellate(case).expect("small"));
        assert!(compare(&model, &simd).contains("\"equal\":true"), "the backends agree");
        let faulty = simd.with_mistake("a bit of a point is wrong: the lowest of the middle u");
        let verdict = compare(&model, &faulty);
        let middle = model.listing.output.points.len() / 2;
        assert!(verdict.contains(&format!("point {middle} u: observed")), "{verdict}");
        assert!(verdict.contains(&format!("\"points\":[{middle}]")), "{verdict}");
    }

    #[test]
    fn listings_are_read_with_and_without_a_header() {
        let case: Case = LINE.parse().expect("a case");
        let model = PatchView::of(case, case.patch().tessellate());
        for text in [model.listing(), model.text(), model.text().replace('\n', "\r\n")] {
            let file = ListingFile::read(&text).expect("a file");
            assert_eq!(file.cases(), LINE, "its one case");
            assert!(file.listing(LINE).is_some(), "its listing");
        }
        let cut = model.listing().replace("end\n", "");
        assert!(ListingFile::read(&cut).is_err_and(|error| error.contains("end")), "truncated");
    }
}
