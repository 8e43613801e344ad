//! Listings by coordinates: the vertices of a patch's primitives, in order, as in captures.

use super::error::VectorError;
use super::lines::{Line, Lines};
use super::listing::Listing;
use super::row::decimal;
use super::words::{self, too_many};
use crate::case::Case;
use crate::names::{Named, named};
use crate::quote::quoted;
use crate::vectors::coordinate::{fixed, from_decimal};
use std::fmt;
use std::io::BufRead;
use tess_core::fixed_point::ONE;
use tess_core::{Domain, DomainPoint, MAX_INDICES, Tessellation};

/// A case, and the coordinates of each vertex of each primitive of an output for it.
///
/// Written as text, it is a record of a vector file of the kind `listings`, in the notation `hex`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Coordinates {
    /// The line of the file that it starts on.
    pub line: u64,
    /// The tessellated case.
    pub case: Case,
    /// The vertices, primitive by primitive.
    pub(crate) vertices: Vec<Vertex>,
}

/// The coordinates of a vertex, as 16.16 numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Vertex {
    /// The first coordinate.
    pub(crate) u: u32,
    /// The second coordinate.
    pub(crate) v: u32,
    /// The third coordinate, if it was captured.
    pub(crate) w: Option<u32>,
}

impl Coordinates {
    /// The output with one point per vertex, in the order of the primitives.
    #[must_use]
    pub fn output(&self) -> Tessellation {
        let points = self.vertices.iter().map(|vertex| DomainPoint::from_bits(vertex.u, vertex.v));
        Tessellation {
            points: points.collect(),
            indices: (0..).take(self.vertices.len()).collect(),
        }
    }

    /// The output with the model's point numbers. Each vertex becomes the model's point at its
    /// place; if several points coincide there, it becomes the one that the model has in this
    /// position. Places that the model lacks become points after the model's. An output that is the
    /// model's sequence therefore equals the model's, index for index.
    #[must_use]
    pub fn numbered(&self) -> Listing {
        let model = self.case.patch().tessellate();
        let mut points = model.points;
        let mut indices = Vec::with_capacity(self.vertices.len());
        for (k, vertex) in self.vertices.iter().enumerate() {
            let place = DomainPoint::from_bits(vertex.u, vertex.v);
            let same = model.indices.get(k).filter(|&&i| points.get(i as usize) == Some(&place));
            let index = same.copied().unwrap_or_else(|| number_of(&mut points, place));
            indices.push(index);
        }
        Listing { line: self.line, case: self.case, output: Tessellation { points, indices } }
    }

    /// The first vertex whose third coordinate is wrong: its number, that coordinate, and the right
    /// one. On triangles 1 - u - v is right, elsewhere 0.
    pub(crate) fn wrong_third(&self) -> Option<(usize, u32, u32)> {
        self.vertices.iter().enumerate().find_map(|(number, vertex)| {
            let right = match self.case.domain() {
                Domain::Triangle => ONE.wrapping_sub(vertex.u).wrapping_sub(vertex.v),
                Domain::Isoline | Domain::Quad => 0,
            };
            let w = vertex.w.filter(|w| *w != right)?;
            Some((number, w, right))
        })
    }
}

/// The number of the first point at a place; the point is added if there is none.
fn number_of(points: &mut Vec<DomainPoint>, place: DomainPoint) -> u32 {
    let number = points.iter().position(|point| *point == place).unwrap_or(points.len());
    if number == points.len() {
        points.push(place);
    }
    u32::try_from(number).unwrap_or(u32::MAX)
}

impl fmt::Display for Coordinates {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}\n{WORD} {} {}", self.case, Notation::Hex.name(), self.vertices.len())?;
        for Vertex { u, v, w } in &self.vertices {
            write!(f, "{u:05x} {v:05x}")?;
            w.map_or(Ok(()), |w| write!(f, " {w:05x}"))?;
            writeln!(f)?;
        }
        writeln!(f, "end")
    }
}

named! {
    /// The notation of coordinates.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    enum Notation: "notation" {
        /// 16.16 numbers of 5 to 8 hex digits: 10000 is 1.
        Hex = "hex",
        /// 16.16 numbers in decimal: 65536 is 1.
        Decimal = "decimal",
        /// Numbers from 0 to 1, or `0x` and the bits of a binary32.
        Float = "float",
    }
}

