//! One tessellated patch in the formats of `--format`.

mod json;

use crate::failure::Failure;
use crate::output::form::FileForm;
use clap::ValueEnum;
use tess_core::Tessellation;
use tess_show::{DrawOptions, Drawing, draw};
use tess_verify::vectors::Listing;
use tess_verify::{Backend, Case};

/// The formats of a patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// A listing as in golden/cases.txt, which `tess check -` reads
    Text,
    /// A row of counts and digests as in golden/patches.csv, which `tess check -` reads
    Csv,
    /// Everything: factors, points (exact and as floats), primitives
    Json,
    /// A Wavefront mesh in the plane, with (u, v) as (x, y)
    Obj,
    /// A picture of 800 x 800 pixels; `tess draw` can do more
    Svg,
    /// The same picture as pixels
    Png,
}

impl FileForm for Format {
    const DEFAULT: Option<Self> = Some(Self::Text);
    const COMMON_EXTENSIONS: &'static [&'static str] = &["txt"];
}

/// The formats of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PictureFormat {
    /// Scalable vector graphics
    Svg,
    /// Pixels
    Png,
}

impl FileForm for PictureFormat {
    const DEFAULT: Option<Self> = Some(Self::Svg);
}

impl PictureFormat {
    /// The bytes of a picture in this format. Errors: the pixels cannot be encoded.
    pub(crate) fn render(self, drawing: &Drawing) -> Result<Vec<u8>, Failure> {
        match self {
            Self::Svg => Ok(drawing.to_svg().into_bytes()),
            Self::Png => drawing.to_png().map_err(Failure::bad_input),
        }
    }
}

/// A patch as a backend tessellated it.
#[derive(Clone, Debug)]
pub(crate) struct OnePatch {
    /// The case and its output.
    pub(crate) listing: Listing,
    /// The name of the backend.
    pub(crate) backend: &'static str,
}

impl OnePatch {
    /// Tessellates one patch on a backend. Errors: the backend could not run, or did not return
    /// exactly one patch.
    pub(crate) fn tessellate(backend: &mut dyn Backend, case: Case) -> Result<Self, Failure> {
        let mut results = backend.tessellate(case.config, &[case.factors])?;
        let name = backend.name();
        match (results.pop(), results.is_empty()) {
            (Some(output), true) => {
                Ok(Self { listing: Listing { line: 0, case, output }, backend: name })
            }
            _ => Err(Failure::unavailable(format!("{name} did not return exactly one patch"))),
        }
    }

    /// The patch.
    pub(crate) const fn case(&self) -> &Case {
        &self.listing.case
    }

    /// The output.
    pub(crate) const fn output(&self) -> &Tessellation {
        &self.listing.output
    }
}

impl Format {
    /// The bytes of a file in this format. Errors: the picture could not be made.
    pub(crate) fn render(self, patch: &OnePatch) -> Result<Vec<u8>, Failure> {
        Ok(match self {
            Self::Text => patch.listing.to_file(patch.backend).into_bytes(),
            Self::Csv => patch.listing.to_csv(patch.backend).into_bytes(),
            Self::Json => json::render(patch).into_bytes(),
            Self::Obj => patch.listing.to_obj().into_bytes(),
            Self::Svg => PictureFormat::Svg.render(&drawing(patch))?,
            Self::Png => PictureFormat::Png.render(&drawing(patch))?,
        })
    }
}

fn drawing(patch: &OnePatch) -> Drawing {
    draw(&patch.listing, &DrawOptions::default())
}
