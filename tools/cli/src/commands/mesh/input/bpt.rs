//! Bezier patch files: the number of patches, then for each its degrees, `3 3`, and its 16
//! control points row by row, three numbers each.
//!
//! Points may have four numbers, x y z w: then they are rational with weight w, a form that the
//! classic files do not know. The file is text; numbers are separated by blanks, one point a line.

use super::text::{number, quoted, without_mark, words};
use glam::{Vec3, Vec4};
use tess_surface::BezierPatch;

/// The content of a file.
#[derive(Debug, Default)]
pub(crate) struct Bpt {
    /// The patches.
    pub(crate) patches: Vec<BezierPatch>,
    /// The line of each patch's degrees, from 1.
    pub(crate) lines: Vec<usize>,
}

/// Lines that have anything on them, numbered from 1.
struct BptLines<'a> {
    lines: Box<dyn Iterator<Item = (usize, &'a [u8])> + 'a>,
    /// The number of the last line that was read.
    line: usize,
}

/// Reads the patches. Errors: the first line that is malformed or missing.
pub(crate) fn parse(bytes: &[u8]) -> Result<Bpt, String> {
    let split = without_mark(bytes).split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii);
    let lines = Box::new((1..).zip(split).filter(|(_, line)| !line.is_empty()));
    let mut lines = BptLines { lines, line: 0 };
    let mut bpt = Bpt::default();
    let read = lines.file(&mut bpt);
    // A file without any line is named by the one that it should begin with.
    read.map_err(|what| format!("line {}: {what}", lines.line.max(1)))?;
    Ok(bpt)
}

impl<'a> BptLines<'a> {
    fn file(&mut self, bpt: &mut Bpt) -> Result<(), String> {
        let count = self.count()?;
        for number in 1..=count {
            let (patch, line) = self.patch(number, count)?;
            bpt.patches.push(patch);
            bpt.lines.push(line);
        }
        match self.lines.next() {
            None => Ok(()),
            Some((line, text)) => {
                self.line = line;
                Err(format!("{} follows the last of {count} patches", quoted(text)))
            }
        }
    }

    fn next(&mut self, expected: impl Fn() -> String) -> Result<&'a [u8], String> {
        match self.lines.next() {
            Some((line, text)) => {
                self.line = line;
                Ok(text)
            }
            None if self.line == 0 => Err(format!("the file is empty; {} is missing", expected())),
            None => Err(format!("the file ends after this line; {} is missing", expected())),
        }
    }

    fn count(&mut self) -> Result<usize, String> {
        let text = self.next(|| "the number of patches".to_owned())?;
        let count = std::str::from_utf8(text).ok().and_then(|text| text.parse().ok());
        let count = count.filter(|&count: &usize| count > 0);
        count.ok_or_else(|| format!("{} is no number of patches", quoted(text)))
    }

    fn patch(&mut self, number: usize, count: usize) -> Result<(BezierPatch, usize), String> {
        let degrees = self.next(|| format!("patch {number} of {count}"))?;
        let line = self.line;
        if !words(degrees).eq([b"3", b"3"]) {
            let degrees = quoted(degrees);
            return Err(format!("the degrees of patch {number} are {degrees}; only `3 3` is read"));
        }
        let mut points = [[Vec4::ZERO; 4]; 4];
        for (index, place) in points.as_flattened_mut().iter_mut().enumerate() {
            let text = self.next(|| format!("point {} of patch {number} of {count}", index + 1))?;
            *place = point(text)?;
        }
        Ok((BezierPatch { points }, line))
    }
}

/// A point in homogeneous coordinates.
fn point(text: &[u8]) -> Result<Vec4, String> {
    let wrong = || format!("{} is no point: three numbers, or four with a weight", quoted(text));
    let mut numbers = Vec::new();
    for word in words(text) {
        numbers.push(number(word).map_err(|why| format!("{}: {why}", wrong()))?);
    }
    match numbers[..] {
        [x, y, z] => Ok(Vec4::new(x, y, z, 1.0)),
        [x, y, z, w] => Ok((Vec3::new(x, y, z) * w).extend(w)),
        _ => Err(wrong()),
    }
}