impl Notation {
    fn parse(self, word: &str) -> Option<u32> {
        match self {
            Self::Hex => words::coordinate(word),
            Self::Decimal => decimal(word),
            Self::Float => match word.strip_prefix("0x") {
                Some(digits) => fixed(u32::try_from(crate::case::parse_hex(digits, 8)?).ok()?),
                None => from_decimal(word),
            },
        }
    }

    const fn right(self) -> &'static str {
        match self {
            Self::Hex => "5 to 8 hex digits, where 10000 is 1",
            Self::Decimal => "whole numbers of 2^-16, where 65536 is 1",
            Self::Float => {
                "multiples of 2^-16 from 0 to 1, with 9 digits or as 0x and the bits of a binary32"
            }
        }
    }
}

const WORD: &str = "coordinates";

/// Whether a line announces coordinates.
pub(super) fn is_announced(line: &Line<'_>) -> bool {
    line.text.split(' ').next() == Some(WORD)
}

/// Reads the part of a record after its case, from the line that announces coordinates to `end`.
pub(super) fn read<R: BufRead>(
    lines: &mut Lines<R>,
    case: Case,
    start: u64,
) -> Result<Coordinates, VectorError> {
    let (notation, count) = announced(lines.last())?;
    let mut vertices = Vec::new();
    loop {
        let line = lines.expect(WORD)?;
        if line.text == "end" || count == Some(vertices.len()) {
            break;
        }
        if vertices.len() == MAX_INDICES {
            return Err(line.error(WORD, too_many(MAX_INDICES + 1, MAX_INDICES)));
        }
        let vertex = vertex(line, notation)?;
        if vertices.first().is_some_and(|first: &Vertex| first.w.is_some() != vertex.w.is_some()) {
            let message = "all vertices have a third coordinate, or none has: this one and those before \
                           it differ";
            return Err(line.error(WORD, message));
        }
        vertices.push(vertex);
    }
    let line = lines.last();
    words::end(line)?;
    let (got, size) = (vertices.len(), case.primitive_size());
    if count.is_some_and(|count| count != got) {
        let message = format!("{} vertices are announced, but there are {got}", count.unwrap_or(0));
        return Err(line.error(WORD, message));
    }
    if !got.is_multiple_of(size) {
        let message = format!("{got} is not a multiple of {size}, the size of a primitive");
        return Err(line.error(WORD, message));
    }
    let numbers = || vertices.iter().flat_map(|vertex| [vertex.u, vertex.v]);
    if notation == Notation::Decimal && numbers().max() == Some(1) {
        let message = "no coordinate is above 1, which is 2^-16 in `decimal`; write `float`";
        return Err(line.error(WORD, message));
    }
    Ok(Coordinates { line: start, case, vertices })
}

/// The notation, and the number of vertices if that is given.
fn announced(line: Line<'_>) -> Result<(Notation, Option<usize>), VectorError> {
    let mut words = line.text.split(' ').skip(1);
    let notation = Notation::from_name(words.next().unwrap_or_default());
    let notation = notation.map_err(|error| line.error(WORD, error.to_string()))?;
    let count = words.next().map(|word| {
        decimal(word).ok_or_else(|| line.error(WORD, format!("{} is not a number", quoted(word))))
    });
    let count = count.transpose()?;
    if let Some(word) = words.next() {
        return Err(line.error(WORD, format!("{} is one word too many", quoted(word))));
    }
    if count.is_some_and(|count| count > MAX_INDICES) {
        return Err(line.error(WORD, too_many(count.unwrap_or(0), MAX_INDICES)));
    }
    Ok((notation, count))
}

fn vertex(line: Line<'_>, notation: Notation) -> Result<Vertex, VectorError> {
    let numbers = line.text.split(' ').map(|word| notation.parse(word)).collect::<Option<Vec<_>>>();
    match numbers.as_deref() {
        Some(&[u, v]) => Ok(Vertex { u, v, w: None }),
        Some(&[u, v, w]) => Ok(Vertex { u, v, w: Some(w) }),
        _ => {
            let (text, right) = (quoted(line.text), notation.right());
            Err(line.error(WORD, format!("{text} is not u, v and perhaps w: {right}")))
        }
    }
}
