//! Bezier patch files: the number of patches, then for each patch its degrees, `3 3`, and its 16
//! control points row by row, three numbers each.
//!
//! Points may have four numbers, x y z w; they are then rational with weight w, a form that the
//! classic files do not have. Some files have the numbers of points, `4 4`, in place of the
//! degrees. The file is text, and `#` begins a comment.
//!
//! There are two layouts. With one point per line, points of three and of four numbers may be
//! mixed. In a free layout, with any white space between the numbers, all points must have equally
//! many numbers; the length of the file determines how many.

use crate::budget::{Budget, FACE};
use crate::read::text::{number, quoted, without_mark, words};
use glam::{Vec3, Vec4};
use std::borrow::Cow;
use tess_surface::BezierPatch;

/// The contents of a file.
#[derive(Debug, Default)]
pub(crate) struct Bpt {
    /// The patches.
    pub(crate) patches: Vec<BezierPatch>,
    /// The line of each patch's degrees, from 1.
    pub(crate) lines: Vec<usize>,
}

/// The number of a line, from 1, and its text without a comment.
type Line<'a> = (usize, Cow<'a, [u8]>);

/// Reads the patches. Errors: the first line that is malformed or missing.
pub(crate) fn parse(bytes: &[u8], budget: &Budget) -> Result<Bpt, String> {
    let with_lines = read(Box::new(lines(bytes).map(|(line, text)| (line, text.into()))), budget);
    with_lines.or_else(|error| match free_numbers(bytes)? {
        Some(numbers) => read(Box::new(points_of_words(bytes, numbers)), budget),
        None => Err(error),
    })
}

/// Reads a file that has one point per line.
fn read<'a>(
    lines: Box<dyn Iterator<Item = Line<'a>> + 'a>,
    budget: &Budget,
) -> Result<Bpt, String> {
    let mut reader = Reader { lines, line: 0 };
    let mut bpt = Bpt::default();
    let read = reader.file(&mut bpt, budget);
    // A fault of a file without any lines is reported for line 1.
    read.map_err(|what| format!("line {}: {what}", reader.line.max(1)))?;
    Ok(bpt)
}

/// The lines that have more than white space and a comment.
fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let lines = without_mark(bytes).split(|&byte| byte == b'\n').map(without_comment);
    (1..).zip(lines).filter(|(_, text)| !text.is_empty())
}

fn without_comment(line: &[u8]) -> &[u8] {
    let end = line.iter().position(|&byte| byte == b'#');
    line[..end.unwrap_or(line.len())].trim_ascii()
}

/// The number of coordinates of each point in a free layout; `None` if the layout is not free.
/// Errors: a file with several points on a line whose length does not fit its number of patches.
fn free_numbers(bytes: &[u8]) -> Result<Option<usize>, String> {
    let Some((line, first)) = lines(bytes).next() else { return Ok(None) };
    let Some(count) = words(first).next().and_then(count_of) else { return Ok(None) };
    let lengths = || lines(bytes).map(|(_, text)| words(text).count());
    let all = lengths().sum::<usize>() - 1;
    // Per patch: two words of degrees, and 16 points.
    let fits = |numbers: &usize| count.checked_mul(2 + 16 * numbers) == Some(all);
    let numbers = [3, 4].into_iter().find(fits);
    let has_lines = words(first).count() == 1 && lengths().all(|length| length <= 4);
    if numbers.is_none() && !has_lines {
        return Err(format!(
            "line {line}: the number of patches is {count}, and {all} words follow; each patch has 50, or 66 with \
             weights"
        ));
    }
    Ok(numbers)
}

/// The words of a free layout, rearranged to one point, or the degrees of one patch, per line.
fn points_of_words(bytes: &[u8], numbers: usize) -> impl Iterator<Item = Line<'_>> {
    let words = lines(bytes).flat_map(|(line, text)| words(text).map(move |word| (line, word)));
    let mut words = words.peekable();
    let mut lengths =
        std::iter::once(1).chain((0..17).map(move |k| if k == 0 { 2 } else { numbers }).cycle());
    std::iter::from_fn(move || {
        let &(line, _) = words.peek()?;
        let point: Vec<&[u8]> =
            words.by_ref().map(|(_, word)| word).take(lengths.next()?).collect();
        Some((line, point.join(&b' ').into()))
    })
}

/// Parses a number of patches, which must not be 0.
fn count_of(word: &[u8]) -> Option<usize> {
    let count = std::str::from_utf8(word).ok().and_then(|text| text.parse().ok());
    count.filter(|&count: &usize| count > 0)
}

/// The remaining lines, and the number of the last line read.
struct Reader<'a> {
    lines: Box<dyn Iterator<Item = Line<'a>> + 'a>,
    line: usize,
}

impl<'a> Reader<'a> {
    fn file(&mut self, bpt: &mut Bpt, budget: &Budget) -> Result<(), String> {
        let count = self.count()?;
        for number in 1..=count {
            let (patch, line) = self.patch(number, count)?;
            // The points, and what a face has.
            budget.charge(1, 256 + FACE, "patches")?;
            bpt.patches.push(patch);
            bpt.lines.push(line);
        }
        match self.lines.next() {
            None => Ok(()),
            Some((line, text)) => {
                self.line = line;
                Err(format!("{} follows the last of {count} patches", quoted(&text)))
            }
        }
    }

    fn next(&mut self, expected: impl Fn() -> String) -> Result<Cow<'a, [u8]>, String> {
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
        count_of(&text).ok_or_else(|| format!("{} is not a number of patches", quoted(&text)))
    }

    fn patch(&mut self, number: usize, count: usize) -> Result<(BezierPatch, usize), String> {
        let degrees = self.next(|| format!("patch {number} of {count}"))?;
        let line = self.line;
        if !words(&degrees).eq([b"3", b"3"]) && !words(&degrees).eq([b"4", b"4"]) {
            let degrees = quoted(&degrees);
            return Err(format!(
                "the degrees of patch {number} are {degrees}; they must be `3 3`, or `4 4` for the numbers of points"
            ));
        }
        let mut points = [[Vec4::ZERO; 4]; 4];
        for (index, place) in points.as_flattened_mut().iter_mut().enumerate() {
            let text = self.next(|| format!("point {} of patch {number} of {count}", index + 1))?;
            *place = point(&text)?;
        }
        Ok((BezierPatch { points }, line))
    }
}

/// Parses a point into homogeneous coordinates.
fn point(text: &[u8]) -> Result<Vec4, String> {
    let wrong = || format!("{} is not a point: three numbers, or four with a weight", quoted(text));
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
