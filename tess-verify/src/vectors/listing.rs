//! Listings: a patch's whole output as text.

use super::coordinates;
use super::error::VectorError;
use super::lines::{Line, Lines};
use super::record::Record;
use super::row::decimal;
use crate::case::{Case, CaseError};
use crate::quote::quoted;
use std::fmt;
use std::io::BufRead;
use tess_core::{Domain, DomainPoint, MAX_INDICES, MAX_POINTS, OutputPrimitive, Tessellation};

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

impl Listing {
    /// The index list, primitive by primitive.
    pub fn primitives(&self) -> impl Iterator<Item = &[u32]> {
        self.output.indices.chunks(primitive_size(&self.case))
    }
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
        for primitive in self.primitives() {
            let words: Vec<_> = primitive.iter().map(u32::to_string).collect();
            writeln!(f, "{}", words.join(" "))?;
        }
        writeln!(f, "end")
    }
}

/// Reads a listing, of which the first line was read already.
pub(super) fn read<R: BufRead>(lines: &mut Lines<R>) -> Result<Record, VectorError> {
    let first = lines.last();
    let parsed: Result<Case, CaseError> = first.text.parse();
    let case = parsed.map_err(|error| first.error(error.field, error.message))?;
    let line = first.place.line;
    let size = primitive_size(&case);
    let second = lines.expect("points")?;
    if coordinates::is_announced(&second) {
        return coordinates::read(lines, case, line).map(Record::Coordinates);
    }
    let output = Tessellation { points: points(lines)?, indices: indices(lines, size)? };
    end(lines.expect("end")?)?;
    Ok(Record::Listing(Listing { line, case, output }))
}

/// The last line of a listing.
pub(super) fn end(line: Line<'_>) -> Result<(), VectorError> {
    if line.text == "end" {
        return Ok(());
    }
    Err(line.error("end", format!("a listing ends with `end`, not {}", quoted(line.text))))
}

/// The points, of which the line that announces them was read already.
fn points<R: BufRead>(lines: &mut Lines<R>) -> Result<Vec<DomainPoint>, VectorError> {
    let count = announced(lines.last(), "points", MAX_POINTS)?;
    let mut points = Vec::with_capacity(count);
    for _ in 0..count {
        let line = lines.expect("points")?;
        let point = parse_point(line.text).ok_or_else(|| {
            let text = quoted(line.text);
            let message =
                format!("{text} is not a point: u and v as 5 to 8 hex digits each, 10000 being 1");
            line.error("points", message)
        })?;
        points.push(point);
    }
    Ok(points)
}

fn indices<R: BufRead>(lines: &mut Lines<R>, size: usize) -> Result<Vec<u32>, VectorError> {
    let count = announced(lines.expect("indices")?, "indices", MAX_INDICES)?;
    if !count.is_multiple_of(size) {
        let message = format!("{count} is no multiple of {size}, the size of a primitive");
        return Err(lines.error("indices", message));
    }
    let mut indices = Vec::with_capacity(count);
    for _ in 0..count / size {
        let line = lines.expect("indices")?;
        let mut words = line.text.as_bytes().split(|byte| *byte == b' ');
        let read = words.try_fold(0, |read, word| {
            indices.push(parse_index(word)?);
            Some(read + 1)
        });
        if read != Some(size) {
            let text = quoted(line.text);
            let message = format!("{text} is not a primitive: {size} decimal indices");
            return Err(line.error("indices", message));
        }
    }
    Ok(indices)
}

/// The number of a line such as `points 17`, of which no patch has more than `most`.
fn announced(line: Line<'_>, what: &'static str, most: usize) -> Result<usize, VectorError> {
    let count = line.text.strip_prefix(what).and_then(|rest| rest.strip_prefix(' '));
    let count: u64 = count.and_then(decimal).ok_or_else(|| {
        line.error(what, format!("expected `{what} COUNT`, not {}", quoted(line.text)))
    })?;
    let few = usize::try_from(count).ok().filter(|&count| count <= most);
    few.ok_or_else(|| line.error(what, too_many(count, most)))
}

pub(super) fn too_many(count: impl fmt::Display, most: usize) -> String {
    format!("{count} is too many: a patch has at most {most}")
}

fn parse_point(text: &str) -> Option<DomainPoint> {
    let (u, v) = text.split_once(' ')?;
    Some(DomainPoint::from_bits(parse_coordinate(u)?, parse_coordinate(v)?))
}

/// 5 to 8 hex digits. Fewer would let the float 1 pass for 2^-16.
pub(super) fn parse_coordinate(text: &str) -> Option<u32> {
    let append = |number, byte: &u8| Some(number << 4 | char::from(*byte).to_digit(16)?);
    (5..=8).contains(&text.len()).then(|| text.as_bytes().iter().try_fold(0, append)).flatten()
}

/// Decimal digits alone: no sign.
fn parse_index(word: &[u8]) -> Option<u32> {
    let digit = |byte: u8| byte.checked_sub(b'0').filter(|digit| *digit < 10).map(u64::from);
    let append = |index: u64, byte: &u8| Some(index * 10 + digit(*byte)?);
    // Ten digits are enough for any index, and cannot overflow 64 bits.
    let index =
        (1..=10).contains(&word.len()).then(|| word.iter().try_fold(0, append)).flatten()?;
    u32::try_from(index).ok()
}
