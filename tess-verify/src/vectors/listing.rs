//! Listings: a patch's whole output as text.

use super::{Lines, VectorError};
use crate::case::{Case, parse_hex};
use std::fmt;
use std::io::BufRead;
use tess_core::{Domain, DomainPoint, OutputPrimitive, Tessellation};

/// A case and an output for it.
///
/// Its text is what a vector file of the kind `listings` has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Listing {
    /// The line of the file that it starts on.
    pub line: u64,
    /// What was tessellated.
    pub case: Case,
    /// What came out.
    pub output: Tessellation,
}

/// How many indices a primitive of a case has: 1, 2 or 3.
#[must_use]
pub fn primitive_size(case: &Case) -> usize {
    match (case.domain(), case.config.output) {
        (_, OutputPrimitive::Point) => 1,
        (_, OutputPrimitive::Line) | (Domain::Isoline, _) => 2,
        (_, OutputPrimitive::TriangleCw | OutputPrimitive::TriangleCcw) => 3,
    }
}

impl fmt::Display for Listing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Tessellation { points, indices } = &self.output;
        writeln!(f, "{}\npoints {}", self.case, points.len())?;
        for point in points {
            writeln!(f, "{:05x} {:05x}", point.u.to_bits(), point.v.to_bits())?;
        }
        writeln!(f, "indices {}", indices.len())?;
        for primitive in indices.chunks(primitive_size(&self.case)) {
            let words: Vec<_> = primitive.iter().map(u32::to_string).collect();
            writeln!(f, "{}", words.join(" "))?;
        }
        writeln!(f, "end")
    }
}

/// Reads a listing whose first line has been read already.
pub(super) fn read<R: BufRead>(lines: &mut Lines<R>, first: &str) -> Result<Listing, VectorError> {
    let line = lines.place.line;
    let case: Case = first
        .parse()
        .map_err(|error: crate::case::CaseError| lines.place.error(error.field, error.message))?;
    let mut output = Tessellation::default();
    for _ in 0..announced(lines, "points")? {
        let text = lines.expect("points")?;
        let point = parse_point(&text).ok_or_else(|| {
            let message = format!("`{text}` is not a point: u and v as up to 8 hex digits each");
            lines.place.error("points", message)
        })?;
        output.points.push(point);
    }
    let size = primitive_size(&case);
    let count = announced(lines, "indices")?;
    if !count.is_multiple_of(size as u64) {
        let message = format!("{count} is no multiple of {size}, the size of a primitive");
        return Err(lines.place.error("indices", message));
    }
    for _ in 0..count / size as u64 {
        let text = lines.expect("indices")?;
        let indices = parse_primitive(&text, size).ok_or_else(|| {
            let message = format!("`{text}` is not a primitive: {size} decimal indices");
            lines.place.error("indices", message)
        })?;
        output.indices.extend(indices);
    }
    let end = lines.expect("end")?;
    if end != "end" {
        return Err(lines.place.error("end", format!("a listing ends with `end`, not `{end}`")));
    }
    Ok(Listing { line, case, output })
}

/// The number of a line such as `points 17`.
fn announced<R: BufRead>(lines: &mut Lines<R>, what: &'static str) -> Result<u64, VectorError> {
    let text = lines.expect(what)?;
    let count = text.strip_prefix(what).and_then(|rest| rest.strip_prefix(' '));
    count
        .and_then(|count| count.parse().ok())
        .ok_or_else(|| lines.place.error(what, format!("expected `{what} COUNT`, not `{text}`")))
}

fn parse_point(text: &str) -> Option<DomainPoint> {
    let (u, v) = text.split_once(' ')?;
    let coordinate = |text: &str| u32::try_from(parse_hex(text, text.len().clamp(1, 8))?).ok();
    Some(DomainPoint::from_bits(coordinate(u)?, coordinate(v)?))
}

fn parse_primitive(text: &str, size: usize) -> Option<Vec<u32>> {
    let indices: Option<Vec<u32>> = text.split(' ').map(|word| word.parse().ok()).collect();
    indices.filter(|indices| indices.len() == size)
}
