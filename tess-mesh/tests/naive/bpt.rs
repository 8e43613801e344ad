//! Bezier patch files, and a reader that takes numbers in sequence.

use super::{bits, names_a_line, without_mark, words_of};
use tess_mesh::raw;
use tess_mesh::tess_surface::glam::{Vec3, Vec4};
use tess_mesh::tess_surface::{BezierPatch, Model};

/// Compares one file. Errors: the first difference, or a message that names no line.
pub(crate) fn check(data: &[u8]) -> Result<(), String> {
    let read = raw::bpt(data).map_err(|error| error.to_string());
    if let Ok(patches) = &read {
        // Refused or not, it must return.
        let _ = Model::bezier(patches.clone());
    }
    let words = |patches: &Vec<BezierPatch>| {
        let points = patches.iter().flat_map(|patch| patch.points.as_flattened());
        points.flat_map(|point| point.to_array()).map(bits).collect()
    };
    super::check(read, words, |message| names_a_line(message, data), || naive(data))
}

fn naive(data: &[u8]) -> Option<Vec<BezierPatch>> {
    let lines = without_mark(data).split(|&byte| byte == b'\n');
    let lines = lines.map(|line| line.split(|&byte| byte == b'#').next().unwrap_or_default());
    let lines: Vec<Vec<String>> = lines.map(words_of).filter(|words| !words.is_empty()).collect();
    let all: Vec<String> = lines.concat();
    let count: usize = all.first()?.parse().ok()?;
    // A patch is the line of its degrees and 16 points; the number of patches precedes them all.
    let has_right_length = |(k, line): (usize, &Vec<String>)| match k % 17 {
        0 => line.len() == 2,
        _ => matches!(line.len(), 3 | 4),
    };
    let has_points_on_lines = lines[0].len() == 1
        && lines.len() == 1 + 17 * count
        && lines[1..].iter().enumerate().all(has_right_length);
    let lines: Vec<Vec<String>> = if has_points_on_lines {
        lines[1..].to_vec()
    } else {
        let numbers = (all.len() - 1) / count;
        let mut rest = all[1..].iter().cloned();
        let mut line = |length: usize| rest.by_ref().take(length).collect();
        let length = |k: usize| if k.is_multiple_of(17) { 2 } else { (numbers - 2) / 16 };
        (0..17 * count).map(|k| line(length(k))).collect()
    };
    let patches = lines.chunks(17).map(|lines| {
        let points: Vec<Vec4> =
            lines[1..].iter().map(|words| point(words)).collect::<Option<_>>()?;
        let rows: Vec<[Vec4; 4]> = points.as_chunks().0.to_vec();
        Some(BezierPatch { points: rows.try_into().ok()? })
    });
    patches.collect()
}

fn point(words: &[String]) -> Option<Vec4> {
    let numbers: Option<Vec<f32>> = words.iter().map(|word| word.parse().ok()).collect();
    let numbers = numbers?;
    let weight = numbers.get(3).copied().unwrap_or(1.0);
    Some((Vec3::from_slice(numbers.get(..3)?) * weight).extend(weight))
}
