//! Listings: a patch's whole output as text.

use super::error::VectorError;
use super::lines::{Line, Lines};
use super::row::decimal;
use super::words::{self, too_many};
use crate::case::Case;
use crate::quote::quoted;
use std::fmt;
use std::io::BufRead;
use tess_core::{DomainPoint, MAX_INDICES, Tessellation};

/// A case and an output for it.
///
/// Written as text, it is a record of a vector file of the kind `listings`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Listing {
    /// The line of the file that it starts on.
    pub line: u64,
    /// The tessellated case.
    pub case: Case,
    /// Its points and indices.
    pub output: Tessellation,
}

impl Listing {
    /// The model's listing of a case. It is in no file, so its line is 0.
    #[must_use]
    pub fn of_model(case: Case) -> Self {
        Self { line: 0, case, output: case.patch().tessellate() }
    }

    /// The index list, primitive by primitive.
    pub fn primitives(&self) -> impl Iterator<Item = &[u32]> {
        self.output.indices.chunks(self.case.primitive_size())
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

/// Reads the points and primitives of a listing. The line that announces the points has already
/// been read.
pub(super) fn read<R: BufRead>(
    lines: &mut Lines<R>,
    case: Case,
    start: u64,
) -> Result<Listing, VectorError> {
    let points = points(lines)?;
    let output = Tessellation { points, indices: indices(lines, case.primitive_size())? };
    words::end(lines.expect("end")?)?;
    Ok(Listing { line: start, case, output })
}

/// Reads the points. The line that announces them has already been read.
///
/// A device without an index buffer lists one point per vertex of each primitive, so there may be
/// as many points as indices, not only the model's 4225.
fn points<R: BufRead>(lines: &mut Lines<R>) -> Result<Vec<DomainPoint>, VectorError> {
    let count = announced(lines.last(), "points", MAX_INDICES)?;
    let mut points = Vec::with_capacity(count);
    for _ in 0..count {
        let line = lines.expect("points")?;
        let point = parse_point(line.text).ok_or_else(|| {
            let text = quoted(line.text);
            let message = format!(
                "{text} is not a point: u and v as 5 to 8 hex digits each, where 10000 is 1"
            );
            line.error("points", message)
        })?;
        points.push(point);
    }
    Ok(points)
}

fn indices<R: BufRead>(lines: &mut Lines<R>, size: usize) -> Result<Vec<u32>, VectorError> {
    let count = announced(lines.expect("indices")?, "indices", MAX_INDICES)?;
    if !count.is_multiple_of(size) {
        let message = format!("{count} is not a multiple of {size}, the size of a primitive");
        return Err(lines.error("indices", message));
    }
    let mut indices = Vec::with_capacity(count);
    for _ in 0..count / size {
        let line = lines.expect("indices")?;
        let read = line.text.split(' ').try_fold(0, |read, word| {
            indices.push(decimal(word)?);
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

/// The number in a line such as `points 17`; it may be at most `most`.
fn announced(line: Line<'_>, what: &'static str, most: usize) -> Result<usize, VectorError> {
    let count = line.text.strip_prefix(what).and_then(|rest| rest.strip_prefix(' '));
    let count: u64 = count.and_then(decimal).ok_or_else(|| {
        line.error(what, format!("expected `{what} COUNT`, not {}", quoted(line.text)))
    })?;
    let few = usize::try_from(count).ok().filter(|&count| count <= most);
    few.ok_or_else(|| line.error(what, too_many(count, most)))
}

fn parse_point(text: &str) -> Option<DomainPoint> {
    let (u, v) = text.split_once(' ')?;
    Some(DomainPoint::from_bits(words::coordinate(u)?, words::coordinate(v)?))
}
