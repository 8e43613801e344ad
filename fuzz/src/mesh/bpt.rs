//! Bezier patch files, and a reader that takes numbers as they come.

use super::{bits, names_a_line, without_mark, words_of};
use glam::{Vec3, Vec4};
use tess_program::fuzzing;
use tess_surface::{BezierPatch, Model};

/// Compares one file. Errors: the first difference, or a message that names no line.
pub fn check(data: &[u8]) -> Result<(), String> {
    let read = fuzzing::bpt(data);
    if let Ok(patches) = &read {
        // Refused or not, it must come to an end.
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
    // A patch is the line of its degrees and 16 points; before all there is their number.
    let lines: Vec<Vec<String>> = lines.map(words_of).filter(|words| !words.is_empty()).collect();
    let patches = lines.get(1..)?.chunks(17).map(|lines| {
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
