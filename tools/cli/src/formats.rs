//! One tessellated patch in the forms that `--format` offers.

mod csv;
mod json;
mod listing;
mod obj;

use crate::failure::Failure;
use clap::ValueEnum;
use tess_check::backend::Backend;
use tess_check::case::Case;
use tess_core::{Domain, OutputPrimitive, Tessellation};

/// The forms of a patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// A listing as in golden/cases.txt, which `tess check -` reads
    Text,
    /// A row of counts and digests as in golden/patches.csv, which `tess check -` reads
    Csv,
    /// Everything: factors, points (exact and as floats), primitives
    Json,
    /// A Wavefront mesh in the plane, (u, v) as (x, y)
    Obj,
}

/// A patch as some backend tessellated it.
#[derive(Clone, Debug)]
pub struct OnePatch {
    /// Its configuration and raw factors.
    pub case: Case,
    /// The result.
    pub result: Tessellation,
    /// Name of the backend.
    pub backend: &'static str,
}

impl OnePatch {
    /// Has a backend tessellate one patch.
    ///
    /// # Errors
    /// The backend could not run, or returned another number of patches than one.
    pub fn tessellate(backend: &mut dyn Backend, case: Case) -> Result<Self, Failure> {
        let mut results = backend.tessellate(case.config, &[case.factors])?;
        let name = backend.name();
        match (results.pop(), results.is_empty()) {
            (Some(result), true) => Ok(Self { case, result, backend: name }),
            _ => Err(Failure::unavailable(format!("{name} did not return exactly one patch"))),
        }
    }

    /// How many indices make a primitive: 1, 2 or 3.
    #[must_use]
    pub fn primitive_size(&self) -> usize {
        match (self.case.config.output, self.case.domain()) {
            (OutputPrimitive::Point, _) => 1,
            (OutputPrimitive::Line, _) | (_, Domain::Isoline) => 2,
            (OutputPrimitive::TriangleCw | OutputPrimitive::TriangleCcw, _) => 3,
        }
    }

    /// The index list, primitive by primitive.
    pub fn primitives(&self) -> impl Iterator<Item = &[u32]> {
        self.result.indices.chunks(self.primitive_size())
    }
}

impl Format {
    /// The bytes of a file in this form.
    ///
    /// # Errors
    /// The picture could not be made.
    pub fn render(self, patch: &OnePatch) -> Result<Vec<u8>, Failure> {
        Ok(match self {
            Self::Text => listing::render(patch).into_bytes(),
            Self::Csv => csv::render(patch).into_bytes(),
            Self::Json => json::render(patch).into_bytes(),
            Self::Obj => obj::render(patch).into_bytes(),
        })
    }
}
