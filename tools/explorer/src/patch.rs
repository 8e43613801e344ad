//! One patch and everything the page shows of it.

use crate::{json, marks, thrown};
use tess_core::{Patch, Tessellation};
use tess_show::{Colours, DrawOptions, Drawing, Explanation, Part, draw, has_rings};
use tess_verify::vectors::Listing;
use tess_verify::{Case, mistakes};
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

/// A case with a result for it: the model's, a backend's or a listing's.
#[wasm_bindgen]
#[derive(Clone, Debug)]
pub struct PatchView {
    pub(crate) listing: Listing,
    patch: Patch,
}

impl PatchView {
    /// A case with the output that somebody gave for it.
    pub(crate) fn of(case: Case, output: Tessellation) -> Self {
        Self { listing: Listing { line: 0, case, output }, patch: case.patch() }
    }

    /// Colours by name. A patch without rings has them plain.
    fn colours(&self, name: &str) -> Result<Colours, JsError> {
        let Case { config, .. } = self.listing.case;
        match name {
            "order" => Ok(Colours::Order),
            "rings" if has_rings(self.listing.case.domain(), config.output) => Ok(Colours::Rings),
            "rings" | "plain" => Ok(Colours::Plain),
            other => Err(thrown(format!("unknown colours {other}: plain, order or rings"))),
        }
    }

    fn explanation(&self, pick: &str) -> Option<Explanation> {
        let (kind, number) = pick.split_at_checked(1).unwrap_or_default();
        let part = match kind {
            "" => Part::Patch,
            "p" => Part::Point(number.parse().ok()?),
            _ => Part::Primitive(number.parse().ok()?),
        };
        Explanation::new(&self.listing.case, part)
    }

    fn drawing(&self, colours: &str, indices: bool, size: u32) -> Result<Drawing, JsError> {
        let colours = self.colours(colours)?;
        Ok(draw(&self.listing, &DrawOptions { indices, colours, size }))
    }
}

#[wasm_bindgen]
impl PatchView {
    /// The model's result for a case line. Errors: the line is no case; the message says which part
    /// is wrong.
    #[wasm_bindgen(constructor)]
    pub fn new(line: &str) -> Result<Self, JsError> {
        let case: Case = line.parse().map_err(thrown)?;
        Ok(Self::of(case, case.patch().tessellate()))
    }

    /// The case as a line that `tess check` reads.
    pub fn line(&self) -> String {
        self.listing.case.to_string()
    }

    /// The `tess patch` command of the case.
    pub fn command(&self) -> String {
        self.listing.case.command()
    }

    /// u and v of each point, 16.16 bits.
    pub fn points(&self) -> Vec<u32> {
        self.listing.output.points.iter().flat_map(|p| [p.u.to_bits(), p.v.to_bits()]).collect()
    }

    /// The index list.
    pub fn indices(&self) -> Vec<u32> {
        self.listing.output.indices.clone()
    }

    /// Indices of a primitive: 1, 2 or 3.
    pub fn primitive_size(&self) -> usize {
        self.listing.case.primitive_size()
    }

    /// Every stage as `tess explain` prints it; of a `pick` such as `p7` or `t12`, where that point
    /// or primitive comes from. Nothing if there is none.
    pub fn explain(&self, pick: &str) -> Option<String> {
        self.explanation(pick).map(|report| report.to_string())
    }

    /// The same as JSON.
    pub fn explain_json(&self, pick: &str) -> Option<String> {
        self.explanation(pick).map(|report| json(&report))
    }

    /// The listing alone, as it stands in a vector file.
    pub fn listing(&self) -> String {
        self.listing.to_string()
    }

    /// The file that `tess patch` writes by default.
    pub fn text(&self) -> String {
        self.listing.to_file("core")
    }

    /// The file of `tess patch --format csv`.
    pub fn csv(&self) -> String {
        self.listing.to_csv("core")
    }

    /// The file of `tess patch --format obj`.
    pub fn obj(&self) -> String {
        self.listing.to_obj()
    }

    /// The picture of `tess draw`: `colours` is plain, order or rings; `size` in pixels. Errors:
    /// unknown colours.
    pub fn svg(&self, colours: &str, indices: bool, size: u32) -> Result<String, JsError> {
        Ok(self.drawing(colours, indices, size)?.to_svg())
    }

    /// The same as a PNG file. Errors: unknown colours, or a size that cannot be drawn.
    pub fn png(&self, colours: &str, indices: bool, size: u32) -> Result<Vec<u8>, JsError> {
        self.drawing(colours, indices, size)?.to_png().map_err(thrown)
    }

    /// Red, green and blue of each primitive, as the pictures have them; `colours` is plain, order
    /// or rings. Errors: unknown colours.
    pub fn fills(&self, colours: &str) -> Result<Vec<u8>, JsError> {
        Ok(self.drawing(colours, false, 64)?.fills.concat())
    }

    /// Twice the signed area of each triangle in units of 2^-32: positive as the output primitive
    /// demands, 0 without area, negative where it is flipped.
    pub fn areas(&self) -> Vec<f64> {
        marks::areas(&self.listing)
    }

    /// For each point of an outer edge or a line: 1 in the exact middle of an even edge, 2 where
    /// the edge is split; else 0.
    pub fn point_marks(&self) -> Vec<u8> {
        marks::points(&self.patch)
    }

    /// A copy with a mistake of the table (`mistakes`), so that a comparison can be seen to fail.
    /// Words that are not in the table, or that change nothing here, give an equal copy.
    pub fn with_mistake(&self, words: &str) -> Self {
        let mut faulty = self.clone();
        let request = mistakes::requests([self.listing.case]).next();
        let wrong = mistakes::named(words)
            .zip(request)
            .and_then(|(mistake, request)| mistake.wrong_answer(&request, &self.listing.output));
        if let Some(wrong) = wrong {
            faulty.listing.output = wrong;
        }
        faulty
    }
}
