//! Bezier patch files: the number of patches, then for each its degrees, `3 3`, and its 16
//! control points row by row, three numbers each.
//!
//! Points may have four numbers, x y z w: then they are rational with weight w, a form that the
//! classic files do not know. The file is text; numbers are separated by blanks, one point a line.

use super::{read, refused};
use crate::failure::Failure;
use glam::{Vec3, Vec4};
use std::fmt::Display;
use std::path::Path;
use tess_surface::{BezierPatch, Model};

/// Lines that have anything on them, numbered from 1.
struct Lines<'a> {
    path: &'a Path,
    lines: Box<dyn Iterator<Item = (usize, &'a str)> + 'a>,
    /// The number of the last line that was read.
    line: usize,
}

/// Reads the patches.
pub(super) fn load(path: &Path) -> Result<Model, Failure> {
    let bytes = read(path)?;
    let text = std::str::from_utf8(&bytes).map_err(|error| {
        let line = bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count() + 1;
        Failure::bad_input(format!("{}: line {line}: not text", path.display()))
    })?;
    let numbered = text.lines().enumerate().map(|(number, line)| (number + 1, line.trim()));
    let lines = Box::new(numbered.filter(|(_, line)| !line.is_empty()));
    let mut lines = Lines { path, lines, line: 0 };
    let count = lines.count()?;
    let (mut patches, mut starts) = (Vec::new(), Vec::new());
    for number in 1..=count {
        let (patch, start) = lines.patch(number, count)?;
        patches.push(patch);
        starts.push(start);
    }
    lines.end(count)?;
    Model::bezier(patches).map_err(|error| {
        refused(path, error, |patch| format!("patch {} at line {}", patch + 1, starts[patch]))
    })
}

impl<'a> Lines<'a> {
    fn failure(&self, message: impl Display) -> Failure {
        Failure::bad_input(format!("{}: line {}: {message}", self.path.display(), self.line))
    }

    fn next(&mut self, expected: impl Fn() -> String) -> Result<&'a str, Failure> {
        match self.lines.next() {
            Some((line, text)) => {
                self.line = line;
                Ok(text)
            }
            None => {
                Err(self
                    .failure(format!("the file ends after this line; {} is missing", expected())))
            }
        }
    }

    fn count(&mut self) -> Result<usize, Failure> {
        let text = self.next(|| "the number of patches".to_owned())?;
        let count = text.parse().ok().filter(|&count: &usize| count > 0);
        count.ok_or_else(|| self.failure(format!("`{text}` is no number of patches")))
    }

    fn patch(&mut self, number: usize, count: usize) -> Result<(BezierPatch, usize), Failure> {
        let degrees = self.next(|| format!("patch {number} of {count}"))?;
        let start = self.line;
        if degrees.split_whitespace().ne(["3", "3"]) {
            let message =
                format!("the degrees of patch {number} are `{degrees}`; only `3 3` is read");
            return Err(self.failure(message));
        }
        let mut points = [[Vec4::ZERO; 4]; 4];
        for (index, point) in points.as_flattened_mut().iter_mut().enumerate() {
            let what = || format!("point {} of patch {number} of {count}", index + 1);
            let text = self.next(what)?;
            *point = self.point(text)?;
        }
        Ok((BezierPatch { points }, start))
    }

    /// A point in homogeneous coordinates.
    fn point(&self, text: &str) -> Result<Vec4, Failure> {
        let numbers: Option<Vec<f32>> =
            text.split_whitespace().map(|word| word.parse().ok()).collect();
        match numbers.as_deref() {
            Some(&[x, y, z]) => Ok(Vec4::new(x, y, z, 1.0)),
            Some(&[x, y, z, w]) => Ok((Vec3::new(x, y, z) * w).extend(w)),
            _ => {
                Err(self
                    .failure(format!("`{text}` is no point: three numbers, or four with a weight")))
            }
        }
    }

    fn end(&mut self, count: usize) -> Result<(), Failure> {
        match self.lines.next() {
            None => Ok(()),
            Some((line, text)) => {
                self.line = line;
                Err(self.failure(format!("`{text}` follows the last of {count} patches")))
            }
        }
    }
}
